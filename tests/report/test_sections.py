"""The three orders of the documenter, and what is left out of them."""

from datetime import datetime
from itertools import pairwise
from pathlib import Path

import pytest

from amp_studio.files import (
    ParameterFile,
    ProjectInfo,
    content_of,
    digest_of,
    fitted_axes,
    new_file,
    open_file,
)
from amp_studio.files.example_files import examples_folder
from amp_studio.files.notes import set_group_note, set_machine_note, set_value_note
from amp_studio.files.storage import save_file
from amp_studio.report import SORTS, Contents
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.model import Grid, Listing, ReportRow
from amp_studio.report.output.page import render_html
from amp_studio.report.output.pdf import typst_source
from amp_studio.report.output.text import render_text
from amp_studio.report.sections import number_key
from amp_studio.schema import Value
from tests.campaigns import some

pytestmark = pytest.mark.usefixtures("without_pictures")


def row_with(number: str) -> ReportRow:
    return ReportRow(
        id="a.b",
        instance="",
        number=number,
        name="",
        group="",
        place="",
        is_set=False,
        is_number=False,
        value="",
        unit="",
        shown_unit="",
        figure="",
        also="",
        entered="",
        no_default=False,
        detail="",
        default="",
        plain_default="",
        is_changed=False,
        state="in-force",
        why="",
        state_mark="",
        forced="",
    )


def rows_by_anchor(file: ParameterFile) -> dict[str, ReportRow]:
    return {r.anchor: r for r in build_report(file, Contents("number")).rows()}


# -- orders --------------------------------------------------------------------


def test_numbers_are_sorted_as_numbers_and_what_has_none_comes_last() -> None:
    ordered = ["2", "11", "1300", "2300", "20020", "P2N9", "P2N10", "P21N3", "Pr61", "R3", "R2051", ""]
    backwards = ordered[::-1]
    assert ordered == sorted(backwards, key=lambda n: number_key(row_with(n)))


def test_the_order_by_number_runs_through_all_axes(mill: ParameterFile) -> None:
    numbers = [int(r.number) for r in build_report(mill, Contents("number")).rows() if r.number]
    assert all(a <= b for a, b in pairwise(numbers))
    assert {1300, 2300, 3300, 4300} <= set(numbers)


def test_the_order_by_axis_has_each_fitted_axis_and_then_the_rest(mill: ParameterFile) -> None:
    sections = build_report(mill, Contents("axis")).sections
    assert [s.title for s in sections] == [
        "Axis X (1 linear)",
        "Axis Y (2 linear)",
        "Axis Z (3 linear)",
        "Axis B (4 rotary)",
        "Axis S (5 spindle)",
        "Non-axis parameters",
    ]
    for axis, section in zip("12345", sections[:-1], strict=True):
        assert {r.instance for part in section.parts for r in part.rows} == {axis}
    rest = {(r.id, r.instance) for part in sections[-1].parts for r in part.rows}
    assert {mill.evaluation.scope(address) for address in rest} <= {"global", "process", "spindle"}


def test_the_order_by_group_is_the_manuals_with_an_axis_a_column(mill: ParameterFile) -> None:
    report = build_report(mill, Contents("group"))
    groups = list(dict.fromkeys(g.name for g in mill.schema.groups))
    assert [s.title for s in report.sections] == [
        g for g in groups if g in {s.title for s in report.sections}
    ]
    home = next(s for s in report.sections if s.title == "Home Parameters").parts[0]
    assert isinstance(home, Grid)
    assert [c.text for c in home.columns] == [
        "X 1 linear",
        "Y 2 linear",
        "Z 3 linear",
        "B 4 rotary",
        "S 5 spindle",
    ]
    line = next(n for n in home.lines if n.name == "Home Calibration")
    assert (line.number, line.shown_unit) == ("1300, 2300 … 4300", "mm")
    assert [line.cell_text(r) if r else None for r in line.cells][:4] == ["12.5", "−2.54", "0", "0°"]


def test_the_parts_of_a_long_group_stay_together(mill: ParameterFile) -> None:
    servo = next(s for s in build_report(mill).sections if s.title == "Servo Parameters")
    assert [p.title for p in servo.parts][:2] == [
        "SERCOS and General Servo Parameters",
        "Position Loop Parameters",
    ]


