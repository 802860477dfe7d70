"""NUM axes in motion: what the manual prints comes out of the simulated axis."""

import math

import numpy as np
import pytest

from amp_studio.families.num import law_sample as sample
from amp_studio.families.num.law import LAW
from amp_studio.schema import Value as StoredValue
from amp_studio.sim import AxisLaw, SimulationError, simulate
from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.profiles import SINE
from amp_studio.sim.model import with_model
from tests.programs.test_block import example

Value = float | str | bool | None

# The worked axis of 6-14, 6-18 and 6-22: 100 mm/s, 60 ms, µm; 1000 mm/s² of 6-36; P50 of a 1060.
MILL: dict[str, Value] = {
    "axes.measured": 1.0,
    "axes.servoed": 1.0,
    "axes.modulo": 0.0,
    "axes.limited_excursion": 0.0,
    "axes.internal_unit": 3.0,
    "axes.rotary_unit": 0.0,
    "axes.assignment@0": 0.0,
    "measure.multi@0": 1.0,
    "measure.divi@0": 2.0,
    "misc.sampling_period": 5.0,
    "misc.functions_more": 0.0,
    "servo.max_speed@0": 6000.0,
    "servo.acceleration_fast@0": 1000.0,
    "servo.loop_gain@0": 4915.0,
    "servo.group_time_constant@1": 60.0,
    "servo.in_position_window@0": 20.0,
    "servo.max_following_error@0": 6600.0,
    "servo.movement_tolerance@0": 50.0,
    "servo.speed_anticipation@1": 0.0,
    "servo.filter_terms@1": 0.0,
    "servo.acceleration_least_time": 0.0,
}


def bound(axis: str = "0", application: str = "1060 Series 1", **changes: Value) -> AxisLaw:
    """Return an axis of the mill; a change is named by its id with _at_ for @ and __ for the point."""
    values = MILL | {name.replace("_at_", "@").replace("__", "."): value for name, value in changes.items()}
    model = {name: value for name, value in values.items() if name.startswith("model.")}

    def value(parameter: str, instance: str) -> Value:
        return values.get(f"{parameter}@{instance}" if instance else parameter)

    read = AxisParameters(value, axis, model, application=application)
    law = with_model(LAW.bind(read), read)
    read.refuse_unused()
    return law


def moved(law: AxisLaw, speed: float, seconds: float = 1.0, ramp: str = "linear") -> Motion:
    """Run a move at a speed in mm/s, that goes on for a second."""
    profile = move(speed * (seconds + 0.5), speed, law.ramps[ramp])
    return run_axis(law, profile, RunEnd(seconds), engine="plain")


def steady(motion: Motion) -> float:
    """Return the following error at the end of a move that is still going on, in mm."""
    return float(
        np.mean(
            motion.columns["following_error"][-100 * motion.rows_per_servo_period :][
                :: motion.rows_per_servo_period
            ][-20:]
        )
    )


def test_kvar_4915_gives_9_volts_at_100_mm_s_and_a_following_error_of_6_mm() -> None:
    motion = moved(bound(), 100.0)  # 6-14; at VMAX the error stabilises at VMAX x T (11-3)
    assert motion.columns["output"][-1] == pytest.approx(9.0, abs=0.001)
    assert steady(motion) == pytest.approx(6.0, abs=0.002)
    assert motion.stop == 0


def test_one_metre_a_minute_with_60_ms_is_followed_1_mm_behind() -> None:
    assert steady(moved(bound(), 1000.0 / 60.0)) == pytest.approx(1.0, abs=0.002)  # 6-18


@pytest.mark.parametrize(("limit", "alarm"), [(6600.0, 0), (5900.0, 1)])
def test_emax_with_its_margin_lets_top_speed_pass_and_less_than_vmax_x_t_does_not(
    limit: float, alarm: int
) -> None:
    motion = moved(bound(servo__max_following_error_at_0=limit), 100.0)  # 6-22
    assert motion.stop == alarm


def test_emax_stops_the_axis_at_the_following_error_that_it_is() -> None:
    motion = moved(bound(servo__max_following_error_at_0=3000.0), 100.0)
    error = motion.columns["following_error"][-1]
    assert 3.0 < error < 3.0 + 100.0 * 0.005


@pytest.mark.parametrize(("constant", "alarm"), [(60.0, 0), (66.0, 0), (70.0, 2), (50.0, 2)])
def test_a_time_constant_that_does_not_fit_the_gain_brings_the_dynamic_check(
    constant: float, alarm: int
) -> None:
    # 6-24: 1.125 and 0.875 of the gain; 10 µm a sample are 2 mm/s more
    law = bound(servo__group_time_constant_at_1=constant, servo__movement_tolerance_at_0=10.0)
    assert moved(law, 100.0).stop == alarm


