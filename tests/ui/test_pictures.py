"""The page of pictures: handles dragged, stepped by keys and typed, in the real window."""

import threading

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAccessible
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from amp_studio.schema import Value
from amp_studio.ui.base.theme import GAP2
from amp_studio.ui.pictures.page import MIN_CARD, PicturesPage

from .conftest import WAIT_MS, action

RIGHT = ("zone.limit3_max", "1")
LOW = ("zone.limit3_min", "2")


@pytest.fixture
def pictures(window):
    """Return the page of pictures of the example mill in the place of the table, with the travel alone."""
    window.resize(1200, 540)  # no room beside the table or below it
    action(window, "Pictures").trigger()
    page = window.page.pictures
    page.show_picture("travel")
    page.grab()
    return page


def place(canvas, *addresses):
    """Return where a handle is, and its number."""
    (found,) = [
        n for n, h in enumerate(canvas.scene.handles) if [d.address for d in h.drags] == list(addresses)
    ]
    return QPointF(*canvas.place.at(canvas.scene.handles[found].at)).toPoint(), found


def at(canvas, x, y):
    """Return the point of a place of the machine."""
    return QPointF(*canvas.place.at((x, y))).toPoint()


def press(canvas, *addresses):
    point, _ = place(canvas, *addresses)
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=point)
    return point


def drag(canvas, to, *addresses):
    press(canvas, *addresses)
    QTest.mouseMove(canvas, to)
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=to)


def test_an_edge_is_dragged_in_mm_as_one_undo_step(window, pictures, file, whole):
    before, canvas = whole(), pictures.chosen_card.canvas
    start = press(canvas, RIGHT)
    for x in (-140.0, -120.0, -100.0):
        QTest.mouseMove(canvas, QPoint(at(canvas, x, 0.0).x(), start.y()))
    assert window.workspace.undo_stack.count() == 0
    assert file.get(RIGHT).value == pytest.approx(-100.0, abs=2.0)
    assert canvas.tag(canvas.handle).old == "was −150 mm"
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(at(canvas, -100.0, 0.0).x(), start.y()))
    assert (window.workspace.undo_stack.count(), file.get(RIGHT).unit) == (1, "mm")
    assert window.workspace.undo_stack.undoText() == "Drag 1007 Limit 3 Max Value, X"
    window.workspace.undo_stack.undo()
    assert whole() == before
    assert place(canvas, RIGHT)[0] == start


def test_a_corner_moves_both_axes_in_one_step(window, pictures, file):
    canvas = pictures.chosen_card.canvas
    drag(canvas, at(canvas, -120.0, -340.0), RIGHT, LOW)
    assert [file.get(a).value for a in (RIGHT, LOW)] == pytest.approx([-120.0, -340.0], abs=3.0)
    assert window.workspace.undo_stack.count() == 1
    window.workspace.undo_stack.undo()
    assert [file.get(a) for a in (RIGHT, LOW)] == [Value(-150.0, "mm"), Value(-300.0, "mm")]


def test_an_inch_file_is_dragged_in_inches(window, pictures, file):
    window.workspace.show_in("inch")
    canvas = pictures.chosen_card.canvas
    drag(canvas, at(canvas, -5.0, -8.0), RIGHT)
    assert (file.get(RIGHT).value, file.get(RIGHT).unit) == (pytest.approx(-5.0, abs=0.1), "in")


def test_esc_during_a_drag_gives_the_old_value_back(window, pictures, file, whole):
    before, canvas = whole(), pictures.chosen_card.canvas
    press(canvas, RIGHT)
    QTest.mouseMove(canvas, at(canvas, -120.0, -200.0))
    assert file.get(RIGHT) != Value(-150.0, "mm")
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert whole() == before
    assert window.workspace.undo_stack.count() == 0
    assert window.page.shows_pictures
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=at(canvas, -120.0, -200.0))
    assert whole() == before


