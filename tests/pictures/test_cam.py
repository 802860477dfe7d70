"""The cam of an axis among the pictures of its file: position, speed and acceleration."""

import pytest

from amp_studio.pictures import draw, pictures_of


def test_the_cam_is_drawn_for_the_axis_that_has_points(example):
    """Page 4-57: 32 points of 12.5 ms are 0.4 s, and one point more than steps."""
    file = example("57c422b")
    picture = next(each for each in pictures_of(file) if each.name == "cam")
    assert [name for _, name in picture.parts] == ["Y", "Y speed", "Y acceleration"]
    scene = draw(file, "cam", "Y")
    assert len(scene.curves[0].x) == 33
    assert scene.x.high == pytest.approx(0.4)
    assert scene.y.label == "position counts"
    assert draw(file, "cam", "Y speed").y.label == "speed counts/s"
    assert draw(file, "cam", "Y acceleration").levels


def test_a_cam_that_cannot_be_read_is_a_note(example):
    file = example("57c422b")
    file.set(("cam.time_points", "Y.3"), None)
    scene = draw(file, "cam", "Y")
    assert not scene.curves
    assert "points that are not set" in scene.notes[0].text
