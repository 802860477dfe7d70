"""The tuning story of appendix C: its test motor and its runs, for the tests."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from amp_studio.families.acromill import law_plant as plant
from amp_studio.families.acromill.law import LAW
from amp_studio.schema import load_schema
from amp_studio.sim import AxisLaw, AxisParameters, ParameterValue, Ramp
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.command.ramps import end_of, move
from amp_studio.sim.model import with_model

TURN = plant.PULSES_PER_TURN
"""Pulses of a turn; a turn is 1 mm of these axes."""
PRINTED = 500.0
"""Turns/s2: ACC 500, DEC 500, STP 500 (page 115)."""
VERIFIED = 500.0 / 60.0 / 0.1
"""Turns/s2 with which the ramps take the "approximately 100 msec" that page 115 has verified."""

_DEFAULTS: dict[str, ParameterValue] = {
    "axes.pulses_per_unit": TURN,
    "tuning.servo_period": plant.SERVO_PERIOD * 1000.0,
    "tuning.fbvel": 0.0,
    "tuning.dac_gain": 3276.8,
    "axes.excess_error_band": 4.0,
    "speeds.rapid": 500.0,
    "speeds.rapid_acc_dec": PRINTED,
}
_GAINS = (
    "p_gain",
    "i_gain",
    "i_delay",
    "i_limit",
    "d_time",
    "d_gain",
    "vel_ffwd",
    "acc_ffwd",
    "torque_limits",
)


def gains(run: int) -> dict[str, ParameterValue]:
    """Return the gains of a printed run, 1 to 12, as the table of the guide has them."""
    row = load_schema("acromill").tables["tuning-runs"].rows[run - 1]
    values = dict(zip((f"servo.{name}" for name in _GAINS), (float(each) for each in row[1:10]), strict=True))
    for time in ("servo.i_delay", "servo.d_time"):
        values[time] *= 1000.0  # s in the table, canonical ms
    return dict(values)


def axis_of(run: int, **changes: ParameterValue) -> AxisLaw:
    """Return the test motor with the gains of a run; changes by parameter id with ``__`` for the point."""
    values = _DEFAULTS | gains(run) | {name.replace("__", "."): value for name, value in changes.items()}
    read = AxisParameters(lambda parameter, _instance: values.get(parameter), "X", values)
    return with_model(LAW.bind(read), read)


@dataclass(frozen=True)
class Scope:
    """What the oscilloscope of the story shows: the following error in pulses at every servo sample."""

    time: npt.NDArray[np.float64]
    error: npt.NDArray[np.float64]
    ramp: float
    """s of each ramp."""
    end: float
    """s: end of the command."""

    def between(self, start: float, end: float) -> npt.NDArray[np.float64]:
        """Return the error from ``start`` to ``end`` s."""
        return self.error[(self.time >= start) & (self.time < end)]

    @property
    def at_speed(self) -> float:
        """Mean error in the last 0.2 s at speed, when what the ramp left has died away."""
        return float(self.between(self.end - self.ramp - 0.2, self.end - self.ramp).mean())

    def ringing(self, start: float, length: float) -> float:
        """Return the difference of the greatest and the least error in a stretch."""
        stretch = self.between(start, start + length)
        return float(stretch.max() - stretch.min())


@cache
def trace(run: int, ramp: float) -> Scope:
    """Return the trace of a printed run."""
    return index(axis_of(run), ramp=ramp)


def index(
    axis: AxisLaw, *, ramp: float = PRINTED, turns: float = 10.0, rpm: float = 500.0, tail: float = 0.3
) -> Scope:
    """Run the index of the story: 10 turns at 500 turns a minute (page 115)."""
    profile = move(turns, rpm / 60.0, Ramp("linear", ramp))
    end = end_of(profile)
    motion = run_axis(axis, profile, RunEnd(end + tail), engine="plain")
    every = motion.rows_per_servo_period
    columns = motion.columns
    return Scope(
        columns["time_s"][::every], columns["following_error"][::every] * TURN, rpm / 60.0 / ramp, end
    )