def test_a_handle_that_loses_its_place_is_still_one_step(window_with):
    """Pr461 has no printed range: a feedrate below nothing leaves no ramp to draw, and the step is there."""
    window = window_with("syntec-mill")
    action(window, "Pictures").trigger()
    pictures, rapid = window.page.pictures, ("feed.rapid", "1")
    pictures.show_picture("ramps")
    pictures.grab()
    file, canvas = window.workspace.file, pictures.chosen_card.canvas
    before = file.get(rapid)
    low = QPoint(press(canvas, rapid).x(), canvas.height() - 2)
    QTest.mouseMove(canvas, low)
    assert file.get(rapid).value < 0
    assert canvas.scene.handles == ()
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=low)
    assert window.workspace.undo_stack.count() == 1
    window.workspace.undo_stack.undo()
    assert file.get(rapid) == before


def test_clicks_go_round_the_handles_that_lie_on_each_other(window, pictures, file):
    """Limit 2 at the place of the overtravel: each of both edges can be taken."""
    low = ("zone.overtravel_negative", "1")
    window.workspace.edit(
        "elsewhere",
        {
            ("zone.limit2_min", "1"): file.get(low),
            ("zone.limit2_min", "2"): Value(-400.0, "mm"),
            ("zone.limit2_max", "2"): Value(6.0, "mm"),
        },
    )
    canvas = pictures.chosen_card.canvas
    here, chosen = place(canvas, low)[0], []
    assert place(canvas, ("zone.limit2_min", "1"))[0] == here
    for _ in range(3):
        QTest.mouseClick(canvas, Qt.MouseButton.LeftButton, pos=here)
        chosen.append(canvas.handle.drags[0].address)
    assert chosen[0] != chosen[1]
    assert set(chosen) == {low, ("zone.limit2_min", "1")}
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=here)
    QTest.mouseMove(canvas, at(canvas, -480.0, -200.0))
    assert file.get(chosen[2]).value > -495.0
    QTest.keyClick(canvas, Qt.Key.Key_Escape)


def test_no_other_key_works_during_a_drag(window, pictures, file):
    """An undo in the middle would take a step back under the moving value."""
    window.workspace.edit("elsewhere", {LOW: Value(-280.0, "mm")})
    canvas = pictures.chosen_card.canvas
    press(canvas, RIGHT)
    QTest.mouseMove(canvas, at(canvas, -120.0, -200.0))
    QTest.keyClick(canvas, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert (file.get(LOW), window.workspace.undo_stack.index()) == (Value(-280.0, "mm"), 1)
    QTest.keyClick(canvas, Qt.Key.Key_Escape)


def test_a_picture_that_goes_during_a_drag_gives_the_old_value_back(window, pictures, file, whole):
    before, canvas = whole(), pictures.chosen_card.canvas
    press(canvas, RIGHT)
    QTest.mouseMove(canvas, at(canvas, -120.0, -200.0))
    window.go_to(RIGHT)
    assert whole() == before
    assert not canvas.is_dragging


def test_a_file_out_of_range_on_purpose_keeps_its_mark_when_a_drag_is_given_up(window, pictures, file):
    window.workspace.edit("forced", {RIGHT: Value(-400.0, "mm")}, force="by a test")
    canvas = pictures.chosen_card.canvas
    press(canvas, RIGHT)
    QTest.mouseMove(canvas, at(canvas, -120.0, -200.0))
    assert RIGHT not in file.forced
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert (file.get(RIGHT), file.forced) == (Value(-400.0, "mm"), {RIGHT: "by a test"})


def test_beyond_the_allowed_range_the_value_stays_and_the_tag_shows_why(pictures, file):
    """Page 6-8: the larger end stays above the smaller one."""
    canvas = pictures.chosen_card.canvas
    press(canvas, RIGHT)
    QTest.mouseMove(canvas, at(canvas, -400.0, -200.0))
    assert file.get(RIGHT) == Value(-150.0, "mm")
    assert "is outside -350 to 999999.99 mm" in canvas.tag(canvas.handle).reason
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=at(canvas, -400.0, -200.0))


def test_the_tag_has_the_finding_of_the_place_while_it_is_dragged(window, pictures, file, qtbot):
    """Page 5-11: the home position lies within the overtravels."""
    canvas = pictures.chosen_card.canvas
    high = ("zone.overtravel_positive", "1")
    press(canvas, high)
    QTest.mouseMove(canvas, at(canvas, -60.0, -200.0))
    qtbot.waitUntil(lambda: bool(canvas.tag(canvas.handle).reason), timeout=WAIT_MS)
    assert canvas.tag(canvas.handle).severity in {f.severity for f in window.workspace.findings_of(high)}
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert window.workspace.findings == ()


