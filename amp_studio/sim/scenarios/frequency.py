"""Scenario `frequency`: a sine of many frequencies on the simulated axis, beside the linear model of its law.

The open loop follows from the closed one without feed-forward: T = L / (1 + L),
both of the measured position.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Response, Series
from amp_studio.sim.trace import Alarm, Figure, Trace
from amp_studio.sim.tuning.advice import stable_inertias
from amp_studio.sim.tuning.linear import LinearModel, Margins, axis_model

from .columns import alarms_of
from .sweep import sweep, tones_of

_SETTINGS = {
    "move.lowest": "lowest frequency of the sweep (Hz); default: a tenth of the bandwidth",
    "move.highest": "highest frequency of the sweep (Hz); default: past bandwidth and margins",
    "move.amplitude": "amplitude of the sine (mm or deg); default: as small as counts and friction allow",
    "move.points": "frequencies of the sweep; default: 24",
}

POINTS, MAX_POINTS = 24, 400
CURVE = 400
"""Points of the drawn linear model."""
_MIN_PEAK = 0.01
"""dB: below it an axis has no resonance peak; one that only falls has its largest answer, 0 dB, at rest."""


@dataclass(frozen=True)
class _Loop:
    """An axis and the figures of its linear model."""

    axis: AxisLaw
    model: LinearModel
    """From the command to the position."""
    cut: LinearModel
    """The position loop, cut where the position is measured."""
    inner: LinearModel | None
    """The velocity loop."""
    stable: bool
    margins: Margins
    damping: float
    """Damping ratio of the position loop."""
    bandwidth: float | None


@dataclass(frozen=True, eq=False)
class _Swept:
    """The measured loops over the frequencies of the curve, nan where they were not measured."""

    closed: Response
    opened: Response


_LINEAR = (
    "The linear model is the law at rest on the machine without dry friction, backlash, counts and limits; it"
    " is sampled as the control samples, and its loop is cut where the position is measured."
)


_MIN_DIFFERENCE = 0.02
"""Share of the model's bandwidth from which the sweep's is another figure."""


def run_frequency(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Sweep an axis; raises SimulationError for impossible settings."""
    refuse_unknown(settings, _SETTINGS)
    models = axis_model(axis)
    model, cut = models.whole, models.cut
    if model.drifts():
        raise SimulationError(f"The position loop of axis {axis.axis} is open. Use the scenario velocity")
    margins = cut.margins()
    damping = models.damping(margins.phase_frequency)
    loop = _Loop(axis, model, cut, models.inner, model.is_stable(), margins, damping, model.bandwidth())
    low, high, points = _span(loop, settings)
    # The swept frequencies are points of the drawn curve, so that both can be compared without
    # interpolation.
    curve = np.unique(np.concatenate([np.geomspace(low, high, CURVE), _known(loop, low, high)]))
    notes, alarms = [_LINEAR], tuple[Alarm, ...]()
    swept = _Swept(
        np.full(len(curve), np.nan, dtype=np.complex128), np.full(len(curve), np.nan, dtype=np.complex128)
    )
    if loop.stable:
        swept, alarms, note = _measured(loop, curve, _frequencies(low, high, points, curve), settings)
        notes += [note] if note else []
    else:
        alarms = (Alarm("UNSTABLE", 0.0, _unstable(loop)),)
    result = _figures(loop, curve, swept)
    notes += [difference] if (difference := _difference(axis, result)) else []
    return Trace(
        scenario="frequency",
        axis=axis.axis,
        model=axis.title,
        columns=_columns(loop, curve, swept),
        units=_UNITS,
        result=result,
        alarms=alarms,
        assumptions=(*assumptions(axis), *notes),
        move={"move.lowest": low, "move.highest": high},
    )


