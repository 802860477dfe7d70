"""The record of a machine laid over a simulated move: shifted to where both agree best,
with the difference and its root mean square.

The lag is sought by the correlation of the first signal that both have (command, position, velocity,
following error, torque), to a part of a row by a parabola (C. Knapp, G. Carter, IEEE Transactions on
Acoustics, Speech, and Signal Processing 24, 1976).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from amp_studio.files import text_of_name
from amp_studio.schema import UnitError, canonical, dimension, read_table_text, unit_named
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace

from .drive_record import named_columns, read_number_table, seconds_of

SIGNALS = {
    "command_position": "command( position)?|(position )?(command|setpoint)|commanded position|sollposition",
    "position": "position|pos|(actual|measured|axis) (position|pos)|istposition",
    "velocity": "velocity|speed|(actual|measured|axis) (velocity|speed)|istgeschwindigkeit",
    "following_error": "following error|position error|error|schleppfehler",
    "torque": "torque|current|(actual|measured|motor) (torque|current)|iq|istmoment",
}
"""Signal of a trace -> names of its column in a record."""
_TIME = "time|t|zeit"
LEAST_ROWS = 20
MOST_ROWS = 20_000
"""Rows in which the lag is sought; longer traces are thinned for it."""


def read_channels(path: Path, trace: Trace) -> tuple[Series, dict[str, Series]]:
    """Return time in s and the signals of a record that the trace has too, in its units;
    raises SimulationError, OSError.
    """
    name, text = text_of_name(path.name), read_table_text(path)
    places = named_columns(text, {"time": _TIME, **SIGNALS})
    known = {signal: place for signal, place in places.items() if signal in trace.columns}
    if "time" not in places or not known:
        signals = ", ".join(filter(trace.columns.__contains__, SIGNALS))
        raise SimulationError(f"{name}: it needs a column of time and one of {signals}, with their units")
    columns = read_number_table(text, [place for place, _ in (places["time"], *known.values())])
    if len(columns[0]) < LEAST_ROWS:
        raise SimulationError(f"{name}: {len(columns[0])} rows are too few: at least {LEAST_ROWS}")
    time = columns[0] * seconds_of(name, places["time"][1])
    if not (np.diff(time) > 0.0).all():
        raise SimulationError(f"{name}: its time does not rise from row to row")
    return time - time[0], {
        signal: column * _factor(name, signal, unit, trace.units[signal])
        for (signal, (_, unit)), column in zip(known.items(), columns[1:], strict=True)
    }


def _factor(name: str, signal: str, unit: str, wanted: str) -> float:
    """Return how much of the trace's unit one of the record's is;
    a column without a unit is in that of the trace.
    """
    if unit in ("", wanted):
        return 1.0
    try:
        own, theirs = unit_named(unit), unit_named(wanted)
        if dimension(own) == dimension(theirs):
            return canonical(1.0, own) / canonical(1.0, theirs)
    except UnitError:
        pass
    raise SimulationError(
        f"{name}: {signal.replace('_', ' ')} is in {unit[:20]}, and the simulation has it in {wanted}"
    )


@dataclass(frozen=True)
class Trigger:
    """Where a record begins, as at an oscilloscope: its signal passes a level (edge) or is at it (level)."""

    signal: str
    rising: bool
    level: float
    """In the unit of the trace."""
    before: float = 0.0
    """s of the record that are kept ahead of it; the rest is cut off."""
    is_level: bool = False
    """A signal that is at the level or beyond it in its first row, fires there: no edge is waited for."""

    def time(self, name: str, time: Series, values: Series) -> float:
        """Return when a signal passes the level first, between two rows on a line, or where it is there from
        its first row; ``name`` is who has it.
        """
        excess = values - self.level if self.rising else self.level - values
        above = excess >= 0.0 if self.is_level else excess > 0.0
        if self.is_level and above[0]:
            return float(time[0])
        passes = np.flatnonzero(above[1:] & ~above[:-1])
        if not passes.size:
            way = "above" if self.rising else "below"
            raise SimulationError(
                f"{name}: its {self.signal.replace('_', ' ')} never goes {way} {self.level:g}, where the"
                f" trigger is; it is between {values.min():g} and {values.max():g}"
            )
        n = int(passes[0])
        share = (self.level - values[n]) / (values[n + 1] - values[n])
        return float(time[n] + share * (time[n + 1] - time[n]))


def trigger_of(text: str, before: float = 0.0) -> Trigger:
    """Return a trigger as it is written, ``velocity>100`` (edge) or ``velocity>=100`` (level), in the unit
    of the trace; raises SimulationError.
    """
    match = re.fullmatch(r"\s*([a-z _]+?)\s*([<>])(=?)\s*([+-]?[0-9]*[.,]?[0-9]+)\s*", text)
    signal = match[1].replace(" ", "_") if match else ""
    if match is None or signal not in SIGNALS:
        known = ", ".join(SIGNALS)
        raise SimulationError(
            f"'{text[:40]}' is no trigger: velocity>100 or velocity>=100, with one of {known}"
        )
    if before < 0.0:
        raise SimulationError(f"{before:g} s ahead of the trigger: it must be 0 or more")
    return Trigger(signal, match[2] == ">", float(match[4].replace(",", ".")), before, match[3] == "=")


def laid_over(trace: Trace, path: Path, trigger: Trigger | None = None) -> Trace:
    """Return a trace with the signals of a record (``recorded_…``) and the differences (``difference_…``,
    record less simulation).

    With a trigger both are laid over each other where their signal passes its level; else by the best lag.
    Raises SimulationError for a record that does not fit, OSError where it cannot be read.
    """
    time, signals = read_channels(path, trace)
    here = trace.columns["time_s"]
    first = next(iter(each for each in SIGNALS if each in signals))
    if trigger is None:
        lag = _lag(here, trace.columns[first], time, signals[first])
    else:
        first, name = trigger.signal, text_of_name(path.name)
        if first not in signals:
            raise SimulationError(f"{name}: it has no {first.replace('_', ' ')} for the trigger")
        there = trigger.time(name, time, signals[first])
        lag = there - trigger.time("The simulation", here, trace.columns[first])
        kept = time >= there - trigger.before
        time, signals = time[kept], {signal: values[kept] for signal, values in signals.items()}
    columns, units, result = dict(trace.columns), dict(trace.units), dict[str, Figure]()
    for signal, values in signals.items():
        laid = np.interp(here + lag, time, values, left=np.nan, right=np.nan)
        off = laid - trace.columns[signal]
        if not np.isfinite(off).any():
            continue
        columns[f"recorded_{signal}"], columns[f"difference_{signal}"] = laid, off
        units[f"recorded_{signal}"] = units[f"difference_{signal}"] = unit = trace.units[signal]
        result[f"difference_rms_{signal}"] = float(np.sqrt(np.nanmean(off**2))), unit
        result[f"difference_peak_{signal}"] = float(np.nanmax(np.abs(off))), unit
    if not result:
        raise SimulationError(f"{text_of_name(path.name)}: the record and the simulated move do not overlap")
    note = (
        f"The record was laid over the simulation by its {first.replace('_', ' ')}: 0 s of the simulation is"
        f" {lag:.6g} s of the record."
    )
    found = {**trace.result, "record_lag": (lag, "s"), **result}
    return replace(trace, columns=columns, units=units, result=found, assumptions=(note, *trace.assumptions))


def _lag(here: Series, simulated: Series, time: Series, recorded: Series) -> float:
    """Return the time of the record at which the simulation begins."""
    step = max(float(np.median(np.diff(time))), float(here[-1] + time[-1]) / MOST_ROWS)
    one = np.interp(np.arange(0.0, here[-1] + step, step), here, simulated)
    two = np.interp(np.arange(0.0, time[-1] + step, step), time, recorded)
    one, two = np.diff(one), np.diff(two)  # changes: a different zero of the position is none
    # Long enough for both, so that the circular correlation does not overlap itself.
    size = 1 << (len(one) + len(two)).bit_length()
    product = np.fft.irfft(np.fft.rfft(two, size) * np.conj(np.fft.rfft(one, size)), size)
    # Lags of both signs: a negative one is found at the end of the circle.
    places = np.concatenate([np.arange(len(two)), np.arange(-len(one) + 1, 0)])
    best = int(places[int(np.argmax(product[places]))])
    # The lag before the first one is at the end, the one after -1 at the beginning.
    low, middle, high = product[best - 1], product[best], product[(best + 1) % size]
    bend = low - 2.0 * middle + high
    return float(step * (best + (0.5 * (low - high) / bend if bend < 0.0 else 0.0)))
