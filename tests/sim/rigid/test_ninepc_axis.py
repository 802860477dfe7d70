"""A 9/PC axis is read from its own parameters; what is missing or not simulated is named."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pytest

from amp_studio.families.ninepc import law as family
from amp_studio.sim import SimulationError
from amp_studio.sim.rigid import bind
from amp_studio.sim.rigid.laws import loop_ratio
from amp_studio.sim.rigid.scenarios import SCENARIOS

axis_servo = partial(bind.axis_servo, family="9pc")

Values = dict[str, float | str | bool | None]
File = Callable[..., Callable[[str, str], float | str | bool | None]]


def test_every_figure_comes_from_its_parameter(ninepc: File) -> None:
    values: Values = {
        "servo.velocity_integral_gain": 82.0,
        "accdec.programmed_delay": 10.0,
        "timing.fine_foreground": 10.0,
        "timing.scans_per_logic": 2.0,
    }
    servo = axis_servo(ninepc(values), "1")
    assert servo.position_gain == 1.0
    assert servo.velocity_rate == pytest.approx(200.0)  # 13107.2 / 65536 per ms
    assert servo.integral_rate == pytest.approx(82.0 / 65.536)
    assert servo.count == pytest.approx(10.0 / 16000.0)
    assert servo.excess_error == 11.2
    assert servo.exponential_time == 200.0
    assert servo.rapid_feedrate == 10000.0
    assert servo.acceleration_at_rated == 1989.66667
    assert servo.unit == "mm"
    assert not servo.zero_following_error


@pytest.mark.parametrize("gain", [0.5, 1.0, 2.0])
def test_the_bounds_of_the_manual_are_three_and_ten_times_the_position_loop(
    ninepc: File, gain: float
) -> None:
    # Pages 7-54 and 7-56: the inference that gives the velocity loop gains their unit.
    low, high = (
        axis_servo(
            ninepc({"servo.initial_gain": gain, "servo.velocity_proportional_gain": gain * bound}), "1"
        )
        for bound in (3277.0, 10923.0)
    )
    assert loop_ratio(low) == pytest.approx(3.0, rel=1e-3)
    assert loop_ratio(high) == pytest.approx(10.0, rel=1e-3)
    integral = axis_servo(
        ninepc({"servo.initial_gain": gain, "servo.velocity_integral_gain": gain * 1092.0}), "1"
    )
    assert integral.integral_rate == pytest.approx(integral.position_rate, rel=1e-3)


@pytest.mark.parametrize(
    "parameter",
    [
        "axis.type",
        "servo.loop_type",
        "servo.position_loop_type",
        "servo.initial_gain",
        "servo.gain_break_point",
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
def test_a_needed_parameter_that_is_not_set_is_named(ninepc: File, parameter: str) -> None:
    with pytest.raises(SimulationError) as fault:
        axis_servo(ninepc({parameter: None}), "1")
    assert fault.value.parameter == parameter
    assert str(fault.value) == f"{parameter} is not set for axis 1. The simulation needs it: set a value"


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"axis.type": "unfitted"}, "Axis 1 is unfitted"),
        ({"axis.type": "spindle"}, "is a spindle"),
        ({"servo.loop_type": "sercos"}, "third-party SERCOS drive"),
        ({"servo.loop_type": "none"}, "has no servo"),
        ({"servo.hardware_type": "none"}, "has no servo"),
        ({"servo.position_loop_type": "open"}, "no position loop"),
        ({"servo.position_loop_type": "off"}, "servo is off"),
        ({"servo.position_loop_type": "detached"}, "detached"),
        ({"servo.position_loop_type": "depth-probe"}, "depth probe"),
        ({"servo.position_feedback_type": "none"}, "no position feedback"),
        ({"servo.initial_gain": 0.0}, "position gain (servo.initial_gain@1) is 0; it must be above 0"),
        ({"servo.lead_screw_pitch": 0.0}, "travel (servo.lead_screw_pitch@1) is 0; it must be above 0"),
        ({"servo.position_counts": 0.0}, "feedback counts (servo.position_counts@1) is 0;"),
        ({"servo.initial_gain": "one"}, "servo.initial_gain of axis 1 is 'one', not a number"),
    ],
)
def test_an_axis_that_cannot_be_simulated_says_why(ninepc: File, values: Values, words: str) -> None:
    with pytest.raises(SimulationError) as fault:
        axis_servo(ninepc(values), "1")
    assert words in str(fault.value)


def test_zero_following_error_needs_its_percentage_and_not_the_gain_break(ninepc: File) -> None:
    zfe: Values = {
        "servo.position_loop_type": "zfe",
        "servo.feed_forward": 80.0,
        "servo.gain_break_point": None,
        "servo.gain_break_ratio": None,
    }
    servo = axis_servo(ninepc(zfe), "1")
    assert servo.zero_following_error
    assert servo.feed_forward == 80.0
    with pytest.raises(SimulationError, match=r"servo\.feed_forward is not set"):
        axis_servo(ninepc({**zfe, "servo.feed_forward": None}), "1")


def test_a_rotary_axis_turns_in_degrees(ninepc: File) -> None:
    servo = axis_servo(ninepc({"axis.type": "rotary", "servo.lead_screw_pitch": None}), "1")
    assert servo.unit == "deg"
    assert servo.count == pytest.approx(360.0 / 16000.0)
    assert any("360 deg" in note for note in servo.assumptions)
    own = axis_servo(ninepc({"axis.type": "rotary"}), "1", {"model.travel_per_turn": 4.0})
    assert own.count == pytest.approx(4.0 / 16000.0)


def test_a_scale_with_coded_markers_counts_by_its_smaller_period(ninepc: File) -> None:
    # Page 7-33: 20,000 counts for 20 mm are 0.001 mm; the pitch is not used (B-2).
    values: Values = {"servo.position_feedback_type": "dcm", "servo.dcm_small_period": 20.0,
                      "servo.position_counts": 20000.0, "servo.lead_screw_pitch": None}  # fmt: skip
    assert axis_servo(ninepc(values), "1").count == pytest.approx(0.001)


def test_an_analog_axis_has_its_velocity_loop_in_the_drive(ninepc: File) -> None:
    # Pages 7-2 and 7-67: 1989.66667 mm/s2 at a peak of 200 % are half of that at rated torque.
    servo = axis_servo(ninepc({"servo.loop_type": "analog", "servo.velocity_proportional_gain": None}), "1")
    assert servo.acceleration_at_rated == pytest.approx(1989.66667 / 2.0)
    assert servo.torque_limit_positive == 200.0
    assert loop_ratio(servo) == pytest.approx(10.0, rel=1e-3)
    assert any(note.startswith("ASSUMED") for note in servo.assumptions)


def test_the_borrowed_acceleration_is_flagged_until_it_is_given(ninepc: File) -> None:
    borrowed = axis_servo(ninepc(), "1")
    assert any("ASSUMED: 1989.67 mm/s2" in note for note in borrowed.assumptions)
    own = axis_servo(ninepc(), "1", {"model.acceleration_at_rated": 4000.0})
    assert own.acceleration_at_rated == 4000.0
    assert not any("ASSUMED" in note for note in own.assumptions)


def test_a_standard_motor_takes_its_gains_from_the_tables(ninepc: File) -> None:
    # Pages 7-6, 7-54, 7-56.
    asked = []

    def gains(motor: str, ratio: str) -> tuple[float, float] | None:
        asked.append((motor, ratio))
        return (4000.0, 200.0) if motor == "b420e" else None

    values: Values = {
        "servo.standard_motor_values": True,
        "servo.motor_type": "b420e",
        "servo.load_inertia_ratio": "r1",
    }
    servo = axis_servo(ninepc(values), "1", motor_gains=gains)
    assert asked == [("b420e", "r1")]
    assert servo.velocity_rate == pytest.approx(4000.0 / 65.536)
    assert servo.integral_rate == pytest.approx(200.0 / 65.536)
    # Changing a gain on line sets the tables to No (7-6): a gain given by hand is used.
    by_hand = axis_servo(ninepc(values), "1", {"servo.velocity_proportional_gain": 6553.6}, motor_gains=gains)
    assert by_hand.velocity_rate == pytest.approx(100.0)
    unknown = axis_servo(ninepc({**values, "servo.motor_type": "b999"}), "1", motor_gains=gains)
    assert unknown.velocity_rate == pytest.approx(200.0)
    assert any("gains of the file are simulated instead" in note for note in unknown.assumptions)


def test_a_value_given_by_hand_goes_before_the_file_and_a_slip_is_refused(ninepc: File) -> None:
    assert axis_servo(ninepc(), "1", {"servo.initial_gain": 2.0}).position_gain == 2.0
    for slip in ("servo.inital_gain", "servo.reversal_error", "servo.feed_forward"):
        with pytest.raises(SimulationError, match="is not used"):
            axis_servo(ninepc(), "1", {slip: 1.0})


def test_a_family_without_a_servo_model_is_refused(ninepc: File) -> None:
    with pytest.raises(SimulationError, match="family 'facts-alone' cannot be simulated yet"):
        axis_servo(ninepc(), "1", family="facts-alone")


def test_every_assumption_names_its_page_or_is_marked(ninepc: File) -> None:
    for note in (*axis_servo(ninepc(), "1").assumptions, *family._ZFE):
        assert any(character.isdigit() for character in note) or "not simulated" in note, note


def test_the_scenario_goes_from_a_file_to_a_trace_in_one_call(ninepc: File) -> None:
    settings: Values = {"move.distance": 20.0, "move.feedrate": 3000.0, "servo.initial_gain": 2.0}
    trace = SCENARIOS["step"].run(ninepc(), "1", settings, "9pc", None)
    assert trace.result["distance"] == (20.0, "mm")
    assert trace.result["predicted_following_error"][0] == pytest.approx(1.5)
    assert trace.model.startswith("9/PC axis: ")
    assert set(family.MODEL_SETTINGS) >= {"model.acceleration_at_rated"}
    for slip in ({"move.speed": 1.0}, {"move.distance": "far"}):
        with pytest.raises(SimulationError, match=r"move\."):
            SCENARIOS["step"].run(ninepc(), "1", slip, "9pc", None)


def test_advice_ends_at_the_bounds_that_the_manual_prints(ninepc: File) -> None:
    linear = axis_servo(ninepc(), "1").sources
    rotary = axis_servo(ninepc({"axis.type": "rotary"}), "1").sources
    assert (linear["excess_error"].largest, rotary["excess_error"].largest) == (214.1, 214.0)  # page 7-20
    assert (linear["position_gain"].largest, linear["gain_break_ratio"].largest) == (30.0, 1.0)
    assert linear["linear_acceleration"].largest == 20000.0
    assert linear["rapid_feedrate"].largest == 243840.0  # page 9-1
    assert linear["velocity_rate"].largest == 65535.0
