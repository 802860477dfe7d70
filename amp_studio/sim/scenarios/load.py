"""Scenario `load`: a torque comes at once on the load of an axis at rest, stays, and goes;
then the same from the other side.

What a machine is judged by at the tool: how far the load moves, how long the control takes to bring it back,
and what is left between both sides when nothing pushes any more.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.engine.profiles import POLYNOMIAL
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import assumptions, torque_unit
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace
from amp_studio.sim.tuning.loops import Loops

from .columns import alarms_of, column_units, per_minute
from .figures import stability

_SETTINGS = {
    "move.load": "torque on the load (torque); default: a tenth of the range of the output",
    "move.duration": "time with the torque, and as long without it (s); default: as the loop needs",
    "move.force_per_torque": (
        "force at the load for one unit of torque (N); with it the stiffness is in µm/N too"
    ),
}
SHARE = 0.1
"""Share of the range of the output that the torque has when none is given."""
_RATED = 100.0
"""%: the range of a drive with a velocity loop, and of an output in %."""
_SHORTEST, _LONGEST, _LAGS = 0.1, 3.0, 12.0
"""s, s, and time constants of the slowest pole: the time with the torque."""
_LONGEST_PUSH = 60.0
"""s: the most that can be asked for."""
BACK = 0.05
"""Share of the largest way within which the load is back, a count at least."""
_PHASES = (0.0, 1.0, 0.0, -1.0, 0.0)
"""Shares of the torque, one after the other; what the axis does in the first one is what its weight does."""


@dataclass(frozen=True)
class Loaded:
    """The way of the load from its rest position, in each phase."""

    ways: list[Series]
    times: list[Series]
    """s from the beginning of the phase."""

    @property
    def sag(self) -> float:
        """The largest way under the torque."""
        return max(float(np.abs(self.ways[n]).max()) for n in (1, 3))

    @property
    def remains(self) -> float:
        """The way at the end of the torque."""
        return max(abs(float(_end(self.ways[n]))) for n in (1, 3))

    @property
    def lost_motion(self) -> float:
        """What is left between both sides without a torque."""
        return abs(_end(self.ways[2]) - _end(self.ways[4]))

    def recovery(self, band: float) -> float | None:
        """Return the time in s until the load is back within ``band`` u for good;
        None where it is not by the end of the torque.
        """
        outside = np.flatnonzero(np.abs(self.ways[1]) > band)
        after = int(outside[-1]) + 1 if outside.size else 0
        return float(self.times[1][after]) if after < self.times[1].size else None


def _end(way: Series) -> float:
    return float(way[-max(1, len(way) // 10) :].mean())


def run_load(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Push the load of an axis; raises SimulationError for impossible settings."""
    refuse_unknown(settings, _SETTINGS)
    load = above_zero(settings, "move.load") or SHARE * _range(axis)
    loops = Loops(axis)
    lasts = above_zero(settings, "move.duration", _LONGEST_PUSH) or _time(loops)
    each = max(2, round(lasts / axis.servo_period))
    push = np.repeat(np.array(_PHASES) * load, each).tolist()
    standing = [0.0, math.inf, 0.0, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
    pushed = replace(axis, push=push, after=None)
    motion = run_axis(pushed, standing, RunEnd(len(push) * axis.servo_period))
    stable, margins = stability(axis)
    whole = stable and motion.stop == 0
    found = _loaded(motion, each * axis.servo_period) if whole else None
    return Trace(
        scenario="load",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, found, load, loops, above_zero(settings, "move.force_per_torque")),
        alarms=alarms_of(axis, motion, stable, margins),
        assumptions=(NOTE, *assumptions(axis)),
        move={"move.load": load, "move.duration": lasts},
    )


NOTE = (
    "Stiffness is the largest way of the load for one unit of torque: a smaller figure is a stiffer axis. The"
    " torque acts on the load; dry friction takes its part of it."
)


def _range(axis: AxisLaw) -> float:
    """Return the range of the torque."""
    if torque_unit(axis) == "%":
        return _RATED
    limit = axis.machine.output_limit
    return limit if math.isfinite(limit) else _RATED


def _time(loops: Loops) -> float:
    """Return the time in s in which the loop takes a torque up."""
    sizes = np.abs(loops.models.whole.poles())
    moving = sizes[(sizes > 1e-9) & (sizes < 1.0 - 1e-9)]
    if not moving.size:
        return _SHORTEST
    needed = -_LAGS * loops.models.whole.period / math.log(float(moving.max()))
    return min(max(needed, _SHORTEST), _LONGEST)


def _loaded(motion: Motion, lasts: float) -> Loaded:
    time, position = motion.columns["time_s"], motion.columns["position"]
    # A row on the border belongs to the next phase, whatever rounding made of its time.
    parts = [(time >= n * lasts - 1e-9) & (time < (n + 1) * lasts - 1e-9) for n in range(len(_PHASES))]
    rest = _end(position[parts[0]])
    return Loaded(
        [position[part] - rest for part in parts], [time[part] - n * lasts for n, part in enumerate(parts)]
    )


def _figures(
    axis: AxisLaw, found: Loaded | None, load: float, loops: Loops, force: float | None
) -> dict[str, Figure]:
    """Return stiffness, sag and recovery of a load that comes at once, with those of the linear loop."""
    unit, torque = axis.unit, torque_unit(axis)
    stable = loops.stable and loops.inner_stable
    linear = loops.yields[0] if stable and loops.closed else math.inf
    band = max(axis.machine.position_count, BACK * found.sag if found else 0.0)
    stiffness, sag, remains, recovery, lost = (
        (found.sag / load, found.sag, found.remains, found.recovery(band), found.lost_motion)
        if found
        else (None,) * 5
    )
    figures: dict[str, Figure] = {
        "load": (load, torque),
        "stiffness": (stiffness, f"{unit}/{torque}"),
        "predicted_stiffness": (linear if math.isfinite(linear) else None, f"{unit}/{torque}"),
        "sag": (sag, unit),
        "remaining_deflection": (remains, unit),
        "recovery_time": (recovery, "s"),
        "lost_motion": (lost, unit),
        "Ms": (loops.outer.sensitivity if stable else None, ""),
    }
    if loops.inner is not None:
        figures["velocity_loop_Ms"] = (loops.inner.sensitivity if loops.inner_stable else None, "")
    if force is not None and unit == "mm":
        figures["stiffness_by_force"] = (1e3 * sag / (load * force) if sag is not None else None, "µm/N")
    return figures


SCENARIO = Scenario(
    "load",
    "A torque comes at once on the load of a standing axis: stiffness, sag, recovery",
    _SETTINGS,
    run_load,
    headline="sag",
    checked=("stiffness", "sag", "recovery_time"),
)