def test_p57_of_0_switches_the_dynamic_check_off() -> None:
    law = bound(servo__group_time_constant_at_1=30.0, servo__movement_tolerance_at_0=0.0)
    assert moved(law, 100.0).stop == 0


def test_a_rotary_axis_has_no_dynamic_check_because_its_unit_is_not_printed() -> None:
    law = bound(axes__assignment_at_0=7.0, servo__group_time_constant_at_1=30.0)
    assert law.unit == "deg"
    assert any("not printed" in each and "P57" in each for each in law.assumptions)


@pytest.mark.parametrize(("percent", "left"), [(50.0, 3.0), (100.0, 0.0)])
def test_speed_anticipation_leaves_the_rest_of_the_following_error(percent: float, left: float) -> None:
    law = bound(servo__speed_anticipation_at_1=percent)  # 6-26
    assert steady(moved(law, 100.0)) == pytest.approx(left, abs=0.003)


def test_a_circle_of_50_mm_at_2_236_m_a_minute_is_50_um_too_small() -> None:
    # 6-32: 0.037 m/s and 60 ms. The equation is that of a loop without samples and of a drive without lag:
    # both take their share of the time constant away, here 2 ms and twice the 0.8 ms of 200 Hz
    law = bound(model__velocity_bandwidth=200.0, model__velocity_integral=0.0, misc__sampling_period=2.0)
    speed, radius = 2236.0 / 60.0, 50.0
    circle = [0.0, math.inf, 0.0, radius, speed / radius, 0.0, SINE, 0.0]
    motion = run_axis(law, circle, RunEnd(2.6), engine="plain")
    short = radius - float(motion.columns["position"].max())
    lag = 1.0 / (2.0 * math.pi * 200.0)
    assert short == pytest.approx(0.050 * (1.0 - (0.002 + 2.0 * lag) / 0.060), abs=0.0005)


def test_the_speed_on_a_circle_of_50_mm_is_lowered_to_2_236_m_a_minute() -> None:
    law = bound(servo__circle_error=0.050)  # 6-32: 50 µm, 60 ms
    assert law.circle_feedrate(50.0) == pytest.approx(2236.07 / 60.0, abs=1e-3)


def test_the_speed_on_a_circle_goes_by_the_time_constant_of_the_group() -> None:
    law = bound(servo__circle_error=0.050, servo__axis_time_constant_at_0=30.0)  # 6-40
    assert law.circle_feedrate(50.0) == pytest.approx(2236.07 / 60.0, abs=1e-3)


@pytest.mark.parametrize(("error", "why"), [(None, "not set"), (0.0, "leaves no speed")])
def test_without_a_tolerated_error_the_speed_on_circles_is_not_limited(error: float | None, why: str) -> None:
    law = bound(servo__circle_error=error)
    assert law.circle_feedrate(50.0) is None
    assert any("P52N0" in each and why in each for each in law.assumptions)


def test_emax_and_approach_speed_of_the_worked_examples_are_predicted() -> None:
    predicted = bound(servo__acceleration_work_at_0=1000.0).predict(100.0)
    assert predicted["maximum_following_error"].value == pytest.approx(6.6)  # 6-22: 6600 µm
    assert predicted["approach_speed"].value == pytest.approx(3600.0)  # 6-36
    assert "approach_speed" not in bound().predict(100.0)


def test_an_axis_takes_the_approach_speed_with_the_acceleration_of_p32() -> None:
    # 6-36: 1000 mm/s² x 60 ms are 3600 mm/min: a step of that speed accelerates the axis by 1000 mm/s²
    motion = moved(
        bound(model__velocity_bandwidth=1000.0, model__velocity_integral=0.0), 3600.0 / 60.0, 0.1, "none"
    )
    speeds = motion.columns["velocity"][:: motion.rows_per_servo_period]
    assert float(np.diff(speeds).max()) / 0.005 == pytest.approx(1000.0, rel=0.01)


def test_bit_5_of_p7n1_chooses_the_sine_squared_ramp() -> None:
    assert next(iter(bound().ramps)) == "linear"  # 9-6
    assert next(iter(bound(misc__functions_more=32.0).ramps)) == "sine-squared"


def test_a_sine_squared_ramp_has_the_least_time_of_p53() -> None:
    ramp = bound(servo__acceleration_least_time=40.0).ramps["sine-squared"]
    assert (ramp.acceleration, ramp.time) == (1000.0, 0.040)  # 6-38


