"""Syntec axes in motion: what the slides print comes out of the simulated axis."""

import math

import pytest

from amp_studio.families.syntec.law import LAW
from amp_studio.sim import AxisLaw, SimulationError
from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.command.ramps import move
from amp_studio.sim.model import with_model

Value = float | str | bool | None

# 1.4.2: pitch 10 mm, 10000 pulses a turn, 2 x 983 µs; 1.5.3: loop gain 30.
MILL: dict[str, Value] = {
    "axis.type@1": "linear",
    "axis.servo_mode@1": "cw-ccw",
    "control.blu": "standard",
    "control.series": "super",
    "dda.interpolation_time": 2000.0,
    "resolution.encoder@1": 2500.0,
    "resolution.multiplication@1": "4",
    "resolution.encoder_type@1": "traditional",
    "resolution.screw_teeth@1": 1.0,
    "resolution.motor_teeth@1": 1.0,
    "resolution.pitch@1": 10000.0,
    "feed.rapid@1": 24000.0,
    "home.first_speed@1": 3000.0,
    "servo.loop_gain@1": 30.0,
    "motion.axis_acceleration@1": 100.0,
}


def bound(machine: str = "generic", **changes: Value) -> AxisLaw:
    """Return the axis; a change is named by its id with _at_ for @ and __ for the point."""
    values = MILL | {name.replace("_at_", "@").replace("__", "."): value for name, value in changes.items()}
    model = {name: value for name, value in values.items() if name.startswith("model.")}

    def value(parameter: str, instance: str) -> Value:
        return values.get(f"{parameter}@{instance}" if instance else parameter)

    read = AxisParameters(value, "1", model, machine=machine)
    law = with_model(LAW.bind(read), read)
    read.refuse_unused()
    return law


def moved(law: AxisLaw, feedrate: float, seconds: float = 0.5, ramp: str = "linear") -> Motion:
    """Run a move at a feedrate in u/min, that goes on for the time."""
    speed = feedrate / 60.0
    return run_axis(
        law, move(speed * (seconds + 1.0), speed, law.ramps[ramp]), RunEnd(seconds), engine="plain"
    )


def steady(motion: Motion) -> float:
    return float(motion.columns["following_error"][:: motion.rows_per_servo_period][-1])


def test_1000_mm_a_minute_at_gain_30_is_followed_555_um_behind() -> None:
    # 1.5.3, printed without its decimals; a count is 1 µm
    assert steady(moved(bound(), 1000.0)) == pytest.approx(0.5556, abs=0.003)


@pytest.mark.parametrize(("feedrate", "alarm"), [(62472.0, 0), (62503.0, 1)])
def test_62_472_m_a_minute_is_the_highest_feedrate_under_the_dda_limit(feedrate: float, alarm: int) -> None:
    motion = moved(bound(feed__rapid_at_1=feedrate), feedrate, 0.2)  # 1.4.2
    assert motion.stop == alarm


def test_mot_005_comes_with_pulse_2048() -> None:
    law = bound(feed__rapid_at_1=62503.0)
    motion = moved(law, 62503.0, 0.2)
    assert abs(motion.columns["pulses"][-1]) == 2048.0
    assert law.alarms[motion.stop].code == "MOT-005"


def test_a_gear_halves_the_feedrate_of_the_dda_limit() -> None:
    law = bound(resolution__screw_teeth_at_1=2.0)  # 1.2.6
    assert law.predict(1.0)["dda_feedrate"].value == pytest.approx(31236.0, abs=0.1)


def test_a_serial_controller_has_no_dda_limit() -> None:
    law = bound("serial", feed__rapid_at_1=80000.0)  # 1.4.1
    assert moved(law, 80000.0, 0.2).stop == 0
    assert "dda_feedrate" not in law.predict(1.0)


