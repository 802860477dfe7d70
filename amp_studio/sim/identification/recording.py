"""A recording of a machine: a few signals over the time, read from a table or gathered from a control reading
by reading, with a trigger and what is kept ahead of it.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from amp_studio.files import text_of_name, write_atomic
from amp_studio.schema import read_table_text
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Series

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
MIN_ROWS = 20
_MAX_READINGS = 100_000


@dataclass(frozen=True, eq=False)
class SignalRecord:
    """Signals (of SIGNALS) over the time in s, which rises; a signal without a unit has that of the trace."""

    name: str
    time: Series
    signals: Mapping[str, Series]
    units: Mapping[str, str]

    @property
    def rate(self) -> float:
        """Rows in a second, by the median of their distances."""
        return 1.0 / float(np.median(np.diff(self.time)))

    def triggered(self, trigger: Trigger) -> tuple[SignalRecord, float]:
        """Return it from what is kept ahead of a trigger on, and when that fires; raises SimulationError."""
        if trigger.signal not in self.signals:
            raise SimulationError(
                f"{self.name}: it has no {trigger.signal.replace('_', ' ')} for the trigger"
            )
        there = trigger.time(self.name, self.time, self.signals[trigger.signal])
        kept = self.time >= there - trigger.before
        signals = {signal: values[kept] for signal, values in self.signals.items()}
        return replace(self, time=self.time[kept], signals=signals), there


def read_recording(path: Path) -> SignalRecord:
    """Return the recording in a table with a head of time and signals; raises SimulationError, OSError."""
    name, text = text_of_name(path.name), read_table_text(path)
    places = named_columns(text, {"time": _TIME, **SIGNALS})
    known = [signal for signal in places if signal in SIGNALS]
    if "time" not in places or not known:
        raise SimulationError(
            f"{name}: it needs a column of time and one of {', '.join(SIGNALS)}, with their units"
        )
    columns = read_number_table(text, [places[each][0] for each in ("time", *known)])
    if len(columns[0]) < MIN_ROWS:
        raise SimulationError(f"{name}: {len(columns[0])} rows are too few: at least {MIN_ROWS}")
    time = columns[0] * seconds_of(name, places["time"][1])
    if not (np.diff(time) > 0.0).all():
        raise SimulationError(f"{name}: its time does not rise from row to row")
    units = {signal: places[signal][1] for signal in known}
    return SignalRecord(name, time - time[0], dict(zip(known, columns[1:], strict=True)), units)


def write_recording(recording: SignalRecord, path: Path) -> None:
    """Write a recording as the table that `read_recording` reads; raises SaveError."""
    heads = ["time (s)"]
    for signal in recording.signals:
        unit = recording.units.get(signal, "")
        heads.append(signal.replace("_", " ") + (f" ({unit})" if unit else ""))
    rows = zip(recording.time.tolist(), *(each.tolist() for each in recording.signals.values()), strict=True)
    lines = [",".join(heads), *(",".join(map(repr, row)) for row in rows)]
    write_atomic(path, ("\n".join(lines) + "\n").encode())


@dataclass(frozen=True)
class Trigger:
    """Where a record begins, as at an oscilloscope: its signal passes a level (edge) or is at it (level)."""

    signal: str
    rising: bool
    level: float
    """In the unit of the trace, or of the control that is read."""
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

    def __str__(self) -> str:
        """The trigger as `trigger_of` reads it."""
        comparison = (">" if self.rising else "<") + ("=" if self.is_level else "")
        return f"{self.signal.replace('_', ' ')} {comparison} {self.level:g}"


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


@dataclass
class LiveRecorder:
    """Gathers the readings of a control: waits for its trigger, keeps what came ahead of it, ends by itself.

    A reading is where it was taken; nothing is put between two of them.
    """

    trigger: Trigger | None = None
    span: float | None = None
    """s after the trigger, or the first reading, at which it ends; None to be stopped."""
    by_event: bool = False
    """Whether it waits for ``fire`` in the place of a trigger."""
    before: float = 0.0
    """s that are kept ahead of that."""
    units: dict[str, str] = field(default_factory=dict)
    has_fired: bool = False
    is_done: bool = False
    _rows: deque[tuple[float, dict[str, float]]] = field(default_factory=deque)
    _fired: float = 0.0

    def add(self, time: float, figures: Mapping[str, tuple[float | None, str]]) -> None:
        """Take a reading at a time in s, which rises: signal -> figure and unit; None for what is not shown.

        Raises SimulationError where it does not show the signal of the trigger.
        """
        if self.is_done or (self._rows and time <= self._rows[-1][0]):
            return
        known = {signal: float(value) for signal, (value, _) in figures.items() if value is not None}
        if self.trigger is not None and self.trigger.signal not in known:
            raise SimulationError(
                f"The control shows no {self.trigger.signal.replace('_', ' ')} for the trigger: it has"
                f" {', '.join(known).replace('_', ' ') or 'none'}"
            )
        self.units |= {signal: figures[signal][1] for signal in known}
        self._rows.append((time, known))
        if not self.has_fired:
            self._wait(time)
        if self.has_fired:
            passed = self.span is not None and time - self._fired >= self.span
            self.is_done = passed or len(self._rows) >= _MAX_READINGS

    def _wait(self, time: float) -> None:
        """Fire, or leave out what is longer ago than is kept ahead of the trigger."""
        trigger = self.trigger
        if trigger is None and not self.by_event:
            self.fire(time)
            return
        if trigger is not None and self._passes(trigger):
            self.fire(time)
        before = self.before if trigger is None else trigger.before
        # The reading ahead of what is kept stays: it shows where the signal came from.
        while len(self._rows) > 2 and self._rows[1][0] < time - before - 1e-9:
            self._rows.popleft()

    def _passes(self, trigger: Trigger) -> bool:
        """Return whether the last reading is where a trigger fires."""
        values = [row[trigger.signal] for _, row in list(self._rows)[-2:]]
        beyond = [(value - trigger.level if trigger.rising else trigger.level - value) for value in values]
        is_there = [each >= 0.0 if trigger.is_level else each > 0.0 for each in beyond]
        return is_there[-1] and (trigger.is_level or (len(is_there) > 1 and not is_there[0]))

    def fire(self, time: float) -> None:
        """Begin to keep everything: what was waited for has come at a time in s."""
        if not self.has_fired:
            self.has_fired, self._fired = True, time

    @property
    def fired_after(self) -> float | None:
        """When it fired, in s from the first reading that is kept; None before that."""
        return self._fired - self._rows[0][0] if self.has_fired and self._rows else None

    @property
    def count(self) -> int:
        """How many readings there are."""
        return len(self._rows)

    def recording(self, name: str) -> SignalRecord:
        """Return what was read, from its first reading on, with the signals that every reading has; raises
        SimulationError for less than two readings.
        """
        if len(self._rows) < 2:
            raise SimulationError(f"{name}: {len(self._rows)} readings are no recording")
        names = [each for each in SIGNALS if all(each in row for _, row in self._rows)]
        time = np.array([at for at, _ in self._rows])
        signals = {each: np.array([row[each] for _, row in self._rows]) for each in names}
        return SignalRecord(name, time - time[0], signals, {each: self.units.get(each, "") for each in names})
