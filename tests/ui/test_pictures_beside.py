"""Pictures beside the table: both are seen, follow each other, and stay where a person put them."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from amp_studio.pictures import pictures_of
from amp_studio.ui.forms.handle_footer import HandleFooter
from amp_studio.ui.pictures.card import PictureCard
from amp_studio.ui.pictures.split import PictureLayout

from .conftest import WAIT_MS, action

RIGHT = ("zone.limit3_max", "1")
BREAK = ("servo.gain_break_point", "3")


@pytest.fixture
def beside(window, qtbot):
    """Return the window with the travel beside the table of zones."""
    window.resize(1440, 900)
    window.go_to(RIGHT)
    action(window, "Pictures").trigger()
    qtbot.waitUntil(lambda: window.page.middle.arrangement == "below", timeout=WAIT_MS)
    window.page.pictures.head.places.buttons["beside"].click()
    return window


def handle_of(pictures):
    handle = pictures.chosen_card.canvas.handle
    return None if handle is None else handle.drags[0].address


def test_an_edit_in_the_table_moves_the_picture_and_a_dragged_handle_moves_the_cell(beside):
    view, pictures = beside.table_view, beside.page.pictures
    assert view.isVisible()
    assert pictures.isVisible()
    canvas = pictures.card("travel").canvas
    index = beside.table.index_of(RIGHT)

    def right():
        return next(h for h in canvas.scene.handles if [d.address for d in h.drags] == [RIGHT])

    beside.workspace.enter(RIGHT, "-200")
    assert right().at[0] == -200.0
    start = QPointF(*canvas.place.at(right().at)).toPoint()
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=start)
    to = QPoint(QPointF(*canvas.place.at((-100.0, 0.0))).toPoint().x(), start.y())
    QTest.mouseMove(canvas, to)
    assert float(index.data().split()[0].replace("−", "-")) == pytest.approx(-100.0, abs=5.0)
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=to)
    assert view.isVisible()


def test_the_selected_value_marks_its_handle_and_the_keyboard_stays_in_the_table(beside, qtbot):
    beside.go_to(BREAK)
    beside.table_view.setFocus()
    qtbot.waitUntil(lambda: handle_of(beside.page.pictures) == BREAK, timeout=WAIT_MS)
    assert beside.page.pictures.card("error") in beside.page.pictures._seen
    assert QApplication.focusWidget() is beside.table_view
    assert len([c for c in beside.page.pictures.cards.values() if c.canvas.handle is not None]) == 1


def test_a_value_without_a_handle_marks_none(beside, qtbot):
    qtbot.waitUntil(lambda: handle_of(beside.page.pictures) == RIGHT, timeout=WAIT_MS)
    beside.go_to(("control.type", ""))
    qtbot.waitUntil(
        lambda: all(c.canvas.handle is None for c in beside.page.pictures.cards.values()), timeout=WAIT_MS
    )


def test_a_chosen_handle_selects_its_cell_in_its_group_and_keeps_the_keyboard(beside, qtbot):
    beside.go_to(("control.type", ""))
    canvas = beside.page.pictures.card("travel").canvas
    number = next(n for n, h in enumerate(canvas.scene.handles) if [d.address for d in h.drags] == [RIGHT])
    canvas.choose(number)
    canvas.focus_handle()
    qtbot.waitUntil(lambda: beside.table_view.address() == RIGHT, timeout=WAIT_MS)
    assert QApplication.focusWidget() is canvas._spots[number]


def test_a_corner_stays_chosen_while_the_table_shows_one_of_its_values(beside, qtbot):
    canvas = beside.page.pictures.card("travel").canvas
    number = next(n for n, h in enumerate(canvas.scene.handles) if len(h.drags) == 2)
    canvas.choose(number)
    wanted = canvas.handle.drags[0].address
    qtbot.waitUntil(lambda: beside.table_view.address() == wanted, timeout=WAIT_MS)
    beside.page.pictures._mark_selected()
    assert canvas.handle is canvas.scene.handles[number]


def test_esc_in_a_picture_goes_to_the_table_and_both_stay(beside):
    canvas = beside.page.pictures.card("travel").canvas
    canvas.setFocus()
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert QApplication.focusWidget() is beside.table_view
    assert beside.page.shows_pictures


def test_a_name_in_a_picture_selects_its_parameter_and_both_stay(beside):
    beside.page.pictures.parameter_requested.emit(BREAK)
    assert beside.table_view.address() == BREAK
    assert beside.page.pictures.isVisible()


def test_place_and_border_are_those_of_the_next_start(beside, open_window, path):
    beside.page.middle.setSizes([300, 700])
    beside.page.middle.splitterMoved.emit(300, 1)
    kept = beside.settings.pictures()
    assert (kept.choice, kept.is_shown) == ("beside", True)
    assert 25 <= kept.beside <= 50
    beside.page.pictures.head.close_button.click()
    assert not beside.settings.pictures().is_shown
    assert not action(beside, "Pictures").isChecked()


def test_a_file_that_is_opened_shows_its_pictures_as_the_files_before_it(beside, qtbot):
    beside.pictures._early.setInterval(1)
    page = beside.page
    page.pictures.hide()
    page.pictures = None  # as in a page that has just been opened
    beside.tabs.current_changed.emit(page)
    qtbot.waitUntil(lambda: page.shows_pictures, timeout=WAIT_MS)


def test_in_a_small_room_the_pictures_cover_the_table_and_leave_it_with_the_room(beside, qtbot):
    beside.page.pictures.head.places.buttons["below"].click()
    assert beside.table_view.isVisible()
    beside.resize(1440, 470)
    qtbot.waitUntil(lambda: beside.page.middle.covers, timeout=WAIT_MS)
    assert not beside.table_view.isVisible()
    assert not beside.menus["view.values"].isChecked()  # what is not seen is not pressed
    beside.resize(1440, 900)
    qtbot.waitUntil(lambda: not beside.page.middle.covers, timeout=WAIT_MS)
    assert beside.table_view.isVisible()
    assert beside.menus["view.values"].isChecked()


def test_a_read_value_of_the_settings_is_what_was_kept_and_rubbish_is_ignored():
    kept = PictureLayout("below", 30, 70, is_shown=True)
    assert PictureLayout.read(str(kept)) == kept
    assert PictureLayout.read(str(PictureLayout())) == PictureLayout()
    for odd in (None, 7, "", "below", "below x 45 1", "below 30 45 2 9", "below -3 45 1", ["below"]):
        assert PictureLayout.read(odd) == PictureLayout()
    assert PictureLayout.read("under 999 0 1") == PictureLayout(None, 80, 20, is_shown=True)


@pytest.mark.parametrize(
    ("choice", "size", "place"),
    [
        (None, (1362, 754), "beside"),
        (None, (882, 574), "below"),
        (None, (775, 374), "instead"),
        ("beside", (882, 374), "beside"),
        ("beside", (500, 700), "instead"),
        ("below", (500, 700), "below"),
        ("instead", (1362, 754), "instead"),
    ],
)
def test_the_room_decides_while_nothing_is_chosen(choice, size, place):
    assert PictureLayout(choice).fitting(*size) == place


def test_parts_without_room_are_a_list_and_a_step_is_a_plain_number(workspace, qtbot):
    picture = next(each for each in pictures_of(workspace.file) if each.name == "error")
    card = PictureCard(workspace, picture)
    qtbot.addWidget(card)
    card.resize(700, 300)
    card.show()
    assert (card.parts.isVisible(), card.more_parts.isVisible()) == (True, False)
    card.resize(260, 300)
    assert (card.parts.isVisible(), card.more_parts.isVisible()) == (False, True)
    assert card.more_parts.currentData() == card.part
    footer = HandleFooter(workspace)
    qtbot.addWidget(footer)
    tiny = card.canvas.scene.handles[0]
    footer.show_handle(replace(tiny, drags=(replace(tiny.drags[0], step=1e-05),)))
    assert "0.00001" in footer.keys.text()


def test_a_diagram_that_needs_more_height_than_there_is_below_the_table_covers_it(window, qtbot):
    window.resize(1366, 640)
    window.go_to(("control.type", ""))  # no picture has a handle for it
    action(window, "Pictures").trigger()
    middle, pictures = window.page.middle, window.page.pictures
    pictures.show_picture("travel")
    qtbot.waitUntil(lambda: middle.arrangement == "below", timeout=WAIT_MS)
    pictures.show_picture("loop")
    qtbot.waitUntil(lambda: middle.covers, timeout=WAIT_MS)
    assert pictures.height() >= pictures.least_height
    pictures.show_picture("travel")
    qtbot.waitUntil(lambda: not middle.covers, timeout=WAIT_MS)
