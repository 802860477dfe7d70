"""Recommendation is a number in the parameter's own unit, and it helps: run again with it, and it is gone."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from amp_studio.sim import Recommendation, Trace
from amp_studio.sim.rigid.scenarios import SCENARIOS

Values = dict[str, float | str | bool | None]
File = Callable[..., Callable[[str, str], float | str | bool | None]]


def run(ninepc: File, values: Values | None = None) -> Trace:
    return SCENARIOS["step"].run(ninepc(values), "1", {}, "9pc", None)


def given(trace: Trace) -> dict[str, Recommendation]:
    return {advice.parameter: advice for advice in trace.recommendations}


def test_a_well_set_axis_gets_no_advice(ninepc: File) -> None:
    trace = run(ninepc)
    assert trace.alarms == ()
    assert trace.recommendations == ()


@pytest.mark.parametrize("excess", [5.0, 203.2])
def test_the_excess_error_is_110_percent_of_what_the_axis_needs(ninepc: File, excess: float) -> None:
    # Page 7-20: 1.1 x 10000 / (1 x 1000 x 1) = 11 mm.
    trace = run(ninepc, {"servo.excess_error": excess, "servo.feedrate_suppression": excess})
    advice = given(trace)["servo.excess_error"]
    assert advice.value == pytest.approx(11.0)
    assert advice.unit == "mm"
    assert "10000 mm/min" in advice.why
    assert "(page 7-20)" in advice.why
    if excess == 203.2:
        assert "1.15 s later" in advice.why
    else:
        assert trace.alarms


def test_a_gain_break_makes_the_excess_error_larger(ninepc: File) -> None:
    # Page 7-20 with a ratio of 0.5: 22 mm.
    values: Values = {"servo.gain_break_ratio": 0.5, "servo.gain_break_point": 5.0}
    assert given(run(ninepc, values))["servo.excess_error"].value == 22.0


def test_the_limits_below_the_excess_error_go_down_with_it(ninepc: File) -> None:
    # Page 7-20: inposition band < gain break point < feedrate suppression <= excess error.
    loose: Values = dict.fromkeys(
        ("servo.excess_error", "servo.feedrate_suppression", "servo.gain_break_point"), 203.2
    )
    advice = given(run(ninepc, loose))
    band, low, middle, high = (
        0.0254,
        advice["servo.gain_break_point"].value,
        advice["servo.feedrate_suppression"].value,
        advice["servo.excess_error"].value,
    )
    assert band < low < middle <= high
    assert run(ninepc, {p: a.value for p, a in advice.items()}).recommendations == ()


def test_suppression_tells_what_it_cost(ninepc: File) -> None:
    # Page 7-21.
    trace = run(ninepc, {"servo.feedrate_suppression": 9.0})
    advice = given(trace)["servo.feedrate_suppression"]
    assert advice.value == 11.2
    assert "halved for" in advice.why
    assert "needs 10 mm" in advice.why


def test_a_ramp_steeper_than_the_torque_is_brought_down_to_what_there_is(ninepc: File) -> None:
    weak: Values = {
        "servo.max_torque_positive": 20.0,
        "servo.max_torque_negative": 20.0,
        "servo.excess_error": 60.0,
        "servo.feedrate_suppression": 60.0,
        "accdec.linear_acceleration": 650.0,
    }
    advice = given(run(ninepc, weak))["accdec.linear_acceleration"]
    # 80 % of 20 % of 1989.66667 mm/s2.
    assert advice.value == 318.0
    assert "torque was at its limit" in advice.why
    better = run(ninepc, {**weak, "accdec.linear_acceleration": advice.value})
    assert better.result["time_at_torque_limit"][0] == 0.0


def test_a_ramp_steeper_than_the_servo_is_named_as_a_jump(ninepc: File) -> None:
    # Page 10-2: 5000 mm/min / 60 / 0.120 s = 694.4 mm/s2.
    for ramp in (3000.0, 0.0):
        advice = given(run(ninepc, {"accdec.linear_acceleration": ramp}))["accdec.linear_acceleration"]
        assert advice.value == 694.0
        assert "120 ms" in advice.why


def test_an_exponential_that_starts_too_hard_gets_more_iterations(ninepc: File) -> None:
    values: Values = {
        "accdec.positioning_mode": "exponential",
        "accdec.programmed_delay": 1.0,
        "timing.fine_foreground": 10.0,
        "servo.max_torque_positive": 20.0,
        "servo.max_torque_negative": 20.0,
        "servo.excess_error": 60.0,
        "servo.feedrate_suppression": 60.0,
    }
    advice = given(run(ninepc, values))["accdec.programmed_delay"]
    # 166.7 mm/s / 318.3 mm/s2 = 524 ms: 53 iterations of 10 ms.
    assert (advice.value, advice.unit) == (53.0, "")


def test_overshoot_of_a_slow_velocity_loop_asks_for_four_times_the_position_loop(ninepc: File) -> None:
    slow: Values = {"servo.velocity_proportional_gain": 1500.0, "accdec.linear_acceleration": 650.0}
    trace = run(ninepc, slow)
    assert (trace.result["overshoot"][0] or 0.0) > 0.0254
    advice = given(trace)["servo.velocity_proportional_gain"]
    # 4 x 65536 / 60 = 4369.07, to three digits and up.
    assert (advice.value, advice.unit) == (4370.0, "")
    better = run(ninepc, {**slow, "servo.velocity_proportional_gain": advice.value})
    assert (better.result["overshoot"][0] or 0.0) < 0.0254


def test_a_gain_break_below_the_cutting_feedrate_is_raised(ninepc: File) -> None:
    # Page 7-22: 5000 x 0.001 / 1.
    values: Values = {"servo.gain_break_point": 2.0, "servo.gain_break_ratio": 0.5}
    advice = given(run(ninepc, values))["servo.gain_break_point"]
    assert advice.value == 5.0
    assert "2000 mm/min" in advice.why


def test_a_band_below_one_count_is_raised_to_two(ninepc: File) -> None:
    advice = given(run(ninepc, {"servo.inposition_band": 0.0002}))["servo.inposition_band"]
    assert advice.value == 0.00125


def test_a_value_the_parameter_cannot_take_is_cut_and_said(ninepc: File) -> None:
    # Page 7-20: at most 214.1 mm; this axis would need 550.
    values: Values = {
        "servo.initial_gain": 0.02,
        "servo.excess_error": 200.0,
        "servo.feedrate_suppression": 200.0,
    }
    advice = given(run(ninepc, values))["servo.excess_error"]
    assert advice.value == 214.1
    assert "the upper limit of servo.excess_error is 214.1" in advice.why