def test_a_value_of_no_axis_spans_the_columns(mill: ParameterFile) -> None:
    parts = [p for s in build_report(mill).sections for p in s.parts]
    spanning = {n.name for p in parts if isinstance(p, Grid) for n in p.lines if n.spans}
    assert "Control Type" in spanning
    assert any(isinstance(p, Listing) for p in parts), "a group without an axis parameter needs no columns"


# -- what is printed -----------------------------------------------------------


@pytest.mark.parametrize("sort", some(SORTS))
def test_every_existing_value_of_a_fitted_axis_is_printed_once(mill: ParameterFile, sort: Sort) -> None:
    printed = [(r.id, r.instance) for r in build_report(mill, Contents(sort, inactive=True)).rows()]
    axes = fitted_axes(mill)
    for parameter, instance in mill.addresses():
        if mill.schema.parameters[parameter].optional and (parameter, instance) not in mill.values:
            continue  # entries of a table are printed if they are set
        layout = mill.machine_schema.layout(mill.schema.parameters[parameter])
        is_fitted = layout is None or layout.scope != "axis" or instance in axes
        exists = mill.evaluation.state((parameter, instance)).state != "hidden"
        assert printed.count((parameter, instance)) == int(is_fitted and exists), (parameter, instance)


def test_what_is_left_out_is_counted(mill: ParameterFile) -> None:
    report = build_report(mill, Contents(inactive=True))
    counts = dict(report.counts)
    reported = sum(int(counts[k]) for k in ("Values", "Hidden, left out", "Of unfitted axes, left out"))
    axes = fitted_axes(mill)
    empty = [a for a in mill.addresses() if mill.schema.parameters[a[0]].optional and a not in mill.values]
    entries = [a for a in empty if mill.evaluation.scope(a) != "axis" or a[1] in axes]
    assert reported + len(entries) == len(mill.addresses())
    assert int(counts["Values"]) == len(list(report.rows()))


@pytest.mark.parametrize("sort", some(SORTS))
def test_changed_only_keeps_what_differs_from_the_printed_default(mill: ParameterFile, sort: Sort) -> None:
    changed = {r.anchor for r in build_report(mill, Contents(sort, changed_only=True)).rows()}
    everything = build_report(mill, Contents(sort))
    assert changed == {r.anchor for r in everything.rows() if r.is_changed or r.no_default}
    assert {"home.calibration@1", "home.calibration@2", "servo.gain_break_point@1"} <= changed
    assert "home.calibration@3" not in changed
    assert all(
        part.rows for s in build_report(mill, Contents(sort, changed_only=True)).sections for part in s.parts
    )


def test_marks_report_changed_forced_and_ignored_apart(mill: ParameterFile) -> None:
    rows = {r.anchor: r for r in build_report(mill, Contents(inactive=True)).rows()}
    assert rows["home.calibration@1"].marks == "*"
    assert rows["home.calibration@3"].marks == ""
    assert rows["servo.gain_break_point@1"].marks == "*!"
    ignored = next(r for r in rows.values() if r.state == "ignored")
    assert ignored.state_mark.startswith("i")
    assert ignored.why
    assert rows["axis.name@1"].marks == "n", "set, and the manual prints no default for it"


def test_each_reason_has_one_number_and_is_below_its_table(mill: ParameterFile) -> None:
    report = build_report(mill, Contents(inactive=True))
    reasons = {r.state_mark: r.why for r in report.rows() if r.state_mark}
    assert len(set(reasons.values())) == len(reasons)
    for section in report.sections:
        for part in section.parts:
            assert {m for m, _ in part.reasons} == {r.state_mark for r in part.rows if r.state_mark}


def test_a_number_that_belongs_to_another_parameter_is_not_printed(mill: ParameterFile) -> None:
    schema = mill.schema
    disputed = [r for r in rows_by_anchor(mill).values() if schema.on(mill.machine).is_disputed(r.id)]
    assert all(r.number == "" for r in disputed)


# -- around the values ---------------------------------------------------------


