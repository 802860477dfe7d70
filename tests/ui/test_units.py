"""Switching units changes what is shown, never what is stored."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.parameter_table import ParameterTable

from .conftest import editor

EXCESS = ("servo.excess_error", "1")


def test_the_switch_changes_the_display_and_no_value(window: MainWindow, workspace: Workspace) -> None:
    before = dict(workspace.file.values)
    window.go_to(EXCESS)
    assert window.table.index_of(EXCESS).data() == "11 mm"

    window.menus["view.switch_units"].trigger()

    assert window.table.index_of(EXCESS).data() == "0.433070866 in"
    assert workspace.file.values == before
    assert "inch" in window.status.file.text()
    assert [a.isChecked() for a in window.menus.menu("view.units").actions()] == [False, True]
    window.menus["view.switch_units"].trigger()
    assert window.table.index_of(EXCESS).data() == "11 mm"
    assert not workspace.is_dirty


def test_the_unit_system_belongs_to_the_file_and_is_saved_with_it(
    window: MainWindow, workspace: Workspace, path
) -> None:
    window.menus["view.switch_units"].trigger()
    assert workspace.is_dirty
    assert window.save()
    assert b"units: inch" in path.read_bytes()
    assert not workspace.is_dirty


def test_a_bare_number_has_the_unit_that_is_shown(window: MainWindow, workspace: Workspace) -> None:
    window.menus["view.switch_units"].trigger()
    assert window.edits.commit(EXCESS, "0.3")
    assert workspace.file.get(EXCESS) == Value(0.3, "in")

    window.menus["view.switch_units"].trigger()
    assert window.table.shown_value(EXCESS) == "7.62 mm"
    assert window.edits.commit(EXCESS, "8")
    assert workspace.file.get(EXCESS) == Value(8.0, "mm")


def test_as_entered_a_bare_number_stays_in_the_unit_it_is_shown_in(
    window: MainWindow, workspace: Workspace
) -> None:
    """12 typed over 10 in/min means inches: it must not become 12 mm/min."""
    home_speed = ("home.speed_off_switch", "1")
    assert window.edits.commit(home_speed, "10 ipm")
    window.menus["view.as_entered"].trigger()
    assert window.table.shown_value(home_speed) == "10 in/min"

    assert window.edits.commit(home_speed, "12")

    assert workspace.file.get(home_speed) == Value(12.0, "in/min")
    assert "as entered" in window.status.file.text()


def test_a_value_in_its_own_unit_loses_no_digit(table: ParameterTable, workspace: Workspace) -> None:
    """2147483647 is shown as it is, and so is a length of twelve digits."""
    calibration = ("home.calibration", "1")
    counts = ("servo.position_counts", "1")
    workspace.edit("exact", {calibration: Value(123456.789012, "mm")})
    workspace.edit("many", {counts: Value(2147483647, "counts")}, force="on a day")
    assert table.index_of(calibration).data() == "123\u202f456.789012 mm"
    assert table.typed_value(calibration) == "123456.789012 mm"
    assert table.index_of(counts).data() == "2\u202f147\u202f483\u202f647 counts"


def test_an_editor_that_is_left_as_it_was_changes_nothing(window: MainWindow, workspace: Workspace) -> None:
    """What is shown in inches is rounded; taking it over would change the value."""
    window.menus["view.switch_units"].trigger()
    window.go_to(EXCESS)
    QTest.keyClick(window.table_view, Qt.Key.Key_F2)
    assert editor(window).text() == "0.433070866 in"
    QTest.keyClick(editor(window), Qt.Key.Key_Return)
    assert workspace.file.get(EXCESS) == Value(11.0, "mm")


def test_a_converted_value_reports_what_was_entered(table: ParameterTable, workspace: Workspace) -> None:
    workspace.edit("inch", {EXCESS: Value(0.3, "in")})
    index = table.index_of(EXCESS)
    assert index.data() == "7.62 mm"
    assert "Entered as 0.3 in" in index.data(Qt.ItemDataRole.ToolTipRole)


def test_the_menu_checks_the_state_after_an_undo(window: MainWindow, workspace: Workspace) -> None:
    lathe, mill = window.menus.menu("view.machine").actions()
    lathe.trigger()
    assert workspace.file.machine == "lathe"
    assert lathe.isChecked()

    workspace.undo_stack.undo()
    assert workspace.file.machine == "mill"
    assert mill.isChecked()
    assert not lathe.isChecked()


def test_options_stay_when_another_file_is_opened(window: MainWindow, path) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    window.menus["view.unfitted_axes"].trigger()
    window.menus["view.as_entered"].trigger()

    window.files.open_path(other)

    assert window.table.shows_every_axis
    assert window.workspace.as_entered
    assert len(window.menus.menu("view.units").actions()) == 2
