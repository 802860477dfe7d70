"""Every format in every order, for machines plain, odd and empty."""

import os
from datetime import datetime
from functools import cache
from pathlib import Path

import pytest

from amp_studio.files import Header, ParameterFile, SaveError, new_file
from amp_studio.report import SORTS, Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.model import Report
from amp_studio.report.write import FORMATS
from amp_studio.schema import Value, family_ids, load_schema
from tests.campaigns import CAMPAIGN

ODD = (
    '#panic("x") $x$ *b* _i_ `c` \\ " <script>alert(1)</script> &amp; {{ 1 }} {% if %} // /* @ref ='
    " \x00\x1b[2J\u202e 机 é"
)
"""What Typst, HTML, the template engine, a terminal or a printer could take for an order."""

STARTS = {
    ".pdf": b"%PDF-",
    ".html": b"<!DOCTYPE html>",
    ".csv": b"\xef\xbb\xbfnumber,",
    ".txt": b"=" * 100,
    ".xlsx": b"PK",
    ".json": b"{",
}


@pytest.fixture
def mill(small_mill: ParameterFile) -> ParameterFile:
    return small_mill.copy()


@cache
def new_machine(family: str, machine: str | None = None, *axes: str) -> ParameterFile:
    """Return a new file, the same one at each call: to be printed only."""
    return new_file(family, machine, axes)


