"""Plain text of 100 columns, and the literal writing of Typst."""

import re
from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import ParameterFile
from amp_studio.report import SORTS, Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.findings.printed_finding import PrintedFinding
from amp_studio.report.model import Listing, Report, ReportRow, Section
from amp_studio.report.output.pdf import typst_literal, typst_source
from amp_studio.report.output.text import render_text
from tests.campaigns import CAMPAIGN, some

pytestmark = pytest.mark.usefixtures("without_pictures")


def row(number: str, name: str, value: str, **more: object) -> ReportRow:
    known: dict[str, object] = {
        "id": name,
        "instance": "",
        "number": number,
        "name": name,
        "group": "Home",
        "place": "",
        "is_set": True,
        "is_number": True,
        "value": value,
        "figure": value,
        "unit": "mm",
        "shown_unit": "mm",
        "also": "",
        "entered": "",
        "detail": "",
        "no_default": False,
        "default": "0",
        "plain_default": "0",
        "is_changed": False,
        "state": "in-force",
        "why": "",
        "state_mark": "",
        "forced": "",
    }
    return ReportRow(**(known | more))


SMALL = Report(
    title="Mill 7",
    family="9/PC",
    file_name="mill.amp",
    date=datetime(2026, 7, 1, 14, 5, tzinfo=UTC),
    program="AMP Studio",
    contents=Contents("axis"),
    machine=(("Machine", "Mill 7"),),
    facts=(("Units", "metric"),),
    help={},
    pictures=(),
    motion=(),
    exchanges=(),
    tunings=(),
    counts=(("Values", "3"),),
    remarks="",
    remarked=(),
    axis_heads=("Axis", "Name"),
    axes=(("1", "X"),),
    notes=(
        PrintedFinding(
            "error", 1, "Axis 1 X", (("a@1", "1300 Home Calibration"),), "Too far.", "1300 = 0 mm", "5-10"
        ),
    ),
    dangers=(),
    forced=(),
    power_up=(),
    not_set=(("1004", "G30 Position", "Axis 1 X"),),
    sections=(
        Section(
            "axis-1",
            "Axis 1 X",
            (
                Listing(
                    "Home",
                    (
                        row("1300", "Home Calibration", "12.5", is_changed=True),
                        row(
                            "1310",
                            "A name that is far too long for the column that names have in this table of"
                            " ours",
                            "0",
                        ),
                        row(
                            "",
                            "Home Direction",
                            "Negative direction off the switch, then the first marker",
                            unit="",
                            shown_unit="",
                            default="–",
                            state="ignored",
                            why="the axis is not homed",
                            state_mark="i1",
                        ),
                    ),
                    by_place=False,
                ),
            ),
        ),
    ),
)


def test_a_small_report_to_the_letter() -> None:
    said = render_text(SMALL).decode().splitlines()
    values = said[said.index("AXIS 1 X") + 2 : said.index("SIGNATURES") - 1]
    assert values == [
        "Home",
        "----",
        "Number   Parameter                                     Value                     Default",
        "1300     Home Calibration                              12.5 mm                   0             *",
        "1310     A name that is far too long for the column    0 mm                      0",
        "         that names have in this table of ours",
        "–        Home Direction                                Negative direction off    –             i1",
        "                                                       the switch, then the",
        "                                                       first marker",
        "  i1 the axis is not homed",
        "",
    ]
    findings = said[said.index("FINDINGS") + 2 : said.index("NOT SET") - 2]
    assert findings == [
        "1 error",
        "  - Axis 1 X: Too far. (page 5-10)",
        "    about  1300 Home Calibration",
        "    fix    1300 = 0 mm",
    ]
    assert "Machine ...................... Mill 7" in said
    assert any(re.fullmatch(r"Released by _+  Date _+", line) for line in said)


@pytest.mark.parametrize("sort", some(list(SORTS)[:: 1 if CAMPAIGN else 2], 2))
def test_no_line_is_wider_than_the_paper_and_every_value_is_there(
    tmp_path: Path, eight_axes: ParameterFile, sort: Sort
) -> None:
    print_report(eight_axes, tmp_path / "r.txt", Contents(sort), source=tmp_path / ("n" * 150 + ".amp"))
    lines = (tmp_path / "r.txt").read_text("utf-8").splitlines()
    assert max(len(line) for line in lines) <= 100
    assert all(line == line.rstrip() for line in lines)
    firsts = [line.split(" ", 1)[0] for line in lines]
    for printed in build_report(eight_axes, Contents(sort)).rows():
        assert (printed.number or "–") in firsts, printed.number


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_a_typst_literal_is_one_string_whatever_it_holds(text: str) -> None:
    literal = typst_literal(text)
    assert re.fullmatch(r'"(?:[^"\\]|\\["\\])*"', literal), (
        "a quote or a backslash that stands alone would end it"
    )
    assert all(c.isprintable() or c in "\u200b\u00a0\u2066\u2068\u2069" for c in literal)


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_places_to_break_add_nothing_else(text: str) -> None:
    plain = "".join(c if c.isprintable() or c == "\u00a0" else " " for c in text)
    read = re.sub(r"\\(.)", r"\1", typst_literal(text)[1:-1].replace("\u200b", ""))
    assert read == plain


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("[TRAJ]MAX_LINEAR_ACCELERATION", ["[", "TRAJ]", "MAX_", "LINEAR_", "ACCELERATION"]),
        ("0123456789abcdef01", ["01234567", "89abcdef", "01"]),
        ("-123456.78901234567", ["-123456.", "78901234", "567"]),
        ("zu wenig Reserve: Ms 2,37, Amplitudenreserve, 3 dB", None),
    ],
)
def test_a_word_is_broken_where_a_reader_would_part_it(text: str, lines: list[str] | None) -> None:
    assert typst_literal(text) == f'"{(chr(0x200B).join(lines) if lines else text)}"'


def test_every_text_of_a_report_reaches_typst_as_a_literal(mill: ParameterFile) -> None:
    mill.header.name = 'Mill #evil() "quoted" \\'
    source = typst_source(build_report(mill))
    assert source.count("#evil") == source.count('"Mill #evil() \\"quoted\\" \\\\')
