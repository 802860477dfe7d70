"""Appendix A of the manual, step by step, on a light and on a heavy axis (A-8 to A-10)."""

from dataclasses import dataclass, replace

import pytest

from amp_studio.families.ninepc import law_samples as samples
from amp_studio.families.ninepc.law_tune import (
    SLIGHT,
    SWING,
    Chart,
    Tuned,
    chart,
    highest,
    lowered,
    procedure,
    procedure_run,
)
from amp_studio.sim import SimulationError
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.law import AxisLaw, Ramp

from .conftest import Axis, Values

FEEDRATE = 250.0
"""mm/s: 1500 turns a minute."""
MACHINES: dict[str, Values] = {
    "light": {"servo.motor_type": "b410g"},
    "heavy": {"servo.motor_type": "b420e", "servo.load_inertia_ratio": "r3", "servo.initial_gain": 0.6},
}
"""5974 and 1423 rad/s2 at rated torque."""


@dataclass(frozen=True)
class Bench:
    """An axis on which the procedure is done, and where it ended."""

    law: AxisLaw
    end: Tuned

    def at(self, proportional: float, integral: float) -> Chart:
        return chart(self.law, FEEDRATE, proportional, integral)


@pytest.fixture(scope="module", params=list(MACHINES))
def bench(request: pytest.FixtureRequest, axis: Axis) -> Bench:
    law = axis(MACHINES[request.param], coulomb_friction=5.0, static_friction=8.0)
    return Bench(law, procedure(law, FEEDRATE))


def test_step_1_1500_without_integral_is_overdamped(bench: Bench) -> None:
    seen = bench.at(1500.0, 0.0)
    assert seen.overshoot < 1e-3
    assert max(seen.moving, seen.resting) < 0.01


def test_steps_2_to_4_a_higher_gain_ends_in_a_sharp_overshoot_that_a_lower_one_removes(bench: Bench) -> None:
    gain = bench.end.highest
    assert gain > 2.0 * 1500.0
    assert bench.at(gain * 1.1, 0.0).overshoot > SLIGHT
    assert bench.at(gain / 1.1, 0.0).overshoot < 0.1 * SLIGHT


def test_steps_5_to_7_the_gains_end_5_to_10_times_apart_and_then_nothing_stops_the_oscillation(
    bench: Bench,
) -> None:
    end = bench.end
    assert 5.0 < end.proportional / end.integral < 10.0
    assert end.proportional < 0.8 * end.highest
    assert bench.at(end.proportional, end.integral).clean
    charts = [bench.at(end.highest / 1.3**k, 1.1 * end.unstoppable) for k in range(9)]
    assert all(seen.moving > SWING for seen in charts)


def test_each_higher_integral_gain_brings_an_overshoot_that_a_lower_proportional_one_removes(
    bench: Bench,
) -> None:
    # Step 6, page A-9.
    integral = 0.9 * bench.end.integral
    assert not bench.at(bench.end.highest, integral).clean
    found = lowered(bench.law, FEEDRATE, bench.end.highest, integral)
    assert found is not None
    assert found < bench.end.highest


def test_it_oscillates_in_motion_before_it_does_at_rest(bench: Bench) -> None:
    # Page A-10: first at the commanded velocity, with a higher integral gain at rest too; friction makes the
    # difference.
    charts = [bench.at(bench.end.proportional, bench.end.integral * more) for more in (1.06, 1.5)]
    assert charts[0].moving > SWING > charts[0].resting
    assert min(charts[1].moving, charts[1].resting) > SWING


def test_the_bounded_oscillation_grows_with_the_torque_limit(bench: Bench) -> None:
    # The swing stays the same share of the limit, whatever it is.
    p = list(bench.law.parameters)
    p[samples.LIMIT_POSITIVE] = p[samples.LIMIT_NEGATIVE] = 100.0
    weaker = chart(
        replace(bench.law, parameters=p), FEEDRATE, bench.end.proportional, 2.0 * bench.end.integral
    )
    usual = bench.at(bench.end.proportional, 2.0 * bench.end.integral)
    assert weaker.moving == pytest.approx(usual.moving, rel=0.1)


def test_chatter_of_a_light_axis_is_larger_than_the_overshoot_of_a_heavy_one(axis: Axis) -> None:
    # Page A-9: the same loss of stability throws a light axis further.
    light, heavy = (
        chart(axis(values, coulomb_friction=5.0), FEEDRATE, 65535.0, 0.0).overshoot
        for values in MACHINES.values()
    )
    assert light > 3.0 * heavy > 3.0 * SLIGHT