def test_the_alarm_limits_are_two_and_four_times_the_error_at_rapid() -> None:
    law = bound()  # 24000 mm/min / 30: 13.333 mm
    assert law.limits["MOT-019"] == pytest.approx(26.6667, abs=1e-4)
    assert law.limits["MOT-023"] == pytest.approx(53.3333, abs=1e-4)
    assert law.predict(1.0)["following_error_limit"].value == pytest.approx(26.6667, abs=1e-4)


def test_a_faster_homing_speed_sets_the_alarm_limits() -> None:
    assert bound(home__first_speed_at_1=48000.0).limits["MOT-019"] == pytest.approx(53.3333, abs=1e-4)


def test_a_feedrate_of_more_than_twice_rapid_brings_mot_019() -> None:
    law = bound(feed__rapid_at_1=6000.0, home__first_speed_at_1=0.0)
    assert moved(law, 11900.0).stop == 0
    motion = moved(law, 12200.0)
    assert law.alarms[motion.stop].code == "MOT-019"
    assert motion.columns["following_error"][-1] == pytest.approx(6.667, abs=0.3)


def test_the_interpolation_time_is_that_of_the_series() -> None:
    assert bound().servo_period * 8.0 == pytest.approx(1966e-6)  # 1.4.1
    assert bound(control__series="a10").servo_period * 8.0 == pytest.approx(1638e-6)
    assert any("none is printed" in each for each in bound(control__series="ez").assumptions)


def test_a_linear_encoder_counts_pulses_a_millimetre() -> None:
    law = bound(resolution__encoder_type_at_1="linear", resolution__encoder_at_1=250.0)  # 1.2.5: 1 µm
    assert law.machine.position_count == pytest.approx(0.001)
    assert law.machine.load_sensor


def test_without_feedback_there_is_no_alarm_of_the_following_error() -> None:
    law = bound(resolution__encoder_type_at_1="none")  # 1.2.7
    assert law.limits == {"MOT-019": math.inf, "MOT-023": math.inf}


def test_a_rotary_axis_is_in_degrees() -> None:
    law = bound(axis__type_at_1="rotary1", resolution__screw_teeth_at_1=90.0, resolution__pitch_at_1=360000.0)
    assert law.unit == "deg"
    assert law.machine.position_count == pytest.approx(0.0004)


def test_the_acceleration_time_of_the_control_serves_an_axis_without_its_own() -> None:
    law = bound(motion__axis_acceleration_at_1=None, motion__acceleration_time=200.0)  # 1.5.3
    assert law.ramps["linear"].acceleration == pytest.approx(2000.0)
    assert law.sources["acceleration"].parameter == "motion.acceleration_time"


def test_all_values_that_are_missing_are_named_in_one_sentence() -> None:
    with pytest.raises(SimulationError) as raised:
        bound(feed__rapid_at_1=None, control__series=None, motion__axis_acceleration_at_1=None)
    assert (
        raised.value.what == "The simulation of axis 1 needs values that are not set: feed.rapid,"
        " motion.axis_acceleration, control.series"
    )


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"servo__loop_gain_at_1": 0.0}, "servo.loop_gain of axis 1 is 0; it must be above 0"),
        ({"feed__rapid_at_1": 0.0}, "feed.rapid of axis 1 is 0"),
        ({"resolution__encoder_at_1": 0.0}, "encoder"),
        ({"resolution__pitch_at_1": 0.0}, "pitch"),
        ({"dda__interpolation_time": 0.0}, "dda.interpolation_time of axis 1 is 0; it must be above 0"),
        ({"dda__interpolation_time": 1.0}, "simulated are 0.1 to 100 ms"),
        ({"motion__axis_acceleration_at_1": 0.0}, "a simulated axis needs a time above 0"),
        ({"control__blu": "raw:2"}, "The length of the BLU is printed for its default alone"),
        (
            {"axis__type_at_1": "rotary1", "resolution__encoder_type_at_1": "linear"},
            "a linear encoder has pulses per mm",
        ),
    ],
)
def test_an_impossible_value_is_refused_with_a_sentence(changes: dict[str, Value], sentence: str) -> None:
    with pytest.raises(SimulationError) as raised:
        bound(**changes)
    assert sentence in raised.value.what