def _span(loop: _Loop, settings: ScenarioSettings) -> tuple[float, float, int]:
    """Return lowest and highest frequency in Hz and the number of frequencies."""
    model = loop.model
    middle = loop.bandwidth or loop.margins.phase_frequency or 0.03 * model.nyquist
    # Past the frequency of the gain margin, or the sweep could not show it.
    far = max(10.0 * middle, 1.5 * (loop.margins.gain_frequency or 0.0))
    low = above_zero(settings, "move.lowest") or middle / 10.0
    high = above_zero(settings, "move.highest") or min(far, 0.9 * model.nyquist)
    if high > model.nyquist:
        raise SimulationError(
            f"move.highest is {value_text(high)} Hz; the control samples the position often enough for"
            f" {value_text(model.nyquist)} Hz at most",
            "move.highest",
        )
    if not low < high:
        raise SimulationError(
            f"move.lowest is {value_text(low)} Hz; it must be below {value_text(high)} Hz", "move.lowest"
        )
    return low, high, _points(settings)


def _points(settings: ScenarioSettings) -> int:
    """Return the number of frequencies; raises SimulationError."""
    points = above_zero(settings, "move.points") or float(POINTS)
    if not (points.is_integer() and 2 <= points <= MAX_POINTS):
        raise SimulationError(
            f"move.points is {value_text(points)}; it must be a whole number from 2 to {MAX_POINTS}",
            "move.points",
        )
    return int(points)


def _known(loop: _Loop, low: float, high: float) -> list[float]:
    """Return the frequencies at which the figures are read, and two beside each."""
    figures = (loop.bandwidth, loop.margins.phase_frequency, loop.margins.gain_frequency)
    places = [f for f in figures if f is not None]
    near = [f * factor for f in places for factor in (0.94, 1.0, 1.06)]
    return [f for f in near if low < f < high]


def _frequencies(low: float, high: float, points: int, curve: Series) -> npt.NDArray[np.int64]:
    """Return the indices of the swept frequencies in the curve: evenly spaced, and those of the figures."""
    # A hair lower, so that rounding skips no point of the curve.
    even = np.searchsorted(curve, np.geomspace(low, high, points) * (1.0 - 1e-12))
    own = np.flatnonzero(~np.isin(curve, np.geomspace(low, high, CURVE)))
    return np.unique(np.concatenate([np.minimum(even, len(curve) - 1), own])).astype(np.int64)


# -- the result ----------------------------------------------------------------

_UNITS = {"frequency_hz": "Hz"} | {
    f"{loop}_{what}{source}": unit
    for loop in ("closed", "open", "velocity")
    for what, unit in (("gain_db", "dB"), ("phase_deg", "deg"))
    for source in ("", "_model")
}


def _measured(
    loop: _Loop, curve: Series, places: npt.NDArray[np.int64], settings: ScenarioSettings
) -> tuple[_Swept, tuple[Alarm, ...], str]:
    """Sweep the axis; return closed and open loop, an alarm that ended it, and how the open loop was
    found.
    """
    axis, model = loop.axis, loop.model
    tones = tones_of(axis, model, curve[places].tolist(), above_zero(settings, "move.amplitude"))
    first = last = sweep(axis, tones)
    note, sensed = "", first.measured
    if np.any(model.measured) and model.forwards_position():
        note = (
            "The open loop was not swept: the law takes its feed-forward from the commanded position itself."
        )
        sensed = np.full(len(tones), np.nan, dtype=np.complex128)
    elif not np.any(model.measured):
        note, sensed = _faster(loop, curve[places], sensed)
    elif model.forwards_velocity():
        note = "The open loop was swept with velocity and acceleration feed-forward off."
        last = sweep(axis, tones, feed_forward=False)
        sensed = last.measured
    closed, opened = (np.full(len(curve), np.nan, dtype=np.complex128) for _ in range(2))
    closed[places] = first.position
    known = np.isfinite(sensed)
    # From T = L / (1 + L); with feed-forward on, T would have a second way in.
    opened[places[known]] = sensed[known] / (1.0 - sensed[known])
    return _Swept(closed, opened), alarms_of(axis, first.motion) or alarms_of(axis, last.motion), note


def _faster(loop: _Loop, frequencies: Series, sensed: Response) -> tuple[str, Response]:
    """Return the swept answer of a loop in the motor's device, where the command goes to it as it is;
    else nothing.
    """
    if np.allclose(loop.model.follows(frequencies), loop.cut.feedback(frequencies), rtol=2e-2):
        return "", sensed
    return (
        (
            "The open loop was not swept: the law closes it with the motor's device and delays or smooths the"
            " command before it."
        ),
        np.full(len(frequencies), np.nan, dtype=np.complex128),
    )


