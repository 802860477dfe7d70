"""The frame of the window: tool bar, tabs, status bar, and what a small window does with its panels."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import content_of, new_file
from amp_studio.ui.forms.segment import Segment
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.window.tab_end import TabEnd

from .conftest import WAIT_MS, action

EXCESS = ("servo.excess_error", "1")


def displayed(window: MainWindow, width: int, height: int) -> None:
    """Give the window a size and let everything find its place."""
    window.resize(width, height)
    QApplication.processEvents()


def test_a_narrow_window_has_the_parameter_beside_the_findings(window: MainWindow) -> None:
    displayed(window, 1024, 700)
    assert not window.findChild(QDockWidget, "Parameter").isVisible()
    assert window.table_view.width() > 700
    window.docks.chooser.buttons["Parameter"].click()
    assert window.detail.isVisible()
    assert not window.findings.isVisible()
    window.show_panel("Findings")
    assert window.findings.isVisible()

    displayed(window, 1300, 700)
    assert window.findChild(QDockWidget, "Parameter").isVisible()
    assert window.detail.isVisible()
    assert window.findings.isVisible()
    assert not window.docks.chooser.isVisible()


def test_a_key_shows_the_parameter_also_in_a_narrow_window(window: MainWindow) -> None:
    displayed(window, 1024, 700)
    window.show_panel("Parameter")
    assert window.detail.isVisible()


def test_a_very_narrow_window_keeps_its_table_and_shows_the_left_on_demand(window: MainWindow) -> None:
    displayed(window, 800, 640)
    assert not window.groups.isVisible()
    assert window.table_view.width() > 700
    window.show_panel("Groups")
    assert window.groups.isVisible()


def test_a_low_window_folds_the_findings_to_their_head(window: MainWindow) -> None:
    displayed(window, 1300, 600)
    assert not window.findings.isVisible()
    assert window.table_view.height() > 300
    window.show_panel("Findings")
    assert window.findings.isVisible()
    displayed(window, 1300, 700)
    assert window.findings.isVisible()


def test_a_panel_that_was_closed_by_hand_stays_closed_when_the_window_grows(window: MainWindow) -> None:
    window.findChild(QDockWidget, "Parameter").close()
    displayed(window, 1024, 700)
    displayed(window, 1300, 700)
    assert not window.findChild(QDockWidget, "Parameter").isVisible()


def test_tools_have_words_only_where_there_is_room(window: MainWindow) -> None:
    styles = Qt.ToolButtonStyle
    displayed(window, 1600, 900)
    assert window.tools.toolButtonStyle() == styles.ToolButtonTextBesideIcon
    displayed(window, 1024, 700)
    assert window.tools.toolButtonStyle() == styles.ToolButtonIconOnly
    control = window.tools.widgetForAction(window.menus["control.page"])
    assert control.toolButtonStyle() == styles.ToolButtonTextBesideIcon, "the control keeps its name"
    assert control.geometry().right() <= window.tools.width()


def test_the_segment_of_units_shows_and_switches_them(window: MainWindow) -> None:
    units = window.tools.units
    assert [button.text() for button in units.buttons.values()] == ["mm", "inch"]
    assert units.choice == "metric"
    units.buttons["inch"].click()
    assert window.workspace.file.header.units == "inch"
    window.menus["view.switch_units"].trigger()
    assert units.choice == "metric"
    window.menus["view.as_entered"].trigger()
    assert units.choice is None


def test_a_tab_has_the_family_and_a_dot_while_there_is_unsaved_work(window: MainWindow) -> None:
    bar = window.tabs.sides[0].tabBar()
    end = bar.tabButton(0, bar.ButtonPosition.RightSide)
    assert isinstance(end, TabEnd)
    assert (bar.tabText(0), end.dot.isVisible()) == ("mill", False)
    window.edits.commit(EXCESS, "3 mm")
    assert end.dot.isVisible()
    assert bar.accessibleTabName(0) == "mill.amp, not saved"
    window.menus["edit.undo"].trigger()
    assert not end.dot.isVisible()


def test_the_cross_on_a_tab_closes_its_file(window: MainWindow) -> None:
    bar = window.tabs.sides[0].tabBar()
    bar.tabButton(0, bar.ButtonPosition.RightSide).close_clicked.emit()
    assert window.page is None


def test_values_that_are_not_set_are_a_state_of_the_file_and_no_findings(window_with) -> None:
    window = window_with(content_of(new_file("num", "cnc", [], "bare")))
    assert window.status.not_set.text() == "921 not set"
    assert not window.status.counts["advice"].isVisible()
    assert window.workspace.count("advice") == 0


def test_unsaved_changes_are_counted(window: MainWindow) -> None:
    assert not window.status.changes.isVisible()
    window.edits.commit(EXCESS, "3 mm")
    window.edits.commit(("servo.excess_error", "2"), "3 mm")
    assert window.status.changes.text().startswith("2 unsaved")


def test_a_segment_speaks_only_when_a_user_presses(qtbot: QtBot) -> None:
    segment = Segment("Side", [("a", "A", ""), ("b", "B", "")])
    qtbot.addWidget(segment)
    heard: list[str] = []
    segment.chosen.connect(heard.append)
    segment.show_choice("b")
    assert (segment.choice, heard) == ("b", [])
    segment.buttons["a"].click()
    assert (segment.choice, heard) == ("a", ["a"])
    segment.buttons["a"].click()
    assert segment.choice == "a"


def test_words_that_need_more_than_the_window_has_leave_the_tool_bar(window: MainWindow) -> None:
    """A longer language: no tool falls off the end."""
    window.menus["control.page"].setIconText("Übertragung zur Steuerung starten und prüfen")
    displayed(window, 1210, 700)
    assert window.tools.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonIconOnly
    displayed(window, 1900, 700)
    assert window.tools.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon


def test_the_end_of_the_tabs_lists_every_open_file(window: MainWindow, path: Path) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    window.files.open_path(other)
    corner = window.tabs.sides[0].cornerWidget(Qt.Corner.TopRightCorner)
    corner.menu.aboutToShow.emit()
    assert [entry.text() for entry in corner.menu.actions()] == ["mill.amp", "other.amp"]
    corner.menu.actions()[0].trigger()
    assert window.workspace.path == path


@pytest.mark.parametrize("size", [(1400, 900), (1366, 768), (1024, 700)])
def test_nothing_has_moved_after_each_panel_was_opened_and_closed_twice(
    window: MainWindow, size: tuple[int, int], qtbot: QtBot
) -> None:
    displayed(window, *size)
    window.docks.reset()
    QApplication.processEvents()
    before = places(window)
    for _ in range(2):
        action(window, "Report Preview").trigger()
        qtbot.waitUntil(lambda: window.docks.preview.widget() is not None, timeout=WAIT_MS)
        QApplication.processEvents()
        action(window, "Report Preview").trigger()
        QApplication.processEvents()
        assert places(window) == before
    for dock in window.docks.docks:
        if dock.isHidden():
            continue
        for _ in range(2):
            dock.toggleViewAction().trigger()
            QApplication.processEvents()
            dock.toggleViewAction().trigger()
            QApplication.processEvents()
        assert places(window) == before, dock.objectName()


def test_a_message_without_room_ends_with_dots_and_its_tooltip_has_the_whole(window: MainWindow) -> None:
    displayed(window, 1024, 700)
    bar, text = window.statusBar(), f"/hall/{'line/' * 40}MILL_1394.pdf written"
    window.show_status(text)
    QApplication.processEvents()
    assert (bar.currentMessage(), bar.toolTip()) == (text, text)
    assert bar.elided().endswith("…")
    assert text.startswith(bar.elided()[:-1])
    window.show_status("saved")
    assert bar.elided() == "saved"
    bar.clearMessage()
    assert not bar.toolTip()


def places(window: MainWindow) -> dict[str, tuple[int, int, int, int]]:
    """Return where the table and each panel that is seen are."""
    widgets = {"table": window.centralWidget()} | {d.objectName(): d for d in window.docks.docks}
    return {name: w.geometry().getRect() for name, w in widgets.items() if w.isVisible()}
