"""Values are edited as one undoable step each; undo gives exactly the file before,
findings and marks with it.
"""

from collections.abc import Callable

import pytest
from PySide6.QtGui import QGuiApplication

from amp_studio.files import ParameterFile, RangeError, copy_axis, delete_axis, retype_axis
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.validate import Validator

CALIBRATION = ("home.calibration", "1")
EXCESS = ("servo.excess_error", "1")

Whole = Callable[[], tuple[object, ...]]


def a_value(w: Workspace) -> None:
    w.edit("value", {EXCESS: Value(3.0, "mm")})


def not_set(w: Workspace) -> None:
    w.edit("unset", {EXCESS: None})


def axis_type(w: Workspace) -> None:
    w.do("type", lambda: retype_axis(w.file, "2", "rotary"))


def axis_type_in_the_table(w: Workspace) -> None:
    w.edit("type", {("axis.type", "2"): Value("rotary")})


def copied_axis(w: Workspace) -> None:
    w.edit("value", {EXCESS: Value(3.0, "mm"), ("axis.type", "6"): Value("linear")})
    w.do("copy", lambda: copy_axis(w.file, "1", "6"))


def deleted_axis(w: Workspace) -> None:
    w.do("delete", lambda: delete_axis(w.file, "1"))


def control_type(w: Workspace) -> None:
    w.edit("lathe", {("control.type", ""): Value("lathe")})


def forced(w: Workspace) -> None:
    w.edit("force", {CALIBRATION: Value(1e9, "mm")}, force="on a day")


def forced_then_mended(w: Workspace) -> None:
    forced(w)
    w.edit("mend", {CALIBRATION: Value(1.0, "mm")})


def facts(w: Workspace) -> None:
    w.do("facts", lambda: vars(w.file.header).update(name="other", notes="two\nlines"))


STEPS = [
    a_value,
    not_set,
    axis_type,
    axis_type_in_the_table,
    copied_axis,
    deleted_axis,
    control_type,
    forced,
    forced_then_mended,
    facts,
]


@pytest.mark.parametrize("step", STEPS)
def test_undo_gives_exactly_the_file_before_and_redo_the_file_after(
    step: Callable[[Workspace], None], workspace: Workspace, whole: Whole
) -> None:
    before = whole()
    step(workspace)
    after = whole()
    assert after != before
    steps = workspace.undo_stack.count()

    for _ in range(2):
        for _ in range(steps):
            workspace.undo_stack.undo()
        assert whole() == before
        assert not workspace.is_dirty
        for _ in range(steps):
            workspace.undo_stack.redo()
        assert whole() == after


def test_an_axis_that_turns_takes_its_figures_along_in_degrees(
    workspace: Workspace, file: ParameterFile
) -> None:
    pitch = ("servo.lead_screw_pitch", "2")
    figure = file.values[pitch].value

    axis_type(workspace)

    assert file.values[pitch] == Value(figure, "deg")


def test_an_operation_that_fails_in_the_middle_changes_nothing(workspace: Workspace, whole: Whole) -> None:
    before = whole()

    def fail() -> None:
        workspace.file.set(EXCESS, Value(5.0, "mm"))
        raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        workspace.do("fails", fail)

    assert whole() == before
    assert workspace.undo_stack.count() == 0


def test_an_operation_that_fails_puts_marks_and_facts_back(workspace: Workspace, whole: Whole) -> None:
    forced(workspace)
    before = whole()
    assert workspace.file.forced == {CALIBRATION: "on a day"}

    def fail() -> None:
        workspace.file.set_checked({CALIBRATION: Value(1.0, "mm"), EXCESS: Value(-1e9, "mm")}, force="later")
        workspace.file.header.notes = "half done"
        assert workspace.file.forced == {EXCESS: "later"}
        raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        workspace.do("fails", fail)

    assert whole() == before
    workspace.undo_stack.undo()
    workspace.undo_stack.redo()
    assert whole() == before


def test_what_changes_nothing_is_no_step(workspace: Workspace) -> None:
    assert not workspace.edit("same", {EXCESS: workspace.file.get(EXCESS)})
    assert workspace.undo_stack.count() == 0


def test_out_of_range_is_refused_unless_it_is_forced(workspace: Workspace, whole: Whole) -> None:
    before = whole()

    with pytest.raises(RangeError):
        workspace.edit("value", {CALIBRATION: Value(1e9, "mm")})

    assert whole() == before


def test_out_of_range_asks_and_nothing_is_the_answer(
    window: MainWindow, workspace: Workspace, user, whole: Whole
) -> None:
    before = whole()
    user.answers("Cancel")

    assert not window.edits.commit(CALIBRATION, "99999999")

    assert "is outside" in user.asked[0]
    assert whole() == before


