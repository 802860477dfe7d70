"""The axis menu: name, configure type and servo, copy, delete; each one step."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import Value
from amp_studio.ui.actions import axis
from amp_studio.ui.dialogs.axis_dialogs import AxisDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User, action


def choose(dialog: AxisDialog, axis: str, **labels: str) -> None:
    """Choose an axis and, by the last word of a parameter's id, its choices."""
    dialog.form.set_answer("axis", axis)
    for parameter_id in dialog.form.editors:
        label = labels.get(parameter_id.rpartition(".")[2])
        if label:
            dialog.form.set_answer(parameter_id, label)


def test_a_dialog_begins_with_the_selected_axis(window: MainWindow) -> None:
    window.go_to(("home.calibration", "3"))
    assert axis._dialog(window, "Name Axis").axis() == "3"
    window.go_to(("zone.group_count", "2"))
    assert axis._dialog(window, "Name Axis").axis() == "1", "a process is no axis"


def test_name(window: MainWindow, file: ParameterFile, accept) -> None:
    accept(AxisDialog, lambda d: choose(d, "1", name="U"))
    action(window, "Name Axis").trigger()
    assert file.get(("axis.name", "1")) == Value("u")
    assert window.table.column_head(window.table.columns.index("1")) == ("U", "1 linear")


def test_configure_type_takes_the_units_along_as_one_step(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    before = dict(file.values)
    accept(AxisDialog, lambda d: choose(d, "2", type="rotary"))
    action(window, "Configure Axis Type").trigger()

    assert file.get(("axis.type", "2")) == Value("rotary")
    assert file.get(("servo.excess_error", "2")).unit == "deg"
    assert window.workspace.undo_stack.count() == 1
    window.menus["edit.undo"].trigger()
    assert file.values == before


def test_tab_goes_through_the_fields_before_the_buttons(window: MainWindow, qtbot) -> None:
    dialog = axis._dialog(window, "Configure Servo")
    dialog.ask_for(["servo.hardware_type", "servo.loop_type"])
    dialog.show()
    dialog.form.editors["axis"].setFocus()
    for parameter_id, row in (("servo.hardware_type", 0), ("servo.loop_type", 1)):
        QTest.keyClick(dialog.focusWidget(), Qt.Key.Key_Tab)
        field = dialog.form.editors[parameter_id]
        assert dialog.focusWidget() is field
        field.setCurrentIndex(row)
        QTest.keyClick(field, Qt.Key.Key_Down)
        assert field.currentIndex() == row + 1
    dialog.close()


def test_configure_servo(window: MainWindow, file: ParameterFile, accept) -> None:
    accept(
        AxisDialog,
        lambda d: choose(d, "1", hardware_type="SERCOS Interface", loop_type="Position or Analog Spindle"),
    )
    action(window, "Configure Servo").trigger()
    assert file.get(("servo.loop_type", "1")) == Value("analog")


def test_copy(window: MainWindow, file: ParameterFile, accept) -> None:
    window.edits.commit(("servo.excess_error", "1"), "3 mm")
    accept(AxisDialog, lambda d: choose(d, "1"))
    action(window, "Copy Axis").trigger()
    assert file.get(("servo.excess_error", "2")) == Value(3.0, "mm")
    assert file.get(("axis.name", "2")) == Value("y")
    assert "Copy axis 1 to 2" in window.menus["edit.undo"].text()


def test_axes_of_two_types_are_not_copied(
    window: MainWindow, file: ParameterFile, monkeypatch, user: User
) -> None:
    before = dict(file.values)

    def run(dialog: AxisDialog) -> int:
        choose(dialog, "1")
        dialog.form.editor("target", QComboBox).setCurrentIndex(3)
        return 1

    monkeypatch.setattr(AxisDialog, "exec", run)
    action(window, "Copy Axis").trigger()
    assert "only axes of the same type can be copied" in user.reads()
    assert file.values == before


def test_delete(window: MainWindow, file: ParameterFile, accept) -> None:
    before = dict(file.values)
    accept(AxisDialog, lambda d: choose(d, "5"))
    action(window, "Delete Axis").trigger()
    assert fitted_axes(file) == ("1", "2", "3", "4")
    assert "5" not in window.table.columns
    window.menus["edit.undo"].trigger()
    assert file.values == before
    assert "5" in window.table.columns


@pytest.mark.parametrize("machine", ["Lathe", "Mill"])
def test_control_type_is_in_the_options(window: MainWindow, file: ParameterFile, machine: str) -> None:
    action(window, machine).trigger()
    assert file.machine == machine.casefold()
