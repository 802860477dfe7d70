"""Cams made of points: the printed program's number of points, registers, limits, and the way back."""

import math
from pathlib import Path

import numpy as np
import pytest

from amp_studio.cli import run
from amp_studio.families.servo57c422b.law_cam_table import make, present
from amp_studio.files import ParameterFile, open_file
from amp_studio.sim import CamPoints, SimulationError, cam_figures, cam_picture, read_cam_points


@pytest.fixture
def press(checkout: Path) -> ParameterFile:
    return open_file(checkout / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp").file


def stroke(cycle: float, counts: float = 16000.0) -> CamPoints:
    """Return a stroke and back along a cosine."""
    x = np.linspace(0.0, cycle, 201)
    return CamPoints("time", x, counts / 2.0 * (1.0 - np.cos(2.0 * math.pi * x / cycle)))


@pytest.mark.parametrize(("cycle", "points"), [(1.0, 800), (4.0, 1600), (5.0, 1334)])
def test_a_cycle_has_the_points_of_the_printed_program(
    press: ParameterFile, cycle: float, points: int
) -> None:
    """Page 5-10: 1, 4 and 5 s."""
    assert make(press, "Y", stroke(cycle), 0).figures["points"] == (points, "")


def test_what_was_made_is_what_the_registers_contain(press: ParameterFile) -> None:
    made = make(press, "Y", stroke(0.4), 10)
    press.set_checked(made.settings)
    found = present(press, "Y")
    assert (found.position == made.position).all()
    assert found.position[-1] == 0.0, "the rounded steps add up: nothing drifts away"
    assert found.figures["points"] == (32, "")
    assert abs(found.position.max() - 16000.0) <= 1.0


def test_a_shorter_cam_gives_up_the_points_of_the_one_before(press: ParameterFile) -> None:
    press.set_checked(make(press, "Y", stroke(0.2), 10).settings)
    left = [address for address in press.values if address[0] == "cam.time_points" and address[1] > "Y.15"]
    assert {address[1] for address in left if int(address[1].partition(".")[2]) > 15} == set()


def test_a_cam_that_jumps_or_moves_on_is_doubtful(press: ParameterFile) -> None:
    """Page 4-56: from the last point to the loop back point within one step."""
    ramp = CamPoints("time", np.array([0.0, 0.4]), np.array([0.0, 16000.0]))
    doubts = make(press, "Y", ramp, 10).doubts
    assert any("16000 counts further" in text for text in doubts)
    triangle = CamPoints("time", np.array([0.0, 0.2, 0.4]), np.array([0.0, 16000.0, 0.0]))
    assert any("loop back point 0" in text for text in make(press, "Y", triangle, 10).doubts)


def test_a_step_beyond_a_word_is_refused(press: ParameterFile) -> None:
    """Page 4-50: words are -32768 to 32767."""
    with pytest.raises(SimulationError, match="page 4-50"):
        make(press, "Y", stroke(0.1, 1e7), 10)


def test_a_position_cam_has_points_one_increment_apart(press: ParameterFile) -> None:
    """Pages 4-51 to 4-57: 956 positions at most, an increment of 0 to 32767 counts."""
    x = np.linspace(0.0, 4000.0, 41)
    cam = make(press, "Y", CamPoints("master", x, 2.0 * x), 0)
    assert cam.figures["increment"] == (5.0, "counts")
    assert cam.figures["points"] == (801.0, "")
    press.set_checked(cam.settings)
    assert (present(press, "Y").position == cam.position).all()
    assert cam_figures(cam)["greatest_slope"][0] == 2.0
    with pytest.raises(SimulationError, match="page 4-53"):
        make(press, "Y", CamPoints("master", x * 1_000_003.0 / 4000.0, x), 0)


def test_the_picture_has_position_speed_and_acceleration_with_its_limit(press: ParameterFile) -> None:
    picture = cam_picture(present(press, "Y"))
    assert [panel.title for panel in picture.panels] == [
        "position counts",
        "speed counts/s",
        "acceleration counts/s²",
    ]
    assert picture.panels[2].levels


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,position\n0,0\n", "2 to"),
        ("time,position\n0,0\n1,5\n1,6\n", "does not rise"),
        ("master,way\n0,0\n", "needs the columns"),
        ("time,position [mm]\n0,0\n1,1\n", "must be in counts"),
    ],
)
def test_points_that_are_none_are_refused_in_words(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(SimulationError, match=words):
        read_cam_points(path)


def test_the_verb_writes_a_cam_and_its_picture(
    press: ParameterFile, tmp_path: Path, checkout: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, points = tmp_path / "press.amp", tmp_path / "points.csv"
    path.write_bytes((checkout / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp").read_bytes())
    points.write_text("time [ms];position\n0;0\n200;800\n400;0\n", "utf-8")
    before, picture = path.read_bytes(), tmp_path / "cam.svg"
    wrong = ["cam", str(path), "--axis", "Y", "--points", str(points), "-o", str(tmp_path / "cam.png")]
    assert (run(wrong), path.read_bytes()) == (2, before), "a picture that cannot be drawn changes nothing"
    assert run(["cam", str(path), "--axis", "Y", "--points", str(points), "-o", str(picture)]) == 0
    assert "cycle time: 0.4 s" in capsys.readouterr().out
    assert present(open_file(path).file, "Y").position.max() == 800.0
    assert "acceleration" in picture.read_text("utf-8")