def test_forcing_takes_the_value_and_marks_it(
    window: MainWindow, file: ParameterFile, workspace: Workspace, user
) -> None:
    user.answers("Force and Mark")

    assert window.edits.commit(CALIBRATION, "99999999")

    assert file.get(CALIBRATION) == Value(99999999.0, "mm")
    assert "in the studio" in file.forced[CALIBRATION]
    sentence = [f.message for f in workspace.findings_of(CALIBRATION)]
    assert any("It was forced" in message for message in sentence)


def test_what_is_no_number_is_reported_and_changes_nothing(window: MainWindow, user, whole: Whole) -> None:
    before = whole()

    assert not window.edits.commit(CALIBRATION, "abc")

    assert user.reads() == "1300 Home Calibration: 'abc' is not a number.\n\nNothing was changed."
    assert whole() == before


def test_a_decimal_comma_is_a_decimal_comma(window: MainWindow, file: ParameterFile) -> None:
    """0,5 must not become 5."""
    assert window.edits.commit(CALIBRATION, "0,5")
    assert file.get(CALIBRATION) == Value(0.5, "mm")


def test_default_and_not_set_by_the_menu(window: MainWindow, file: ParameterFile, user) -> None:
    window.go_to(EXCESS)
    window.edits.range.to_default()
    assert file.get(EXCESS) == file.default(EXCESS)

    window.edits.range.clear()
    assert file.get(EXCESS) is None

    no_default = next(
        a
        for a in file.addresses()
        if file.default(a) is None and file.evaluation.state(a).state == "in-force"
    )
    before = file.get(no_default)
    window.go_to(no_default)
    window.guarded(window.edits.range.to_default)
    assert "No default is printed" in user.reads()
    assert file.get(no_default) == before


def test_a_value_goes_to_all_axes_of_the_type(window: MainWindow, file: ParameterFile) -> None:
    window.edits.commit(EXCESS, "4 mm")
    rotary = file.get(("servo.excess_error", "4"))
    window.go_to(EXCESS)

    window.edits.range.to_all_axes()

    assert [file.get(("servo.excess_error", a)) for a in "123"] == [Value(4.0, "mm")] * 3
    assert file.get(("servo.excess_error", "4")) == rotary


def test_a_value_of_a_process_is_no_value_of_an_axis(window: MainWindow, user) -> None:
    """Instance 1 of a process comes beside instance 1 of an axis, not in its place."""
    window.go_to(("zone.group_count", "1"))
    window.guarded(window.edits.range.to_all_axes)
    assert user.reads() == "Select a value of a fitted axis first."


def test_copy_and_paste_a_value(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    window.edits.range.copy()
    assert QGuiApplication.clipboard().text() == "11 mm"

    window.go_to(("servo.gain_break_point", "2"))
    QGuiApplication.clipboard().setText("3,5 mm")
    window.edits.range.paste()
    assert file.get(("servo.gain_break_point", "2")) == Value(3.5, "mm")


def test_without_a_selected_value_the_clipboard_stays(window: MainWindow, user) -> None:
    QGuiApplication.clipboard().setText("3,5 mm")
    view = window.page_in_front.table_view
    view.selectionModel().clear()
    window.guarded(window.edits.range.copy)
    assert user.reads() == "Select a value in the table first."
    assert QGuiApplication.clipboard().text() == "3,5 mm"


def test_one_key_fixes_the_selected_finding_and_undo_takes_it_back(
    window: MainWindow, workspace: Workspace
) -> None:
    window.edits.commit(EXCESS, "0.1 mm")
    finding = next(f for f in workspace.findings if f.fix and f.severity == "error")
    row = workspace.findings.index(finding)
    window.findings.show_all()
    window.findings.select(finding)
    before = dict(workspace.file.values)

    window.edits.fix_selected()

    assert all(workspace.file.get(r.address) == r.value for r in finding.fix)
    assert finding not in workspace.findings
    workspace.undo_stack.undo()
    assert workspace.file.values == before
    assert workspace.findings[row] == finding


def test_the_findings_follow_each_edit_and_equal_a_full_run(window: MainWindow, workspace: Workspace) -> None:
    edits = [
        {EXCESS: Value(0.1, "mm")},
        {("axis.type", "3"): Value("unfitted")},
        {("servo.position_loop_type", "2"): Value("open")},
        {("control.type", ""): Value("lathe")},
        {("axis.type", "1"): Value("rotary")},
        {("servo.hardware_type", "2"): None},
    ]
    for wanted in edits:
        workspace.edit("edit", wanted)
        assert workspace.findings == Validator(workspace.file).run()
    for _ in edits:
        workspace.undo_stack.undo()
        assert workspace.findings == Validator(workspace.file).run()
