"""A delay that is no multiple of the physics step:
the simulated axis is the discrete linear model of its law.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import AxisLaw, Machine, law_of, simulate
from amp_studio.sim.axis.motion import RunEnd, run_axis, steps
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.machine import DELAY_SHARE, machine_array
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.sim.tuning.linear import linear_model
from tests.campaigns import some

EXAMPLES = Path(__file__).parents[2] / "examples"
FAMILIES = {
    "9pc": ("mill-1394/MILL_1394.amp", "1"),
    "num": ("num-1060-mill/MILL_1060.amp", "0"),
    "syntec": ("syntec-mill/SYNTEC_MILL.amp", "1"),
    "57c422b": ("57c422b-label-press/LABEL_PRESS.amp", "X"),
    "acromill": ("acromill-router/ROUTER.amp", "X"),
}


def example(family: str, part: float | None, gain: float | None = None) -> AxisLaw:
    """Return the axis of a family's example as a linear machine; ``part`` of a physics step is its delay,
    None for its own.
    """
    name, instance = FAMILIES[family]
    file = open_file(EXAMPLES / name).file
    if gain is not None:
        file.set(("servo.p_gain", instance), Value(gain, "V/count"))
    axis = bind_axis(file, law_of(family), instance)
    samples, substeps = steps(axis)
    ideal: dict[str, float] = dict.fromkeys(
        ("coulomb_friction", "static_friction", "backlash", "gravity", "position_count", "motor_count"), 0.0
    )
    if part is not None:
        ideal["delay"] = part * axis.servo_period / samples / substeps
    machine: Machine = replace(axis.machine, **ideal)
    assert machine_array(machine, axis.servo_period / samples / substeps)[DELAY_SHARE] > 0.1
    return replace(axis, machine=machine)


# The laws of Syntec and 57C422B round to whole units: a sine of many, within the limit of the output.
@pytest.mark.parametrize(
    ("family", "part", "settings"),
    some(
        [
            ("9pc", 2.37, {"move.lowest": 3.0}),
            ("num", 2.37, {}),
            ("syntec", 2.37, {"move.amplitude": 0.2, "move.lowest": 2.0, "move.highest": 20.0}),
            ("57c422b", 2.37, {"move.amplitude": 100.0, "move.lowest": 5.0, "move.highest": 22.0}),
            ("acromill", None, {}),
            ("acromill", 0.5, {}),
        ],
        3,
    ),
)
def test_an_example_swept_is_its_linear_model(
    family: str, part: float | None, settings: dict[str, float]
) -> None:
    trace = SCENARIOS["frequency"].run(example(family, part), settings)
    assert trace.alarms == ()
    gain, model = (trace.columns[f"closed_gain_db{which}"] for which in ("", "_model"))
    phase, modelled = (trace.columns[f"closed_phase_deg{which}"] for which in ("", "_model"))
    near = np.isfinite(gain) & (model > -20.0)
    assert np.count_nonzero(near) > 10
    assert np.max(np.abs(gain - model)[near]) < 0.2
    assert np.max(np.abs(phase - modelled)[near]) < 1.0


def test_the_figures_of_the_router_are_those_of_its_model() -> None:
    """Its own file: 1.6 physics steps of delay; averaged,
    the axis had 425 Hz and 7.3 deg beside 486 Hz and 4.4 deg.
    """
    found = SCENARIOS["frequency"].run(example("acromill", None), {}).result
    for figure in ("bandwidth", "phase_margin", "gain_margin"):
        assert found[f"swept_{figure}"][0] == pytest.approx(found[figure][0], rel=2e-3)


@pytest.mark.parametrize("gain", [0.08, 0.10])
def test_the_axis_swings_up_where_the_model_is_not_stable(gain: float) -> None:
    axis = example("acromill", None, gain)
    motion = run_axis(axis, move(0.1, 1.0, axis.ramps["none"]), RunEnd(0.5))
    error = motion.columns["following_error"]
    swing = [float(np.ptp(part)) for part in np.array_split(error[len(error) // 2 :], 2)]
    assert (swing[1] > 0.01) == (not linear_model(axis).is_stable())  # mm: at the limit of the output


def test_what_the_sweep_of_the_57c422b_contains_besides_the_model_is_named() -> None:
    """Its own file: dry friction and Deadband Compensation make 79.0 Hz of 76.1 Hz;
    without both the sweep is the model's.
    """
    file = open_file(EXAMPLES / FAMILIES["57c422b"][0]).file
    with_all = simulate(file, "frequency", "X", advise=False)
    assert with_all.result["swept_bandwidth"][0] > 1.02 * with_all.result["bandwidth"][0]
    assert any(
        "it contains dry friction, counts, limits and what the control itself" in text
        for text in with_all.assumptions
    ), with_all.assumptions
    file.set(("gain.deadband", "X"), Value(0))
    without = simulate(
        file, "frequency", "X", {"model.coulomb_friction": 0.0, "model.static_friction": 0.0}, advise=False
    )
    assert without.result["swept_bandwidth"][0] == pytest.approx(without.result["bandwidth"][0], rel=0.01)
    assert without.result["swept_phase_margin"][0] == pytest.approx(
        without.result["phase_margin"][0], abs=0.5
    )
    assert not any("The sweep has another bandwidth" in text for text in without.assumptions)
