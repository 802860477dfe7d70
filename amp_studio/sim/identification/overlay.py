"""The record of a machine laid over a simulated move: shifted to where both agree best,
with the difference and its root mean square.

The lag is sought by the correlation of the first signal that both have (command, position, velocity,
following error, torque), to a part of a row by a parabola (C. Knapp, G. Carter, IEEE Transactions on
Acoustics, Speech, and Signal Processing 24, 1976). A record that is much coarser than the simulation, as the
readings of a control, is compared at its readings alone: nothing is known between two of them.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from amp_studio.schema import UnitError, canonical, dimension, unit_named
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace

from .recording import MIN_ROWS, SIGNALS, SignalRecord, Trigger, read_recording

MAX_ROWS = 20_000
"""Rows in which the lag is sought; longer traces are thinned for it."""
_COARSE = 8.0
"""Rows of the simulation from one of the record to the next, from which it is compared at its readings
alone.
"""
_SECONDS = {"s": 1.0, "min": 60.0}
_TRIED = 2000
"""Lags that are tried of a coarse record."""


def _channels_of(recording: SignalRecord, trace: Trace) -> dict[str, Series]:
    """Return the signals of a recording that the trace has too, in its units; raises SimulationError."""
    found = {
        signal: values
        * unit_factor(recording.name, signal, recording.units.get(signal, ""), trace.units[signal])
        for signal, values in recording.signals.items()
        if signal in trace.columns
    }
    if not found:
        signals = ", ".join(filter(trace.columns.__contains__, SIGNALS))
        raise SimulationError(
            f"{recording.name}: it needs a column of time and one of {signals}, with their units"
        )
    return found


def unit_factor(name: str, signal: str, unit: str, wanted: str) -> float:
    """Return how much of the trace's unit one of the record's is;
    a column without a unit is in that of the trace.
    """
    if unit in ("", wanted):
        return 1.0
    (way, _, time), (wanted_way, _, wanted_time) = unit.rpartition("/"), wanted.rpartition("/")
    if way and way == wanted_way and {time, wanted_time} <= _SECONDS.keys():  # counts are no unit of ours
        return _SECONDS[wanted_time] / _SECONDS[time]
    try:
        own, theirs = unit_named(unit), unit_named(wanted)
        if dimension(own) == dimension(theirs):
            return canonical(1.0, own) / canonical(1.0, theirs)
    except UnitError:
        pass
    raise SimulationError(
        f"{name}: {signal.replace('_', ' ')} is in {unit[:20]}, and the simulation has it in {wanted}"
    )


def laid_over(trace: Trace, record: Path | SignalRecord, trigger: Trigger | None = None) -> Trace:
    """Return a trace with the signals of a record (``recorded_…``) and the differences (``difference_…``,
    record less simulation).

    With a trigger both are laid over each other where their signal passes its level; else by the best lag.
    Raises SimulationError for a record that does not fit, OSError where it cannot be read.
    """
    recording = record if isinstance(record, SignalRecord) else read_recording(record)
    name, time, signals = recording.name, recording.time, _channels_of(recording, trace)
    if len(time) < MIN_ROWS:
        raise SimulationError(f"{name}: {len(time)} rows are too few: at least {MIN_ROWS}")
    here = trace.columns["time_s"]
    first = next(iter(each for each in SIGNALS if each in signals))
    is_coarse = float(np.median(np.diff(time))) > _COARSE * float(np.median(np.diff(here)))
    if trigger is None:
        seek = _lag_of_readings if is_coarse else _lag
        lag = seek(here, trace.columns[first], time, signals[first])
    else:
        first = trigger.signal
        kept, there = replace(recording, signals=signals).triggered(trigger)
        lag = there - trigger.time("The simulation", here, trace.columns[first])
        time, signals = kept.time, dict(kept.signals)
    columns, units, result = dict(trace.columns), dict(trace.units), dict[str, Figure]()
    for signal, values in signals.items():
        over = _readings if is_coarse else _rows
        laid, off = over(here, trace.columns[signal], time - lag, values)
        if not np.isfinite(off).any():
            continue
        columns[f"recorded_{signal}"], columns[f"difference_{signal}"] = laid, off
        units[f"recorded_{signal}"] = units[f"difference_{signal}"] = unit = trace.units[signal]
        result[f"difference_rms_{signal}"] = float(np.sqrt(np.nanmean(off**2))), unit
        result[f"difference_peak_{signal}"] = float(np.nanmax(np.abs(off))), unit
    if not result:
        raise SimulationError(f"{name}: the record and the simulated move do not overlap")
    note = (
        f"The record was laid over the simulation by its {first.replace('_', ' ')}: 0 s of the simulation is"
        f" {lag:.6g} s of the record."
    )
    found = {**trace.result, "record_lag": (lag, "s"), **result}
    return replace(trace, columns=columns, units=units, result=found, assumptions=(note, *trace.assumptions))


def _rows(here: Series, simulated: Series, time: Series, values: Series) -> tuple[Series, Series]:
    """Return a record, and how much more it is, in the rows of the simulation; NaN where it is not there."""
    laid = np.interp(here, time, values, left=np.nan, right=np.nan)
    return laid, laid - simulated


def _readings(here: Series, simulated: Series, time: Series, values: Series) -> tuple[Series, Series]:
    """Return the same of single readings, each in the row of the simulation that is nearest to it."""
    laid, off = np.full(len(here), np.nan), np.full(len(here), np.nan)
    inside = (time >= here[0]) & (time <= here[-1])
    after = np.clip(np.searchsorted(here, time[inside]), 1, len(here) - 1)
    nearest = np.where(time[inside] - here[after - 1] < here[after] - time[inside], after - 1, after)
    laid[nearest] = values[inside]
    off[nearest] = values[inside] - np.interp(time[inside], here, simulated)
    return laid, off


def _lag(here: Series, simulated: Series, time: Series, recorded: Series) -> float:
    """Return the time of the record at which the simulation begins."""
    step = max(float(np.median(np.diff(time))), float(here[-1] + time[-1]) / MAX_ROWS)
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


def _lag_of_readings(here: Series, simulated: Series, time: Series, recorded: Series) -> float:
    """Return the same of single readings: where they differ least from the simulation, which rests before and
    after the move; a different zero is none.
    """

    def left(lag: float) -> float:
        return float(np.var(recorded - np.interp(time - lag, here, simulated)))

    lags = np.linspace(-float(here[-1]), float(time[-1]), _TRIED)
    best = min(lags, key=left)
    width = float(lags[1] - lags[0])
    while width > 1e-6:  # by halves: the sum is smooth within the distance of two lags
        best = min((best - 0.5 * width, best, best + 0.5 * width), key=left)
        width *= 0.5
    return float(best)
