"""Texts of pictures lie on no other text, in whatever size a picture is drawn."""

import re
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path

import pytest

from amp_studio.drawing import scene_svg
from amp_studio.drawing.frame import Placement
from amp_studio.drawing.labels import Box, labels_of
from amp_studio.drawing.scene import NamedPlace, Scale, Scene, Text
from amp_studio.drawing.svg import LINE, measured
from amp_studio.files import open_file
from amp_studio.pictures import pictures_of
from tests.campaigns import CAMPAIGN, some

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*/*.amp"))
SIZES = ((240.0, 110.0), (424.0, 190.0), (720.0, 480.0))


def overlapping(found):
    return [(a.text, b.text) for a, b in combinations(found.placed, 2) if a.box.overlaps(b.box)]


@pytest.mark.parametrize("example", some(EXAMPLES), ids=lambda path: path.stem)
def test_no_two_texts_of_a_picture_overlap_in_any_size_and_none_is_lost(example: Path) -> None:
    for picture in pictures_of(open_file(example).file):
        for part, _ in picture.parts:
            scene = picture.scene(part)
            for width, height in SIZES[:: 1 if CAMPAIGN else 2]:
                frame = Placement.within(scene, width, height)
                found = labels_of(frame, width, height, measured, LINE)
                assert overlapping(found) == [], (picture.name, part, width)
                for label in found.placed:
                    box = label.box
                    assert box.left >= 0.0, (picture.name, part, width, label.text)
                    assert box.left + box.width <= width, (picture.name, part, width, label.text)
                    assert 0.0 <= box.top <= height - LINE, (picture.name, part, width, label.text)
                named = [label.text for label in found.placed] + [text for _, text in found.left_out]
                for text in scene.texts:
                    assert any(each.startswith(text.text) for each in named), (picture.name, part, text.text)


def test_the_name_of_a_speed_is_clear_of_its_ramps_on_paper() -> None:
    file = open_file(next(path for path in EXAMPLES if path.stem == "LATHE_LS176")).file
    (ramps,) = (picture for picture in pictures_of(file) if picture.name == "ramps")
    for part, _ in ramps.parts:
        scene = ramps.scene(part)
        frame = Placement.within(scene, 720.0, 480.0)
        found = labels_of(frame, 720.0, 480.0, measured, LINE)
        strokes = [s for line in scene.lines for s in pairwise(map(frame.at, line.points))]
        (name,) = (label for label in found.placed if "Rapid Feedrate" in label.text)
        assert not any(name.box.is_crossed(*stroke) for stroke in strokes), (part, name)


def test_a_line_crosses_a_box_where_it_goes_through_it() -> None:
    box = Box(10.0, 10.0, 20.0, 10.0)
    assert box.is_crossed((0.0, 0.0), (40.0, 30.0))
    assert box.is_crossed((12.0, 12.0), (14.0, 14.0))
    assert not box.is_crossed((0.0, 18.0), (18.0, 36.0))
    assert not box.is_crossed((0.0, 5.0), (40.0, 5.0))


def crowd(count: int) -> Scene:
    """Return a scene with so many names at one point."""
    texts = tuple(Text((5.0, 5.0), f"Limit {n}", f"{n} mm", "right") for n in range(count))
    return Scene("travel", "", "", "", Scale("X", "mm", 0.0, 10.0), Scale("Y", "mm", 0.0, 10.0), texts=texts)


def test_names_at_one_point_go_away_from_it_with_a_line_to_each():
    scene = crowd(8)
    found = labels_of(Placement.within(scene, 424.0, 260.0), 424.0, 260.0, measured, LINE)
    names = [label for label in found.placed if label.text.startswith("Limit")]
    assert (len(names), overlapping(found), found.left_out) == (8, [], ())
    assert names[0].leader is None
    assert sum(label.leader is not None for label in names) >= 3
    for label in names:
        if label.leader:
            assert label.box.nearest(label.leader[0]) == label.leader[1]


@pytest.mark.parametrize("apart", range(1, 45, 2))
def test_two_limits_near_the_top_of_a_panel_are_both_read_however_near_they_are(apart: int) -> None:
    for top in range(40):
        levels = (NamedPlace("limit 10 mm", 100.0 - top), NamedPlace("suppression 9 mm", 100.0 - top - apart))
        scene = replace(crowd(0), look="panel", y=Scale("Y", "mm", 0.0, 100.0), levels=levels)
        frame = Placement(scene, 40.0, 20.0, 400.0, 100.0)  # a pixel is a millimetre
        found = labels_of(frame, 480.0, 160.0, measured, LINE)
        names = " ".join(label.text for label in found.placed if "mm" in label.text and label.over)
        assert all(level.name in names for level in levels)
        assert overlapping(found) == [], top


def test_a_crowd_loses_its_values_then_texts_and_the_tips_have_them_all():
    scene = crowd(60)
    found = labels_of(Placement.within(scene, 240.0, 110.0), 240.0, 110.0, measured, LINE)
    assert overlapping(found) == []
    placed = {label.text for label in found.placed}
    assert {text.partition(" mm")[0].rpartition(" ")[0] for _, text in found.left_out} == {
        f"Limit {n}" for n in range(60)
    } - placed
    svg = scene_svg(scene, 240.0, 110.0)
    assert len(re.findall("<title>Limit", svg)) == len(found.left_out) > 0


def test_boxes_that_touch_do_not_overlap():
    box = Box(0.0, 0.0, 10.0, 10.0)
    assert not box.overlaps(Box(10.0, 0.0, 10.0, 10.0))
    assert box.overlaps(Box(9.9, 9.9, 10.0, 10.0))


def test_what_is_measured_upwards_has_room_for_a_longer_word():
    """``Geschwindigkeit, Zoll/min`` was cut at the left edge: it lay around the middle of ``speed,
    in/min``.
    """
    scene = Scene("home", "", "", "", Scale("X", "mm", 0.0, 10.0), Scale("speed", "in/min", 0.0, 10.0))
    assert re.search(r'<text x="8.0"[^>]* text-anchor="start">speed, in/min<', scene_svg(scene, 720.0, 300.0))