def test_the_axes_are_summed_up(mill: ParameterFile) -> None:
    report = build_report(mill)
    assert report.axis_heads == (
        "Axis",
        "Name",
        "Axis Type",
        "Servo Hardware Type",
        "Servo Loop Type",
        "Values",
        "Changed",
        "Findings",
    )
    assert [line[:2] for line in report.axes] == [("1", "X"), ("2", "Y"), ("3", "Z"), ("4", "B"), ("5", "S")]
    assert "error" in report.axes[0][-1], "the value forced out of range is a finding of axis 1"


def test_forced_values_findings_and_missing_values_are_listed(mill: ParameterFile) -> None:
    report = build_report(mill)
    assert [(r.number, r.text, r.forced) for r in report.forced] == [
        ("1730", "999999 mm", "by J. Fitter on 2026-07-01")
    ]
    assert ("2735", "Inposition Band", "Y") in report.not_set
    about = (("servo.gain_break_point@1", "1730 Gain Break Point"),)
    error = next(n for n in report.severities()["error"] if n.about == about)
    assert error.page == "7-22"
    assert error.place == "X"
    assert error.fix == "", "nobody can know which value within the range was meant"
    assert "It was forced by J. Fitter on 2026-07-01" in error.message


def test_the_same_sentence_about_several_axes_is_shown_once(mill: ParameterFile) -> None:
    before = [n for n in build_report(mill).notes if n.about and n.about[0][0].startswith("home.calibration")]
    assert before == []
    for axis in "23":
        mill.set(("home.calibration", axis), Value(1.05e6, "mm"))
    found = [n for n in build_report(mill).notes if n.about and n.about[0][0].startswith("home.calibration")]
    assert [(n.place, n.count, n.fix) for n in found] == [
        ("Y, Z", 2, "2300, 3300 Home Calibration = 999999.99 mm")
    ]
    assert found[0].about == (("home.calibration@2", "2300"), ("home.calibration@3", "3300 Home Calibration"))


def test_a_forced_value_is_not_forgotten(mill: ParameterFile) -> None:
    """Neither one of an axis that is not fitted nor one that is the printed default."""
    mill.forced[("home.calibration", "8")] = mill.forced[("home.calibration", "3")] = "by hand"
    report = build_report(mill, Contents(changed_only=True))
    assert {"home.calibration@3", "home.calibration@8"} <= {r.anchor for r in report.forced}
    assert "home.calibration@3" in {r.anchor for r in report.rows()}


def test_the_facts_name_the_file_and_its_checksum(
    tmp_path: Path, mill: ParameterFile, date: datetime
) -> None:
    path = tmp_path / "mill.amp"
    save_file(mill, path)
    report = build_report(mill, source=path, date=date)
    facts = dict(report.machine + report.facts)
    assert facts["File"] == "mill.amp"
    assert len(facts["SHA-256 without the secret values"]) == 64
    assert facts["Schema signature"] == mill.schema.signature[:16]
    assert facts["Machine type"] == "Mill"
    assert facts["Axes"] == "5 of 8 fitted"
    assert build_report(mill, source=path, date=date).when == "2026-07-01 14:05"


def test_a_checksum_is_never_printed_beside_other_values_unsaid(tmp_path: Path, mill: ParameterFile) -> None:
    path = tmp_path / "mill.amp"
    save_file(mill, path)
    mill.set(("home.calibration", "1"), Value(13.0, "mm"))
    assert "unsaved changes" in checksum(mill, path)[1]
    path.write_bytes(b"cut off")
    assert "cannot be read" in checksum(mill, path)[1]
    assert "not saved yet" in checksum(mill)[1]


def checksum(file: ParameterFile, path: Path | None = None) -> tuple[str, str]:
    return next(fact for fact in build_report(file, source=path).facts if "SHA-256" in fact[0])


def test_passwords_cannot_be_tried_against_the_checksum_of_a_report(
    tmp_path: Path, mill: ParameterFile
) -> None:
    path, printed = tmp_path / "mill.amp", []
    for code in (77, 78, None):
        mill.set(("password.character", "1"), None if code is None else Value(code))
        path.write_bytes(content_of(mill))
        printed += [checksum(mill, path), checksum(mill)]
    assert set(printed[:-2]) <= {
        ("SHA-256 without the secret values", printed[0][1]),
        ("SHA-256 without the secret values", printed[0][1] + " (not saved yet)"),
    }
    mill.set(("home.calibration", "1"), Value(13.0, "mm"))
    path.write_bytes(content_of(mill))
    assert checksum(mill, path)[1] != printed[0][1]