def test_keys_move_the_focused_handle_by_a_step_and_shift_by_ten(pictures, file):
    canvas = pictures.chosen_card.canvas
    spot = canvas._spots[place(canvas, RIGHT)[1]]
    spot.setFocus()
    QTest.keyClick(spot, Qt.Key.Key_Left)
    assert file.get(RIGHT) == Value(-151.0, "mm")
    QTest.keyClick(spot, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert file.get(RIGHT) == Value(-141.0, "mm")


def test_a_number_is_typed_for_the_focused_handle(pictures, file):
    canvas = pictures.chosen_card.canvas
    spot = canvas._spots[place(canvas, RIGHT)[1]]
    spot.setFocus()
    QTest.keyClicks(spot, "-")
    QTest.keyClicks(pictures.footer.field, "133.5")
    QTest.keyClick(pictures.footer.field, Qt.Key.Key_Return)
    assert file.get(RIGHT) == Value(-133.5, "mm")
    pictures.footer.field.setText("-9999999")
    QTest.keyClick(pictures.footer.field, Qt.Key.Key_Return)
    assert "is outside" in pictures.footer.more.text()
    assert file.get(RIGHT) == Value(-133.5, "mm")


def test_the_picture_follows_edits_elsewhere_and_a_change_during_a_drag_keeps_its_scales(
    window, pictures, file
):
    canvas = pictures.chosen_card.canvas
    window.workspace.edit("elsewhere", {RIGHT: Value(-200.0, "mm")})
    assert canvas.scene.handles[place(canvas, RIGHT)[1]].at[0] == -200.0
    scale = canvas.scene.x
    press(canvas, ("zone.overtravel_negative", "1"))
    QTest.mouseMove(canvas, at(canvas, -510.0, -200.0))
    assert canvas.scene.x == scale
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=at(canvas, -510.0, -200.0))
    assert canvas.scene.x != scale


def test_a_picture_that_was_hidden_follows_when_it_is_seen_again(window, pictures):
    pictures.show_picture("jog")
    window.workspace.edit("elsewhere", {RIGHT: Value(-200.0, "mm")})
    pictures.show_picture("travel")
    canvas = pictures.chosen_card.canvas
    assert canvas.scene.handles[place(canvas, RIGHT)[1]].at[0] == -200.0


def test_a_name_leads_to_its_parameter_in_the_table(window, pictures):
    canvas = pictures.chosen_card.canvas
    canvas.grab()
    box, address = next((b, a) for b, a in canvas._names if canvas.nearest(b.center()) is None)
    QTest.mouseClick(canvas, Qt.MouseButton.LeftButton, pos=box.center().toPoint())
    assert not window.page.shows_pictures
    assert window.page.table_view.address() == address
    assert not action(window, "Pictures").isChecked()


def test_each_handle_is_an_accessible_child_with_its_name_and_value(pictures):
    canvas = pictures.chosen_card.canvas
    interface = QAccessible.queryAccessibleInterface(canvas)
    names = {interface.child(n).text(QAccessible.Text.Name) for n in range(interface.childCount())}
    assert "1007 Limit 3 Max Value, X: −150 mm" in names
    assert len(canvas._spots) == len(canvas.scene.handles)


def _end(page):
    return max(card.geometry().bottom() for card in page.cards.values() if not card.isHidden())


def _lowest(page, names):
    return min(page.cards[name].height() for name in names)


