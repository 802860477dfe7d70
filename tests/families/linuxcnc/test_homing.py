"""Homing and limits beside those of a real LinuxCNC, which is a second opinion where methods agree."""

import os
import shutil

import pytest

from amp_studio.sim import SimulationError, simulate
from tests.programs.test_block import example

from .real_homing import HOMINGS, MEASURED, RealHoming, keys_of, measured, simulated
from .real_limits import BLOCKS, EDGE, JOGS, planned
from .real_limits import measured as measured_limits
from .test_real_program import has_user

SAMPLES = 0.0021
"""s: two servo samples later or earlier, which is how far both may see a switch apart."""
EACH = [pytest.param(homing, axis, id=f"{homing.name} {axis}") for homing in HOMINGS for axis in homing.homes]


@pytest.mark.parametrize(("homing", "axis"), EACH)
def test_an_axis_turns_and_ends_where_the_real_one_does(homing: RealHoming, axis: str) -> None:
    """Onto the switch, back, off it at the latch speed, and to Home: the same places, and 0.025 s at most."""
    real, (ours, trace) = MEASURED[homing.name][axis], simulated(homing, axis)
    keys = keys_of(homing, axis)
    search, latch = float(keys["HOME_SEARCH_VEL"]), float(keys["HOME_LATCH_VEL"])
    slow = abs(latch) * SAMPLES
    fast = abs(search) * SAMPLES or slow
    # A latch in the direction of the search is begun by a second turn, off the switch as fast as onto it.
    first = 2 if search * latch > 0.0 else 1
    assert len(ours.turns) == len(real.turns)
    assert ours.turns[:first] == pytest.approx(real.turns[:first], abs=fast or 1e-6)
    assert ours.turns[first:] == pytest.approx(real.turns[first:], abs=slow)
    assert ours.time == pytest.approx(real.time, abs=0.025)
    assert trace.result["home_position"] == (float(keys["HOME"]), "mm")


@pytest.mark.parametrize("block", BLOCKS)
def test_a_block_beyond_a_limit_is_refused_by_both(block: str) -> None:
    """An arc that ends inside was "not begun" here; the real one begins it and stops beyond the limit."""
    words, alarms = BLOCKS[block][0], planned(block).alarms
    assert bool(alarms) == bool(words)
    if alarms:
        assert ("is not begun" in alarms[0].message) == ("would exceed" in words)
        assert f"at {'-' if 'negative' in words else ''}{EDGE:g} mm" in alarms[0].message


def test_a_move_against_a_limit_is_refused_in_the_scenario_too() -> None:
    trace = simulate(example("linuxcnc-mill"), "travel", "X", {})
    assert "is refused" in trace.alarms[0].message
    assert trace.result["limit"] == (8.0, "mm")


@pytest.mark.skipif(
    not (os.environ.get("AMP_STUDIO_FULL") and shutil.which("linuxcnc") and os.geteuid() == 0 and has_user()),
    reason="a minute, alone on the computer: make campaign, with linuxcnc-uspace, root and a user cnc",
)
@pytest.mark.parametrize("homing", [*HOMINGS, None], ids=lambda homing: homing.name if homing else "limits")
def test_the_real_control_still_does_so(homing: RealHoming | None) -> None:
    if homing is None:
        blocks, jogs = measured_limits()
        assert {block: words for block, (words, _) in blocks.items()} == {
            block: words for block, (words, _) in BLOCKS.items()
        }
        assert [abs(place) for place in jogs] == pytest.approx([EDGE] * len(JOGS), abs=1e-5)
        return
    for axis, course in measured(homing).items():
        assert course.turns == pytest.approx(MEASURED[homing.name][axis].turns, abs=0.1), axis
        assert course.time == pytest.approx(MEASURED[homing.name][axis].time, abs=0.03), axis


def test_what_the_real_one_refuses_is_refused() -> None:
    """H817: a search without a latch."""
    file = example("linuxcnc-mill")
    file.set(("joint.home_latch_velocity", "0"), None)
    with pytest.raises(SimulationError, match="needs a latch"):
        simulate(file, "home", "X", {})
