"""The simulator beside others: one axis with all non-linear parts,
and its linear part for those that know only that.

Peers: the same axis in C (``sim_axis.c``, compiled here with -O2), scipy's ``lsim`` and python-control's
``forced_response`` on the linear part. Accuracy comes first: halving the physics step has to change nothing
that can be seen, and the C program has to give the same positions; otherwise nothing is measured.
"""

import ctypes
import math
import shutil
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import control
import numpy as np
import numpy.typing as npt
import scipy.signal
from measure import Measure, timed

from amp_studio.sim import AxisLaw, Machine, Ramp
from amp_studio.sim.axis.motion import RunEnd, prepared, run_axis, steps
from amp_studio.sim.command.ramps import end_of, move
from amp_studio.sim.engine import kernel as shared
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.compiled import compiled
from amp_studio.sim.engine.machine import DELAY_SHARE, machine_array
from amp_studio.sim.engine.signals import COMMAND, COMMAND_VELOCITY, MOTOR, OUTPUT, POSITION

SECONDS = 10.0
"""Simulated time of a run."""
TIMES_REAL = 8_000.0
"""How many times faster than real time one core has to be.

It was 10,000 while an output that arrives inside of a physics step was averaged over it; now such a step is
cut in two, and here every step is one: 80,000 advances of two masses, 14 ns each. The C program, which cuts
too, is the measure of what is possible."""
SAME = 1e-9
"""mm: largest difference of the positions in C."""
VISIBLE = 0.002
"""mm: largest difference that halving the step may make with ideal devices, on a move of 1.5 m."""
COUNTS = 0.003
"""mm: what counts may add to it, three of them:
whether one comes a sample sooner is decided by the last digit."""
STRIDE = 4
"""Physics steps for one row: a row every 1 ms."""

GAIN, VELOCITY_GAIN, INTEGRAL, LIMIT, RATE = range(5)
WANTED, LAST, SUM = range(3)

Rows = npt.NDArray[np.float64]
_Call = Callable[[], int]


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Ask for a velocity: proportional to the following error, and that of the command."""
    s[WANTED] = p[GAIN] * (io[COMMAND] - io[POSITION]) + io[COMMAND_VELOCITY]


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Ask for a torque: proportional and integral, limited, without windup."""
    error = s[WANTED] - (io[MOTOR] - s[LAST]) * p[RATE]
    s[LAST] = io[MOTOR]
    output = p[VELOCITY_GAIN] * error + s[SUM]
    if output > p[LIMIT]:
        output = p[LIMIT]
    elif output < -p[LIMIT]:
        output = -p[LIMIT]
    else:
        s[SUM] += p[INTEGRAL] * error
    io[OUTPUT] = output


