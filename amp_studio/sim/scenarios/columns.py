"""Columns, units and alarms of a trace, for every scenario."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.engine.signals import DIVERGED, EMERGENCY_STOP
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.rounding import value_text
from amp_studio.sim.trace import Alarm
from amp_studio.sim.tuning.linear import Margins


def per_minute(columns: dict[str, npt.NDArray[np.float64]]) -> dict[str, npt.NDArray[np.float64]]:
    """Return the columns with velocities in u/min, as feedrates are."""
    return {
        name: column * 60.0 if name in ("command_velocity", "velocity") else column
        for name, column in columns.items()
    }


def column_units(axis: AxisLaw) -> dict[str, str]:
    """Return the unit of every column of a trace."""
    u = axis.unit
    torque = "%" if axis.machine.velocity_per_output > 0.0 else axis.output_unit
    own = {"time_s": "s", "command_position": u, "command_velocity": f"{u}/min", "position": u}
    own |= {"measured_position": u, "following_error": u, "velocity": f"{u}/min"}
    return own | {"output": axis.output_unit, "torque": torque} | dict(axis.monitors)


def alarms_of(
    axis: AxisLaw, motion: Motion, stable: bool = True, margins: Margins | None = None
) -> tuple[Alarm, ...]:
    """Return the alarm that ended a run, after those for a loop that is not stable (``margins`` are its own)
    and for an axis at rest.
    """
    alarms = []
    if not stable or motion.stop == int(DIVERGED):
        moment = 0.0 if motion.alarm_row is None else float(motion.columns["time_s"][motion.alarm_row])
        alarms.append(
            Alarm(
                "UNSTABLE",
                0.0 if not stable else moment,
                f"The loop of axis {axis.axis} is not"
                f" stable{_margins(margins)}{'. ' if axis.undamped else ''}{axis.undamped}",
            )
        )
    alarms.extend(_standstill(axis, motion))
    if motion.stop != 0 and motion.stop != int(DIVERGED):
        moment = float(motion.columns["time_s"][motion.alarm_row or 0])
        if motion.stop == int(EMERGENCY_STOP):
            alarms.append(Alarm("EMERGENCY STOP", moment, "The emergency stop that was asked for"))
        else:
            text = axis.alarms[motion.stop]
            alarms.append(Alarm(text.code, moment, text.message))
    return tuple(alarms)


def _standstill(axis: AxisLaw, motion: Motion) -> Iterator[Alarm]:
    """Yield an alarm for an axis that friction keeps at rest although a way was commanded,
    longer than what counts as in position.
    """
    machine, columns = axis.machine, {name: column[motion.driven] for name, column in motion.columns.items()}
    friction = max(machine.static_friction, machine.coulomb_friction)
    moved = np.flatnonzero(columns["command_velocity"])
    if friction == 0.0 or not moved.size or motion.stop == int(EMERGENCY_STOP) or np.any(columns["velocity"]):
        return
    time = columns["time_s"]
    way = float(np.abs(columns["command_velocity"]).mean()) * float(time[-1] - time[0])
    if way <= max(axis.inposition_band, axis.rest_band, machine.position_count):
        return
    unit, peak = column_units(axis)["torque"], float(np.abs(columns["torque"]).max())
    weight = f" and its weight {value_text(abs(machine.gravity), unit, 3)}" if machine.gravity else ""
    yield Alarm(
        "NO MOTION",
        float(time[moved[0]]),
        f"Axis {axis.axis} does not move: its friction at rest is "
        f"{value_text(friction, unit, 3)}{weight}, and the"
        f" torque was at most {value_text(peak, unit, 3)}",
    )


def _margins(margins: Margins | None) -> str:
    if margins is None:
        return ""
    known = (("gain margin", margins.gain, "dB"), ("phase margin", margins.phase, "deg"))
    parts = [f"{value_text(value, unit, 3)} {name}" for name, value, unit in known if value is not None]
    return f": {' and '.join(parts)}" if parts else ", whatever its gain is"