def test_all_pictures_are_side_by_side_where_there_is_room_and_one_alone_where_not(workspace, qtbot):
    page = PicturesPage(workspace)
    qtbot.addWidget(page)
    page.show()

    def seen():
        return [name for name, card in page.cards.items() if not card.isHidden()]

    for height, names in ((820, ["travel", "ramps", "gears", "jog"]), (613, ["travel", "ramps", "gears"])):
        page.resize(1000, height)
        qtbot.waitUntil(lambda names=names: seen() == names, timeout=WAIT_MS)
        qtbot.waitUntil(lambda: page.footer.y() - _end(page) <= 2 * GAP2, timeout=WAIT_MS)  # all is used
        qtbot.waitUntil(lambda names=names: _lowest(page, names) >= MIN_CARD[1], timeout=WAIT_MS)
    page.resize(1000, 430)
    qtbot.waitUntil(lambda: seen() == ["travel", "ramps"], timeout=WAIT_MS)
    page.resize(600, 500)
    qtbot.waitUntil(lambda: seen() == ["travel"], timeout=WAIT_MS)


def test_a_read_only_file_is_looked_at_and_not_dragged(window, pictures, file, monkeypatch):
    monkeypatch.setattr(type(window.workspace), "may_edit", False)
    canvas = pictures.chosen_card.canvas
    drag(canvas, at(canvas, -100.0, -200.0), RIGHT)
    assert file.get(RIGHT) == Value(-150.0, "mm")
    assert canvas._refused == "The file is read-only"


@pytest.mark.parametrize(
    "example", ["num-1060-mill", "syntec-mill", "57c422b-label-press", "acromill-router", "grblhal-router"]
)
def test_every_family_has_a_page_of_pictures(window_with, example: str):
    window = window_with(example)
    action(window, "Pictures").trigger()
    page = window.page.pictures
    for name in list(page.head.names.buttons)[1:]:
        page.show_picture(name)
        card = page.chosen_card
        assert (card.picture.name, card.grab().isNull()) == (name, False)
        scene = card.canvas.scene
        assert card.canvas._names or scene.notes or scene.curves


@pytest.mark.own_window
def test_pictures_open_at_the_handle_of_the_selected_value_and_the_parameter_panel_follows(window, qtbot):
    window.resize(1200, 540)  # no room beside the table or below it
    window.go_to(("servo.gain_break_point", "3"))
    action(window, "Pictures").trigger()
    page = window.page.pictures
    qtbot.waitUntil(lambda: page.chosen_card.canvas.handle is not None, timeout=WAIT_MS)
    card = page.chosen_card
    assert (page.filter_name, card.part, card.canvas.handle.label) == (
        "error",
        "3",
        "3730 Gain Break Point, Z",
    )
    card.canvas.choose(0)
    wanted = card.canvas.handle.drags[0].address
    qtbot.waitUntil(lambda: window.page.detail._address == wanted, timeout=WAIT_MS)


def test_a_family_without_pictures_shows_it(qtbot, workspace, monkeypatch):
    monkeypatch.setattr("amp_studio.ui.pictures.page.pictures_of", lambda _: ())
    page = PicturesPage(workspace)
    qtbot.addWidget(page)
    page.show()
    assert page.chosen_card is None
    assert "This family has no pictures." in {label.text() for label in page.findChildren(QLabel)}


@pytest.mark.own_window
def test_a_value_without_a_handle_opens_all_pictures(window):
    window.go_to(("control.type", ""))
    action(window, "Pictures").trigger()
    assert window.page.pictures.filter_name == "all"


def test_the_loops_are_drawn_at_the_speed_that_is_chosen(pictures):
    """Page 7-25: 10 mm of following error at rapid and gain 1, a quarter of it at 25 %."""
    pictures.show_picture("loop")
    card = pictures.chosen_card
    assert not card.speed.isHidden()
    card.speed.setValue(25.0)
    assert card.part == "1@25"
    texts = {text.text: text.value for text in card.canvas.scene.texts}
    assert texts["following error"] == "2.5 mm"
    card.speed.setValue(100.0)
    assert card.part == "1"


def test_what_pictures_need_is_loaded_beside_the_window_however_soon_they_are_asked_for(window, monkeypatch):
    """The simulator and the law of the axes took a fifth of a second of the window's thread."""
    threads = []
    monkeypatch.setattr(
        "amp_studio.ui.actions.picture.load", lambda *_: threads.append(threading.current_thread())
    )
    window.pictures._loaded.clear()
    action(window, "Pictures").trigger()
    assert window.page.shows_pictures
    assert threads
    assert threading.main_thread() not in threads
