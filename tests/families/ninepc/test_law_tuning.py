"""Appendix A of the manual, step by step, on a light and on a heavy axis (A-8 to A-10).

The tuning program moves at the cutting feedrate and waits; the ramp is just below what the servo can do. An oscillation is judged by its
persistence: the torque swings through a quarter of its limits at the end of the constant speed, or at rest.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from amp_studio.sim.law import Ramp
from amp_studio.sim.motion import Until, run_axis
from amp_studio.sim.ramps import end_of, move

from .conftest import Axis

FEEDRATE = 250.0
"""mm/s: 1500 turns a minute."""
SWING = 100.0
"""% of rated torque, a quarter of both limits."""
SLIGHT = 0.02
"""Share of the feedrate: a slight overshoot."""


class Chart(NamedTuple):
    """What the strip chart recorder shows of one run."""

    overshoot: float
    """Share of the feedrate."""
    moving: float
    """Swing of the torque in % at the end of the constant speed."""
    resting: float

    @property
    def clean(self) -> bool:
        return self.overshoot < SLIGHT and self.moving < SWING and self.resting < SWING


Tuning = Callable[[float, float], Chart]
MACHINES = {
    "light": ({"servo.motor_type": "b410g"}, 1.0),
    "heavy": ({"servo.motor_type": "b420e", "servo.load_inertia_ratio": "r3"}, 0.6),
}
"""Values and position gain: 5974 and 1423 rad/s2 at rated torque."""


@pytest.fixture(scope="module", params=list(MACHINES))
def tuning(request: pytest.FixtureRequest, axis: Axis) -> Tuning:
    values, gain = MACHINES[request.param]

    def run(proportional: float, integral: float, limit: float = 200.0) -> Chart:
        law = axis(
            {
                **values,
                "servo.initial_gain": gain,
                "servo.velocity_proportional_gain": proportional,
                "servo.velocity_integral_gain": integral,
                "servo.max_torque_positive": limit,
                "servo.max_torque_negative": limit,
            },
            coulomb_friction=5.0,
            static_friction=8.0,
        )
        ramp = min(0.8 * 200.0 * law.machine.acceleration_per_output, FEEDRATE * gain / 0.12)
        profile = move(FEEDRATE * (FEEDRATE / ramp + 0.8 + 0.3 / gain), FEEDRATE, Ramp("linear", ramp, ramp))
        end = end_of(profile)
        columns = run_axis(law, profile, Until(end + 0.8 / gain), engine="compiled", thin=True).columns
        time, torque = columns["time_s"], columns["output"]
        braking = end - FEEDRATE / ramp
        steady = (time > braking - 0.15) & (time < braking)
        return Chart(
            float(columns["velocity"][time < braking].max()) / FEEDRATE - 1.0,
            float(np.ptp(torque[steady])),
            float(np.ptp(torque[-150:])),
        )

    return run


def highest(tuning: Tuning) -> float:
    """Return the highest proportional gain without an integral one that is clean, to 10 % (steps 2 to 4)."""
    gain = 1500.0
    while tuning(gain * 1.1, 0.0).clean:
        gain *= 1.1
    return gain


def lowered(tuning: Tuning, proportional: float, integral: float) -> float | None:
    """Return the first clean proportional gain below, None if there is none down to an eighth (step 6)."""
    gain = proportional
    while gain > proportional / 8.0:
        if tuning(gain, integral).clean:
            return gain
        gain /= 1.1
    return None


def ended(tuning: Tuning) -> tuple[float, float, float]:
    """Raise the integral gain and lower the proportional one in turn; return both at the end and the integral gain that no
    proportional gain stops (steps 5 to 7).
    """
    proportional = highest(tuning)
    integral, last = proportional / 50.0, 0.0
    while (found := lowered(tuning, proportional, integral)) is not None:
        proportional, last, integral = found, integral, integral * 1.1
    return proportional, last, integral


def test_step_1_1500_without_integral_is_overdamped(tuning: Tuning) -> None:
    chart = tuning(1500.0, 0.0)
    assert chart.overshoot < 1e-3
    assert max(chart.moving, chart.resting) < 1.0


def test_steps_2_to_4_a_higher_gain_ends_in_a_sharp_overshoot_that_a_lower_one_removes(
    tuning: Tuning,
) -> None:
    gain = highest(tuning)
    over, below = tuning(gain * 1.1, 0.0), tuning(gain / 1.1, 0.0)
    assert gain > 2.0 * 1500.0
    assert over.overshoot > SLIGHT
    assert below.overshoot < 0.1 * SLIGHT


def test_steps_5_to_7_the_gains_end_5_to_10_times_apart_and_then_nothing_stops_the_oscillation(
    tuning: Tuning,
) -> None:
    first = highest(tuning)
    proportional, integral, too_high = ended(tuning)
    assert 5.0 < proportional / integral < 10.0
    assert proportional < 0.8 * first
    assert tuning(proportional, integral).clean
    charts = [tuning(first / 1.3**k, 1.2 * too_high) for k in range(9)]
    assert all(chart.moving > SWING for chart in charts)


def test_it_oscillates_in_motion_before_it_does_at_rest(tuning: Tuning) -> None:
    # Page A-10: first at the commanded velocity, with a higher integral gain at rest too; friction makes the difference.
    proportional, integral, _ = ended(tuning)
    charts = [tuning(proportional, integral * more) for more in (1.1, 1.5)]
    assert charts[0].moving > SWING > charts[0].resting
    assert min(charts[1].moving, charts[1].resting) > SWING


def test_the_bounded_oscillation_grows_with_the_torque_limit(tuning: Callable[..., Chart]) -> None:
    proportional, integral, _ = ended(tuning)
    swings = [tuning(proportional, 2.0 * integral, limit).moving for limit in (100.0, 200.0)]
    assert swings[1] / swings[0] == pytest.approx(2.0, rel=0.1)


def test_chatter_of_a_light_axis_is_larger_than_the_overshoot_of_a_heavy_one(axis: Axis) -> None:
    # Page A-9: the same loss of stability throws a light axis further.
    sizes = []
    for values, _ in MACHINES.values():
        law = axis({**values, "servo.velocity_proportional_gain": 65535.0}, coulomb_friction=5.0)
        ramp = FEEDRATE / 0.12
        profile = move(FEEDRATE, FEEDRATE, Ramp("linear", ramp, ramp))
        columns = run_axis(law, profile, Until(0.8), engine="compiled", thin=True).columns
        sizes.append(float(columns["velocity"].max()) / FEEDRATE - 1.0)
    assert sizes[0] > 3.0 * sizes[1] > 3.0 * SLIGHT


def test_an_axis_too_heavy_for_its_position_gain_is_not_overdamped_at_1500_and_the_result_says_so(
    axis: Axis,
) -> None:
    heavy = axis({"servo.motor_type": "b420e", "servo.load_inertia_ratio": "r3"})
    said = " ".join(heavy.assumptions)
    assert "too heavy for its position gain" in said
    assert "Proportional Gain 2300 on this axis" in said
    assert "too heavy" not in " ".join(axis().assumptions)


def test_what_does_not_fit_is_said_with_the_result(axis: Axis) -> None:
    assert "7xx motors" in " ".join(axis({"servo.motor_type": "b720e"}).assumptions)
    assert "smooth overshoot" in " ".join(axis().assumptions)
    assert "smooth overshoot" not in " ".join(axis({"servo.velocity_integral_gain": 100.0}).assumptions)
    assert "not stable" in " ".join(axis({"servo.velocity_proportional_gain": 17408.0}).assumptions)
