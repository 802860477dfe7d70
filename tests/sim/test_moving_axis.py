"""An axis whose command changes while it moves: one motion, stepped once."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.sim import AxisLaw, law_of
from amp_studio.sim.axis.motion import Engine, RunEnd, run_axis
from amp_studio.sim.axis.moving_axis import MovingAxis, way
from amp_studio.sim.axis.orders import Watch
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.law import Ramp
from tests.sim.tiny import tiny


@pytest.mark.parametrize(
    "ramp",
    [Ramp("linear", 200.0), Ramp("exponential", time=0.02), Ramp("s-curve", 200.0, jerk=4000.0), Ramp()],
)
def test_the_whole_is_one_motion_that_turns_where_the_event_was_seen(ramp: Ramp) -> None:
    course = MovingAxis(tiny())
    seen = course.go(20.0, ramp, Watch(5.0, 1.0), 100.0)
    assert seen is not None
    assert 5.0 <= seen.position < 5.0 + 20.0 * 0.002
    at = course.position
    course.stop(Ramp())
    course.to(1.0, 10.0, ramp)
    motion = course.motion()
    columns = motion.columns
    crossed = int(np.argmax(columns["position"] >= 5.0))
    assert columns["time_s"][crossed] == pytest.approx(seen.time, abs=0.001)
    assert columns["command_position"].max() == pytest.approx(at, abs=1e-9)
    assert columns["position"][-1] == pytest.approx(1.0, abs=0.01)
    assert motion.command_end is not None


def test_an_event_in_the_middle_of_a_ramp_is_seen_too() -> None:
    course = MovingAxis(tiny())
    seen = course.go(100.0, Ramp("linear", 50.0), Watch(0.5, 1.0), 300.0)
    assert seen is not None
    assert 0.0 < course.velocity < 20.0
    course.stop(Ramp("linear", 50.0))
    assert course.position == pytest.approx(course.motion().columns["command_position"][-1])


def test_an_event_that_never_comes_is_none() -> None:
    assert MovingAxis(tiny()).go(20.0, Ramp(), Watch(1e6, 1.0), 10.0) is None


def test_an_event_of_an_earlier_stage_is_not_seen_again() -> None:
    course = MovingAxis(tiny())
    assert course.go(20.0, Ramp(), Watch(5.0, 1.0), 100.0) is not None
    course.stop(Ramp())
    back = course.go(-20.0, Ramp(), Watch(3.0, -1.0), 100.0)
    assert back is not None
    assert back.position == pytest.approx(3.0, abs=0.05)


def of_the_mill() -> AxisLaw:
    """Return an axis of a law whose machine code other tests need, too."""
    file = open_file(examples_folder() / "mill-1394" / "MILL_1394.amp").file
    return bind_axis(file, law_of("9pc"), "1", {"model.delay": 0.7, "model.backlash": 0.05})


@pytest.mark.parametrize(
    ("engine", "made"),
    [("plain", partial(tiny, delay=0.0007, backlash=0.05)), ("compiled", of_the_mill)],
    ids=["plain", "compiled"],
)
def test_stepped_in_slices_it_is_the_motion_of_one_run(engine: Engine, made: Callable[[], AxisLaw]) -> None:
    """The state that an interruption keeps is all of it, in both engines and with a delay in the drive."""
    axis, ramp = made(), Ramp("linear", 200.0)
    whole = run_axis(axis, move(5.0, 20.0, ramp), RunEnd(0.4), engine=engine, thin=True).columns
    sliced = MovingAxis(axis, engine=engine)
    sliced.order(way(5.0, 20.0, ramp, axis), 1.0)
    while sliced.time < 0.35:
        sliced.advance(0.007)
    columns = sliced.motion().columns
    rows = int(np.searchsorted(columns["time_s"], 0.35))
    for name in ("time_s", "position", "command_position", "torque", "measured_position"):
        np.testing.assert_allclose(columns[name][:rows], whole[name][:rows], rtol=0.0, atol=1e-12)


def test_after_an_alarm_the_axis_is_taken_up_where_it_came_to_rest() -> None:
    moving = MovingAxis(tiny(excess=0.4, coulomb_friction=5.0), coast=5.0)
    moving.go(20.0, Ramp(), Watch(50.0, 1.0), 60.0)
    assert moving.stop_number == 1
    assert moving.is_over
    at = moving.measured
    moving.restart()
    assert not moving.is_over
    moving.to(at + 1.0, 5.0, Ramp("linear", 50.0))
    assert moving.measured == pytest.approx(
        at + 1.0, abs=0.07
    )  # friction stays in a loop without an integral
