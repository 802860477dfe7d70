"""The screen of an emulated control on a second line: what its operator sees, for a live page.

Some controls show positions and faults on their screen alone: their protocol carries parameters and nothing
else. A client that connects here sends a line and gets the status as one line of JSON. Nothing can be changed
over it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import asdict, replace
from typing import Protocol

from amp_studio.transfer.links import Endpoint, Link, LinkError, Listener, listen
from amp_studio.transfer.status import ActiveFault, AxisStatus, ControlStatus, known_fault
from amp_studio.transfer.ways import SCREEN

_KNOWN_STATES = ("homed", "moving")
_LONGEST_QUESTION = 64  # bytes without an end of line after which a client is cut off


class ScreenAxis(Protocol):
    """One axis as a panel shows it; lengths in ``unit``."""

    @property
    def letter(self) -> str: ...
    @property
    def position(self) -> float: ...
    @property
    def following_error(self) -> float: ...
    @property
    def velocity(self) -> float: ...
    @property
    def unit(self) -> str: ...
    @property
    def is_homed(self) -> bool: ...
    @property
    def is_busy(self) -> bool: ...
    @property
    def alarm(self) -> tuple[str, str] | None:
        """Code and message; None for no alarm."""


class _ScreenLine:
    """One client at a time that looks at the screen; a new one takes the line over."""

    def __init__(self, listener: Listener, status: Callable[[], ControlStatus]) -> None:
        self._listener, self._status = listener, status
        self._link: Link | None = None
        self._question = b""

    def turn(self) -> None:
        """Answer what has come; waits for nothing."""
        newest = self._listener.accept(0)
        if newest is not None:
            self.close()
            self._link = newest
        if self._link is None:
            return
        try:
            self._question += self._link.read(0)
            *lines, self._question = self._question.split(b"\n")
            if lines:  # asked twice at once, one answer shows all there is
                self._link.write(json.dumps(asdict(self._status())).encode() + b"\n")
            if len(self._question) > _LONGEST_QUESTION:
                self.close()
        except LinkError:
            self.close()

    def close(self) -> None:
        """Cut the client off."""
        self._question = b""
        if self._link is not None:
            self._link.close()
            self._link = None


def open_screen(
    place: Endpoint | None,
    status: Callable[[], ControlStatus] | None,
    show: Callable[[str], None],
    stack: ExitStack,
) -> Callable[[], None]:
    """Begin to listen for who looks at a screen; returns what gives it its turn.

    Where it is reached is shown to the operator, or that the control has none. Raises LinkError.
    """
    if place is None:
        return lambda: None
    if status is None:
        show("no screen: the status of this control is asked for over its line")
        return lambda: None
    listener = listen(replace(place, protocol=SCREEN))
    stack.callback(listener.close)
    line = _ScreenLine(listener, status)
    stack.callback(line.close)
    show(f"screen at {listener.endpoint}")
    return line.turn


def screen_status(family: str, name: str, state: str, axes: Iterable[ScreenAxis]) -> ControlStatus:
    """Return what a screen shows of axes, and their alarms as faults with what the manual has about them."""
    axes = tuple(axes)
    return ControlStatus(
        family, SCREEN, name, state, tuple(map(_axis, axes)), tuple(filter(None, map(_fault(family), axes)))
    )


def _axis(axis: ScreenAxis) -> AxisStatus:
    states = ("homed" if axis.is_homed else "not homed", *(("moving",) if axis.is_busy else ()))
    figures = axis.position, axis.following_error, axis.velocity
    return AxisStatus(axis.letter, *figures, axis.unit, states, _KNOWN_STATES)


def _fault(family: str) -> Callable[[ScreenAxis], ActiveFault | None]:
    return lambda axis: known_fault(family, *axis.alarm, axis.letter) if axis.alarm else None