def _columns(loop: _Loop, curve: Series, swept: _Swept) -> dict[str, Series]:
    """Return gain and phase of both loops, swept and by the model."""
    columns: dict[str, Series] = {"frequency_hz": curve}
    pairs = (
        ("closed", loop.model.follows(curve), swept.closed),
        ("open", loop.cut.loop(curve), swept.opened),
    )
    for name, linear, found in pairs:
        phase = np.degrees(np.unwrap(np.angle(linear)))
        # An unwrapped phase is open by whole turns: the lowest frequency is put between -270° and 90°.
        phase -= 360.0 * round((phase[0] + 90.0) / 360.0)
        known, apart = np.isfinite(found), np.full(len(curve), np.nan)
        # The sweep is unwrapped by the model: its own points are too far apart to count turns.
        apart[known] = np.degrees(np.angle(found[known] / linear[known]))
        columns[f"{name}_gain_db_model"], columns[f"{name}_phase_deg_model"] = _db(linear), phase
        columns[f"{name}_gain_db"], columns[f"{name}_phase_deg"] = _db(found), phase + apart
    if loop.inner is not None:
        inner = loop.inner.loop(np.minimum(curve, loop.inner.nyquist))
        columns["velocity_gain_db_model"] = _db(inner)
        columns["velocity_phase_deg_model"] = np.degrees(np.unwrap(np.angle(inner)))
    return columns


def _db(response: Response) -> Series:
    return np.asarray(20.0 * np.log10(np.maximum(np.abs(response), 1e-12)))


def _figures(loop: _Loop, curve: Series, swept: _Swept) -> dict[str, Figure]:
    """Return the named figures; the margins are those of the loop that is unstable,
    where the velocity loop is.
    """
    inside = loop.inner.margins() if loop.inner else None
    # The margins of a position loop mean nothing while the loop inside of it runs away.
    margins = loop.margins if loop.model.is_stable_inside() or inside is None else inside
    inertias = stable_inertias(loop.axis) if loop.stable else None
    peak = float(_db(loop.model.follows(loop.model.grid())).max())
    return {
        "bandwidth": (loop.bandwidth if loop.stable else None, "Hz"),
        "swept_bandwidth": (_falls(curve, np.abs(swept.closed), math.sqrt(0.5)), "Hz"),
        "phase_margin": (margins.phase, "deg"),
        "phase_margin_frequency": (margins.phase_frequency, "Hz"),
        "swept_phase_margin": (_swept_phase(curve, swept.opened), "deg"),
        "gain_margin": (margins.gain, "dB"),
        "gain_margin_frequency": (margins.gain_frequency, "Hz"),
        "swept_gain_margin": (_swept_gain(swept.opened), "dB"),
        "Ms": (loop.cut.sensitivity()[0] if loop.stable else None, ""),
        "Ms_frequency": (loop.cut.sensitivity()[1] if loop.stable else None, "Hz"),
        "resonance_peak": (peak if loop.stable and peak > _MIN_PEAK else None, "dB"),
        "damping_ratio": (loop.damping, ""),
        "least_damping_ratio": (loop.model.least_damping(), ""),
        "least_stable_inertia": (inertias[0] if inertias else None, ""),
        "most_stable_inertia": (inertias[1] if inertias else None, ""),
        **_of_velocity_loop(loop, inside),
    }


def _of_velocity_loop(loop: _Loop, inside: Margins | None) -> dict[str, Figure]:
    """Return the figures of the velocity loop; None for each where the control closes none."""
    phase, gain, bandwidth = (inside.phase, inside.gain, inside.phase_frequency) if inside else (None,) * 3
    return {
        "velocity_loop_Ms": (loop.inner.sensitivity()[0] if loop.inner and loop.stable else None, ""),
        "velocity_loop_phase_margin": (phase, "deg"),
        "velocity_loop_gain_margin": (gain, "dB"),
        "velocity_loop_bandwidth": (bandwidth, "Hz"),
    }