AXIS = AxisLaw(
    axis="1",
    unit="mm",
    title="axis with all non-linear parts",
    position_sample=position_sample,
    velocity_sample=velocity_sample,
    parameters=(20.0, 3.0, 0.05, 90.0, 4000.0),
    state_size=3,
    servo_period=0.001,
    velocity_period=0.00025,
    machine=Machine(
        acceleration_per_output=50.0,
        inertia_ratio=1.5,
        viscous_friction=0.01,
        coulomb_friction=3.0,
        static_friction=4.0,
        motor_friction=0.3,
        backlash=0.01,
        resonance=80.0,
        gravity=2.0,
        spring=0.001,
        bandwidth=300.0,
        delay=0.0003,
        torque_limit_positive=80.0,
        torque_limit_negative=80.0,
        motor_count=0.0005,
        position_count=0.001,
        load_sensor=True,
    ),
    output_unit="%",
    position_rate=20.0,
    feedrate=200.0,
)
IDEAL = replace(AXIS.machine, motor_count=0.0, position_count=0.0)
PROFILE = move(1500.0, 200.0, Ramp("s-curve", 2000.0, jerk=40000.0))


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield the measures; raises AssertionError where the figures are not right."""
    rows, ours = _kernel()
    filled = ours()
    for axis, visible in ((AXIS, VISIBLE + COUNTS), (replace(AXIS, machine=IDEAL), VISIBLE)):
        whole, halved = (run_axis(axis, PROFILE, RunEnd(SECONDS), refine=refine).columns for refine in (1, 2))
        moved = float(np.max(np.abs(whole["position"] - halved["position"][::2])))
        assert moved < visible, f"halving the step moves the axis by {moved:g} mm"
    yield Measure(
        f"{SECONDS:g} s of an axis with all non-linear parts", timed(ours, times), SECONDS / TIMES_REAL
    )
    theirs = _in_c(folder, rows.shape)
    if theirs is not None:
        other, run = theirs
        run()
        off = float(np.max(np.abs(rows[:filled, 3] - other[:filled, 3])))
        assert off < SAME, f"the same axis in C is {off:g} mm away"
        yield Measure("  the same in C, -O2", timed(run, times))
    yield from _linear(times)


def _kernel() -> tuple[Rows, _Call]:
    """Return the rows that a call fills, and the call."""
    vectors, rows = prepared(AXIS, PROFILE, RunEnd(SECONDS), STRIDE)
    run = compiled(AXIS.position_sample, AXIS.velocity_sample)
    fresh = [np.array(each, dtype=np.float64) for each in vectors]

    def call() -> int:
        return run(*(each.copy() for each in fresh), rows)

    return rows, call


def _in_c(folder: Path, shape: tuple[int, int]) -> tuple[Rows, _Call] | None:
    """Return the same for the C program; None without a compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        return None
    library = folder / "sim_axis.so"
    source = Path(__file__).with_name("sim_axis.c")
    command = [compiler, "-O2", "-shared", "-fPIC", str(source), "-o", str(library), "-lm"]
    subprocess.run(command, check=True, capture_output=True)
    program = ctypes.CDLL(str(library)).run
    samples, substeps = steps(AXIS)
    step = AXIS.servo_period / samples / substeps
    part = machine_array(AXIS.machine, step)[DELAY_SHARE] * step
    machines = [machine_array(AXIS.machine, span) for span in (step, part, step - part)]
    arrays = [np.array(each) for each in (AXIS.parameters, *machines, PROFILE)]
    rows = np.empty((shape[0], len(shared.COLUMNS)))
    pointers = [each.ctypes.data_as(ctypes.c_void_p) for each in (*arrays, rows)]
    whole = [ctypes.c_long(each) for each in (samples, substeps, STRIDE, shape[0])]
    program.restype = ctypes.c_long

    def call() -> int:
        return int(program(*pointers[:5], ctypes.c_double(AXIS.servo_period), *whole, pointers[5]))

    return rows, call


def _linear(times: int) -> Iterator[Measure]:
    """Yield the linear part of the axis, continuous, by the peers, over the same time in the same steps."""
    p, machine = AXIS.parameters, AXIS.machine
    proportional = p[VELOCITY_GAIN] * machine.acceleration_per_output
    integral = p[INTEGRAL] * p[RATE] * machine.acceleration_per_output
    velocity = scipy.signal.TransferFunction([proportional, integral], [1.0, proportional, integral])
    closed = scipy.signal.TransferFunction(
        p[GAIN] * velocity.num, np.polyadd(np.polymul(velocity.den, [1.0, 0.0]), p[GAIN] * velocity.num)
    )
    time = np.arange(0.0, SECONDS, 0.00025)
    wanted = np.interp(time, [0.0, 0.1, end_of(PROFILE) - 0.1, math.inf], [0.0, 0.0, 1500.0, 1500.0])
    states = closed.to_ss()
    other = control.ss(states.A, states.B, states.C, states.D)
    few = max(1, times // 5)
    yield Measure(
        "  its linear part by scipy lsim", timed(lambda: scipy.signal.lsim(states, wanted, time), few)
    )
    yield Measure(
        "  its linear part by control.forced_response",
        timed(lambda: control.forced_response(other, time, wanted), few),
    )
    rigid = replace(AXIS, machine=Machine(machine.acceleration_per_output))
    vectors, rows = prepared(rigid, PROFILE, RunEnd(SECONDS), 1)
    run = compiled(AXIS.position_sample, AXIS.velocity_sample)
    fresh = [np.array(each, dtype=np.float64) for each in vectors]
    yield Measure("  its linear part here", timed(lambda: run(*(v.copy() for v in fresh), rows), times))
