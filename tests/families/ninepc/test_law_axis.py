"""A 9/PC axis is read from its own parameters; what is missing or not simulated is named."""

import math

import pytest

from amp_studio.families.ninepc import law_samples as samples
from amp_studio.sim import SimulationError, law_of

from .conftest import Axis, Values


def test_every_figure_comes_from_its_parameter(axis: Axis) -> None:
    law = axis(
        {
            "servo.position_gear_teeth": 1.0,
            "servo.position_screw_teeth": 2.0,
            "servo.position_counts": 8000.0,
            "servo.velocity_gear_teeth": 1.0,
            "servo.velocity_screw_teeth": 2.0,
            "servo.velocity_counts": 8000.0,
            "servo.velocity_integral_gain": 82.0,
            "servo.sercos_cycle": 2.0,
            "servo.initial_gain": 1.2,
        }
    )
    assert (law.unit, law.servo_period, law.velocity_period, law.output_unit) == ("mm", 0.002, 0.001, "%")
    assert law.position_rate == pytest.approx(20.0)
    assert law.feedrate == 250.0
    assert law.machine.position_count == law.machine.motor_count == pytest.approx(10.0 / 16000.0)
    # Two turns of the motor for one of the screw: 5 mm; 1500 / 65536 of rated torque for 1 rad/s.
    assert law.parameters[samples.PROPORTIONAL] == pytest.approx(
        100.0 * 1500.0 / 65536.0 * 2.0 * math.pi / 5.0
    )
    assert law.parameters[samples.INTEGRAL] / law.parameters[samples.PROPORTIONAL] == pytest.approx(
        82.0 / 1500.0
    )
    assert law.limits == {"excess error": 203.2, "feedrate suppression": 203.2, "inposition band": 0.0254}


@pytest.mark.parametrize(
    "parameter",
    [
        "axis.type",
        "servo.loop_type",
        "servo.position_loop_type",
        "servo.initial_gain",
        "servo.gain_break_point",
        "servo.gain_break_ratio",
        "servo.excess_error",
        "servo.feedrate_suppression",
        "servo.inposition_band",
        "servo.sercos_cycle",
        "servo.position_feedback_type",
        "servo.position_counts",
        "servo.position_gear_teeth",
        "servo.position_screw_teeth",
        "servo.lead_screw_pitch",
        "servo.velocity_proportional_gain",
        "servo.velocity_integral_gain",
        "servo.integrator_discharge",
        "servo.max_torque_positive",
        "servo.max_torque_negative",
        "accdec.linear_acceleration",
        "accdec.linear_deceleration",
    ],
)
def test_a_needed_parameter_that_is_not_set_is_named(axis: Axis, parameter: str) -> None:
    with pytest.raises(SimulationError) as error:
        axis({parameter: None})
    assert error.value.parameter == parameter
    assert str(error.value) == f"{parameter} is not set for axis 1. The simulation needs it: set a value"


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"axis.type": "unfitted"}, "Axis 1 is unfitted"),
        ({"axis.type": "spindle"}, "is a spindle"),
        ({"servo.loop_type": "none"}, "has no servo"),
        ({"servo.hardware_type": "none"}, "has no servo"),
        ({"servo.position_loop_type": "off"}, "servo is off"),
        ({"servo.position_loop_type": "detached"}, "detached"),
        ({"servo.position_loop_type": "depth-probe"}, "depth probe"),
        ({"servo.position_feedback_type": "none"}, "no position feedback"),
        ({"servo.initial_gain": 0.0}, "servo.initial_gain is 0; it must be above 0"),
        ({"servo.initial_gain": math.nan}, "servo.initial_gain is nan; it must be above 0"),
        (
            {"servo.initial_gain": math.inf},
            "servo.initial_gain is inf, which no machine has; it must be from 1e-09 to 1e+09",
        ),
        ({"servo.initial_gain": "one"}, "servo.initial_gain of axis 1 is 'one', not a number"),
        ({"servo.gain_break_ratio": 1.5}, "servo.gain_break_ratio is 1.5; it must be 1 or less"),
        ({"servo.excess_error": -1.0}, "servo.excess_error is -1; it must not be negative"),
        ({"servo.lead_screw_pitch": 0.0}, "servo.lead_screw_pitch is 0; it must be above 0"),
        ({"servo.position_counts": 0.0}, "servo.position_counts is 0; it must be above 0"),
        (
            {"servo.velocity_proportional_gain": -5.0},
            "velocity_proportional_gain is -5; it must not be negative",
        ),
        ({"servo.integrator_discharge": 0.0}, "servo.integrator_discharge is 0; it must be 1 or more"),
        ({"servo.max_torque_positive": math.inf}, "max_torque_positive is inf, which no machine has"),
        ({"servo.torque_filter": 0.0}, "servo.torque_filter is 0; it must be above 0"),
        ({"servo.sercos_cycle": 0.0}, "servo.sercos_cycle is 0; it must be above 0"),
        ({"servo.sercos_cycle": 1e6}, "servo.sercos_cycle is 1e+06; it must be 1000 ms or less"),
        ({"accdec.linear_acceleration": -1.0}, "linear_acceleration is -1; it must not be negative"),
        (
            {"servo.load_inertia_ratio": "r9"},
            "servo.load_inertia_ratio of axis 1 is 'r9', not one of r0, r1, r2, r3",
        ),
        ({"servo.reversal_error": math.nan}, "servo.reversal_error is nan; it must be a number"),
        ({"servo.velocity_screw_teeth": math.inf}, "servo.velocity_screw_teeth is inf, which no machine has"),
        ({"servo.velocity_screw_teeth": 0.0}, "servo.velocity_screw_teeth is 0; it must be above 0"),
    ],
)
def test_an_axis_that_cannot_be_simulated_shows_why(axis: Axis, values: Values, words: str) -> None:
    with pytest.raises(SimulationError) as error:
        axis(values)
    assert words in str(error.value)


