"""The open position loop as a Nyquist or a Nichols chart, the sensitivity over the frequency below it.

Both charts have the area that a sound loop stays out of: the points nearer to -1 than 1 / Ms (K. J. Åström,
T. Hägglund, Advanced PID Control, 2006, 4.6).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from amp_studio.drawing import Curve, Dot, NamedPlace, Picture, Scale, Scene, ShapeSort, panel_of

from .rounding import value_text
from .series import Response, Series
from .trace import Trace
from .tuning.loops import SOUND

_NYQUIST_SIDE, _NYQUIST_CENTRE = 1.6, (-0.6, -0.4)
"""Half a side of the part of the plane around -1 that is drawn: farther out a loop is of no interest."""
_NICHOLS_GAIN, _NICHOLS_PHASE = (-40.0, 40.0), (-360.0, 0.0)
_MIN_SENSITIVITY = -30.0
"""dB below which it is drawn flat: the scale is for the peak."""
_ROUND = 181
"""Points of a circle."""
_EMPTY = ""

Along = Callable[[Response], tuple[Series, Series]]
"""Returns where points of the loop are in a chart."""


def nyquist(trace: Trace, before: Trace | None) -> Picture:
    """Return the loop in the complex plane."""
    (x, y), side = _NYQUIST_CENTRE, _NYQUIST_SIDE
    circle = np.exp(1j * np.linspace(0.0, 2.0 * math.pi, _ROUND))
    across = Scale("real part", _EMPTY, x - side, x + side)
    up = Scale("imaginary part", _EMPTY, y - side, y + side)
    curves = (
        Curve("gain 1", circle.real, circle.imag, "dim", dashed=True),
        _sound(lambda loop: (loop.real, loop.imag)),
        *_loops(trace, before, lambda loop: (loop.real, loop.imag), across, up),
    )
    scene = Scene(
        "nyquist",
        _EMPTY,
        "imaginary part of the open loop",
        _EMPTY,
        across,
        up,
        equal=True,
        curves=curves,
        dots=(Dot((-1.0, 0.0), "point", "error"),),
        look="panel",
        share=4.0,
    )
    return Picture(_EMPTY, (), (_sensitivity(trace, before),), above=scene)


def nichols(trace: Trace, before: Trace | None) -> Picture:
    """Return the gain of the loop over its phase."""

    def along(loop: Response) -> tuple[Series, Series]:
        phase = np.degrees(np.unwrap(np.angle(loop)))
        # Near the highest gain a position loop has -90 deg: the turn in which it is drawn.
        phase -= 360.0 * np.round((phase[0] + 90.0) / 360.0) if phase.size else 0.0
        # The smallest addend keeps the logarithm finite where the loop is 0.
        return phase, 20.0 * np.log10(np.abs(loop) + 1e-300)

    def around(loop: Response) -> tuple[Series, Series]:
        # Not unwrapped: the whole area around -1 lies between -360 and 0 deg, the turn of the chart.
        return np.degrees(np.angle(loop)) % 360.0 - 360.0, 20.0 * np.log10(np.abs(loop) + 1e-300)

    across = Scale("phase", "deg", *_NICHOLS_PHASE, step=90.0)
    up = Scale(_EMPTY, "dB", *_NICHOLS_GAIN)
    scene = Scene(
        "nichols",
        _EMPTY,
        "gain of the open loop",
        _EMPTY,
        across,
        up,
        curves=(_sound(around), *_loops(trace, before, along, across, up)),
        levels=(NamedPlace(_EMPTY, 0.0),),
        marks=(NamedPlace("−180 deg", -180.0),),
        dots=(Dot((-180.0, 0.0), "point", "error"),),
        look="panel",
        share=3.5,
    )
    return Picture(_EMPTY, (), (_sensitivity(trace, before),), above=scene)


def _sound(along: Along) -> Curve:
    """Return the edge of the area that a sound loop stays out of."""
    edge = -1.0 + np.exp(1j * np.linspace(0.0, 2.0 * math.pi, _ROUND)) / SOUND.sensitivity
    return Curve(f"Ms {value_text(SOUND.sensitivity)}", *along(edge), "limit")


def _loops(trace: Trace, before: Trace | None, along: Along, x: Scale, y: Scale) -> Iterator[Curve]:
    if before is not None and "open_gain_db_model" in before.columns:
        yield from _inside(Curve("before", *along(_loop(before, "_model")[1]), "before"), x, y)
    yield from _inside(Curve("position loop", *along(_loop(trace, "_model")[1]), "now"), x, y)
    if "velocity_gain_db_model" in trace.columns:
        inner = _loop(trace, "_model", "velocity")[1]
        yield from _inside(Curve("velocity loop", *along(inner), "outside"), x, y)
    swept = _loop(trace, _EMPTY)[1]
    if swept.size:
        yield from _inside(Curve("position loop, swept", *along(swept), "output", dots=True), x, y)


def _inside(curve: Curve, x: Scale, y: Scale) -> Iterator[Curve]:
    """Yield the pieces of a curve inside of a chart: a drawing does not cut off what leaves it."""
    seen = (curve.x >= x.low) & (curve.x <= x.high) & (curve.y >= y.low) & (curve.y <= y.high)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], seen.astype(np.int8), [0]])))
    for n, (first, last) in enumerate(zip(edges[::2], edges[1::2], strict=True)):
        name = curve.name if n == 0 else _EMPTY  # one entry for all pieces
        yield replace(curve, name=name, x=curve.x[first:last], y=curve.y[first:last])


def _loop(trace: Trace, source: str, name: str = "open") -> tuple[Series, Response]:
    """Return the frequencies in Hz and an open loop, of the model or as it was swept."""
    gain, phase = trace.columns[f"{name}_gain_db{source}"], trace.columns[f"{name}_phase_deg{source}"]
    known = np.isfinite(gain) & np.isfinite(phase)
    loop = 10.0 ** (gain[known] / 20.0) * np.exp(1j * np.radians(phase[known]))
    return trace.columns["frequency_hz"][known], np.asarray(loop)


def _sensitivity(trace: Trace, before: Trace | None) -> Scene:
    """Return the size of 1 / (1 + L) over the frequency, with what a sound loop has at most."""
    curves = []
    sides: tuple[tuple[Trace | None, str, str, ShapeSort], ...] = (
        (before, "open", "before", "before"),
        (trace, "velocity", "velocity loop", "outside"),
        (trace, "open", "position loop", "now"),
    )
    for each, loop_name, words, sort in sides:
        if each is not None and f"{loop_name}_gain_db_model" in each.columns:
            frequency, loop = _loop(each, "_model", loop_name)
            # Minus, because it is the reciprocal in dB; where 1 + L is 0 the addend keeps it finite.
            size = np.maximum(-20.0 * np.log10(np.abs(1.0 + loop) + 1e-300), _MIN_SENSITIVITY)
            curves.append(Curve(words, frequency, size, sort))
    at = trace.result.get("Ms_frequency", (None, ""))[0]
    marks = () if at is None else (NamedPlace(f"Ms {value_text(at, 'Hz', 3)}", at),)
    level = NamedPlace(f"Ms {value_text(SOUND.sensitivity)}", 20.0 * math.log10(SOUND.sensitivity))
    along = ("frequency", "Hz")
    return panel_of("sensitivity", curves, along, "dB", levels=(level,), marks=marks, log=True, share=1.2)


_MAX_MS = 4.0
"""Where the scale of Ms ends: beyond it a loop is all but unstable."""


def tuned(trace: Trace) -> Picture:
    """Return what `tune` gives: how far a torque moves the load, and Ms over the inertia,
    with the present gains and with the recommended ones.
    """
    sides: tuple[tuple[str, str, ShapeSort], ...] = (
        ("before", "present", "before"),
        ("after", "recommended", "now"),
    )
    time, share = trace.columns["time_s"], trace.columns["inertia_share"]
    ways, robust = [], []
    for name, words, sort in sides:
        way, ms = trace.columns[f"load_way_{name}"], trace.columns[f"Ms_{name}"]
        known = np.isfinite(way)
        if known.any():
            ways.append(Curve(words, time[known], way[known], sort))
        # In pieces: a line through the inertias without a stable loop would show Ms where there is none.
        stable = np.isfinite(ms) & (ms < _MAX_MS)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], stable.astype(np.int8), [0]])))
        for n, (first, last) in enumerate(zip(edges[::2], edges[1::2], strict=True)):
            robust.append(Curve(words if n == 0 else _EMPTY, share[first:last], ms[first:last], sort))
    unit = trace.units["load_way_after"]
    push = panel_of("way of the load per torque", ways, ("time", "s"), unit, share=1.5)
    above = Scene(
        "robustness",
        _EMPTY,
        "Ms over the inertia",
        _EMPTY,
        Scale("inertia, 1 as it is taken to be", _EMPTY, float(share[0]), float(share[-1]), log=True),
        Scale(_EMPTY, _EMPTY, 1.0, _MAX_MS),
        curves=tuple(robust),
        levels=(NamedPlace(f"Ms {value_text(SOUND.sensitivity)}", SOUND.sensitivity),),
        marks=(NamedPlace(_EMPTY, 1.0),),
        look="panel",
        share=1.5,
    )
    return Picture(_EMPTY, (), (push,), above=above)
