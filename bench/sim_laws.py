"""The laws of all five families at their own sampling times, each with the gains of its example.

The machine has friction, stiction, weight, a spring, where the gains allow it backlash and a resonance, a
current loop or velocity loop, delay, limits and counts. Halving the physics step has to move no axis by more
than a thousandth of its largest following error and three counts.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measure import Measure, timed

from amp_studio.files import open_file
from amp_studio.sim import AxisLaw, law_of
from amp_studio.sim.axis.motion import RunEnd, prepared, run_axis, steps
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.compiled import compiled

SECONDS = 10.0
TIMES_REAL = 10_000.0
"""How many times faster than real time one core has to be."""
ROW = 0.001
"""s from one row to the next, at least."""
RESONANCE = 80.0
"""Hz"""
EXAMPLES = Path(__file__).parents[1] / "examples"


@dataclass(frozen=True)
class Case:
    """An axis of an example, with the machine that it moves."""

    family: str
    file: str
    axis: str
    torque: float
    """What friction and weight are shares of, in the unit of the torque."""
    two_masses: bool = True
    """Whether its gains have the margin for motor and load that move apart;
    an axis without it swings for ever."""


CASES = (
    Case("9pc", "mill-1394/MILL_1394.amp", "1", 100.0),
    Case("num", "num-1060-mill/MILL_1060.amp", "0", 100.0),
    Case("syntec", "syntec-mill/SYNTEC_MILL.amp", "1", 100.0),
    Case("57c422b", "57c422b-label-press/LABEL_PRESS.amp", "X", 2.0),
    Case("acromill", "acromill-router/ROUTER.amp", "X", 2.0, two_masses=False),
)


def axis_of(case: Case) -> AxisLaw:
    """Return the axis of a case."""
    file, law = open_file(EXAMPLES / case.file).file, law_of(case.family)
    count = bind_axis(file, law, case.axis).machine.position_count
    apart = {
        "model.backlash": 5.0 * count,
        "model.resonance": RESONANCE,
        "model.damping": 0.3,
        "model.inertia_ratio": 0.5,
    }
    machine = {
        "model.coulomb_friction": 0.02 * case.torque,
        "model.static_friction": 0.03 * case.torque,
        "model.motor_friction": 0.3,
        "model.gravity": 0.01 * case.torque,
        "model.spring": 1e-7 * case.torque,
    }
    return bind_axis(file, law, case.axis, {**machine, **(apart if case.two_masses else {})})


def measures(times: int) -> Iterator[Measure]:
    """Yield how long ten seconds of each axis take; raises AssertionError where halving the step can be
    seen.
    """
    for case in CASES:
        axis = axis_of(case)
        assert axis.feedrate is not None
        feedrate = 0.5 * axis.feedrate
        profile = move(0.8 * SECONDS * feedrate, feedrate, next(iter(axis.ramps.values())))
        whole, halved = (
            run_axis(axis, profile, RunEnd(SECONDS), refine=n, engine="compiled") for n in (1, 2)
        )
        assert whole.stop == 0, f"{case.family}: alarm {whole.stop}"
        rows = min(len(whole.columns["position"]), len(halved.columns["position"][::2]))
        apart = whole.columns["position"][:rows] - halved.columns["position"][::2][:rows]
        seen = 0.001 * np.max(np.abs(whole.columns["following_error"])) + 3.0 * axis.machine.position_count
        most = float(np.max(np.abs(apart)))
        assert most < seen, f"{case.family}: halving the step moves the axis by {most:g} {axis.unit}"
        samples, substeps = steps(axis)
        step = axis.servo_period / samples / substeps
        vectors, table = prepared(axis, profile, RunEnd(SECONDS), max(1, round(ROW / step)))
        run = compiled(axis.position_sample, axis.velocity_sample)
        fresh = [np.array(each, dtype=np.float64) for each in vectors]

        def call(fresh=fresh, table=table, run=run) -> int:
            return run(*(each.copy() for each in fresh), table)

        name = f"  {case.family} law, a sample each {axis.servo_period * 1e3:.4g} ms"
        yield Measure(name, timed(call, times), SECONDS / TIMES_REAL)
