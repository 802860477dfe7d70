"""A command that goes on until something happens: the motion before the event stays what it was."""

from __future__ import annotations

import numpy as np
import pytest

from amp_studio.sim.course import Course
from amp_studio.sim.law import Ramp
from tests.sim.tiny import tiny


@pytest.mark.parametrize(
    "ramp",
    [Ramp("linear", 200.0), Ramp("exponential", time=0.02), Ramp("s-curve", 200.0, jerk=4000.0), Ramp()],
)
def test_the_whole_is_one_motion_that_turns_where_the_event_was_seen(ramp: Ramp) -> None:
    course = Course(tiny())
    seen = course.go(20.0, ramp, lambda c: c["position"] >= 5.0, 100.0)
    assert seen is not None
    assert 5.0 <= seen.position < 5.0 + 20.0 * 0.002
    at = course.position
    course.stop(Ramp())
    course.to(1.0, 10.0, ramp)
    motion = course.run()
    columns = motion.columns
    crossed = int(np.argmax(columns["position"] >= 5.0))
    assert columns["time_s"][crossed] == pytest.approx(seen.time, abs=0.001)
    assert columns["command_position"].max() == pytest.approx(at, abs=1e-9)
    assert columns["position"][-1] == pytest.approx(1.0, abs=0.01)
    assert motion.command_end is not None


def test_an_event_in_the_middle_of_a_ramp_is_seen_too() -> None:
    course = Course(tiny())
    seen = course.go(100.0, Ramp("linear", 50.0), lambda c: c["position"] >= 0.5, 300.0)
    assert seen is not None
    assert 0.0 < course.velocity < 20.0
    course.stop(Ramp("linear", 50.0))
    assert course.position == pytest.approx(course.run().columns["command_position"][-1])


def test_an_event_that_never_comes_is_none() -> None:
    assert Course(tiny()).go(20.0, Ramp(), lambda c: c["position"] >= 1e6, 10.0) is None


def test_an_event_of_an_earlier_stage_is_not_seen_again() -> None:
    course = Course(tiny())
    assert course.go(20.0, Ramp(), lambda c: c["position"] >= 5.0, 100.0) is not None
    course.stop(Ramp())
    back = course.go(-20.0, Ramp(), lambda c: c["position"] <= 3.0, 100.0)
    assert back is not None
    assert back.position == pytest.approx(3.0, abs=0.05)
