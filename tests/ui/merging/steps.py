"""What a person does in the window that compares and merges."""

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu
from pytestqt.qtbot import QtBot

from amp_studio.schema import Address, Value
from amp_studio.ui.merge.window import MergeWindow
from tests.ui.conftest import WAIT_MS

EXCESS = ("servo.excess_error", "1")
CALIBRATION = ("home.calibration", "1")
RAPID = ("feedrate.rapid", "1")


def show(displayed: MergeWindow, address: Address) -> None:
    """Make the row of a parameter the current one."""
    row = next(r for r in displayed.merge.rows if r.id.part == "value" and r.address == address)
    displayed.tree.show_row(row)
    assert displayed.tree.row() is row


def press(displayed: MergeWindow, key: str | Qt.Key) -> None:
    """Press a key in the tree."""
    displayed.tree.setFocus()
    QTest.keyClick(displayed.tree, key)


def click(displayed: MergeWindow, address: Address, column: int) -> None:
    """Click on the cell of a parameter."""
    show(displayed, address)
    index = displayed.tree.currentIndex().siblingAtColumn(column)
    place = displayed.tree.visualRect(index)
    QTest.mouseClick(
        displayed.tree.viewport(),
        Qt.MouseButton.LeftButton,
        pos=place.topLeft() + QPoint(16, place.height() // 2),
    )


def choose(displayed: MergeWindow, column: int, *path: str) -> None:
    """Choose a source in the menu over a column."""
    menu: QMenu | None = displayed.head.buttons[column].menu()
    displayed.head.buttons[column].fill()
    for name in path:
        assert menu is not None
        found = [a for a in menu.actions() if a.text().replace("&", "") == name]
        assert len(found) == 1, [a.text() for a in menu.actions()]
        menu = found[0].menu()
        if menu is None:
            found[0].trigger()


def is_read(displayed: MergeWindow) -> Callable[[], bool]:
    """Return a question: is nothing being read any more."""
    return lambda: not displayed._reading  # nothing outside shows the end of what is quick


def merge(displayed: MergeWindow, qtbot: QtBot) -> None:
    """Click on Merge as soon as the result has been checked."""
    qtbot.waitUntil(displayed.outcome.merge.isEnabled, timeout=WAIT_MS)
    displayed.outcome.merge.click()


def result(displayed: MergeWindow, address: Address) -> Value | None:
    """Return a value of the result."""
    return displayed.merge.result().get(address)
