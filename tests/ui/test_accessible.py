"""Every part of the window that takes the keyboard has a name for a screen reader."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication, QWidget

from amp_studio.ui.main_window import MainWindow


def nameless(window: QWidget) -> list[str]:
    """Return the classes of the visible parts that take the focus and have no accessible name."""
    found = (
        part
        for part in window.findChildren(QWidget)
        if part.isVisible() and part.focusPolicy() != Qt.FocusPolicy.NoFocus
    )
    named = ((part, QAccessible.queryAccessibleInterface(part)) for part in found)
    return [
        f"{type(part).__name__} in {type(part.parent()).__name__}"
        for part, interface in named
        if interface is not None and not interface.text(QAccessible.Text.Name)
    ]


def test_every_part_of_the_window_has_a_name(window: MainWindow) -> None:
    window.edits.commit(("servo.excess_error", "1"), "5 mm")
    window.go_to(("servo.excess_error", "1"))
    QApplication.processEvents()
    assert nameless(window) == []


def test_every_part_of_the_first_page_has_a_name(open_window) -> None:
    window = open_window()
    QApplication.processEvents()
    assert nameless(window) == []


def test_a_message_is_announced_with_its_words(window: MainWindow) -> None:
    window.page.bar.say("The file was saved.", "information")
    interface = QAccessible.queryAccessibleInterface(window.page.bar)
    assert interface.text(QAccessible.Text.Description) == "The file was saved."


def test_a_row_of_the_findings_is_read_with_its_severity_and_axes(window: MainWindow) -> None:
    window.edits.commit(("servo.excess_error", "1"), "5 mm")
    window.findings.show_all()
    text = window.findings.model.index(0, 0).data(Qt.ItemDataRole.AccessibleTextRole)
    assert text.startswith("error: At rapid 10\u202f000 mm/min")
    assert text.endswith("(X)")
