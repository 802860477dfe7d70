"""A commissioning with keys alone, and how many clicks a download takes."""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QWidget
from pytestqt.qtbot import QtBot

from amp_studio.schema import Value
from amp_studio.ui.control.page import ControlPage
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.main_window import MainWindow

from .at_control import at_control, settled
from .conftest import WAIT_MS, Control, User, action, on_disk

EXCESS = ("servo.excess_error", "1")
BAND = ("servo.inposition_band", "1")


class Hands:
    """Presses keys where the keyboard is, and nowhere else."""

    @property
    def here(self) -> QWidget:
        """The widget that has the keyboard."""
        found = QApplication.focusWidget()
        assert found is not None, "the keyboard is nowhere"
        return found

    def press(self, *keys: str) -> None:
        for key in keys:
            pressed = QKeySequence(key)[0]
            QTest.keyClick(self.here, pressed.key(), pressed.keyboardModifiers())

    def enter(self, text: str) -> None:
        for letter in text:  # the first opens an editor, which gets the rest
            for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
                # keyClick takes the first byte of its UTF-8 for a letter that is not ASCII.
                QApplication.sendEvent(self.here, QKeyEvent(kind, 0, Qt.KeyboardModifier.NoModifier, letter))

    def go_to(self, name: str, key: str = "Tab") -> None:
        """Press Tab until the keyboard is at what a screen reader calls so."""
        for _ in range(40):
            text = self.here.text() if isinstance(self.here, QAbstractButton) else ""
            if name in (self.here.accessibleName() or text):
                return
            self.press(key)
        raise AssertionError(f"no way with {key} to {name}")


def the_project_is_opened(hands: Hands, window: MainWindow, qtbot: QtBot) -> None:
    hands.press("Ctrl+Shift+P")
    hands.enter("open project")
    hands.press("Return")
    qtbot.waitUntil(lambda: window.workspace is not None, timeout=WAIT_MS)
    qtbot.waitUntil(lambda: QApplication.focusWidget() is window.table_view, timeout=WAIT_MS)


def a_value_is_found_changed_and_its_finding_fixed(hands: Hands, window: MainWindow, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: window.finder._finder() is not None, timeout=WAIT_MS)
    hands.press("Ctrl+K")
    hands.enter("1750")
    hands.press("Return")
    assert window.selected() == EXCESS
    hands.enter("0.5")
    hands.press("Return")
    assert window.workspace.file.get(EXCESS) == Value(0.5, "mm")
    assert window.workspace.count("error") == 1
    hands.press("Alt+Down", "F8")
    assert window.workspace.count("error") == 0
    assert window.workspace.file.get(EXCESS) == Value(11.66667, "mm")
    hands.press("Ctrl+S")
    assert not window.workspace.is_dirty


def it_is_sent(hands: Hands, window: MainWindow, qtbot: QtBot) -> ControlPage:
    hands.press("F5")
    page = settled(window, qtbot)
    assert hands.here is page.table
    hands.press("F5")
    assert page.session.phase == "ready", "what can be dangerous is not checked"
    hands.go_to("I have checked what can be dangerous")
    hands.press("Space", "F5")
    return settled(window, qtbot)


def it_is_verified(hands: Hands, page: ControlPage, window: MainWindow, qtbot: QtBot) -> None:
    assert page.session.phase == "done", page.bar.text.text()
    assert hands.here is page.primary
    hands.go_to("Read Again", "Shift+Tab")
    hands.press("Space")
    settled(window, qtbot)
    assert "Nothing differs" in page.empty.text()
    hands.press("Escape")
    assert hands.here is window.table_view


def the_report_is_written(hands: Hands, path: Path, qtbot: QtBot) -> None:
    def fill_in() -> None:
        assert isinstance(QApplication.activeModalWidget(), ReportDialog)
        hands.go_to("File")
        hands.press("Ctrl+A")
        hands.enter(str(path))
        hands.press("Return")

    QTimer.singleShot(200, fill_in)
    hands.press("Ctrl+P")
    qtbot.waitUntil(path.exists, timeout=WAIT_MS)


