"""What a live page has read of a control: the asking, the curves of each axis, and what has happened."""

from __future__ import annotations

import threading
import time
from collections import deque
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal

from amp_studio.drawing import Curve, Picture, Scene, panel_of
from amp_studio.ui.base.task import Task, TaskProgress

if TYPE_CHECKING:
    from amp_studio.transfer import ActiveFault, AxisStatus, ControlStatus

PERIOD = 0.2
"""s from one question to the next, at least."""
_KEPT = 150
"""Readings of an axis that stay in the picture: half a minute."""
_HISTORY = 50
"""Events that are remembered."""


class StatusReadings(QObject):
    """Asks a control for its status in a separate thread, until it is stopped; may outlast its page."""

    read = Signal(object, float)
    """A reading, and when the control had answered (s of the monotonic clock): a window that is busy takes it
    later.
    """
    failed = Signal(object)

    def __init__(self, address: str, family: str) -> None:
        super().__init__()
        self._address, self._family = address, family
        self._task: Task | None = None

    @property
    def is_running(self) -> bool:
        """Whether the control is being asked."""
        return self._task is not None

    def start(self) -> None:
        """Begin to ask."""
        if self._task is not None:
            return
        task = self._task = Task(self._ask)
        task.failed.connect(self._over)
        task.done.connect(self._over)  # a method: it is called in the window's thread
        task.begin()

    def stop(self) -> None:
        """Ask no more; the line is closed after the present answer."""
        if self._task is not None:
            self._task.cancelled.set()

    def _over(self, error: object) -> None:
        self._task = None
        self.failed.emit(error)

    def _ask(self, _progress: TaskProgress, cancelled: threading.Event) -> None:
        from contextlib import closing

        from amp_studio.transfer.client import StatusReader

        with closing(StatusReader(self._address, self._family)) as reader:
            while not cancelled.is_set():
                begun = time.monotonic()
                status = reader.read()
                self.read.emit(status, time.monotonic())
                # From question to question, so a slow line is asked without a pause but never faster than
                # this.
                cancelled.wait(max(PERIOD - (time.monotonic() - begun), 0.0))


@dataclass
class AxisReadings:
    """The last readings of one axis: (s, figure) of each signal that its control shows, by name."""

    unit: str = ""
    signals: dict[str, deque[tuple[float, float]]] = field(default_factory=dict)

    def add(self, now: float, axis: AxisStatus) -> None:
        """Add a reading at a time in s."""
        self.unit = axis.unit
        figures = {
            "following error": axis.following_error,
            "velocity": axis.velocity,
            "position": axis.position,
        }
        for name, value in figures.items():
            if value is not None:
                self.signals.setdefault(name, deque(maxlen=_KEPT)).append((now, value))

    def picture(self) -> Picture | None:
        """Return what the control shows as dots; nothing is known between two readings."""
        names = [each for each in ("following error", "position", "velocity") if each in self.signals]
        return Picture("", (), tuple(map(self._panel, names))) if names else None

    def _panel(self, name: str) -> Scene:
        x, y = np.array(self.signals[name]).T
        unit = f"{self.unit}/s" if name == "velocity" else self.unit
        return panel_of(name, (Curve("", x, y, "now", dots=True),), ("time", "s"), unit)


class EventReadings:
    """What has happened while it was looked, the last one first, and which faults are active."""

    def __init__(self) -> None:
        self.events: list[str] = []
        self.active: dict[tuple[str, str], tuple[ActiveFault, datetime]] = {}
        self._states: dict[str, set[str]] = {}

    def take(self, status: ControlStatus) -> bool:
        """Take a reading; returns whether a fault in it is new."""
        now = datetime.now(UTC).astimezone()
        self._compare("", {status.state} - {""}, now)
        for axis in status.axes:
            self._compare(axis.axis, set(axis.states), now)
        present = {(fault.axis, fault.code): fault for fault in status.faults}
        for key in [key for key in self.active if key not in present]:
            fault, since = self.active.pop(key)
            self._record(f"{since:%H:%M:%S}–{now:%H:%M:%S} {titled(fault)}")
        new = [key for key in present if key not in self.active]
        self.active |= {key: (present[key], now) for key in new}
        return bool(new)

    def _compare(self, axis: str, states: set[str], now: datetime) -> None:
        """Record the states that have begun since the last reading; those of the first are no event."""
        before = self._states.get(axis)
        self._states[axis] = states
        for state in sorted(states - before) if before is not None else ():
            self._record(f"{now:%H:%M:%S} {f'{axis}: ' if axis else ''}{state}")

    def record_act(self, text: str) -> None:
        """Record what the operator did, with the time."""
        self._record(f"{datetime.now(UTC).astimezone():%H:%M:%S} {text}")

    def _record(self, text: str) -> None:
        self.events.insert(0, text)
        del self.events[_HISTORY:]


def lamps_of(axis: AxisStatus) -> dict[str, bool]:
    """Return every state of an axis that its control shows, and whether it is on; ``not homed`` is no lamp
    beside ``homed``.
    """
    on = set(axis.states)
    known = dict.fromkeys((*axis.known_states, *axis.states))
    return {name: name in on for name in known if name.removeprefix("not ") == name or name[4:] not in known}


def titled(fault: ActiveFault) -> str:
    """Return a fault in one line, with its axis."""
    return f"{fault.axis + ': ' if fault.axis else ''}{fault.code} {fault.text}".strip()