# -- where it does not fit -------------------------------------------------------------------------


def test_an_axis_too_heavy_for_its_position_gain_is_not_overdamped_at_1500_and_the_result_shows_it(
    axis: Axis,
) -> None:
    heavy = axis({**MACHINES["heavy"], "servo.initial_gain": 1.0})
    assert chart(heavy, FEEDRATE, 1500.0, 0.0).overshoot > SLIGHT
    assert highest(heavy, FEEDRATE) > 10000.0  # the procedure goes on upwards anyway
    text = " ".join(heavy.assumptions)
    assert "too heavy for its position gain" in text
    assert "Proportional Gain 2300 on this axis" in text
    assert "too heavy" not in " ".join(axis().assumptions)


def test_what_does_not_fit_is_in_the_result(axis: Axis) -> None:
    assert "7xx motors" in " ".join(axis({"servo.motor_type": "b720e"}).assumptions)
    assert "smooth overshoot" in " ".join(axis().assumptions)
    assert "smooth overshoot" not in " ".join(axis({"servo.velocity_integral_gain": 100.0}).assumptions)
    assert "not stable" in " ".join(axis({"servo.velocity_proportional_gain": 17408.0}).assumptions)


def test_the_smooth_overshoot_of_large_systems_takes_a_soft_load_on_a_linear_scale_or_an_open_loop(
    axis: Axis,
) -> None:
    # Page A-9; an overshoot without an oscillation, at a gain at which a rigid axis has none.
    def overshoot(values: Values, resonance: float) -> float:
        soft = {"resonance": resonance, "coulomb_friction": 3.0, "static_friction": 5.0}
        law = axis({**MACHINES["heavy"], "servo.velocity_proportional_gain": 3000.0, **values}, **soft)
        columns = run_axis(
            law,
            move(400.0, FEEDRATE, Ramp("linear", 600.0, 600.0)),
            RunEnd(1.3),
            engine="compiled",
            thin=True,
        ).columns
        return float(columns["velocity"].max()) / FEEDRATE - 1.0

    scale: Values = {"servo.position_feedback_type": "aqb-one-marker", "servo.position_counts": 100000.0}
    opened: Values = {"servo.position_loop_type": "open"}
    assert overshoot(scale, 8.0) > 0.05
    assert overshoot(opened, 8.0) > 0.05
    assert max(overshoot(scale, 0.0), overshoot(opened, 0.0), overshoot({}, 0.0)) < 0.01


# -- the scenario ----------------------------------------------------------------------------------


def test_the_procedure_ends_at_the_edge_and_recommends_nothing(bench: Bench) -> None:
    trace = procedure_run(bench.law, {})
    end = trace.result["velocity_proportional_gain"][0]
    assert end is not None
    assert end == pytest.approx(bench.end.proportional, rel=0.01)
    assert trace.recommendations == ()
    assert "A-8 to A-10" in trace.assumptions[0]
    assert "tune finds gains with a reserve" in trace.assumptions[0]


def test_it_goes_without_torque_filter_and_discharge_as_table_a_a_needs_it(axis: Axis) -> None:
    law = axis({"servo.torque_filter": 50.0, "servo.integrator_discharge": 8.0})
    assert procedure_run(law, {}).result == procedure_run(axis(), {}).result


@pytest.mark.parametrize(
    ("values", "settings", "words"),
    [
        ({"servo.position_loop_type": "open"}, {}, "no digital velocity loop inside a closed position loop"),
        ({"servo.loop_type": "sercos"}, {}, "no digital velocity loop"),
        ({"servo.max_torque_positive": 0.0}, {}, "it cannot move"),
        ({"feedrate.max_cutting": None, "feedrate.rapid": None}, {}, "Give a feedrate"),
        ({}, {"move.feedrate": 0.0}, "must be above 0"),
        ({}, {"move.speed": 1.0}, "move.speed"),
        ({}, {}, "No proportional gain keeps axis 1 from overshoot"),
        ({"servo.initial_gain": 0.001}, {}, "at most 30 s are simulated"),
    ],
)
def test_an_axis_that_cannot_be_tuned_shows_why(
    axis: Axis, values: Values, settings: Values, words: str, request: pytest.FixtureRequest
) -> None:
    law = (
        axis({"servo.initial_gain": 20.0}, delay=0.05)
        if words.startswith("No proportional")
        else axis(values)
    )
    with pytest.raises(SimulationError, match=words):
        procedure_run(law, settings)