def test_a_commissioning_with_keys_alone(
    open_window: Callable[..., MainWindow],
    start_control: Callable[..., Control],
    user: User,
    example: bytes,
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    path = tmp_path / "Büro" / "mill.amp"
    path.parent.mkdir()
    path.write_bytes(example)
    control = start_control()
    path.with_name("project.yaml").write_text(
        f"amp_studio_project: 1\nname: MILL\nfamily: 9pc\nmachine: mill\ncontrol: {control.address}\n"
    )
    window, hands = open_window(), Hands()
    user.chooses(path.parent)
    the_project_is_opened(hands, window, qtbot)
    a_value_is_found_changed_and_its_finding_fixed(hands, window, qtbot)
    page = it_is_sent(hands, window, qtbot)
    it_is_verified(hands, page, window, qtbot)
    the_report_is_written(hands, path.with_suffix(".csv"), qtbot)
    assert on_disk(path).get(EXCESS) == Value(11.66667, "mm")


def test_a_new_machine_with_keys_alone(
    open_window: Callable[..., MainWindow], user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    """From the welcome to the table of the new file, and into a page and back."""
    window, hands = open_window(), Hands()
    user.chooses(tmp_path / "FIRST.amp")

    def fill_in() -> None:
        dialog = QApplication.activeModalWidget()
        if not isinstance(dialog, NewFileDialog) or QApplication.focusWidget() is None:
            QTimer.singleShot(50, fill_in)
            return
        try:
            hands.go_to("Name")
            hands.press("Ctrl+A")
            hands.enter("FIRST")
            hands.press("Return")
        except AssertionError:
            dialog.reject()  # else it waits for ever
            raise

    QTimer.singleShot(50, fill_in)
    hands.press("Ctrl+N")
    qtbot.waitUntil(lambda: window.workspace is not None, timeout=WAIT_MS)
    qtbot.waitUntil(lambda: QApplication.focusWidget() is window.table_view, timeout=WAIT_MS)
    hands.press("Alt+4")
    qtbot.waitUntil(lambda: window.page_in_front.turned_to == "tuning", timeout=WAIT_MS)
    assert hands.here is not window.table_view
    hands.press("Escape")
    assert hands.here is window.table_view


@pytest.mark.parametrize("name", ["Motion", "Tuning", "Check in Motion", "Blocks and Programs"])
def test_the_keyboard_is_nowhere_where_it_is_not_seen(window: MainWindow, name: str, qtbot: QtBot) -> None:
    """Tab went from the last button on to the table behind the page, where keys changed nothing one saw."""
    hands = Hands()
    action(window, name).trigger()
    qtbot.waitUntil(lambda: QApplication.focusWidget() is not None, timeout=WAIT_MS)
    stops: list[QWidget] = []
    while hands.here not in stops:
        assert hands.here.isVisible(), f"after {len(stops)} Tabs"
        stops.append(hands.here)
        hands.press("Tab")
    assert len(stops) > 5


def test_a_changed_value_is_at_the_control_after_two_clicks_and_one_look(
    window: MainWindow, start_control: Callable[..., Control], qtbot: QtBot, path: Path
) -> None:
    """From an open file whose control is known: the tool bar, a look, the button, which saves too."""
    control = start_control(file=window.workspace.file.copy())
    at_control(window, control.address, "send", qtbot)
    window.control.leave()
    window.edits.commit(BAND, "0.03 mm")
    clicks = 0

    def click(button: QWidget) -> None:
        nonlocal clicks
        assert button.isVisible()
        assert button.isEnabled()
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        clicks += 1

    click(window.tools.widgetForAction(window.menus["control.page"]))
    page = settled(window, qtbot)
    (row,) = page.table.rows.values()
    assert (row.difference.address, row.takes_file) == (BAND, True), "the look"
    assert page.primary.text() == "Save and Send 1 Value to the Control"
    click(page.primary)
    settled(window, qtbot)
    assert page.session.phase == "done", page.bar.text.text()
    assert on_disk(path).get(BAND) == Value(0.03, "mm")
    assert clicks == 2


def test_a_second_click_of_the_tool_bar_sends_nothing(
    window: MainWindow, start_control: Callable[..., Control], qtbot: QtBot
) -> None:
    control = start_control(file=window.workspace.file.copy())
    window.edits.commit(BAND, "0.03 mm")
    page = at_control(window, control.address, "send", qtbot)
    assert page.primary.isEnabled()
    window.menus["control.page"].trigger()
    assert settled(window, qtbot).session.phase == "ready"
    assert window.workspace.is_dirty


@pytest.mark.parametrize("name", ["At the Control", "Motion"])
def test_no_command_changes_values_that_are_not_seen(window: MainWindow, name: str, qtbot: QtBot) -> None:
    """F8 and Clear were taken by the hidden table while another page was in front."""
    window.go_to(EXCESS)
    window.edits.commit(EXCESS, "0.5 mm")
    action(window, name).trigger()
    steps = window.workspace.undo_stack.index()
    for each in ("edit.clear", "edit.fix", "edit.default", "edit.all_axes", "guide.done"):
        assert not window.menus[each].isEnabled(), each
        window.menus[each].trigger()
    qtbot.waitUntil(lambda: QApplication.focusWidget() is not None, timeout=WAIT_MS)
    Hands().press("F8")
    assert window.workspace.undo_stack.index() == steps
    window.menus["view.findings"].trigger()
    assert window.page_in_front.findings.isVisible(), (
        "what is shown beside the values brings them to the front"
    )
    assert window.menus["edit.clear"].isEnabled()
