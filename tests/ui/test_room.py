"""The table has the room: its share of the window, columns as wide as their contents,
and nothing that moves by itself.
"""

from collections.abc import Callable
from itertools import accumulate
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from amp_studio.drawing import Curve, Picture, linked, panel_of
from amp_studio.schema import Value
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.plot import MIN_PANEL, Plot
from amp_studio.ui.base.theme import font
from amp_studio.ui.base.translated import worded
from amp_studio.ui.forms.place_tree import counts_with_room
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.cell_look import as_written
from amp_studio.ui.table.column_widths import MIN_NAMES, ContentWidths, column_widths
from amp_studio.ui.table.more_columns import STRIP
from amp_studio.ui.table.parameter_table import CONTROL
from tests.campaigns import CAMPAIGN

EXCESS, SPEEDS = ("servo.excess_error", "1"), ("feedrate.rapid", "1")
EXAMPLES = (
    "mill-1394",
    "num-1060-mill",
    "syntec-mill",
    "57c422b-label-press",
    "acromill-router",
    "grblhal-router",
)


@pytest.fixture
def opened(window_with):  # the window of an example
    def show(folder: str, width: int = 1366, height: int = 768) -> MainWindow:
        window = window_with(folder)
        resized(window, width, height)
        return window

    return show


def resized(window: MainWindow, width: int, height: int) -> None:
    window.resize(width, height)
    QApplication.processEvents()


@pytest.mark.parametrize("folder", EXAMPLES)
def test_the_table_of_every_family_has_the_room_and_no_figure_is_cut(opened, folder: str) -> None:
    window = opened(folder)
    view = window.table_view
    assert view.width() >= 0.55 * window.width()
    for group in list(window.workspace.file.schema.groups)[: 40 : 1 if CAMPAIGN else 3]:
        window.table.show_parameters(list(group.parameters))
        assert view.verticalHeader().width() <= view.width() / 3, group
        assert not cut_figures(window), group


def cut_figures(window: MainWindow) -> list[str]:
    """Return the numbers for which their column is too narrow, with their unit and the mark of a finding."""
    view, table = window.table_view, window.table
    painter = view._delegate.painter
    found = []
    for row in range(len(table.rows)):
        for column in range(len(table.columns)):
            look = table.look(row, column)
            room = view._delegate.number_room if table.is_in_block(row) else view.columnWidth(column)
            if look is not None and look.is_number and painter.needed(look, painter.slot(look)) > room:
                found.append(look.text)
    return found


def test_a_unit_that_all_values_of_a_row_have_is_in_its_head_and_else_in_every_cell(opened) -> None:
    window = opened("mill-1394")
    window.go_to(("servo.position_counts", "1"))
    table = window.table
    row = table.index_of(("servo.position_counts", "1")).row()
    assert table.unit_of_row(row) == "counts"
    row = table.index_of(EXCESS).row()
    assert table.unit_of_row(row) == "", "X is in mm and B in degrees"
    assert {table.look(row, n).unit for n in range(5)} == {"mm", "°"}
    assert table.cell_text(("servo.position_counts", "1")).endswith("counts"), "and who hears it hears both"
    window.workspace.edit("", {("servo.excess_error", axis): None for axis in "123"})
    assert table.unit_of_row(row) == "", "a number typed for X, where nothing is set now, is in mm"


def test_columns_with_nothing_to_say_are_not_shown(opened) -> None:
    window = opened("acromill-router")
    view = window.table_view
    assert not window.table.has_numbers
    assert view._corner.number_width == 0
    assert not window.table.fact_columns
    assert "read by Save" in window.page.list_title.text(), "what holds for every row is said once"


def test_values_of_the_control_are_a_block_above_the_axes_and_keys_go_through_both(opened) -> None:
    window = opened("num-1060-mill")
    view, table = window.table_view, window.table
    of_control = [CONTROL in row.cells for row in table.rows if not row.section]
    assert of_control == sorted(of_control, reverse=True)
    assert [row.section for row in table.rows if row.section] == ["Control", "Axes"]
    last = max(n for n in range(len(table.rows)) if table.is_in_block(n))
    view.setCurrentIndex(table.index(last, 0))
    QTest.keyClick(view, Qt.Key.Key_Down)
    assert view.currentIndex().row() == last + 2
    assert not table.is_in_block(view.currentIndex().row())
    QTest.keyClick(view, Qt.Key.Key_Up)
    assert view.currentIndex().row() == last


