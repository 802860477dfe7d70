"""A stepped sine on the simulated axis: amplitude and phase of its position at one frequency after the other.

At each frequency the axis follows a sine until what the start left has died away; then amplitude and phase
are taken from whole cycles by least squares (R. Pintelon, J. Schoukens, System Identification, 2012).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.engine.profiles import SINE
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.series import Response, Series
from amp_studio.sim.tuning.linear import LinearModel

CYCLES = 3
"""Whole cycles that a frequency is measured over, at least."""
_SAMPLES = 60
"""Servo samples that a frequency is measured over, at least."""
DIES = 7.0
"""Time constants of the slowest pole before a frequency is measured: what is left is 0.1 %."""
_LONGEST = 2000.0
"""Most simulated seconds."""
SHARE = 0.25
"""Share of feedrate, torque and limits of the following error that the sine uses."""
_COUNTS = 50.0
"""Counts of the answer, where the limits allow it."""
_MIN_COUNTS = 0.5
"""Counts of an answer below which it is none."""
_FINEST = 1e-4
"""u: a count of an ideal device, for the choice of an amplitude."""


@dataclass(frozen=True)
class Tone:
    """One frequency of a sweep: Hz, u, its start and the times between which it is measured, in s."""

    frequency: float
    amplitude: float
    start: float
    begin: float
    end: float


@dataclass(frozen=True, eq=False)
class Sweep:
    """Actual and measured position as a share of the command; nan from where an alarm ended the run."""

    position: Response
    measured: Response
    motion: Motion


def tones_of(
    axis: AxisLaw, model: LinearModel, frequencies: Sequence[float], amplitude: float | None
) -> list[Tone]:
    """Return the tones of a sweep one after the other; each lasts whole cycles. ``amplitude`` in u,
    None for a fitting one.

    Raises SimulationError where the sweep would take too long.
    """
    slowest = float(np.max(np.abs(model.poles()), initial=0.0))
    dies = DIES * model.period / -math.log(slowest) if 0.0 < slowest < 1.0 else 0.0
    tones: list[Tone] = []
    start = 0.0
    for frequency in frequencies:
        # Whole cycles, so that each tone begins at the zero of its sine, where the one before ended.
        wait = math.ceil(dies * frequency) / frequency
        cycles = max(CYCLES, math.ceil(_SAMPLES * model.period * frequency))
        begin, end = start + wait, start + wait + cycles / frequency
        tones.append(Tone(frequency, amplitude or _amplitude(axis, model, frequency), start, begin, end))
        start = end
    if start > _LONGEST:
        raise SimulationError(
            f"The sweep takes {start:.6g} s of the axis; {_LONGEST:.0f} s are simulated at most. Raise"
            " move.lowest",
            "move.lowest",
        )
    return tones


def _amplitude(axis: AxisLaw, model: LinearModel, frequency: float) -> float:
    """Return an amplitude in u within a quarter of feedrate, torque and limits,
    and above 50 counts where it can be.
    """
    rate, machine = 2.0 * math.pi * frequency, axis.machine
    answer = complex(model.follows(np.array([frequency]))[0])
    # Bounded below: what hardly moves the axis must not ask for a boundless amplitude.
    follows, error = max(abs(answer), 1e-3), max(abs(1.0 - answer), 1e-3)
    limits = [level for level in axis.limits.values() if 2.0 * axis.inposition_band < level < math.inf]
    most = [SHARE * level / error for level in limits]
    if axis.feedrate:
        most.append(SHARE * axis.feedrate / rate)
    torque = min(machine.torque_limit_positive, machine.torque_limit_negative)
    if machine.velocity_per_output == 0.0:
        torque = min(torque, machine.output_limit)
    if math.isfinite(torque):
        most.append(SHARE * torque * machine.acceleration_per_output / rate**2 / follows)
    if most and (machine.coulomb_friction or machine.backlash):
        return min(most)  # friction and backlash weigh less
    return min([_COUNTS * max(machine.position_count, machine.motor_count, _FINEST) / follows, *most])


def sweep(axis: AxisLaw, tones: Sequence[Tone], *, feed_forward: bool = True) -> Sweep:
    """Run the axis over the tones."""
    rows: list[float] = []
    for tone in tones:
        duration = tone.end - tone.start if tone is not tones[-1] else math.inf
        rows += [tone.start, duration, 0.0, tone.amplitude, 2.0 * math.pi * tone.frequency, 0.0, SINE, 0.0]
    swept = axis if axis.sweep_parameters is None else replace(axis, parameters=axis.sweep_parameters)
    motion = run_axis(swept, rows, RunEnd(tones[-1].end), thin=True, feed_forward=feed_forward)
    columns = {name: column[:: motion.rows_per_servo_period] for name, column in motion.columns.items()}
    time = np.ascontiguousarray(columns["time_s"])
    found = np.full((2, len(tones)), np.nan, dtype=np.complex128)
    for n, tone in enumerate(tones):
        # An alarm ended the run before this tone was measured.
        if time[-1] < tone.end - 2.0 * axis.servo_period:
            break
        inside = slice(*np.searchsorted(time, (tone.begin - 1e-9, tone.end - 1e-9)))  # time only grows
        for row, name in enumerate(("position", "measured_position")):
            answer = _fitted(time[inside] - tone.start, columns[name][inside], tone)
            if abs(answer) * tone.amplitude >= _MIN_COUNTS * axis.machine.position_count:
                found[row, n] = answer
    return Sweep(found[0], found[1], motion)


def _fitted(time: Series, position: Series, tone: Tone) -> complex:
    """Return amplitude and phase of a position as a share of the commanded sine."""
    angle = 2.0 * math.pi * tone.frequency * time
    base = np.column_stack([np.sin(angle), np.cos(angle), np.ones_like(angle)])
    found = np.linalg.lstsq(base, position, rcond=None)[0]
    return complex(found[0], found[1]) / tone.amplitude
