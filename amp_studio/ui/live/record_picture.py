"""What a record of Live is drawn as: its signals over time, the simulation under them, and the move that it
shows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from amp_studio.drawing import Curve, NamedPlace, Picture, Scene, linked, panel_of
from amp_studio.files import ParameterFile
from amp_studio.schema import UnitError, convert
from amp_studio.sim import SignalRecord, SimulationError, Trace, unit_factor
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.translated import tr, unit_in_words

SIGNALS = ("following_error", "position", "velocity")
"""In the order in which they are drawn, the first above."""
_SPARSE = 50.0
"""Readings in a second below which they are dots: nothing is known between them."""
_FAR = 1.6
"""A limit below this multiple of the largest error is drawn."""


def move_of(file: ParameterFile, record: SignalRecord) -> tuple[SignalRecord, dict[str, float | str], str]:
    """Return a record with its position counted from its beginning, and the settings of the move that it
    shows, in words too; raises SimulationError where the axis did not move.
    """
    position = record.signals.get("position")
    if position is None or float(np.ptp(position)) == 0.0:
        raise SimulationError(tr("The axis did not move: nothing is simulated."))
    unit = record.units.get("position", "")
    distance = float(position[-1] - position[0])
    speeds = record.signals.get("velocity")
    if speeds is None or not float(np.max(np.abs(speeds))):
        speeds = np.diff(position) / np.diff(record.time)
    feed = 60.0 * float(np.max(np.abs(speeds)))
    system = file.schema.family.units.get(file.header.units, {})
    wanted = system.get("length", unit)
    try:
        factor = convert(1.0, unit, wanted) if unit not in ("", "counts", wanted) else 1.0
    except UnitError:
        factor = 1.0
    way = f"{written(f'{distance:.5g}')} {unit_in_words(unit)}"
    words = tr("simulated: {distance} at {feed}/min, as recorded").format(
        distance=way, feed=f"{written(f'{feed:.5g}')} {unit_in_words(unit)}"
    )
    zeroed = replace(record, signals={**record.signals, "position": position - position[0]})
    return zeroed, {"move.distance": distance * factor, "move.feedrate": feed * factor}, words


def signals_of(record: SignalRecord) -> list[str]:
    """Return the signals of a record in the order in which they are drawn."""
    return [each for each in SIGNALS if each in record.signals]


def record_picture(record: SignalRecord, fired: float | None, trace: Trace | None = None) -> Picture:
    """Return a record over its time, with its trigger, and the simulation under it shifted to fit."""
    marks = (NamedPlace(tr("trigger"), fired),) if fired else ()
    return Picture("", (), linked([_panel(record, signal, marks, trace) for signal in signals_of(record)]))


def _panel(record: SignalRecord, signal: str, marks: tuple[NamedPlace, ...], trace: Trace | None) -> Scene:
    time, values, unit = record.time, record.signals[signal], record.units.get(signal, "")
    sparse = len(time) - 2 < _SPARSE * float(time[-1] - time[0])
    curves = [Curve(tr("machine"), time, values, "now", dots=sparse)]
    levels: list[NamedPlace] = []
    if trace is not None and f"recorded_{signal}" in trace.columns:
        factor = unit_factor(record.name, signal, unit, trace.units[signal])
        zero = float(values[0]) if signal == "position" else 0.0
        lag = trace.result["record_lag"][0] or 0.0
        here = trace.columns["time_s"] + lag
        seen = (here >= time[0]) & (here <= time[-1])
        under = trace.columns[signal][seen] / factor + zero
        curves.insert(0, Curve(tr("simulated"), here[seen], under, "before"))
        if signal == "following_error":
            levels = _levels(trace, float(np.max(np.abs(values))) * factor, factor)
    return panel_of(signal.replace("_", " "), curves, ("time", "s"), unit, marks=marks, levels=levels)


def _levels(trace: Trace, most: float, factor: float) -> list[NamedPlace]:
    """Return the limits of the error that are near it, on both sides."""
    near = {name: level for name, (level, _) in trace.limits.items() if level and level <= _FAR * most}
    return [
        NamedPlace(name.replace("_", " ") if sign > 0.0 else "", sign * level / factor)
        for name, level in near.items()
        for sign in (1.0, -1.0)
    ]
