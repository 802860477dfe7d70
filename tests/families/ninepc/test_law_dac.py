"""The DAC monitor shows a signal of the servo in volts, as far as appendix A prints its scale."""

import numpy as np
import pytest

from amp_studio.families.ninepc import law_samples as samples
from amp_studio.sim import SimulationError
from amp_studio.sim.engine.signals import MONITOR
from amp_studio.sim.scenarios.step import run_step

from .conftest import Axis, Values

UNIT_86, UNIT_87 = "model.dac_unit_86", "model.dac_unit_87"
CODE_86, CODE_87 = "patch.dac_monitor@2", "patch.dac_monitor@3"
VOLTS_820, SPEED_910 = "spindle.voltage_at_max@1.1", "spindle.max_speed@1.1"
VOLTS_830, SPEED_930 = "spindle.voltage_at_max@2.1", "spindle.max_speed@2.1"
TEN_VOLTS: Values = {VOLTS_820: 10.0, SPEED_910: 3000.0, VOLTS_830: 10.0, SPEED_930: 3000.0}
"""As page A-4 sets them."""


def volts(axis: Axis, signal: float, **changed: float) -> float:
    """Return what 86 gives for a following error in mm that counts in thousandths."""
    figures = {"voltage": 10.0, "speed": 3000.0, **changed}
    law = axis({CODE_86: 201.0, VOLTS_820: figures["voltage"], SPEED_910: figures["speed"]}, {UNIT_86: 0.001})
    io = [0.0] * (MONITOR + len(law.monitors))
    io[MONITOR + samples.FOLLOWING_ERROR] = signal
    samples.dac_monitors(list(law.parameters), io)
    return io[-1]


@pytest.mark.parametrize(
    ("code", "signal"),
    [
        (101.0, "velocity_feedback"),
        (201.0, "control_following_error"),
        (301.0, "integral_torque"),
        (401.0, "velocity_error"),
        (601.0, "velocity_command"),
    ],
)
def test_a_function_code_plus_the_axis_number_selects_the_signal(
    axis: Axis, code: float, signal: str
) -> None:
    # Table A.B, page A-6.
    law = axis(
        {CODE_86: code, "servo.velocity_integral_gain": 100.0, VOLTS_820: 10.0, SPEED_910: 99999.9},
        {UNIT_86: 0.01},
    )
    columns = run_step(law, {"move.distance": 2.0, "move.duration": 0.1}).columns
    assert law.monitors[-1] == ("dac_86", "V")
    assert np.max(np.abs(columns[signal])) > 0.0
    assert columns["dac_86"] == pytest.approx(columns[signal] * 10.0 / (99999.9 * 0.01))


def test_coarse_ipcs_are_shown_as_the_velocity_of_the_command_and_are_inferred(axis: Axis) -> None:
    # Table A.B names them; IPC is the incremental position command of Figure 7.4.
    law = axis({CODE_86: 501.0, VOLTS_820: 10.0, SPEED_910: 99999.9}, {UNIT_86: 0.01})
    columns = run_step(law, {"move.distance": 2.0, "move.duration": 0.1}).columns
    wanted = columns["command_velocity"] / 60.0 * 10.0 / (99999.9 * 0.01)  # mm/min there, mm/s here
    assert np.max(columns["dac_86"]) == pytest.approx(np.max(wanted), rel=0.02)
    assert any(text.startswith("INFERRED: coarse IPCs (500)") for text in law.assumptions)


def test_the_result_has_the_scale_of_table_a_c_to_begin_with(axis: Axis) -> None:
    law = axis({**TEN_VOLTS, CODE_86: 401.0}, {UNIT_86: 0.01})
    assert any(
        "400 (Table A.C, A-7): 50 at a pitch of 0.1 in, 20 at 0.5 in" in text for text in law.assumptions
    )


def test_820_is_the_voltage_at_full_scale_and_910_the_signal_there(axis: Axis) -> None:
    # Pages: 820 at 10 V, 910 at 3000.
    assert volts(axis, 3.0) == pytest.approx(10.0)
    assert volts(axis, -1.5) == pytest.approx(-5.0)


@pytest.mark.parametrize(("speed", "voltage"), [(1500.0, 2.0), (3000.0, 1.0), (6000.0, 0.5)])
def test_a_larger_910_lowers_the_voltage(axis: Axis, speed: float, voltage: float) -> None:
    # Pages.
    assert volts(axis, 0.3, speed=speed) == pytest.approx(voltage)


@pytest.mark.parametrize(("full_scale", "most"), [(10.0, 10.0), (5.0, 5.0), (-10.0, -10.0)])
def test_the_voltage_ends_at_full_scale(axis: Axis, full_scale: float, most: float) -> None:
    # Page A-5: 820 is the highest voltage; page 12-2: -10 to 10 V, the range that Voltage at Max limits.
    assert volts(axis, 1e6, voltage=full_scale) == most
    assert volts(axis, -1e6, voltage=full_scale) == -most