@pytest.fixture
def built_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a report that another format has had too be the same one: the formats differ, not what is in
    them.
    """
    monkeypatch.setattr("amp_studio.report.write.build_report", _report_of)


_built: dict[tuple[ParameterFile, Contents], Report] = {}


def _report_of(file: ParameterFile, contents: Contents, **options: object) -> Report:
    if (file, contents) not in _built:
        _built[file, contents] = build_report(file, contents, **options)
    return _built[file, contents]


@pytest.mark.usefixtures("built_once")
@pytest.mark.parametrize(
    ("ending", "changed_only", "sort"),
    [
        (ending, changed_only, sort)
        for n, (ending, changed_only) in enumerate(
            [*((ending, True) for ending in FORMATS if ending != ".pdf"), (".txt", False), (".html", False)]
        )
        for at, sort in enumerate(SORTS)
        if CAMPAIGN or (n + at) % len(SORTS) == 0
    ],
)
def test_a_new_file_is_printed_in_every_format_and_order(
    tmp_path: Path, ending: str, sort: Sort, changed_only: bool
) -> None:
    path = tmp_path / f"report{ending}"
    print_report(new_machine("9pc", "mill", *"XYZBS"), path, Contents(sort, changed_only))
    assert path.read_bytes().startswith(STARTS[ending])
    assert list(tmp_path.iterdir()) == [path], "nothing else may be left in the folder, not even a backup"


EVERY_FAMILY = [
    (family, ending, tuple(SORTS)[n % len(SORTS)])
    for n, family in enumerate(family_ids())
    for at, ending in enumerate(FORMATS)
    if CAMPAIGN or (n + at) % 4 == 0
]
"""Each family in one or two formats, in a campaign in each; the orders in turn, as every format prints the
same rows. Of the PDF `make campaign` sets all values: those of the examples are set by their pages
(tests/docs/test_commands.py).
"""


@pytest.mark.usefixtures("built_once")
@pytest.mark.parametrize(("family", "ending", "sort"), EVERY_FAMILY)
def test_every_family_is_printed(tmp_path: Path, family: str, ending: str, sort: Sort) -> None:
    path = tmp_path / f"report{ending}"
    print_report(new_machine(family), path, Contents(sort, changed_only=ending == ".pdf" and not CAMPAIGN))
    assert path.read_bytes().startswith(STARTS[ending])


@pytest.mark.parametrize("ending", FORMATS)
def test_a_file_without_a_single_value_is_printed(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"report{ending}"
    for changed_only in (False, True) if CAMPAIGN else (False,):
        print_report(ParameterFile(load_schema("9pc"), Header()), path, Contents(changed_only=changed_only))
        assert path.read_bytes().startswith(STARTS[ending])


@pytest.mark.parametrize(
    ("ending", "sort"), [(ending, tuple(SORTS)[n % len(SORTS)]) for n, ending in enumerate(FORMATS)]
)
def test_no_text_of_a_file_is_taken_for_an_order(
    tmp_path: Path, mill: ParameterFile, ending: str, sort: Sort
) -> None:
    mill.header.name = mill.header.notes = mill.header.revision = ODD
    mill.header.notes = "= not a heading\n- not a list\n" + ODD + "W" * 300
    mill.forced[("servo.gain_break_point", "1")] = ODD
    mill.unknown[ODD] = "1"
    path = tmp_path / f"report{ending}"
    contents = Contents(sort, changed_only=ending == ".pdf")  # the odd texts are not among the other values
    print_report(mill, path, contents, source=tmp_path / ("n" * 120 + "#.amp"))
    content = path.read_bytes()
    assert content.startswith(STARTS[ending])
    if ending == ".html":
        assert b"<script>alert" not in content
    if ending in (".html", ".txt", ".json"):
        assert not {0x00, 0x1B} & set(content), "no sign may steer a terminal or a printer"


@pytest.mark.parametrize("ending", FORMATS)
def test_the_same_file_on_the_same_date_gives_the_same_report(
    tmp_path: Path, mill: ParameterFile, date: datetime, ending: str
) -> None:
    contents = Contents(changed_only=True, without=frozenset() if CAMPAIGN else frozenset({"pictures"}))
    for name in ("one", "two"):
        print_report(mill.copy(), tmp_path / f"{name}{ending}", contents, date=date)
    assert (tmp_path / f"one{ending}").read_bytes() == (tmp_path / f"two{ending}").read_bytes()


def test_a_report_that_exists_is_replaced(tmp_path: Path, mill: ParameterFile) -> None:
    path = tmp_path / "report.TXT"
    path.write_text("old")
    print_report(mill, path)
    assert path.read_bytes().startswith(STARTS[".txt"])
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["report.doc", "report", "report.pdf.bak"])
def test_another_ending_is_refused_in_one_sentence(tmp_path: Path, mill: ParameterFile, name: str) -> None:
    with pytest.raises(
        ValueError,
        match=r"unknown report format\. Use the file extension \.pdf, \.html, \.xlsx, \.csv, \.json, \.txt",
    ) as refused:
        print_report(mill, tmp_path / name)
    assert "\n" not in str(refused.value)
    assert list(tmp_path.iterdir()) == []


def test_another_order_is_refused(tmp_path: Path, mill: ParameterFile) -> None:
    with pytest.raises(ValueError, match=r"Unknown order 'name'\. Known: axis, number, group"):
        print_report(mill, tmp_path / "report.txt", Contents("name"))


def test_a_folder_that_is_not_there_is_shown_in_one_sentence(tmp_path: Path, mill: ParameterFile) -> None:
    with pytest.raises(SaveError, match=r"report\.txt cannot be written: No such file or directory"):
        print_report(mill, tmp_path / "nowhere" / "report.txt")


def test_writing_a_report_changes_nothing_in_the_file(
    tmp_path: Path, mill: ParameterFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "amp_studio.report.output.pdf.set_pdf", lambda source, options: (b"%PDF-", "")
    )  # knows no file
    before, forced = dict(mill.values), dict(mill.forced)
    for ending in FORMATS if CAMPAIGN else (".html", ".pdf"):
        print_report(mill, tmp_path / f"report{ending}")
    assert (mill.values, mill.forced) == (before, forced)
    assert mill.get(("home.calibration", "1")) == Value(12.5, "mm")


@pytest.mark.parametrize("ending", [".pdf", ".json", ".html"])
def test_a_name_that_is_no_text_here_is_printed_as_far_as_it_is_one(
    ending: str, mill: ParameterFile, tmp_path: Path
) -> None:
    """As every name with an umlaut is where the locale is C without UTF-8, or one of an old disk is."""
    source = tmp_path / os.fsdecode(b"m\xfcl-\xc3\xbc.amp")
    print_report(mill, tmp_path / f"mill{ending}", source=source)
    content = (tmp_path / f"mill{ending}").read_bytes()
    assert content.startswith(STARTS[ending])
    assert ending == ".pdf" or "m\ufffdl-\xfc.amp" in content.decode("utf-8")
