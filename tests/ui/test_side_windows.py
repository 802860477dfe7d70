"""The windows beside the table: a command that is given again brings its window back, and one that is closed
leaves nothing behind.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QDialog, QWidget

from amp_studio.ui.main_window import MainWindow

COMMANDS = {
    "edit.steps": "StepList",
    "edit.quick": "QuickEdit",
    "edit.calculator": "CalculatorDialog",
    "edit.tables": "TablesDialog",
    "axis.compare": "AxisComparison",
    "view.settings": "SettingsDialog",
    "file.compare": "MergeWindow",
    "file.migrate": "MigrationWindow",
    "project.compare": "MachinesDialog",
}
"""What opens a window beside the table -> its class."""


@pytest.fixture
def quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let nothing be simulated: only the windows count."""
    nothing: Iterator[object] = iter(())
    monkeypatch.setattr("amp_studio.ui.motion.check_page.check_motion", lambda _file: nothing)


def beside(window: MainWindow) -> list[QWidget]:
    """Return the windows and dialogs of a main window, those that are hidden too."""
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    direct = Qt.FindChildOption.FindDirectChildrenOnly
    found = window.findChildren(QWidget, options=direct)
    return [each for each in found if isinstance(each, QDialog) or each.windowType() == Qt.WindowType.Window]


def test_each_command_has_one_window_that_goes_when_it_is_closed(window: MainWindow, quiet: None) -> None:
    for _ in range(3):
        for command in COMMANDS:
            window.menus[command].trigger()
    opened = beside(window)
    assert sorted(type(each).__name__ for each in opened) == sorted(COMMANDS.values())
    for each in opened:
        each.close()
    assert beside(window) == []


def test_what_belongs_to_a_value_follows_the_selection(window: MainWindow, quiet: None) -> None:
    window.menus["edit.calculator"].trigger()
    (first,) = beside(window)
    window.go_to(("servo.excess_error", "2"))
    window.menus["edit.calculator"].trigger()
    (second,) = beside(window)
    assert second is not first, "its result would go to the value that was selected before"


def test_each_file_has_its_windows(window: MainWindow, quiet: None, path: Path) -> None:
    second = path.with_name("second.amp")
    second.write_bytes(path.read_bytes())
    window.menus["edit.steps"].trigger()
    window.open_first(second)
    window.menus["edit.steps"].trigger()
    assert [each.windowTitle() for each in beside(window)] == ["Steps: mill.amp", "Steps: second.amp"]
    window.files.close()
    assert [each.windowTitle() for each in beside(window)] == ["Steps: mill.amp"]
