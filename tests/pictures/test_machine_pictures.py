"""The pictures of the page Machine: course of a homing, way in the plan, speed of the spindle; all from runs
of the one engine.
"""

import math
from itertools import pairwise

import pytest

from amp_studio.pictures import (
    draw_approach,
    draw_homing,
    draw_spindle,
    draw_usual_approach,
    pictures_of,
    usual_way,
)
from amp_studio.pictures.approach import run_way
from amp_studio.sim import check_again, simulate
from tests.programs.test_block import example

HOMED = [
    "57c422b-label-press",
    "acromill-router",
    "grblhal-router",
    "linuxcnc-mill",
    "num-1060-mill",
    "syntec-mill",
]


def picture(file, name: str):
    return next(each for each in pictures_of(file) if each.name == name)


def texts_of(scene) -> dict[str, str]:
    return {text.text: text.value for text in scene.texts}


def test_the_stages_of_a_homing_have_their_parameter_and_speed() -> None:
    """9/PC 5-3 to 5-4: G28 Home Speed to the switch, Home Speed from Limit Switch off it and home."""
    file = example("mill-1394")
    trace = simulate(file, "home", "1", {"move.switch_length": "5 mm"}, advise=False)
    scene = draw_homing(file, trace)
    words = texts_of(scene)
    assert words["1 to the switch"] == "1011 at 2500 mm/min"
    assert words["2 off the switch"] == "1350 at 254 mm/min"
    assert words["3 to the home position"] == "1350 at 254 mm/min"
    assert words["home"] == "6 mm"
    assert words["switch"] == "5 mm"
    assert words["past it"] == "2.5 mm", "the overrun of 7.5 mm is half as long again as the switch"
    assert (scene.areas[0].left, scene.areas[0].right) == (0.0, 5.0)
    assert trace.course is not None
    home = next(dot.at[0] for dot in scene.dots if dot.kind == "home")
    assert home == pytest.approx((trace.course.home or 0.0) - 41.0)
    markers = sorted(dot.at[0] for dot in scene.dots if dot.kind == "end")
    assert all(b - a == pytest.approx(12.7) for a, b in pairwise(markers))
    assert any(at == pytest.approx(home) for at in markers), "the home position is a marker"


@pytest.mark.parametrize("name", HOMED)
def test_every_family_draws_its_homing(name: str) -> None:
    file = example(name)
    trace = simulate(file, "home", None, advise=False)
    assert trace.course is not None
    scene = draw_homing(file, trace)
    stages = [text for text in scene.texts if text.sort == "now"]
    assert stages, "each has a stage with its speed"
    assert bool(scene.areas) == (trace.course.switch is not None)
    places = [place for line in scene.lines if line.sort == "now" for place, _ in line.points]
    assert scene.x.low < min(places) <= max(places) < scene.x.high


def test_a_homing_in_inches_is_drawn_in_inches() -> None:
    trace = simulate(example("acromill-router"), "home", "X", advise=False)
    assert trace.course is not None
    assert trace.course.unit == "in"
    # A turn is 4096 pulses (page 113).
    assert trace.course.turn == pytest.approx(4096 / 20480)
    assert trace.course.home == pytest.approx(trace.result["home_from_start"][0])


def test_the_way_stops_where_the_engine_stops_it() -> None:
    file = example("mill-1394")
    travel = picture(file, "travel")
    way = usual_way(travel, "1+2")
    assert way is not None
    trace = run_way(travel, "1+2", way)
    scene = draw_approach(travel, "1+2", way, trace, hard=12.0)
    overrun = trace.result["overrun"][0]
    assert overrun is not None
    past = next(text for text in scene.texts if text.sort == "output")
    assert past.text == f"{overrun:.3g} mm past"
    amber = next(line for line in scene.lines if line.sort == "output")
    assert math.dist(*amber.points) == pytest.approx(overrun, rel=1e-2)
    hit = draw_approach(travel, "1+2", way, trace, hard=5.0)
    assert any(text.text.endswith("meets the hard stop") for text in hit.texts if text.sort == "error")


def test_a_picture_that_counts_from_the_switch_is_run_in_the_places_of_the_machine() -> None:
    """The travel of a Grbl is -790 to 0 mm (machine_limits.c); its picture begins at the switch."""
    scene = draw_usual_approach(picture(example("grblhal-router"), "travel"), "X+Y")
    refused = next(note.text for note in scene.notes if note.wrong)
    assert refused.startswith("The way would break the soft limit of Y")


def test_one_axis_alone_is_run_in_the_places_of_the_machine_too() -> None:
    """X homes towards minus: its picture is 0 to 790 mm, its machine -790 to 0 (machine_limits.c). The way
    began in the middle of the picture, where the machine has no limit.
    """
    file = example("grblhal-router")
    for axis in "YZ":
        file.set(("axis.max_travel", axis), None)
    travel = picture(file, "travel")
    assert travel.parts == (("X", "X"),)
    way = usual_way(travel, "")
    assert way is not None
    trace = run_way(travel, "", way)
    assert trace.columns["position"][0] == pytest.approx(way.start[0] - 790.0)
    scene = draw_approach(travel, "", way, trace)
    assert next(line.points[0] for line in scene.lines if line.sort == "now") == way.start
    assert "refused" in next(note.text for note in scene.notes if note.wrong)


def test_axes_of_two_units_have_a_plan_with_the_reason() -> None:
    scene = draw_usual_approach(picture(example("syntec-mill"), "travel"), "1+4")
    assert any(note.text.startswith("The axes do not move in one unit") for note in scene.notes)


def test_speeds_that_no_gear_has_are_a_doubt_and_an_amber_field() -> None:
    file = example("num-1060-mill")
    assert "gap_low" not in simulate(file, "spindle", None, {"move.speed": 600}).result
    low = next(
        address for address in file.values if address[0] == "spindle.range_min" and address[1] == "1.42"
    )
    old = file.get(low)
    file.set(low, type(old)(540, old.unit))
    check = check_again(file, "spindle", None)
    assert (check.verdict, check.why) == ("doubtful", "No gear has the speeds from 500 to 540 rpm")
    scene = draw_spindle(picture(file, "gears"), check.trace)
    gap = next(area for area in scene.areas if area.sort == "gap")
    assert (gap.left, gap.right) == (500.0, 540.0)
    assert "40 rpm in no gear" in texts_of(scene)
