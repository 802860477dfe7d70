"""The texts of pictures in the font of the window: none on another, and a tip for what has no room."""

from itertools import combinations
from pathlib import Path

from PySide6.QtCore import QPointF, QSizeF
from PySide6.QtGui import QFontMetricsF

from amp_studio.drawing import scene_in_words
from amp_studio.drawing.frame import EDGE, Placement
from amp_studio.files import open_file
from amp_studio.pictures import pictures_of
from amp_studio.ui.base.figures import with_groups
from amp_studio.ui.base.scene_painter import caption_fonts, painted_labels
from amp_studio.ui.base.translated import sentenced, unit_in_words
from amp_studio.ui.pictures.canvas import PictureCanvas
from amp_studio.ui.pictures.page import TEXT_ROW

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*/*.amp"))
SIZES = ((240.0, 110.0), (424.0, 190.0), (880.0, 520.0))


def test_no_two_texts_of_any_picture_overlap_in_any_size(qapp):
    for example in EXAMPLES:
        for picture in pictures_of(open_file(example).file):
            scene = picture.scene()
            for size in SIZES:
                found = painted_labels(Placement.within(scene, *size), QSizeF(*size))
                over = [(a.text, b.text) for a, b in combinations(found.placed, 2) if a.box.overlaps(b.box)]
                assert over == [], (example.stem, picture.name, size)


def test_a_tip_has_the_value_of_a_handle_and_the_texts_that_have_no_room(workspace, qtbot):
    picture = next(p for p in pictures_of(workspace.file) if p.name == "error")
    canvas = PictureCanvas(workspace, lambda like: picture.scene("1", like))
    qtbot.addWidget(canvas)
    canvas.resize(160, 80)
    canvas.grab()
    handle = canvas.scene.handles[0]
    assert canvas.tip(QPointF(*canvas.place.at(handle.at))).startswith(f"{handle.label}: {handle.value}")
    assert canvas._left_out
    at, text = canvas._left_out[0]
    assert text in canvas.tip(QPointF(*at))


def test_the_texts_of_a_loop_stay_in_their_rows_at_the_least_height_of_the_picture(qapp, german):
    """In a German window of 1366 x 768 "Lagerückführung" and the values beside it were in other boxes."""
    for example in EXAMPLES:
        for picture in pictures_of(open_file(example).file):
            scene = picture.scene()
            size = (880.0, float(scene.rows * TEXT_ROW + 2.0 * EDGE))
            if scene.rows:
                scene = scene_in_words(scene, sentenced, unit_in_words)
                frame = Placement.within(scene, *size)
                placed = painted_labels(frame, QSizeF(*size)).placed
                for text in scene.texts:
                    at = frame.at(text.at)[1]
                    # A box and a signal may have one name in German: "Output" and "output".
                    away = [abs(p.box.top + 0.5 * p.box.height - at) for p in placed if p.text == text.text]
                    assert min(away) < 8.0, (example.stem, text.text)


def test_every_text_of_a_picture_is_painted_whole_in_its_place(qapp):
    """ "Y −400 mm to 6 mm" was cut at the edge: it was measured with a hyphen and painted with a minus."""
    for example in EXAMPLES:
        for picture in pictures_of(open_file(example).file):
            for size in SIZES:
                for label in painted_labels(Placement.within(picture.scene(), *size), QSizeF(*size)).placed:
                    plain, strong = map(QFontMetricsF, caption_fonts())
                    wide = (strong if label.strong else plain).horizontalAdvance(with_groups(label.text))
                    wide += plain.horizontalAdvance(f" {with_groups(label.value)}") if label.value else 0.0
                    assert wide <= label.box.width, (example.stem, picture.name, label.text)
                    is_inside = label.box.left >= 0.0 and label.box.left + label.box.width <= size[0]
                    assert is_inside or label.box.width > size[0], (example.stem, picture.name, label.text)


def test_no_figure_is_twice_in_a_row_of_a_ladder(qapp):
    """The greatest jog speed of X was printed twice where it is that of the rapid feedrate."""
    for example in EXAMPLES:
        for picture in pictures_of(open_file(example).file):
            rows = [(text.at, text.text) for text in picture.scene().texts if not text.value]
            assert len(rows) == len(set(rows)), (example.stem, picture.name)