def test_a_column_that_has_no_room_leaves_as_a_whole_and_keys_bring_it(opened) -> None:
    window = opened("mill-1394", 1024, 700)
    window.go_to(EXCESS)
    view = window.table_view
    more = view._more
    assert more.isVisible()
    ends = [view.columnViewportPosition(n) + view.columnWidth(n) for n in range(view.model().columnCount())]
    assert more.x() - view.verticalHeader().width() in ends, "the strip begins where a column ends"
    window.go_to((EXCESS[0], "5"))
    displayed = view.visualRect(view.currentIndex())
    assert displayed.left() >= 0
    assert not more.isVisible() or view.verticalHeader().width() + displayed.right() < more.x()


def test_ctrl_and_a_click_adds_a_cell_and_all_of_them_take_what_is_typed(opened) -> None:
    window = opened("mill-1394")
    window.go_to(EXCESS)
    view, port = window.table_view, window.table_view.viewport()
    third = view.visualRect(window.table.index_of((EXCESS[0], "3"))).center()
    QTest.mouseClick(port, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ControlModifier, third)
    assert view.cells.addresses() == [EXCESS, (EXCESS[0], "3")]
    assert view._fill_typed("9 mm") is None
    values = [window.workspace.file.get((EXCESS[0], axis)) for axis in "123"]
    assert values == [Value(9.0, "mm"), Value(11.0, "mm"), Value(9.0, "mm")]


def test_a_default_reads_as_a_user_writes_it_and_an_own_value_stays() -> None:
    assert as_written(Value(253.9998, "mm/min")) == Value(254.0, "mm/min")
    assert as_written(Value(0.0254, "mm")) == Value(0.0254, "mm")
    assert as_written(Value(2.54321, "mm")) == Value(2.54321, "mm")


def sizes(window: MainWindow) -> list[object]:
    """Return every size once the layout is at rest."""
    for _ in range(4):
        QApplication.processEvents()
    view = window.table_view
    parts = [dock for dock in window.docks.docks if dock.isVisible()]
    return [
        [(dock.objectName(), dock.geometry().getRect()) for dock in parts],
        view.geometry().getRect(),
        [view.columnWidth(n) for n in range(view.model().columnCount())],
        view.verticalHeader().width(),
    ]


@pytest.mark.parametrize("size", [(1366, 768), (1024, 700), (2560, 1440)])
def test_panels_that_open_and_close_twice_leave_every_size_as_it_was(opened, size: tuple[int, int]) -> None:
    window = opened("mill-1394", *size)
    window.go_to(EXCESS)
    for panel in ("Findings", "Parameter", "Groups"):
        window.docks.show(panel)
        QApplication.processEvents()
        opened_first = sizes(window)
        window.docks.toggle(panel)
        QApplication.processEvents()
        closed_first = sizes(window)
        for _ in range(2):
            window.docks.toggle(panel)
            QApplication.processEvents()
            assert sizes(window) == opened_first, panel
            window.docks.toggle(panel)
            QApplication.processEvents()
            assert sizes(window) == closed_first, panel
        window.docks.show(panel)
    assert window.table_view.isVisible()


def test_findings_never_open_by_themselves_and_fold_with_the_next_group_once_there_are_none(opened) -> None:
    window = opened("mill-1394")
    assert not window.findings.isVisible()
    table = window.table_view.geometry()
    window.workspace.edit("small", {EXCESS: Value(0.001, "mm")})
    QApplication.processEvents()
    assert window.findings.has_findings
    assert (window.findings.isVisible(), window.table_view.geometry()) == (False, table)
    window.findings.fold.click()
    assert window.findings.isVisible()
    window.menus["edit.undo"].trigger()
    QApplication.processEvents()
    assert window.findings.isVisible(), "not under the hand"
    window.go_to(SPEEDS)
    QApplication.processEvents()
    assert not window.findings.isVisible()


