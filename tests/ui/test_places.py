"""Back and forward through the places that were visited, the manual beside the table,
and what is seen while a file is opened.
"""

from pathlib import Path

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtWidgets import QApplication, QLabel

from amp_studio.ui.dialogs.manual_window import ManualWindow
from amp_studio.ui.main_window import MainWindow

EXCESS, RAPID, HOME = ("servo.excess_error", "1"), ("feedrate.rapid", "1"), ("home.calibration", "2")


@pytest.fixture
def manual(window: MainWindow) -> ManualWindow:
    window.menus["help.tutorial"].trigger()
    (opened,) = window.beside.of(ManualWindow)
    return opened


def test_back_and_forward_go_through_the_groups_that_were_visited(window: MainWindow) -> None:
    for address in (EXCESS, RAPID, HOME, ("home.calibration", "3")):
        window.go_to(address)
    back, forward = window.menus["view.back"], window.menus["view.forward"]
    back.trigger()
    assert (window.selected(), window.page.listed_title) == (RAPID, "Feedrate Parameters")
    back.trigger()
    assert window.selected() == EXCESS
    forward.trigger()
    forward.trigger()
    assert window.selected() == ("home.calibration", "3"), "moving within a group is no new place"
    forward.trigger()
    assert window.statusBar().currentMessage() == "This is the place that was visited last."
    window.visited.menu.aboutToShow.emit()
    listed = [action.text() for action in window.visited.menu.actions()]
    assert listed[0] == "&1 mill: Home Parameters, 3300 Home Calibration"
    assert len(listed) == len(set(listed)) >= 3


def test_back_leaves_the_page_at_the_control_first(window: MainWindow) -> None:
    window.go_to(EXCESS)
    window.go_to(RAPID)
    window.control.show("compare")
    window.menus["view.back"].trigger()
    assert (window.control.is_shown, window.selected()) == (False, RAPID)


@pytest.mark.own_window
def test_back_and_forward_go_through_the_pages_too(window: MainWindow) -> None:
    """From Motion back chose another group in the table behind it, and showed Motion still."""
    window.go_to(EXCESS)
    window.go_to(RAPID)
    for name in ("view.motion", "view.tuning"):
        window.menus[name].trigger()
    back, forward = window.menus["view.back"], window.menus["view.forward"]
    seen = []
    for action in (back, back, back, forward, forward):
        action.trigger()
        seen.append((window.page_in_front.turned_to, window.selected()))
    assert seen == [("motion", RAPID), ("", RAPID), ("", EXCESS), ("", RAPID), ("motion", RAPID)]
    window.visited.menu.aboutToShow.emit()
    assert [action.text() for action in window.visited.menu.actions()][:2] == [
        "&1 mill: Tuning",
        "&2 mill: Motion",
    ]


def test_the_manual_has_its_pages_with_links_and_a_search(manual: ManualWindow) -> None:
    assert manual.text.toPlainText().startswith("A first mill to zero errors")
    manual.search.setText("lost motion")
    found = [item.text(0) for item in manual.items() if not item.isHidden()]
    assert 0 < len(found) < 10
    manual.search.setText("zyx")
    assert manual.bar.text.text() == "No page has all of these words: leave one out."
    manual.search.clear()
    manual.text.anchorClicked.emit(QUrl("howto/first-download.md"))
    assert manual.text.toPlainText().startswith("Make the first download")
    manual.text.anchorClicked.emit(QUrl("../reference/index.md"))
    assert "made for the site" in manual.bar.text.text()


def test_a_file_that_is_opened_at_the_start_is_named_before_it_is_there(qapp: QApplication) -> None:
    window = MainWindow(opening=[str(Path("hall") / "mill.amp"), "lathe.amp"])
    page = window.centre.currentWidget()
    assert isinstance(page, QLabel)
    assert page.text() == "Opening mill.amp and 1 more …"
    window.show_values()
    assert window.centre.currentWidget() is window.welcome
    window.close()
    window.deleteLater()
