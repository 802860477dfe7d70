"""A family that is nothing like the 9/PC: many axes that are always there, words of bits, texts."""

from pathlib import Path

import pytest

from amp_studio.files import Header, ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report import SORTS, Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.model import Grid
from amp_studio.report.output.text import render_text
from amp_studio.report.write import FORMATS
from amp_studio.schema import Schema, Value
from tests.campaigns import some


@pytest.fixture
def wide(wide_family: Schema) -> ParameterFile:
    file = ParameterFile(wide_family, Header(machine="small"))
    for n in range(12):
        file.set(("axis.position", str(n)), Value(n / 8, "mm"))
    file.set(("word.mode", "0"), Value(0b101001))
    file.set(("word.mode", "1"), Value(0))
    file.set(("machine.name", ""), Value(""))
    return file


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("sort", some(SORTS))
def test_it_is_printed_in_every_format_and_order(
    tmp_path: Path, wide: ParameterFile, ending: str, sort: Sort
) -> None:
    print_report(wide, tmp_path / f"r{ending}", Contents(sort))
    assert (tmp_path / f"r{ending}").stat().st_size > 500


def test_more_axes_than_a_page_is_wide_go_into_another_table(wide: ParameterFile) -> None:
    parts = build_report(wide).sections[0].parts
    assert [[c.text for c in p.columns] for p in parts if isinstance(p, Grid)] == [
        [f"Axis {n}" for n in range(8)],
        [f"Axis {n}" for n in range(8, 12)],
    ]
    assert [r.value for r in parts[1].rows] == ["1", "1.125", "1.25", "1.375"]


def test_a_value_of_no_axis_is_printed_once(wide: ParameterFile) -> None:
    anchors = [r.anchor for r in build_report(wide).rows()]
    assert len(anchors) == len(set(anchors)) == 16


def test_the_order_by_axis_has_every_axis(wide: ParameterFile) -> None:
    titles = [s.title for s in build_report(wide, Contents("axis")).sections]
    assert titles == [*(f"Axis {n}" for n in range(12)), "Non-axis parameters"]


def test_the_order_by_number_counts_within_a_number(wide: ParameterFile) -> None:
    numbers = [r.number for r in build_report(wide, Contents("number")).rows()]
    assert numbers == ["P2N0", "P2N1", "P2N2", *(f"P10N{n}" for n in range(12)), ""]


def test_the_bits_of_a_word_are_shown_in_words(wide: ParameterFile) -> None:
    rows = {r.anchor: r for r in build_report(wide).rows()}
    assert rows["word.mode@0"].detail == "bit 0: Axis turns; bit 3: Second gear; Loop: closed"
    assert rows["word.mode@1"].detail == "Loop: open"
    assert rows["word.mode@2"].detail == ""


def test_bits_that_one_lost_figure_would_name_have_its_name_once() -> None:
    file = new_file("57c422b")
    for instance, word in (("X", 0x11C), ("Y", 0x8)):
        file.set(("setup.drive", instance), Value(word))
    found = {row.instance: row.detail for row in build_report(file).rows() if row.id == "setup.drive"}
    assert found == {"X": "bits 2, 3, 4, 8: Unnamed (figure 4.2)", "Y": "bit 3: Unnamed (figure 4.2)"}


def test_a_bit_that_is_inferred_is_called_so() -> None:
    file = new_file("57c422b")
    file.set(("setup.switches", "X"), Value(0x4))
    rows = [row.detail for row in build_report(file).rows() if row.id == "setup.switches"]
    assert "Home in Negative Direction (inferred)" in rows[0]


def test_an_empty_text_is_not_taken_for_a_missing_one(wide: ParameterFile) -> None:
    report = build_report(wide)
    assert report.not_set == (("P2N2", "Mode word", "Word 2"),)
    assert {r.anchor: r.text for r in report.rows()}["machine.name@"] == "(empty)"


def test_a_family_without_an_axis_profile_has_no_axis_summary(wide: ParameterFile) -> None:
    report = build_report(wide)
    assert (report.axis_heads, report.axes) == ((), ())
    assert "Of unfitted axes, left out" not in dict(report.counts)


def test_a_number_that_is_a_name_is_whole_in_the_text() -> None:
    text = render_text(
        build_report(open_file(examples_folder() / "linuxcnc-mill" / "MILL.amp").file)
    ).decode()
    assert "\n[JOINT_0]MIN_LIMIT Least Position" in text
    assert "\n[SPINDLE_0]MIN_FORWARD_VELOCITY Least Speed" in text
