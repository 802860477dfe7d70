"""One sequence of homing for every family: what it meets, and what it shows where it fails."""

import itertools
import math

import pytest

from amp_studio.sim.axis.homing import Homed, home_axis, markers_ahead
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.command.events import CodedScale, Failure, Homing, Ramp, Surroundings
from tests.sim.tiny import tiny

RAMP = Ramp("linear", 200.0)
SWITCHED = Homing(
    approach=20.0,
    leave=-4.0,
    marker="next",
    turn=5.0,
    coordinate=100.0,
    failures={
        "marker": Failure("NO MARKER", "none", 25.0),
        "stuck": Failure("STUCK", "on", 25.0),
        "switch": Failure("NO SWITCH", "none"),
    },
)


def homed(homing: Homing, around: Surroundings) -> tuple[MovingAxis, Homed]:
    moving, found = MovingAxis(tiny(), engine="plain"), Homed()
    moving.follow(home_axis(moving, homing, RAMP, around, found))
    return moving, found


def test_the_live_axis_goes_through_the_same_sequence_in_slices_of_time() -> None:
    """A machine behind an emulated control is stepped by the clock: the same places, whatever the slices
    are.
    """
    around = Surroundings(switch=30.0, marker=28.0)
    _, whole = homed(SWITCHED, around)
    moving, found = MovingAxis(tiny(), engine="plain", keep=False), Homed()
    moving.begin(home_axis(moving, SWITCHED, RAMP, around, found))
    while moving.is_busy:
        moving.advance(0.013)
    assert (found.marker, found.coordinate) == (whole.marker, whole.coordinate) == (28.0, 100.0)
    assert found.left == whole.left


@pytest.mark.parametrize(
    ("around", "code"),
    [
        (Surroundings(switch=30.0, marker=28.0, has_markers=False), "NO MARKER"),
        (Surroundings(switch=30.0, marker=28.0, is_stuck=True), "STUCK"),
        (Surroundings(switch=30.0, marker=28.0, high=25.0), "NO SWITCH"),
    ],
    ids=["marker missing", "switch stuck", "end of the way before the switch"],
)
def test_a_homing_that_fails_names_its_alarm_and_leaves_the_axis_at_rest(
    around: Surroundings, code: str
) -> None:
    moving, found = homed(SWITCHED, around)
    assert (found.alarm, found.home, found.coordinate) == (code, None, None)
    assert moving.velocity == 0.0


def test_the_search_goes_on_until_the_way_ends() -> None:
    moving, _ = homed(SWITCHED, Surroundings(switch=400.0, high=350.0))
    assert 340.0 < moving.load < 352.0


def test_a_switch_on_which_the_axis_is_is_left_at_once() -> None:
    _, found = homed(SWITCHED, Surroundings(switch=-1.0, marker=-3.0))
    assert found.marker == -3.0


def test_a_second_approach_counts_where_it_stops() -> None:
    around = Surroundings(switch=30.0)
    grbl = Homing(
        approach=20.0,
        leave=-20.0,
        marker="none",
        turn=1.0,
        coordinate=-2.0,
        final=20.0,
        offset=-2.0,
        again=2.0,
        pull_off=2.0,
        stops_by_switch=True,
    )
    moving, found = homed(grbl, around)
    assert found.marker == pytest.approx(30.0, abs=0.2)
    assert moving.position == pytest.approx(found.marker - 2.0)


def test_a_coded_scale_is_known_by_three_markers() -> None:
    """LS176, 20 and 20.02 mm: at most three periods of travel, whichever way."""
    scale = CodedScale(20.0, 20.02, 10.0, 7.0)
    ahead = markers_ahead(scale, 101.0, 1.0)
    gaps = [b - a for a, b in itertools.pairwise(ahead)]
    # An odd marker i and the even one behind it are o + i * (1501 - 1500) apart: i = (gap - o) / 0.02.
    assert round((gaps[1] - 10.0) / 0.02) == ahead[1] / 20.0 == 6.0
    homing = Homing(
        approach=0.0, leave=20.0, marker="next", turn=20.0, coordinate=50.0, final=10.0, scale=scale
    )
    moving, found = homed(homing, Surroundings(scale=101.0))
    assert found.marker == pytest.approx(ahead[2] - 101.0)
    assert found.marker < 30.0
    assert moving.position == pytest.approx(50.0 - 7.0 - 101.0)  # scale zero is called 7
    assert found.coordinate == 50.0


def test_without_markers_a_coded_scale_is_no_home() -> None:
    homing = Homing(
        approach=0.0,
        leave=20.0,
        marker="next",
        turn=20.0,
        coordinate=0.0,
        scale=CodedScale(20.0, 20.02, 10.0, 0.0),
    )
    _, found = homed(homing, Surroundings(has_markers=False))
    assert found.alarm == "HOME"
    assert math.isinf(Surroundings().switch)
