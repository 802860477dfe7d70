"""Inertia and friction of an axis out of the record of its drive, as settings of the simulator's machine."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.scenarios import IDENTIFY
from amp_studio.schema import axis_name
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, law_of
from amp_studio.sim.model import AT_SPEED, torque_unit
from amp_studio.sim.rounding import rounded, value_text
from amp_studio.sim.trace import Figure, Trace
from amp_studio.sim.unit_system import in_unit, length_unit

from .analysis import Analysis, MeasuredTorque, settled_analysis
from .beyond_friction import residual_doubts
from .drive_record import DriveRecord, position_factor, read_drive_record, speed_factor, torque_figure
from .friction import FrictionFit
from .lost_motion import backlash, is_closed_by_weight

DIGITS = 6
DOUBTFUL_FIT, DOUBTFUL_ERROR = 0.9, 0.5
"""r² below which, and share of a figure above which its standard error is a doubt."""
FIGURES = ("acceleration_per_output", "viscous_friction", "coulomb_friction", "gravity")
"""What the machine gets; each has a standard error beside it."""
_LOST = (
    "The backlash is by how much the load lags behind its motor in one direction more than in the other: what"
    " the drive train yields to the friction of the load is in it."
)
SLOW_ROWS = 0.05
"""s from one row to the next, from which ramps are hardly in a record."""
_SLOW = (
    "The record has a row each {}: is its time in ms? Inertia and friction need some hundred rows a second"
)
_CLOSED = (
    "The backlash cannot be seen: the weight is more than half of the dry friction, and may keep the gap"
    " closed on the same side in both directions"
)
_EQUAL = (
    "The dry friction is taken as equal in both directions; half of what they differ by is gravity. "
    "In the record of an axis a weight and a friction that is larger in one direction look the same."
)


def identify(
    file: ParameterFile,
    path: Path,
    axis: str | None = None,
    scale: str | None = None,
    system: str | None = None,
    turn: str | None = None,
) -> Trace:
    """Return the figures of an axis' machine, measured and predicted torque over the time.

    ``scale`` is the torque of the record for 1 of the simulator's unit (``0.056 A``), needed where they have
    other units;
    ``system`` as in `simulate`; ``turn`` is the travel for a turn of the motor (``10 mm``), for a record in
    rpm. Raises SimulationError for what the record cannot show, OSError where it cannot be read.
    """
    law = law_of(file.schema.family.family)
    if "velocity" not in law.motion.scenarios:
        name = file.schema.family.name
        raise SimulationError(f"{name} has stepper motors without a servo loop: it has no torque to identify")
    bound = bind_axis(file, law, axis)
    record = read_drive_record(path)
    torque = record.torque / record_scale(record, bound, scale)
    factor = speed_factor(record, bound.unit, turn)
    measured = MeasuredTorque(record, torque, factor, bound)
    found, result = settled_analysis(measured, lambda each: _figures(each, bound))
    fit, notes = found.fit, [_EQUAL]
    if found.is_shifted:
        notes.append(
            f"The motion is {value_text(1e3 * found.shift.value, 'ms', 3)} later than the torque in this "
            "record, and was"
            " shifted so. Whether the axis or the recording delays it, one record does not show."
        )
    lost = _lost_motion(record, fit, bound)
    result |= lost
    notes += [_LOST] if lost else []
    doubts = [*_doubts(result), *residual_doubts(fit, torque_unit(bound))]
    doubts += [_SLOW.format(value_text(fit.period, "s", 3))] if fit.period > SLOW_ROWS else []
    doubts += [_CLOSED] if record.sides is not None and is_closed_by_weight(fit) else []
    return in_unit(
        Trace(
            scenario=IDENTIFY,
            axis=bound.axis,
            letter=axis_name(file.evaluation, bound.axis),
            model=(
                f"{path.name}: {fit.used} of {fit.rows} rows, by {', '.join(record.columns)}; "
                f"a filter of {value_text(1e3 * fit.window, 'ms', 3)}"
            ),
            columns=_columns(fit),
            units=_units(bound),
            result=result,
            assumptions=tuple(notes),
            doubts=tuple(doubts),
        ),
        length_unit(file, system),
    )


def _lost_motion(record: DriveRecord, fit: FrictionFit, bound: AxisLaw) -> dict[str, Figure]:
    """Return the backlash where the record has the positions of motor and load, and a direction closes the
    gap; {} elsewhere.
    """
    if record.sides is None or is_closed_by_weight(fit):
        return {}
    size = position_factor(record.sides_unit, bound.unit)
    found = backlash(fit, record.time, record.sides[0] * size, record.sides[1] * size)
    if found is None:
        return {}
    return {"backlash": (found.value, bound.unit), "backlash_standard_error": (found.error, bound.unit)}


def record_scale(record: DriveRecord, bound: AxisLaw, scale: str | None) -> float:
    """Return the record's torque for 1 of the simulator's; raises SimulationError where the units do not
    fit.
    """
    own, wanted = record.torque_unit, torque_unit(bound)
    if scale is None:
        if own == wanted:
            return 1.0
        raise SimulationError(
            f"The torque of the record is in {own}, that of axis {bound.axis} in {wanted}: "
            f"give how much is 1 {wanted}, as '0.056 {own}'",
            "scale",
        )
    figure, unit = torque_figure(scale)
    if unit != own:
        raise SimulationError(f"The scale is in {unit}, and the torque of the record in {own}")
    return figure


def _figures(found: Analysis, bound: AxisLaw) -> dict[str, Figure]:
    """Return the figures of an analysis in the units of the settings, each with its standard error."""
    result = _friction_figures(found.fit, bound)
    result |= {
        "time_shift": (1e3 * found.shift.value, "ms"),
        "time_shift_standard_error": (1e3 * found.shift.error, "ms"),
    }
    static = found.static
    if static is not None:
        (coulomb, unit), (error, _) = result["coulomb_friction"], result["coulomb_friction_standard_error"]
        result |= {
            "static_friction": ((coulomb or 0.0) + static.more.value, unit),
            "static_friction_standard_error": (math.hypot(error or 0.0, static.more.error), unit),
            "stribeck_speed": (60.0 * static.speed.value, f"{bound.unit}/min"),
            "stribeck_speed_standard_error": (60.0 * static.speed.error, f"{bound.unit}/min"),
        }
    return result


def _friction_figures(fit: FrictionFit, bound: AxisLaw) -> dict[str, Figure]:
    """Return the figures of the machine in the units of its settings, each with its standard error."""
    inertia, viscous, forward, backward = fit.coefficients.tolist()
    torque = torque_unit(bound)
    half = np.array([0.0, 0.0, 0.5, 0.5])
    dry, weight = np.array([0.0, 0.0, 0.5, -0.5]), half
    coulomb, coulomb_error = float(dry @ fit.coefficients), _error(fit, dry)
    if coulomb < -3.0 * coulomb_error:
        raise SimulationError(
            "The torque is smaller while the axis moves than physics allows: the friction came out below 0. "
            "Look at the signs and units of the columns"
        )
    found = {
        "acceleration_per_output": (
            1.0 / inertia,
            # The figure is 1 / J: its error is that of J over J².
            _error(fit, np.eye(4)[0]) / inertia**2,
            f"{bound.unit}/s2",
        ),
        "viscous_friction": (viscous / AT_SPEED, _error(fit, np.eye(4)[1]) / AT_SPEED, torque),
        "coulomb_friction": (max(0.0, coulomb), coulomb_error, torque),
        "gravity": (float(weight @ fit.coefficients), _error(fit, weight), torque),
        "torque_forward": (forward, _error(fit, np.eye(4)[2]), torque),
        "torque_backward": (backward, _error(fit, np.eye(4)[3]), torque),
    }
    figures: dict[str, Figure] = {}
    for name, (value, error, unit) in found.items():
        figures[name] = value, unit
        figures[f"{name}_standard_error"] = error, unit
    return {
        **figures,
        "r_squared": (fit.r_squared, ""),
        "rows": (float(fit.rows), ""),
        "rows_used": (float(fit.used), ""),
        "top_speed": (60.0 * float(np.abs(fit.velocity[fit.is_used]).max()), f"{bound.unit}/min"),
        "record_time": (fit.period * fit.rows, "s"),
    }


def _error(fit: FrictionFit, weights: np.ndarray) -> float:
    return math.sqrt(max(0.0, float(weights @ fit.covariance @ weights)))


def _doubts(result: dict[str, Figure]) -> list[str]:
    doubts = []
    fit = result["r_squared"][0] or 0.0
    if fit < DOUBTFUL_FIT:
        doubts.append(
            f"Inertia and friction explain {value_text(100.0 * fit, '%', 3)} of the torque; look at "
            "the picture of"
            " the fit"
        )
    for name in FIGURES[:3]:
        value, error = result[name][0] or 0.0, result[f"{name}_standard_error"][0] or 0.0
        if error > DOUBTFUL_ERROR * value:
            doubts.append(
                f"{name.replace('_', ' ').capitalize()} may as well be 0: {figure_text(result, name)}"
            )
    return doubts


def _columns(fit: FrictionFit) -> dict[str, np.ndarray]:
    rest = np.where(fit.is_used, fit.torque - fit.predicted, math.nan)
    return {
        "time_s": fit.time,
        "velocity": 60.0 * fit.velocity,
        "torque": fit.torque,
        "predicted_torque": fit.predicted,
        "residual": rest,
    }


def _units(bound: AxisLaw) -> dict[str, str]:
    torque = torque_unit(bound)
    return {
        "time_s": "s",
        "velocity": f"{bound.unit}/min",
        "torque": torque,
        "predicted_torque": torque,
        "residual": torque,
    }


# -- what is shown -----------------------------------------------------------------------------------


def figure_text(result: dict[str, Figure], name: str) -> str:
    """Return a figure with its standard error, both to the same decimal: ``41.52 ± 0.21 mm/s2``."""
    value, unit = result[name]
    error = result[f"{name}_standard_error"][0] or 0.0
    assert value is not None
    largest = max(abs(value), error)
    if largest == 0.0:
        return f"0 ± 0 {unit}".rstrip()
    # As many digits as reach the second one of the error: the rest would be noise.
    digits = (
        DIGITS
        if error == 0.0
        else min(DIGITS, max(2, 2 + math.floor(math.log10(largest)) - math.floor(math.log10(error))))
    )
    return f"{value_text(value, '', digits)} ± {value_text(error, '', 2)} {unit}".rstrip()


_WORDS = {
    "acceleration_per_output": "acceleration per output",
    "inertia_ratio": "inertia of load / motor",
    "viscous_friction": "viscous friction",
    "coulomb_friction": "Coulomb friction",
    "static_friction": "static friction",
    "backlash": "backlash",
    "resonance": "resonance",
    "damping": "its damping ratio",
    "delay": "delay",
    "gravity": "gravity",
    "stribeck_speed": "Stribeck speed",
    "time_shift": "time shift, torque to motion",
    "torque_forward": "dry friction and gravity, +",
    "torque_backward": "dry friction and gravity, −",
}
MACHINE = (*list(_WORDS)[:10],)
"""Figures that are settings of the machine, in the order in which they are written."""


def figure_rows(trace: Trace) -> list[tuple[str, str]]:
    """Return the figures of a result in words, those of the machine first with their standard errors."""
    result, torque = dict(trace.result), trace.result["viscous_friction"][1]
    length = result["acceleration_per_output"][1].partition("/")[0]
    also = {
        "acceleration_per_output": f" for 1 {torque}",
        "viscous_friction": f" at 1000 {'mm' if length == 'in' else length}/min",
        "gravity": ", above 0 the axis falls to -",
    }
    rows = [
        (words, f"{figure_text(result, name)}{also.get(name, '')}")
        for name, words in _WORDS.items()
        if name in result
    ]
    return rows + [
        (words, value_text(value, unit, 5))
        for name, (value, unit) in result.items()
        if name not in _WORDS
        and not name.endswith("_standard_error")
        and name not in _COUNTED
        and value is not None
        for words in [_FITS.get(name, name.replace("_", " "))]
    ]


def identified_text(trace: Trace) -> str:
    """Return the result for the terminal."""
    rows = figure_rows(trace)
    width = max(len(name) for name, _ in rows)
    recommended = [
        f"{each.parameter} at {value_text(each.value, each.unit)}: {each.why} {each.price}"
        for each in trace.recommendations
    ]
    return "\n".join(
        [
            f"identify, axis {trace.axis_title}: {trace.model}",
            *(f"DOUBTFUL: {doubt}" for doubt in trace.doubts),
            *(f"  {name.ljust(width)}  {text}" for name, text in rows),
            *(["Recommendations"] if recommended else []),
            *(f"  {text}" for text in recommended),
            "Assumptions",
            *(f"  {text}" for text in trace.assumptions),
        ]
    )


_FITS = {"r_squared": "r²"}
_COUNTED = ("rows", "rows_used", "record_time")


def machine_settings(trace: Trace) -> dict[str, str]:
    """Return the machine in a trace of `identify`, as ``--set`` takes it: ``model.*`` -> value."""
    found = {}
    for name in MACHINE:
        value, unit = trace.result.get(name, (None, ""))
        if value is not None:
            named = unit if name in _WITH_UNIT and unit != "counts/s2" else ""
            found[f"model.{name}"] = value_text(rounded(value, DIGITS), named, DIGITS)
    return found


_WITH_UNIT = ("acceleration_per_output", "backlash", "resonance", "delay")
"""Figures that are written with their unit; a torque has that of the axis."""
