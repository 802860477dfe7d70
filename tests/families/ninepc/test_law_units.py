"""The unit of the velocity gains: an inference, and the evidence of the manual for it (7-54 to 7-57)."""

import math

import numpy as np
import pytest

from amp_studio.families.ninepc import law_samples as samples
from amp_studio.families.ninepc import law_units as units
from amp_studio.schema import load_schema
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.engine.profiles import POLYNOMIAL
from amp_studio.sim.errors import SimulationError

from .conftest import Axis, Values

TABLES = load_schema("9pc").tables
MOTORS = ["b410g", "b420e", "b430e", "b515e", "b520e", "b520f", "b530e"]
"""Motors of both tables, without the 7xx."""


def test_65536_is_1_per_ms_in_the_three_printed_bounds() -> None:
    # Pages 7-54, 7-56; in inverse ms the position gain is 60 / gain (7-25).
    assert [units.FULL / bound for bound in (3277.0, 10923.0, 1092.0)] == pytest.approx(
        [20.0, 6.0, 60.0], rel=3e-4
    )


def test_the_bounds_are_about_an_axis_of_1000_rad_a_second_squared() -> None:
    # On it the velocity loop is 3 to 10 times as fast as the position loop at every gain.
    for gain in (0.5, 1.0, 2.0):
        position = gain * 1000.0 / 60.0
        loops = [units.loop_rate(bound * gain, units.NOMINAL) / position for bound in (3277.0, 10923.0)]
        assert loops == pytest.approx([3.0, 10.0], rel=3e-4)


def test_both_upper_bounds_together_are_a_damping_of_0_65_at_gain_1() -> None:
    rate, integral_time = units.loop_rate(10923.0, units.NOMINAL), 10923.0 / 1092.0 * units.VELOCITY_PERIOD
    assert 0.5 * math.sqrt(rate * integral_time) == pytest.approx(0.645, abs=0.001)


@pytest.mark.parametrize("motor", MOTORS)
def test_the_table_gives_the_same_loop_at_every_inertia_ratio(motor: str) -> None:
    # Pages 7-55, 7-56: gain is torque for velocity error, the inertia is that of the axis. One cell of 36 is
    # 0.09 % off.
    loops = []
    for ratio in range(4):
        cells = units.standard_gains(TABLES, motor, ratio)
        assert cells is not None
        inertia = units.inertia_of(motor, ratio, TABLES).acceleration
        loops.append([units.loop_rate(cell, inertia) for cell in cells])
    for loop in loops:
        assert loop == pytest.approx(loops[0], rel=1e-3)


def test_the_table_gives_the_same_motion_at_every_inertia_ratio(axis: Axis) -> None:
    # A rigid load, and a step of the velocity command in the velocity loop alone.
    def velocity(ratio: int) -> np.ndarray:
        law = axis(
            {"servo.standard_motor_values": True, "servo.load_inertia_ratio": f"r{ratio}"}, motor_count=0.0
        )
        step = [0.0, math.inf, 0.0, 1.0, 0.0, 0.0, POLYNOMIAL, 0.0]
        return run_axis(law, step, RunEnd(0.06), mode=1.0, engine="plain", thin=True).columns["velocity"]

    alone = velocity(0)
    assert alone.max() > 1.0
    for ratio in (1, 2, 3):
        assert np.abs(velocity(ratio) - alone).max() < 1e-12


def test_the_gains_of_a_motor_keep_their_ratio_but_for_the_7xx() -> None:
    # Where the results of the tool are rough.
    ratios = {}
    for motor in [*MOTORS, "b720e", "b730e"]:
        cells = units.standard_gains(TABLES, motor, 0)
        assert cells is not None
        ratios[motor] = cells[0] / cells[1]
    assert all(14.0 < ratio < 25.1 for motor, ratio in ratios.items() if motor in MOTORS)
    assert min(ratios["b720e"], ratios["b730e"]) >= 120.0


def test_with_the_default_torque_filter_the_tables_are_stable_at_rated_torque_and_not_at_twice_it() -> None:
    # Gain margin of the 420, whose data are assumed; 200 Hz is the filter as delivered (37-3).
    cells = units.standard_gains(TABLES, "b420e", 0)
    assert cells is not None
    lag = units.LAG + 1.0 / (2.0 * math.pi * 200.0)
    highest = units.highest_rate(lag, cells[0] / cells[1] * units.VELOCITY_PERIOD)
    loop = units.loop_rate(cells[0], units.frame_acceleration("b420"))
    assert 1.5 < highest / loop < 2.0