def test_a_panel_that_opens_while_the_window_becomes_small_is_seen_below(
    open_window, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To show a dock may bring the waiting resize of the window, which takes its contents away."""
    window = open_window(path)
    parameter = window.findChild(QDockWidget, "Parameter")
    parameter.close()

    def displayed() -> None:
        QDockWidget.show(parameter)
        window.docks.fit(QSize(1150, 623))

    monkeypatch.setattr(parameter, "show", displayed)
    window.docks.show("Parameter")
    assert window.page.detail.isVisible()


def test_a_size_that_the_window_gets_while_a_panel_is_turned_is_taken_after_it(opened, qtlog) -> None:
    """What is shown lays the window out, which can resize it at once: here with the preview afloat by then,
    so that the parameter has its side again.
    """
    window = opened("mill-1394", 1300)
    docks = window.docks
    docks.show_preview(True)
    assert docks.chooser.isVisible(), "the parameter is beside the findings"
    docks.preview.setFloating(True)
    docks._bottom.currentChanged.connect(lambda _: docks.fit(window.size()))
    docks.toggle("Parameter")
    assert [record.message for record in qtlog.records if "not contained" in record.message] == []
    parameter = window.findChild(QDockWidget, "Parameter")
    assert parameter.isVisible()
    assert parameter.widget().isAncestorOf(window.focusWidget())


def test_an_explanation_that_outlasts_its_file_leads_nowhere(open_window, path: Path) -> None:
    window = open_window(path)
    page = window.page
    window.files.close(page)
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    page.go_to(("servo.excess_error", "1"))


@pytest.mark.parametrize("size", [(1366, 768), (960, 540)])
def test_the_page_at_the_control_takes_no_room_from_the_panels(opened, size: tuple[int, int]) -> None:
    window = opened("mill-1394", *size)
    before = sizes(window)
    window.control.show("compare")
    sizes(window)
    assert (window.width(), window.height()) == size
    window.control.leave()
    assert sizes(window) == before


def test_the_one_line_of_the_findings_is_never_cut_before_its_link(opened) -> None:
    window = opened("mill-1394", 960, 540)
    findings = window.page.findings
    findings.hint.setText("38 as delivered, to be set in steps 5, 6, 7, 8, 10, 20 " * 2)
    findings.summary.setText('none in this file · 336 active parameters are not set <a href="unset">Show</a>')
    findings.summary.show()
    QApplication.processEvents()
    assert findings.summary.width() >= findings.summary.sizeHint().width()


def test_a_choice_is_read_whole_where_there_is_room_for_it(opened) -> None:
    window = opened("mill-1394", 3200, 1440)
    window.go_to(("servo.position_feedback_type", "1"))
    QApplication.processEvents()
    view, table = window.table_view, window.table
    index = view.currentIndex()
    look = table.look(index.row(), index.column())
    assert look.short, "one that has a shorter text"
    assert view.columnWidth(index.column()) >= view._delegate.painter.needed(look, 0)


def test_the_row_of_tabs_has_no_line_that_ends_before_its_corner(opened) -> None:
    window = opened("mill-1394")
    assert not any(side.tabBar().drawBase() for side in window.tabs.sides)


def test_the_parameter_panel_keeps_its_width_from_value_to_value(opened) -> None:
    window = opened("mill-1394", 1366, 768)
    panel = window.page.detail
    widths = set()
    for address in (("control.type", ""), EXCESS, ("axis.type", "2"), ("servo.position_feedback_type", "1")):
        window.go_to(address)
        for _ in range(4):
            QApplication.processEvents()
        widths.add(panel.width())
        assert panel.value.width() >= panel.value.minimumSizeHint().width(), address
    assert len(widths) == 1


@pytest.mark.parametrize("room", range(150, 1300, 25))
def test_names_have_what_the_columns_leave_free_that_are_seen_whole(room: int) -> None:
    """Names were cut beside 160 white pixels, where the fifth axis had no room."""
    axes = [119, 119, 119, 104, 119]
    widths = column_widths(ContentWidths(42, 260, axes, axes, [0] * 5, 0), room)
    wanted, left = min(42 + 260, room // 3), room - widths.frozen
    whole = [end for end in accumulate(axes) if end <= left - STRIP]
    assert widths.frozen == wanted or sum(axes) >= left or not whole or whole[-1] == left - STRIP
    least = min(wanted, max(42 + MIN_NAMES, room - sum(axes)))
    assert whole == [end for end in accumulate(axes) if end <= room - least - STRIP], (
        "no column leaves for it"
    )


def test_an_edit_lays_and_paints_once(opened) -> None:
    """The heads were announced as changed at every edit: Qt laid and painted the whole table once more."""
    window = opened("mill-1394")
    window.go_to(EXCESS)
    assert window.table.titles[0] == "X 1 linear"
    followed: list[object] = []
    announced: list[object] = []
    window.table.headerDataChanged.connect(lambda *given: announced.append(given))
    window.page.changed.connect(followed.append)
    window.edits.commit(EXCESS, "12 mm")
    assert announced == []
    assert followed == [window.page], "actions and status line follow once too"
    window.workspace.edit("name", {("axis.name", "1"): Value("U")})
    assert announced != [], "another letter is another head"


@pytest.mark.usefixtures("german")
def test_the_head_of_an_axis_is_whole_where_there_is_room(
    open_window: Callable[..., MainWindow], path: Path
) -> None:
    """A German window had "4 Runda…" above a group of short values, beside 270 white pixels."""
    window = open_window(path)
    resized(window, 1366, 768)
    window.go_to(("axis.type", "1"))
    table, heads = window.table, window.table_view.horizontalHeader()
    for column in range(len(table.columns)):
        letter, what = table.column_head(column)
        drawn = QFontMetrics(font("text")).horizontalAdvance(letter)
        drawn += QFontMetrics(font("caption")).horizontalAdvance(what)
        assert heads.sectionSize(column) >= drawn + 8 + 6 + 6, what


def test_panels_without_room_are_left_out_and_named_instead_of_painted_below_the_edge(
    qtbot: QtBot, german: None
) -> None:
    """On a screen at 200 % the figures of the axis lay over the last curve, and a panel was cut."""
    time = np.linspace(0.0, 1.0, 50)
    titles = ("position", "following error", "axis minus spindle", "velocity", "torque")
    panels = [panel_of(title, (Curve("", time, time),), ("time", "s"), "mm") for title in titles]
    plot = Plot()
    qtbot.addWidget(plot)
    plot.draw(Picture("", (), linked(panels)))
    for height, left_out in ((420, ()), (130, ("axis minus spindle", "Geschwindigkeit", "Drehmoment"))):
        plot.resize(600, height)
        plot.grab()
        assert plot.left_out == left_out
        last = plot._frames[-1]
        assert last.height >= MIN_PANEL
        assert last.top + last.height < height - 16.0, "the figures along the axis"
        assert last.scene.x.is_written


def test_an_axis_in_a_sentence_of_the_simulation_is_called_by_its_letter(
    window: MainWindow, german: None
) -> None:
    file = window.workspace.file
    text = "The position loop of axis 1 is open: there is nothing to tune"
    assert (
        sentenced_with_letters(file, text)
        == "Der Lageregler der Achse X ist offen: es gibt nichts abzustimmen"
    )
    assert sentenced_with_letters(file, "axis 1.5 mm") == "axis 1,5 mm", "no number of an axis"


def test_the_rated_torque_of_a_step_is_german(german: None) -> None:
    assert worded("Rated torque") == "Nenndrehmoment"
    assert worded("100 % where torque is in %") == "100 %, wenn in %"


@pytest.mark.parametrize(
    ("room", "displayed"),
    [
        (300, (("error", 6), ("warning", 14), ("recommendation", 121))),
        (170, (("error", 6), ("warning", 14))),
        (60, (("error", 6),)),
    ],
)
def test_the_title_of_a_step_is_read_beside_hundreds_of_findings_and_the_worst_stay(
    room: int, displayed: tuple[tuple[str, int], ...]
) -> None:
    """At 1024 pixels a step was called R…."""
    counts = (("error", 6), ("warning", 14), ("recommendation", 121))
    kept, is_cut = counts_with_room(counts, 120, room, lambda text: 7 * len(text))
    assert (kept, is_cut) == (displayed, displayed != counts)


def test_a_short_title_costs_no_findings() -> None:
    counts = (("error", 6), ("warning", 14))
    assert counts_with_room(counts, 20, 90, lambda text: 7 * len(text)) == (counts, False)