def test_zero_following_error_needs_its_percentage_and_not_the_gain_break(axis: Axis) -> None:
    zfe: Values = {
        "servo.position_loop_type": "zfe",
        "servo.feed_forward": 80.0,
        "servo.gain_break_point": None,
        "servo.gain_break_ratio": None,
    }
    assert axis(zfe).parameters[samples.FEED_FORWARD] == pytest.approx(0.8)
    with pytest.raises(SimulationError, match=r"servo\.feed_forward is not set"):
        axis({**zfe, "servo.feed_forward": None})
    assert axis({"servo.feed_forward": 80.0}).parameters[samples.FEED_FORWARD] == 0.0  # closed loop (7-28)


def test_a_rotary_axis_turns_in_degrees_and_borrows_nothing_in_mm(axis: Axis) -> None:
    rotary: Values = {"axis.type": "rotary", "servo.lead_screw_pitch": None}
    law = axis(rotary)
    assert law.unit == "deg"
    assert law.machine.position_count == pytest.approx(360.0 / 2097152.0)
    assert any("360 deg" in note for note in law.assumptions)
    own = axis(rotary, {"model.travel_per_turn": 4.0})
    assert own.machine.position_count == pytest.approx(4.0 / 2097152.0)
    # 1989.66667 mm/s2 is not 1989.66667 deg/s2 (7-67 prints no degrees).
    analog = axis({**rotary, **ANALOG})
    assert analog.machine.acceleration_per_output == pytest.approx(1000.0 / (2.0 * math.pi) * 360.0 / 100.0)
    assert "printed in mm and inches only" in analog.assumed["acceleration_per_output"]


def test_a_scale_with_coded_markers_counts_by_its_smaller_period_and_measures_the_load(axis: Axis) -> None:
    # Page 7-33: 20,000 counts for 20 mm are 0.001 mm; the screw is that of the motor (B-2).
    law = axis(
        {
            "servo.position_feedback_type": "dcm",
            "servo.dcm_small_period": 20.0,
            "servo.position_counts": 20000.0,
            "servo.reversal_error": 0.05,
        }
    )
    assert law.machine.position_count == pytest.approx(0.001)
    assert law.machine.load_sensor
    # Page 7-18: no reversal error compensation with a linear scale.
    assert law.parameters[samples.REVERSAL] == 0.0
    assert any("linear scale (7-18)" in note for note in law.assumptions)


# -- drives ----------------------------------------------------------------------------------------

ANALOG: Values = {
    "servo.loop_type": "analog",
    "servo.velocity_proportional_gain": None,
    "servo.analog_positive_voltage": 8.0,
    "servo.analog_negative_voltage": -6.0,
    "servo.peak_current": "p200",
    "servo.max_acceleration": 1989.66667,
}


def test_an_analog_axis_is_scaled_by_its_voltages_at_rapid(axis: Axis) -> None:
    # Pages 7-41, 7-43 and 7-67: 8 V at 250 mm/s; 1989.66667 mm/s2 at a peak of 200 %.
    law = axis(ANALOG)
    assert law.output_unit == "V"
    assert law.machine.velocity_per_output == pytest.approx(250.0 / 8.0)
    assert law.parameters[samples.VOLTS_NEGATIVE] == pytest.approx(6.0 / 250.0)
    assert law.machine.acceleration_per_output * 200.0 == pytest.approx(1989.66667)
    assert (law.machine.torque_limit_positive, law.machine.output_limit) == (200.0, 10.0)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"servo.analog_positive_voltage": -8.0}, "analog_positive_voltage is -8; it must be above 0"),
        ({"servo.analog_negative_voltage": 6.0}, "analog_negative_voltage is 6; it must be below 0"),
        ({"servo.analog_positive_voltage": 11.0}, "10 V at most"),
        ({"servo.peak_current": "p0"}, "is 'p0', not a percentage"),
        ({"servo.max_acceleration": 0.0}, "max_acceleration is 0; it must be above 0"),
        ({"feedrate.rapid": None}, "feedrate.rapid is not set"),
    ],
)
def test_an_analog_axis_without_a_scale_shows_why(axis: Axis, values: Values, words: str) -> None:
    with pytest.raises(SimulationError) as error:
        axis({**ANALOG, **values})
    assert words in str(error.value)