def test_the_lag_of_the_loop_is_three_to_five_samples() -> None:
    assert 3.0 < units.LAG / units.VELOCITY_PERIOD < 5.0


def test_no_proportional_gain_is_stable_where_the_integral_time_is_shorter_than_the_lag() -> None:
    # Page A-10.
    assert units.highest_rate(integral_time=units.LAG) == 0.0
    assert units.highest_rate(integral_time=1.5 * units.LAG) > 0.0
    assert units.highest_rate() == pytest.approx(0.5 * math.pi / units.LAG)


def test_an_axis_shows_where_its_inertia_is_from(axis: Axis) -> None:
    known, other = axis(), axis({"servo.motor_type": "b530e", "servo.load_inertia_ratio": "r2"})
    unknown = axis({"servo.motor_type": "nonstandard"})
    assert "data sheet" in known.assumed["acceleration_per_output"]
    assert "no data of a 1326AB-B530E" in other.assumed["acceleration_per_output"]
    assert "1000 rad/s2" in unknown.assumed["acceleration_per_output"]
    # 2.7 N m on 0.004 lb in s2, 10 mm for a turn.
    assert known.machine.acceleration_per_output == pytest.approx(
        5974.3 * 10.0 / (2.0 * math.pi) / 100.0, rel=1e-4
    )
    assert unknown.machine.acceleration_per_output == pytest.approx(15.915, rel=1e-4)


@pytest.mark.parametrize("motor", ["b410g", "b530e"])
def test_motor_data_from_a_data_sheet_are_assumed_with_their_source(axis: Axis, motor: str) -> None:
    # No manual prints them: of the 530 the mean of those two is in its place.
    message = axis({"servo.motor_type": motor}).assumed["acceleration_per_output"]
    assert "data sheet 1326AB Torque Plus (within 10 %), not from a manual" in message
    assert "model.motor_torque" in message
    assert "model.motor_inertia" in message


def test_torque_and_inertia_of_the_motor_can_be_set(axis: Axis) -> None:
    # 8 N m on 0.001 kg m², 1 : 3, 10 mm for a turn.
    set_both = axis(
        {"servo.motor_type": "b530e", "servo.load_inertia_ratio": "r3"},
        {"model.motor_torque": 8.0, "model.motor_inertia": 0.001},
    )
    assert set_both.machine.acceleration_per_output == pytest.approx(
        8.0 / 0.001 / 4.0 / (2.0 * math.pi) * 10.0 / 100.0
    )
    assert "acceleration_per_output" not in set_both.assumed
    half = axis(settings={"model.motor_torque": 5.4})
    assert half.machine.acceleration_per_output == pytest.approx(2.0 * axis().machine.acceleration_per_output)
    assert half.assumed["acceleration_per_output"].startswith(
        "model.motor_inertia of a 1326AB-B410G is taken as 0.000452 kg m²"
    )


def test_half_of_an_unknown_motor_or_a_motor_beside_its_acceleration_is_refused(axis: Axis) -> None:
    other: Values = {"servo.motor_type": "b530e"}
    with pytest.raises(SimulationError, match=r"set model\.motor_inertia too"):
        axis(other, {"model.motor_torque": 8.0})
    with pytest.raises(SimulationError, match=r"set model\.motor_torque too"):
        axis(other, {"model.motor_inertia": 0.001})
    with pytest.raises(SimulationError, match="must be above 0"):
        axis(settings={"model.motor_torque": 0.0})
    with pytest.raises(SimulationError, match=r"model\.motor_torque is not used"):
        axis(settings={"model.motor_torque": 5.0, "model.acceleration_per_output": 10.0})


def test_maximum_servo_acceleration_is_nothing_to_a_digital_axis(axis: Axis) -> None:
    # Page 7-67, against Table A.A: divided by it, the inertia would be out of the loop.
    one, other = axis({"servo.max_acceleration": 500.0}), axis({"servo.max_acceleration": 5000.0})
    assert (one.parameters, one.machine) == (other.parameters, other.machine)
    heavier = axis({"servo.load_inertia_ratio": "r3"})
    assert heavier.parameters[: samples.SIZE] == axis().parameters[: samples.SIZE]
    assert heavier.machine.acceleration_per_output == pytest.approx(
        axis().machine.acceleration_per_output / 4.0
    )