def test_a_rotary_axis_counts_ten_thousandths_of_a_degree() -> None:
    law = bound(
        axes__assignment_at_0=7.0, servo__loop_gain_at_0=491.0, servo__max_following_error_at_0=66000.0
    )
    assert law.unit == "deg"
    assert law.position_rate == pytest.approx(16.65, abs=0.01)
    assert law.limits["maximum following error"] == pytest.approx(6.6)


@pytest.mark.parametrize(
    ("digits", "gain"), [(1.0, 491500.0), (2.0, 49150.0), (3.0, 4915.0), (4.0, 491.5), (5.0, 49.15)]
)
def test_the_gain_is_the_same_in_every_internal_unit(digits: float, gain: float) -> None:
    # 6-15: k is 100, 10, 1, 0.1, 0.01
    law = bound(axes__internal_unit=digits, servo__loop_gain_at_0=gain)
    assert law.position_rate == pytest.approx(16.6659, abs=1e-3)


def test_the_own_time_constant_goes_before_that_of_the_group() -> None:
    law = bound(servo__axis_time_constant_at_0=30.0, servo__speed_anticipation_at_1=100.0)  # 6-40
    assert law.predict(100.0)["steady_following_error"].value == pytest.approx(3.0, abs=0.001)


def test_all_words_that_are_missing_are_named_in_one_sentence() -> None:
    with pytest.raises(SimulationError) as raised:
        bound(servo__loop_gain_at_0=None, servo__max_speed_at_0=None, misc__sampling_period=None)
    assert (
        raised.value.what
        == "The simulation of axis 0 needs values that are not set: misc.sampling_period, servo.max_speed,"
        " servo.loop_gain"
    )


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"servo__loop_gain_at_0": 0.0}, "KVAR (P21N0), which is in the drive with DISC NT, is 0"),
        ({"servo__max_speed_at_0": 0.0}, "Maximum Axis Traverse Rate (P30N0) is 0"),
        ({"servo__group_time_constant_at_1": 0.0}, "The time constant of P56 (or P66) is 0"),
        ({"axes__assignment_at_0": 255.0}, "P9N0 gives the axis no group"),
        ({"servo__acceleration_fast_at_0": 0.0}, "Acceleration, fast speed (P32) is 0"),
        ({"servo__filter_terms_at_1": 4.0}, "averages 4 references; it takes an odd number"),
        ({"servo__filter_terms_at_1": 15.0}, "averages 15 references"),
        ({"axes__rotary_unit": 9.0, "axes__assignment_at_0": 7.0}, "P4N4 is 0 to 4, not 9"),
        ({"measure__divi_at_0": 0.0}, "DIVI"),
        ({"measure__multi_at_0": 0.0}, "MULTI / DIVI (P11)"),
        ({"servo__friction_amplitude_at_0": 10.0, "servo__friction_time_at_0": 2.0}, "never dies away"),
        ({"model__drive_voltage": 11.0}, "model.drive_voltage is 11 V"),
        ({"model__scale": 2.0}, "model.scale is 2"),
        ({"model__velocity_integral": 1e300}, "The machine is too stiff to simulate"),
        ({"model__velocity_bandwidth": 1e300}, "The machine is too stiff to simulate"),
    ],
)
def test_an_impossible_word_is_refused_with_a_sentence(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(SimulationError) as raised:
        bound(**changes)
    assert sentence in raised.value.what


@pytest.mark.parametrize(
    ("given", "application", "taken"),
    [(1.0, "", 0.002), (25.0, "", 0.020), (5.0, "1060 UCSII", 0.004), (5.0, "1060 Series 1", 0.005)],
)
def test_the_sampling_period_is_the_one_in_force(given: float, application: str, taken: float) -> None:
    law = bound(misc__sampling_period=given, application=application)  # 9-10
    assert law.servo_period == pytest.approx(taken)


def test_acceleration_anticipation_works_with_a_whole_speed_anticipation_and_is_assumed() -> None:
    # 6-34: 400 us of a sample of 5 ms; the speed anticipation of this corrector is 100 %.
    whole = bound(servo__acceleration_anticipation_at_0=0.4, servo__speed_anticipation_at_1=100.0)
    assert whole.parameters[sample.AHEAD] == pytest.approx(0.08)
    assert any("P19N0" in each and each.startswith("ASSUMED") for each in whole.assumptions)
    part = bound(servo__acceleration_anticipation_at_0=0.4, servo__speed_anticipation_at_1=60.0)
    assert part.parameters[sample.AHEAD] == 0.0
    assert any("P19N0" in each and "not used" in each and "60 %" in each for each in part.assumptions)


def test_a_filter_makes_the_anticipation_whole_and_e11012_can_switch_it_off() -> None:
    assert steady(moved(bound(servo__filter_terms_at_1=5.0), 50.0)) == pytest.approx(0.0, abs=0.003)
    off = bound(servo__filter_terms_at_1=5.0, model__filter=0.0)
    assert steady(moved(off, 50.0)) == pytest.approx(3.0, abs=0.003)


def test_a_drive_set_to_another_voltage_has_another_gain() -> None:
    # 6-44: another voltage takes the place of 9 V; 4915 with 10 V at top speed is 66.7 ms
    law = bound(model__drive_voltage=10.0)
    assert law.position_rate == pytest.approx(15.0, abs=0.001)


def paired(threshold: float) -> AxisLaw:
    return bound(
        "1",
        **{
            name.replace("@0", "_at_1").replace(".", "__"): value
            for name, value in MILL.items()
            if name.endswith("@0")
        }
        | {
            "axes__measured": 3.0,
            "axes__servoed": 3.0,
            "axes__assignment_at_1": 1.0,
            "servo__loop_gain_at_1": 4915.0 * 60.0 / 59.0,
            "axes__drive_axis_at_1": "axis-0",
            "axes__synchronised": 2.0,
            "servo__sync_error_at_1": threshold,
            "servo__movement_tolerance_at_1": 0.0,
        },
    )


def test_a_synchronised_pair_keeps_what_the_correction_of_a_quarter_leaves() -> None:
    motion = moved(paired(160.0), 100.0)  # 6-30: 1 ms at 100 mm/s, over 1.25
    assert motion.columns["synchronisation_error"][-1] == pytest.approx(-0.08, abs=0.003)
    predicted = paired(160.0).predict(100.0)
    assert predicted["synchronisation_error"].value == pytest.approx(-0.08, abs=1e-3)
    assert predicted["steady_following_error"].value == pytest.approx(5.92, abs=1e-3)
    assert steady(motion) == pytest.approx(5.92, abs=0.003)
    assert motion.stop == 0


def test_threshold_1_of_a_synchronised_pair_is_error_39() -> None:
    assert moved(paired(50.0), 100.0).stop == 3


def test_a_linear_axis_is_not_synchronised_with_a_rotary_one() -> None:
    words = {f"{name[:-1]}1": value for name, value in MILL.items() if name.endswith("@0")}
    changes = {name.replace("@", "_at_").replace(".", "__"): value for name, value in words.items()}
    changes |= {"axes__assignment_at_1": 7.0, "axes__drive_axis_at_0": "axis-1", "axes__synchronised": 1.0}
    with pytest.raises(SimulationError, match="Drive axis 1 moves in deg, driven axis 0 in mm"):
        bound(**changes)


def test_a_group_without_a_time_constant_is_named() -> None:
    with pytest.raises(SimulationError, match=r"not set: servo\.group_time_constant$"):
        bound(servo__group_time_constant_at_1=None)


def test_a_drive_axis_that_is_driven_itself_is_refused() -> None:
    with pytest.raises(SimulationError, match="Drive axis 0 of axis 0 is a driven axis itself"):
        bound(axes__drive_axis_at_0="axis-0", axes__synchronised=1.0)


def test_a_copied_reference_without_correction_is_named() -> None:
    law = bound(axes__drive_axis_at_0="axis-1", axes__synchronised=0.0)
    assert any("copies the reference of drive axis 1" in each for each in law.assumptions)


def test_a_clamp_is_named_as_time_that_is_left_out() -> None:
    """4-23: the reference waits for the report of unclamping; P8 has a bit for each address."""
    file = example("num-1060-mill")
    file.set(("axes.clamped", ""), StoredValue(0x2))
    clamped = [any("has a clamp" in note for note in bind_axis(file, LAW, axis).assumptions) for axis in "01"]
    assert clamped == [False, True]


def test_an_indexed_spindle_is_in_position_at_a_standstill_alone() -> None:
    """Page 8-5: 3/4096 of a turn in a sample of 5 ms are 8.8 rpm, 16 degrees of lag at a gain of 200."""
    mill = example("num-1060-mill")
    times = {}
    for window in (11, 100, 200, 400):
        mill.set(("spindle.window", "1"), StoredValue(window))
        result = simulate(mill, "spindle", None, {"move.orient": 90.0}).result
        times[window] = result["time"][0]
    assert times[11] > times[100] > times[200] == times[400]