def test_a_third_party_drive_is_simulated_as_far_as_the_file_goes(axis: Axis) -> None:
    # Page 7-2: both loops are in the drive; 1 is the gain of most machines (7-25).
    third: Values = dict.fromkeys(("servo.initial_gain", "servo.excess_error", "servo.position_counts"))
    law = axis({**third, "servo.loop_type": "sercos"})
    assert law.position_rate == pytest.approx(1000.0 / 60.0)
    assert any("set model.position_gain" in note for note in law.assumptions)
    own = axis({**third, "servo.loop_type": "sercos"}, {"model.position_gain": 2.0})
    assert own.position_rate == pytest.approx(2000.0 / 60.0)


# -- motors ----------------------------------------------------------------------------------------


def test_a_standard_motor_takes_its_gains_from_the_tables(axis: Axis) -> None:
    # Pages 7-6, 7-55, 7-56: 4000 and 200 of a B420E at 1 : 1.
    standard: Values = {
        "servo.standard_motor_values": True,
        "servo.motor_type": "b420e",
        "servo.load_inertia_ratio": "r1",
    }
    law = axis(standard)
    assert law.parameters[samples.PROPORTIONAL] == pytest.approx(
        100.0 * 4000.0 / 65536.0 * 2.0 * math.pi / 10.0
    )
    assert any("4000 and 200 of Tables 7.B and 7.C" in note for note in law.assumptions)
    # Changing a gain on line sets the tables to No (7-6): a gain given by hand is used.
    by_hand = axis(standard, {"servo.velocity_proportional_gain": 3000.0})
    assert by_hand.parameters[samples.PROPORTIONAL] < law.parameters[samples.PROPORTIONAL]
    # The tables print B420E but neither has a B740C (erratum e-1651-names).
    unknown = axis({**standard, "servo.motor_type": "b740c"})
    assert any("gains of the file are simulated instead" in note for note in unknown.assumptions)


def test_a_feedrate_beyond_the_maximum_motor_speed_is_shown(axis: Axis) -> None:
    # Page 7-74: 15000 mm/min on 10 mm are 1500 rpm.
    assert any("needs 1500 rpm" in note for note in axis({"servo.max_motor_speed": 1400.0}).assumptions)
    assert not any("rpm" in note for note in axis({"servo.max_motor_speed": 1500.0}).assumptions)


def test_the_torque_offset_is_of_the_maximum_torque(axis: Axis) -> None:
    # Pages 7-63, 7-64, 7-60: 1 % of 300 %, in the minus direction.
    law = axis({"servo.torque_offset": 1.0, "servo.torque_offset_direction": "minus"})
    assert law.parameters[samples.OFFSET] == pytest.approx(-3.0)
    assert any("-3 % of rated torque" in note for note in law.assumptions)


def test_every_assumption_names_its_page_or_is_marked(axis: Axis) -> None:
    several = [
        axis(),
        axis(ANALOG),
        axis({"servo.loop_type": "sercos"}),
        axis({"servo.position_loop_type": "open"}),
    ]
    several.append(
        axis({"servo.reversal_error": 0.1, "servo.friction_positive": 3.0, "servo.torque_offset": 2.0})
    )
    for note in (note for law in several for note in law.assumptions):
        assert any(character.isdigit() for character in note), note


def test_a_value_given_by_hand_goes_before_the_file_and_a_slip_is_refused(axis: Axis) -> None:
    assert axis(settings={"servo.initial_gain": 2.0}).position_rate == pytest.approx(2000.0 / 60.0)
    for slip in ("servo.inital_gain", "servo.feed_forward", "model.backlsh"):
        with pytest.raises(SimulationError, match="is not used"):
            axis(settings={slip: 1.0})


def test_advice_ends_at_the_bounds_that_the_manual_prints(axis: Axis) -> None:
    linear = axis().sources
    rotary = axis({"axis.type": "rotary"}).sources
    assert (linear["excess_error"].largest, rotary["excess_error"].largest) == (214.1, 214.0)  # page 7-20
    assert (linear["position_gain"].largest, linear["gain_break_ratio"].largest) == (30.0, 1.0)
    assert linear["linear_acceleration"].largest == 20000.0
    assert linear["feedrate"].largest == 243840.0  # page 9-1
    assert linear["velocity_proportional_gain"].largest == 65535.0


def test_the_settings_of_the_family_are_named() -> None:
    own = {
        "model.coupling",
        "model.travel_per_turn",
        "model.position_gain",
        "model.motor_torque",
        "model.motor_inertia",
    }
    assert set(law_of("9pc").motion.settings) == own | {"model.dac_unit_86", "model.dac_unit_87"}