def _difference(axis: AxisLaw, result: Mapping[str, Figure]) -> str:
    """Return why the sweep has another bandwidth than the linear model; empty where both have the same
    one.
    """
    swept, model, machine = result["swept_bandwidth"][0], result["bandwidth"][0], axis.machine
    if swept is None or model is None or abs(swept / model - 1.0) < _MIN_DIFFERENCE:
        return ""
    parts = {
        "dry friction": machine.coulomb_friction or machine.static_friction,
        "backlash": machine.backlash,
        "counts": machine.motor_count or machine.position_count,
    }
    present = [name for name, amount in parts.items() if amount]
    return (
        f"The sweep has another bandwidth than the linear model ({value_text(swept)} and "
        f"{value_text(model)} Hz): it"
        f" contains {', '.join([*present, 'limits'])} and what the control itself does not do in proportion."
    )


def _unstable(loop: _Loop) -> str:
    """Return how the loop is unstable, and by how much."""
    inside = loop.inner if loop.inner and not loop.model.is_stable_inside() else None
    margins = inside.margins() if inside else loop.margins
    pole = complex(loop.model.poles()[0])
    rate = math.log(abs(pole)) / loop.model.period
    swing = abs(np.angle(pole).item()) / (2.0 * math.pi * loop.model.period)
    grows = (
        f"an oscillation of {value_text(swing, 'Hz', 3)}" if swing > 1e-6 else "a motion without oscillation"
    )
    double = f"doubles every {value_text(math.log(2.0) / rate, 's', 3)}" if rate > 1e-9 else "never dies away"
    by = (
        f"; the gain is {value_text(-margins.gain, 'dB', 3)} too high"
        if margins.gain and margins.gain < 0.0
        else ""
    )
    return (
        f"The {'velocity' if inside else 'position'} loop is not stable: {grows} {double}{by}. It was not"
        f" swept.{' ' if loop.axis.undamped else ''}{loop.axis.undamped}"
    )


def _falls(curve: Series, size: Series, level: float) -> float | None:
    """Return where a swept amplitude falls below a level, between the two frequencies around it."""
    known = np.isfinite(size)
    # Over logarithms a falling amplitude is nearly straight.
    f, y = np.log(curve[known]), np.log(np.maximum(size[known], 1e-12))
    below = np.flatnonzero(y < math.log(level))
    if not below.size or below[0] == 0:
        return None
    n = int(below[0])
    # interp needs rising values, and the amplitude falls: both with a minus.
    return math.exp(float(np.interp(-math.log(level), -y[[n - 1, n]], f[[n - 1, n]])))


def _swept_phase(curve: Series, opened: Response) -> float | None:
    """Return the phase margin of the swept loop in deg; None where it never has the gain 1."""
    known = np.isfinite(opened)
    at = _falls(curve, np.abs(opened), 1.0)
    if at is None:
        return None
    phase = np.unwrap(np.angle(opened[known]))
    return (math.degrees(float(np.interp(math.log(at), np.log(curve[known]), phase))) + 360.0) % 360.0 - 180.0


def _swept_gain(opened: Response) -> float | None:
    """Return the gain margin of the swept loop in dB; None where it does not cross the negative axis."""
    known = np.isfinite(opened)
    response = opened[known]
    # From below alone: there the phase falls through -180°.
    turn = np.flatnonzero((response.imag[:-1] < 0.0) & (response.imag[1:] >= 0.0) & (response.real[1:] < 0.0))
    if not turn.size:
        return None
    n = int(turn[0])
    share = -response.imag[n] / (response.imag[n + 1] - response.imag[n])
    size = np.log(np.abs(response[[n, n + 1]]))
    return -20.0 / math.log(10.0) * float(size[0] + share * (size[1] - size[0]))


SCENARIO = Scenario(
    "frequency",
    "Swept sine beside the linear model: bandwidth and margins",
    _SETTINGS,
    run_frequency,
    checked=("bandwidth", "phase_margin", "gain_margin"),
)
