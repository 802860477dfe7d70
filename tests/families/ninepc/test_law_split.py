"""The slave of a split axis goes with its master (chapter 32)."""

from collections.abc import Callable

import numpy as np
import pytest

from amp_studio.families.ninepc.law import bind
from amp_studio.schema import load_schema
from amp_studio.sim import SimulationError
from amp_studio.sim.axis_parameters import AxisParameters, ParameterValue
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.scenarios.step import run_step
from amp_studio.sim.trace import Trace

from .conftest import EVERYWHERE, VALUES, Values

Pair = Callable[..., AxisLaw]
SETS: Values = {
    "deskew.master@1": "x",
    "deskew.slave@1": "u",
    "deskew.gain@1": 0.0,
    "deskew.skew_limit@1": 5.0,
    "axis.name@1": "x",
    "axis.name@4": "u",
}


def servo(axis: str = "4", coupling: float | None = None, **values: ParameterValue) -> AxisLaw:
    """Return one servo of the pair X (1) and U (4); values by id@instance with _ for the point."""
    merged = {
        **SETS,
        **{name.replace("__", ".").replace("_at_", "@"): value for name, value in values.items()},
    }

    def value(parameter: str, instance: str) -> ParameterValue:
        found = f"{parameter}@{instance}"
        if parameter in EVERYWHERE or found in merged:
            return merged.get(found, VALUES.get(parameter))
        return None if parameter.startswith("deskew.") or parameter == "axis.name" else VALUES.get(parameter)

    model: Values = {} if coupling is None else {"model.coupling": coupling}
    return bind(AxisParameters(value, axis, model, load_schema("9pc").tables))


def moved(law: AxisLaw) -> Trace:
    return run_step(law, {"move.distance": 250.0, "move.feedrate": 10000.0})


def test_different_gains_alone_give_the_skew_that_the_gains_say() -> None:
    # Page 32-1: 10000 mm/min at the gains 1 and 1.1 give 10 and 9.09 mm of following error.
    trace = moved(servo(servo__initial_gain_at_4=1.1))
    assert np.abs(trace.columns["skew"]).max() == pytest.approx(10.0 - 10.0 / 1.1, rel=0.01)
    assert trace.alarms == ()


def test_deskew_gain_brings_the_slave_to_its_master() -> None:
    # Page 32-9: a faster slave is slowed down.
    skews = []
    for gain in (0.0, 0.3, 1.0):
        trace = moved(servo(servo__initial_gain_at_4=1.1, deskew__gain_at_1=gain))
        skews.append(float(np.abs(trace.columns["skew"]).max()))
    assert skews[0] > 3.0 * skews[1] > 6.0 * skews[2]


def test_a_skew_above_its_limit_stops_the_control() -> None:
    # Page 32-10.
    trace = moved(servo(servo__initial_gain_at_4=1.1, deskew__skew_limit_at_1=0.5))
    assert [alarm.code for alarm in trace.alarms] == ["EXCESS SKEW"]
    assert "0.5 mm" in trace.alarms[0].message


def test_equal_servos_have_no_skew_and_the_slave_takes_the_ramps_of_its_master() -> None:
    # Page 32-4: all Acc/Dec and feedrate parameters of the slave are ignored.
    law = servo(accdec__linear_acceleration_at_4=33.0, feedrate__rapid_at_4=60.0)
    assert law.ramps["linear"].acceleration == 500.0
    assert law.feedrate == 250.0
    assert np.abs(moved(law).columns["skew"]).max() < 1e-9


def test_each_servo_of_a_pair_names_the_other() -> None:
    assert any("simulate axis 4 to see the skew" in note for note in servo("1").assumptions)
    assert any("slave of axis 1" in note for note in servo("4").assumptions)
    assert not any("split" in note for note in servo("2").assumptions)


def test_an_impossible_pair_shows_why() -> None:
    with pytest.raises(SimulationError, match=r"deskew\.master is 'z', the name of no axis"):
        servo(deskew__master_at_1="z")
    with pytest.raises(SimulationError, match=r"deskew\.gain is -1; it must not be negative"):
        servo(deskew__gain_at_1=-1.0)


def test_a_coupling_pulls_both_servos_with_the_same_force_and_takes_skew_away() -> None:
    def run(axis: str, coupling: float | None) -> Trace:
        law = servo(axis, coupling, servo__initial_gain_at_4=1.1)
        return run_step(law, {"move.distance": 60.0, "move.feedrate": 6000.0, "move.duration": 0.7})

    loose, slave, master = run("4", None), run("4", 10.0), run("1", 10.0)
    middle = slave.columns["time_s"].searchsorted(
        0.55
    )  # at the full speed, which needs no torque without friction
    skew = float(slave.columns["skew"][middle])
    assert abs(skew) < 0.7 * abs(float(loose.columns["skew"][middle]))
    pulls = [float(trace.columns["torque"][middle]) for trace in (slave, master)]
    assert pulls[0] == pytest.approx(-pulls[1], rel=0.05)
    assert abs(pulls[0]) == pytest.approx(10.0 * abs(skew), rel=0.05)


def test_a_split_axis_without_a_coupling_is_named_and_an_impossible_coupling_refused() -> None:
    for axis in ("1", "4"):
        assert any("model.coupling = 0 % for 1 mm" in note for note in servo(axis).assumptions)
        assert any("pull at each other" in note for note in servo(axis, 5.0).assumptions)
    with pytest.raises(SimulationError, match=r"model\.coupling is -1"):
        servo("4", -1.0)
