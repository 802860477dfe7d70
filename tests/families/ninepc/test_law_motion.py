"""What the manual prints of a 9/PC axis in motion, against the simulated motion (chapters 7 and 10)."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from amp_studio.families.ninepc.law_advice import advise
from amp_studio.families.ninepc.law_figures import (
    Loop,
    following_error,
    printed_excess_error,
    response_time,
    sentence_excess_error,
)
from amp_studio.sim import SimulationError
from amp_studio.sim.axis.motion import Engine, Motion, RunEnd, run_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.profiles import POLYNOMIAL
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.scenarios.frequency import run_frequency
from amp_studio.sim.scenarios.step import run_step
from amp_studio.sim.trace import Trace

from .conftest import Axis, Values

Series = npt.NDArray[np.float64]
IDEAL = {"motor_count": 0.0, "position_count": 0.0}


def cruise(axis: AxisLaw, velocity: float, seconds: float) -> Motion:
    """Run at a constant velocity in u/s from the first moment on."""
    profile = [0.0, math.inf, 0.0, velocity, 0.0, 0.0, POLYNOMIAL, 0.0]
    return run_axis(axis, profile, RunEnd(seconds), thin=True)


def step(axis: AxisLaw, **settings: float | str) -> Trace:
    """Run the scenario `step` with its settings, without ``move.``."""
    return run_step(axis, {f"move.{name}": value for name, value in settings.items()})


def figure(trace: Trace, name: str) -> float:
    value = trace.result[name][0]
    assert value is not None
    return value


# -- following error -------------------------------------------------------------------------------


@pytest.mark.parametrize(("gain", "error"), [(0.25, 0.0040), (0.5, 0.0020), (1.0, 0.0010), (2.0, 0.0005)])
def test_table_7_a_is_the_steady_following_error(axis: Axis, gain: float, error: float) -> None:
    # Page 7-25: mm of following error for each mm/min; at 3000 mm/min.
    law = axis({"servo.initial_gain": gain}, **IDEAL)
    motion = cruise(law, 50.0, 20.0 / law.position_rate)
    assert motion.columns["following_error"][-1] == pytest.approx(3000.0 * error, rel=1e-5)
    assert law.predict(50.0)["steady_following_error"].value == pytest.approx(3000.0 * error)


@pytest.mark.parametrize(("percent", "share"), [(0.0, 1.0), (80.0, 0.2), (100.0, 0.0)])
def test_feed_forward_of_80_percent_leaves_a_fifth_of_the_following_error(
    axis: Axis, percent: float, share: float
) -> None:
    # Page 7-28.
    law = axis({"servo.position_loop_type": "zfe", "servo.feed_forward": percent}, **IDEAL)
    motion = cruise(law, 50.0, 1.2)
    assert motion.columns["following_error"][-1] == pytest.approx(3.0 * share, abs=1e-4)


def test_beyond_the_gain_break_the_following_error_is_that_of_its_equation(axis: Axis) -> None:
    # Pages 7-22, 7-27: 6000 mm/min at gain 1, break at 2 mm, half the gain from there on: 2 + 4 / 0.5.
    law = axis({"servo.gain_break_point": 2.0, "servo.gain_break_ratio": 0.5}, **IDEAL)
    assert following_error(Loop(1.0, 2.0, 0.5, 0.0), 100.0) == 10.0
    assert cruise(law, 100.0, 2.0).columns["following_error"][-1] == pytest.approx(10.0, rel=1e-5)


def test_both_readings_of_the_least_excess_error_are_given(axis: Axis) -> None:
    # Page 7-20: the equation divides by the ratio from the start, the sentence takes 110 % of the error that
    # is expected.
    loop = Loop(1.0, 2.0, 0.5, 0.0)
    assert printed_excess_error(loop, 100.0) == pytest.approx(13.2)
    assert sentence_excess_error(loop, 100.0) == pytest.approx(11.0)
    law = axis({"servo.gain_break_point": 2.0, "servo.gain_break_ratio": 0.5, "servo.excess_error": 9.9})
    reported = law.predict(100.0)
    assert (reported["excess_error_printed"].value, reported["excess_error_by_sentence"].value) == (
        pytest.approx(13.2),
        pytest.approx(11.0),
    )
    # Without a gain break both are one.
    assert printed_excess_error(Loop(2.0, 9.0, 1.0, 0.0), 100.0) == sentence_excess_error(
        Loop(2.0, 9.0, 1.0, 0.0), 100.0
    )
    assert cruise(law, 100.0, 2.0).stop == 1


@pytest.mark.parametrize("gain", [0.5, 1.0, 2.0])
def test_the_response_time_of_10_2_is_two_time_constants_of_the_loop(axis: Axis, gain: float) -> None:
    # 240, 120 and 60 ms: the axis then has 86.5 % of the feedrate. A stiff velocity loop leaves the position
    # loop alone.
    law = axis({"servo.initial_gain": gain, "servo.velocity_proportional_gain": 4000.0}, **IDEAL)
    columns = cruise(law, 50.0, 0.5 / gain).columns
    reached = columns["time_s"][np.flatnonzero(columns["velocity"] >= 50.0 * (1.0 - math.exp(-2.0)))[0]]
    assert response_time(Loop(gain, 1.0, 1.0, 0.0)) == pytest.approx(0.12 / gain)
    assert reached == pytest.approx(0.12 / gain, rel=0.05)


def test_the_table_of_response_times_is_the_equation_but_for_a_slip() -> None:
    # Page 10-2 prints 240, 120, 60, 30, 15 ms for the gains 1/2, 1, 2, 3, 4; its own equation gives 40 and 30
    # for the last two.
    printed = {0.5: 240.0, 1.0: 120.0, 2.0: 60.0, 3.0: 30.0, 4.0: 15.0}
    equation = {gain: 1000.0 * response_time(Loop(gain, 1.0, 1.0, 0.0)) for gain in printed}
    assert [equation[gain] for gain in (0.5, 1.0, 2.0)] == pytest.approx([240.0, 120.0, 60.0])
    assert [equation[gain] for gain in (3.0, 4.0)] == pytest.approx([40.0, 30.0])
    assert printed[4.0] != equation[4.0]


# -- torque ----------------------------------------------------------------------------------------


def test_a_torque_offset_carries_the_weight_that_would_pull_the_axis_down(axis: Axis) -> None:
    # Page 7-63: 1 % of the maximum torque (300 % of rated), at rest too; without it the axis sags.
    weight: Values = {"servo.torque_offset": 1.0, "servo.torque_offset_direction": "plus"}
    sag = [
        cruise(axis(values, gravity=3.0, **IDEAL), 0.0, 0.5).columns["position"][-1]
        for values in (weight, {})
    ]
    assert sag[0] == pytest.approx(0.0, abs=0.002)  # the delay of the first sample
    # Kept by the position loop alone: 3 % of torque / (VPG in % for 1 mm/s x position gain).
    assert sag[1] == pytest.approx(
        -3.0 / (100.0 * 1500.0 / 65536.0 * 2.0 * math.pi / 10.0) / (1000.0 / 60.0), rel=0.02
    )
    assert axis(weight).machine.gravity == pytest.approx(3.0)
    assert "7-63" in axis(weight).assumed["gravity"]


def test_torque_limits_hold_for_accelerating_and_braking_in_a_direction(axis: Axis) -> None:
    # Pages 7-61, 7-62.
    law = axis(
        {
            "servo.max_torque_positive": 40.0,
            "servo.max_torque_negative": 10.0,
            "servo.velocity_proportional_gain": 4000.0,
            "accdec.linear_acceleration": 20000.0,
        }
    )
    for distance, limit in ((150.0, 40.0), (-150.0, 10.0)):
        trace = step(law, distance=distance, feedrate=12000.0)
        output = trace.columns["output"] * math.copysign(1.0, distance)
        moving = trace.columns["velocity"] * math.copysign(1.0, distance) > 60.0
        assert output[moving].max() == limit
        assert output[moving].min() == -limit


def test_friction_compensation_takes_the_lag_out_of_the_start_of_a_move(axis: Axis) -> None:
    # Page 7-84: high friction shows as lag at the beginning; compensation equal to the friction removes it.
    compensation: Values = {
        "servo.friction_threshold": 100.0,
        "servo.friction_positive": 20.0,
        "servo.friction_negative": 20.0,
    }
    machine = {"coulomb_friction": 20.0, "static_friction": 20.0}
    moved = [
        cruise(axis(values, **machine), 5.0, 0.08).columns["position"][-1] for values in (compensation, {})
    ]
    free = cruise(axis(), 5.0, 0.08).columns["position"][-1]
    assert moved[0] == pytest.approx(free, rel=0.1)
    assert moved[1] < 0.1 * free
    assert axis(compensation).machine.coulomb_friction == 20.0


def test_the_discharge_rate_takes_the_velocity_overshoot_back_sooner(axis: Axis) -> None:
    # Page 7-58: noticeable with ZFE and 100 % feed forward.
    over = []
    for rate in (1.0, 4.0):
        law = axis(
            {
                "servo.position_loop_type": "zfe",
                "servo.feed_forward": 100.0,
                "servo.velocity_integral_gain": 150.0,
                "servo.integrator_discharge": rate,
                "accdec.linear_acceleration": 3000.0,
            },
            viscous_friction=0.2,
        )
        over.append(figure(step(law, distance=150.0, feedrate=12000.0), "overshoot"))
    assert 0.0 < over[1] < 0.8 * over[0]


# -- reversal error --------------------------------------------------------------------------------


def test_reversal_error_compensation_takes_up_the_play_and_the_control_is_in_position(axis: Axis) -> None:
    # Page 7-18: a positive value is added to the first motion in the negative direction.
    play = {
        "backlash": 0.05,
        "resonance": 300.0,
        "damping": 0.5,
        "coulomb_friction": 0.4,
        "motor_friction": 0.0,
    }
    ends = []
    for value in (0.05, 0.0):
        law = axis({"servo.reversal_error": value, "servo.velocity_proportional_gain": 3000.0}, **play)
        trace = step(law, distance=-20.0, feedrate=3000.0)
        assert figure(trace, "in_position_time") < 0.8
        ends.append(trace.columns["position"][-1])
    # The model begins in the middle of its play.
    assert ends[0] - ends[1] == pytest.approx(-0.05, abs=1e-5)
    assert -20.025 < ends[0] < -20.0 < ends[1] < -19.95


def test_the_feedrate_is_halved_while_the_following_error_is_above_the_suppression_point(axis: Axis) -> None:
    # Page 7-21.
    law = axis({"servo.feedrate_suppression": 4.0, "accdec.linear_acceleration": 0.0}, **IDEAL)
    columns = step(law, distance=100.0, feedrate=6000.0).columns
    # 6 mm at 6000 mm/min, 3 mm at the half: the control goes to and fro between both.
    assert 4.0 < columns["following_error"].max() < 4.3
    assert set(columns["feed_share"]) == {0.5, 1.0}
    assert set(step(law, distance=100.0, feedrate=3900.0).columns["feed_share"]) == {1.0}


# -- other drives ----------------------------------------------------------------------------------


def test_an_analog_axis_reaches_rapid_at_its_voltage_and_follows_as_its_gain_shows(axis: Axis) -> None:
    # Pages 7-41, 7-25: 8 V keep 15000 mm/min, at gain 1 with 15 mm of following error.
    analog: Values = {
        "servo.loop_type": "analog",
        "servo.analog_positive_voltage": 8.0,
        "servo.analog_negative_voltage": -8.0,
        "servo.max_acceleration": 5000.0,
    }
    columns = cruise(axis(analog), 250.0, 0.6).columns
    assert columns["output"][-1] == pytest.approx(8.0, rel=1e-3)
    assert columns["following_error"][-1] == pytest.approx(15.0, rel=1e-3)


def test_an_open_loop_moves_without_a_following_error_to_check(axis: Axis) -> None:
    law = axis(
        {
            "servo.position_loop_type": "open",
            "servo.excess_error": 0.001,
            "servo.velocity_integral_gain": 50.0,
        }
    )
    motion = cruise(law, 50.0, 0.5)
    assert motion.stop == 0
    assert motion.columns["velocity"][-1] == pytest.approx(50.0, rel=1e-3)
    assert step(law, distance=20.0, feedrate=3000.0).alarms == ()
    with pytest.raises(SimulationError, match="The position loop of axis 1 is open"):
        run_frequency(law, {})
    chatter = axis({"servo.position_loop_type": "open", "servo.velocity_proportional_gain": 20000.0})
    assert [alarm.code for alarm in step(chatter, distance=20.0, feedrate=3000.0).alarms] == ["UNSTABLE"]


# -- recommendations ----------------------------------------------------------------------------------------


def advised(axis: AxisLaw, **settings: Any) -> dict[str, float]:
    trace = step(axis, **settings)
    return {each.parameter: each.value for each in advise(axis, trace)}


def test_a_well_set_axis_gets_no_advice(axis: Axis) -> None:
    law = axis({"servo.excess_error": 16.5, "servo.feedrate_suppression": 16.4})
    assert advised(law) == {}


def test_a_loose_excess_error_is_brought_down_with_the_limits_below_it(axis: Axis) -> None:
    # Page 7-20: 110 % of the 15 mm at 15000 mm/min.
    reported = advised(axis({"servo.gain_break_ratio": 0.9, "servo.gain_break_point": 150.0}), distance=60.0)
    assert reported["servo.excess_error"] == reported["servo.feedrate_suppression"] == pytest.approx(18.4)
    assert reported["servo.gain_break_point"] == pytest.approx(15.0, rel=0.01)


def test_an_excess_error_below_the_following_error_is_raised(axis: Axis) -> None:
    law = axis({"servo.excess_error": 10.0, "servo.feedrate_suppression": 10.0})
    trace = step(law)
    assert [alarm.code for alarm in trace.alarms] == ["EXCESS FOLLOWING ERROR"]
    assert advise(law, trace)[0].value == pytest.approx(16.5)


def test_a_ramp_that_the_torque_cannot_follow_and_one_that_the_servo_cannot_are_brought_down(
    axis: Axis,
) -> None:
    tight: Values = {
        "servo.excess_error": 16.5,
        "servo.feedrate_suppression": 16.4,
        "servo.initial_gain": 1.0,
    }
    weak: Values = {**tight, "servo.max_torque_positive": 15.0, "servo.max_torque_negative": 15.0}
    reported = advised(axis({**weak, "accdec.linear_acceleration": 2000.0}), distance=60.0)
    # 80 % of 15 % of rated torque, rounded down.
    assert reported["accdec.linear_acceleration"] == pytest.approx(0.8 * 15.0 * 95.083, rel=0.01)
    # Page 10-2: 250 mm/s in 120 ms.
    reported = advised(axis({**tight, "accdec.linear_acceleration": 5000.0}), distance=60.0)
    assert reported["accdec.linear_acceleration"] == pytest.approx(2080.0)


def test_how_far_the_load_runs_in_its_backlash_is_no_overshoot_of_the_integrator(axis: Axis) -> None:
    values: Values = {"servo.excess_error": 16.5, "servo.feedrate_suppression": 16.4}
    integral: Values = {"servo.velocity_integral_gain": 200.0}
    law = axis({**values, **integral}, backlash=0.2, resonance=40.0)
    trace = step(law, distance=60.0, feedrate=6000.0)
    assert 0.0254 < figure(trace, "overshoot") < 0.2
    assert advise(law, trace) == ()


def test_a_loop_that_is_not_stable_gets_advice_about_its_loops_alone(axis: Axis) -> None:
    law = axis({"servo.velocity_proportional_gain": 30000.0, "servo.excess_error": 200.0})
    trace = step(law, distance=20.0, feedrate=6000.0)
    assert [alarm.code for alarm in trace.alarms] == ["UNSTABLE"]
    assert not {each.parameter for each in advise(law, trace)} & {
        "servo.excess_error",
        "servo.inposition_band",
    }


def test_the_lag_that_is_set_counts_in_what_the_result_shows_about_the_gains(axis: Axis) -> None:
    fast: Values = {"servo.velocity_proportional_gain": 8000.0}
    assert any("not stable" in note for note in axis(fast).assumptions)
    quick: Values = {"model.delay": 0.1, "model.current_bandwidth": 0.0}
    assert not any("not stable" in note for note in axis(fast, quick).assumptions)


def test_a_finer_step_and_machine_code_change_nothing(axis: Axis) -> None:
    law = axis(
        {"servo.velocity_integral_gain": 100.0},
        coulomb_friction=3.0,
        static_friction=5.0,
        viscous_friction=0.1,
    )
    profile = move(20.0, 100.0, law.ramps["linear"])

    def run(engine: Engine, refine: int) -> Series:
        motion = run_axis(law, profile, RunEnd(0.5), engine=engine, refine=refine)
        return motion.columns["position"][:: motion.rows_per_servo_period]

    usual = run("compiled", 1)
    assert np.abs(run("compiled", 4) - usual).max() < 2e-4
    assert np.array_equal(run("plain", 1), usual)


def test_a_band_below_one_count_and_a_gain_break_below_the_cutting_feedrate_are_raised(axis: Axis) -> None:
    # Page 7-22: 15000 mm/min of cutting at gain 1 need 15 mm.
    reported = advised(
        axis(
            {
                "servo.excess_error": 30.0,
                "servo.feedrate_suppression": 29.0,
                "servo.gain_break_point": 5.0,
                "servo.gain_break_ratio": 0.5,
                "servo.position_counts": 1000.0,
                "servo.inposition_band": 0.001,
            }
        ),
        distance=60.0,
        feedrate=3000.0,
    )
    assert reported["servo.gain_break_point"] == pytest.approx(15.0)
    assert reported["servo.inposition_band"] == pytest.approx(0.02)