def test_two_functions_are_shown_at_once_each_with_its_own_scale(axis: Axis) -> None:
    # Page A-5: 820 and 910 scale 86, 830 and 930 scale 87.
    values = {CODE_86: 201.0, CODE_87: 101.0, VOLTS_820: 10.0, SPEED_910: 5000.0}
    law = axis({**values, VOLTS_830: 5.0, SPEED_930: 1000.0}, {UNIT_86: 0.01, UNIT_87: 1.0})
    columns = run_step(law, {"move.distance": 2.0, "move.duration": 0.1}).columns
    assert columns["dac_86"] == pytest.approx(columns["control_following_error"] / 5.0)
    assert columns["dac_87"] == pytest.approx(columns["velocity_feedback"] * 0.005)


def test_87_alone_takes_830_and_930(axis: Axis) -> None:
    law = axis({CODE_87: 201.0, VOLTS_830: 5.0, SPEED_930: 1000.0}, {UNIT_87: 0.01})
    columns = run_step(law, {"move.distance": 2.0, "move.duration": 0.1}).columns
    assert "dac_86" not in columns
    assert columns["dac_87"] == pytest.approx(columns["control_following_error"] * 0.5)


def test_an_analog_servo_shows_its_following_error(axis: Axis) -> None:
    # Table A.B, page A-6: the functions with a star.
    analog: Values = {
        "servo.loop_type": "analog",
        "servo.analog_positive_voltage": 10.0,
        "servo.analog_negative_voltage": -10.0,
        "servo.max_acceleration": 3000.0,
    }
    law = axis({**analog, **TEN_VOLTS, CODE_86: 201.0}, {UNIT_86: 0.01})
    columns = run_step(law, {"move.distance": 2.0, "move.duration": 0.1}).columns
    assert np.max(columns["dac_86"]) > 0.0
    assert columns["dac_86"] == pytest.approx(columns["control_following_error"] / 3.0)
    with pytest.raises(SimulationError, match="an analog servo has no such signal"):
        axis({**analog, **TEN_VOLTS, CODE_86: 101.0}, {UNIT_86: 0.01})


def test_the_result_shows_that_the_unit_is_not_printed(axis: Axis) -> None:
    law = axis({**TEN_VOLTS, CODE_86: 201.0}, {UNIT_86: 0.01})
    assert any(
        "does not print the unit of the signal: 0.01 is that of" in message for message in law.assumptions
    )


def test_a_monitor_of_another_axis_is_named_and_is_no_column(axis: Axis) -> None:
    # Page A-6: 204 is the following error of axis 4. The other axis of a circle gets the same settings.
    law = axis({**TEN_VOLTS, CODE_86: 204.0}, {UNIT_86: 0.01})
    assert len(law.monitors) == len(samples.MONITORS)
    assert (
        "DAC monitor 86 (patch.dac_monitor) is 204: it shows axis 4, so it is no column of axis 1."
        in law.assumptions
    )


def test_without_its_unit_nothing_is_shown(axis: Axis) -> None:
    law = axis({**TEN_VOLTS, CODE_86: 201.0})
    assert len(law.monitors) == len(samples.MONITORS) == samples.DAC_MONITOR
    assert not any("DAC" in message for message in law.assumptions)


@pytest.mark.parametrize(
    ("values", "unit", "words"),
    [
        ({CODE_86: 0.0}, 1.0, "is 0. Set it to a function code plus the axis number"),
        ({CODE_86: 777.0}, 1.0, "is 777, no function code plus axis number; the control stays in E-STOP"),
        ({CODE_86: 201.5}, 1.0, "is 201.5, no function code"),
        ({CODE_86: float("nan")}, 1.0, "is nan, no function code"),
        ({CODE_86: 701.0}, 1.0, "is 701, no function code plus axis number"),
        ({CODE_86: None}, 1.0, "patch.dac_monitor is not set"),
        ({VOLTS_820: 10.5}, 1.0, "spindle.voltage_at_max is 10.5; it must be from -10 to 10 V"),
        ({SPEED_910: 0.0}, 1.0, "spindle.max_speed is 0; it must be above 0"),
        ({}, 0.0, "model.dac_unit_86 is 0; it must be above 0"),
        ({}, float("nan"), "model.dac_unit_86 is nan; it must be above 0"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_a_sentence(
    axis: Axis, values: Values, unit: float, words: str
) -> None:
    with pytest.raises(SimulationError) as error:
        axis({**TEN_VOLTS, CODE_86: 201.0, **values}, {UNIT_86: unit})
    assert words in str(error.value)