def test_a_file_without_secrets_has_its_own_checksum(tmp_path: Path, mill: ParameterFile) -> None:
    path = tmp_path / "mill.amp"
    for instance in "123456":
        mill.set(("password.character", instance), None)
    save_file(mill, path)
    assert checksum(mill, path) == ("SHA-256 of the file", str(digest_of(path)))


def test_a_file_of_another_schema_is_reported(mill: ParameterFile) -> None:
    mill.header.signature = "0" * 64
    assert "the file was written under 0000000000000000" in dict(build_report(mill).facts)["Schema signature"]


def test_a_saved_file_prints_as_it_did_in_memory(tmp_path: Path, mill: ParameterFile) -> None:
    from amp_studio.files import read_content

    again = read_content(tmp_path / "mill.amp", content_of(mill))
    assert list(build_report(again).rows()) == list(build_report(mill).rows())


def test_a_machine_type_without_axes_of_its_own_prints_too() -> None:
    report = build_report(new_file("9pc", "lathe", ["X", "Z"]))
    assert [line[1] for line in report.axes] == ["X", "Z"]


def test_notes_of_machine_group_and_value_are_printed(mill: ParameterFile) -> None:
    set_machine_note(mill, "Rebuilt in 2019.")
    set_group_note(mill, "home", "Switches are new.")
    set_value_note(mill, ("home.calibration", "1"), "Measured by J. Fitter.")
    report = build_report(mill)
    assert report.remarks == "Rebuilt in 2019."
    assert [text for _, text in report.remarked] == ["Switches are new.", "Measured by J. Fitter."]
    row = next(r for r in report.rows() if r.anchor == "home.calibration@1")
    assert row.small_print == "Note: Measured by J. Fitter."
    assert b"Switches are new." in render_text(report)
    assert b"Switches are new." in render_html(report)


def test_the_cover_has_the_project_beside_a_machine_of_another_name(mill: ParameterFile) -> None:
    def names(name: str, project: str) -> list[tuple[str, str]]:
        mill.header.name = name
        return list(build_report(mill, project=ProjectInfo(project, "9pc", builder="Works")).machine[:3])

    machine = ("Machine", "Mill 7")
    assert names("Mill 7", "Hall 2") == [machine, ("Project", "Hall 2"), ("Builder", "Works")]
    assert names("Mill 7", "Mill 7")[:2] == names("", "Mill 7")[:2] == [machine, ("Builder", "Works")]


def test_figures_of_a_table_have_their_decimal_signs_below_each_other(mill: ParameterFile) -> None:
    grid = next(s for s in build_report(mill).sections if s.title == "Home Parameters").parts[0]
    assert isinstance(grid, Grid)
    line = next(n for n in grid.lines if n.name == "Home Calibration")
    assert [r.whole for r in line.cells if r][:3] == ["12", "−2", "0"]
    assert grid.widest == max(len(r.whole) for r in grid.rows)
    feed = next(n for n in grid.lines if n.name == "Dir to Move Off Limit Switch")
    assert {r.whole for r in feed.cells if r} == {""}, "a choice is no figure"
    source = typst_source(build_report(mill))
    assert '"−2.54", "−2", ' in source


def test_a_word_of_bits_is_decoded_once_below_its_table() -> None:
    file = open_file(examples_folder() / "57c422b-label-press/LABEL_PRESS.amp").file
    report = build_report(file, Contents(language="de"))
    axis = report.sections[0].parts[0]
    word = next(w for w in axis.words if w.name == "Switch Setup")
    assert word.number == "R2, R2050"
    assert [(place, value) for place, value, _ in word.values] == [(("X",), "0x011C"), (("Y",), "0x001D")]
    assert "Bit 8: Use Drive Fault Input (gefolgert)" in word.values[0][2]
    again = next(w for s in report.sections for p in s.parts for w in p.words if w.name == "Mode")
    assert [place for place, _, _ in again.values] == [("X", "Y")], "one value has its meaning once"
    for made in (render_text(report).decode(), render_html(report).decode(), typst_source(report)):
        assert " ".join(made.split()).count("Direction: positive") == 1
