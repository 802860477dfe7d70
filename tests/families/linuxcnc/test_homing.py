"""Homing and limits beside those of a real LinuxCNC, which is a second opinion where methods agree."""

import os
import shutil

import pytest

from amp_studio.sim import SimulationError, simulate
from tests.programs.test_block import example

from .real_homing import HOMINGS, LIMIT, MEASURED, RealHoming, measured, simulated
from .test_real_program import has_user

SAMPLES = 0.0021
"""s: two servo samples later or earlier, which is how far both may see a switch apart."""
EACH = [pytest.param(homing, axis, id=f"{homing.name} {axis}") for homing in HOMINGS for axis in homing.homes]


@pytest.mark.parametrize(("homing", "axis"), EACH)
def test_an_axis_turns_and_ends_where_the_real_one_does(homing: RealHoming, axis: str) -> None:
    """Onto the switch, back, off it at the latch speed, and to Home: the same places, and 0.02 s at most."""
    real, (ours, trace) = MEASURED[homing.name][axis], simulated(homing, axis)
    keys = dict(each.split(" = ") for each in homing.homes[axis].split("|"))
    search, latch = abs(float(keys["HOME_SEARCH_VEL"])), abs(float(keys["HOME_LATCH_VEL"]))
    assert len(ours.turns) == len(real.turns)
    assert ours.turns[0] == pytest.approx(real.turns[0], abs=search * SAMPLES)
    assert ours.turns[1:] == pytest.approx(real.turns[1:], abs=latch * SAMPLES)
    assert ours.time == pytest.approx(real.time, abs=0.02)
    assert trace.result["home_position"] == (float(keys["HOME"]), "mm")


def test_both_refuse_a_move_beyond_a_limit_and_end_a_jog_at_it() -> None:
    words, place = LIMIT
    assert "would exceed X's positive limit" in words
    trace = simulate(example("linuxcnc-mill"), "travel", "X", {})
    assert "limit" in trace.alarms[0].message
    assert trace.result["limit"] == (8.0, "mm")
    assert place == 500.0


@pytest.mark.skipif(
    not (os.environ.get("AMP_STUDIO_FULL") and shutil.which("linuxcnc") and os.geteuid() == 0 and has_user()),
    reason="a minute, alone on the computer: make campaign, with Debian's linuxcnc-uspace, root and a user cnc",
)
@pytest.mark.parametrize("homing", HOMINGS, ids=lambda homing: homing.name)
def test_the_real_control_still_does_so(homing: RealHoming) -> None:
    courses, (words, place) = measured(homing)
    for axis, course in courses.items():
        assert course.turns == pytest.approx(MEASURED[homing.name][axis].turns, abs=0.1), axis
        assert course.time == pytest.approx(MEASURED[homing.name][axis].time, abs=0.03), axis
    assert (words, place) == (LIMIT[0], pytest.approx(LIMIT[1], abs=1e-6))


def test_what_the_real_one_refuses_is_refused() -> None:
    """H817: a search without a latch."""
    file = example("linuxcnc-mill")
    file.set(("joint.home_latch_velocity", "0"), None)
    with pytest.raises(SimulationError, match="needs a latch"):
        simulate(file, "home", "X", {})
