"""A command that goes on until the axis meets something: a switch, a marker, a limit.

Each stage is run to its event, cut at the servo sample that sees it, and run again with what follows: the run before the event is the
same, so the whole is one exact motion of the axis without a second kind of kernel.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from .law import AxisLaw, Ramp
from .motion import Motion, Until, run_axis
from .pieces import Piece, change, length
from .profiles import IN_POSITION, POLYNOMIAL, WIDTH, command, piece_at
from .ramps import exponential_pieces, leg, profile_of
from .signals import COMMAND, COMMAND_ACCELERATION, COMMAND_VELOCITY

Columns = Mapping[str, npt.NDArray[np.float64]]
When = Callable[[Columns], npt.NDArray[np.bool_]]
"""Columns at the servo samples -> where the control sees the event."""

HALVINGS = 100
LAGS = 5.0
"""Time constants of the position loop by which a command goes on beyond the farthest place of an event."""
SETTLE = 20.0
"""Time constants of the position loop that each wait for in position may take."""
LONGEST_WAIT = 5.0
"""s more than that."""


@dataclass(frozen=True)
class Seen:
    """The servo sample that saw an event: s, and in u the actual and the measured position."""

    time: float
    position: float
    measured: float


class Course:
    """The command of one axis so far, from rest at 0; lengths in u, velocities in u/s with their sign."""

    def __init__(self, axis: AxisLaw) -> None:
        self.axis = axis
        self.position = self.velocity = 0.0
        """Of the command at its end."""
        self._rows: list[float] = []
        self._time, self._waits = 0.0, 0
        self.stopped_by: Motion | None = None
        """The run that an alarm of the law ended."""
        self._since = 0  # servo sample of the last event

    def go(self, velocity: float, ramp: Ramp, when: When, farthest: float) -> Seen | None:
        """Go at a velocity until the control sees an event, at most ``farthest`` u; None where it does not come, or an alarm does."""
        pieces = change(ramp, abs(self.velocity), abs(velocity))
        # The axis is behind the command, which does not end before the axis is there.
        behind = LAGS * abs(velocity) / self.axis.position_rate
        even = max(farthest + behind - length(pieces), 0.0) / abs(velocity)
        pieces.append(Piece(even, abs(velocity)))
        sign, begin = math.copysign(1.0, velocity), self.position
        rows = self._placed(pieces, sign)
        motion = self._run(rows)
        if motion.stop != 0:
            self.stopped_by = motion
        driven = {name: each[motion.driven] for name, each in motion.columns.items()}
        columns = {name: each[:: motion.rows_per_servo_period] for name, each in driven.items()}
        # The last stage ended at ``begin``: from there on every sample is one of this stage.
        inside = sign * (columns["command_position"] - begin) > 0.0
        inside &= np.arange(len(inside)) >= self._since
        inside &= columns["time_s"] < rows[-WIDTH] + rows[-WIDTH + 1]
        found = np.flatnonzero(inside & when(columns))
        if not found.size:
            return None
        self.stopped_by = None
        at = int(found[0])
        self._since = at
        self._cut(rows, sign, float(columns["command_position"][at]))
        return Seen(
            float(columns["time_s"][at]),
            float(columns["position"][at]),
            float(columns["measured_position"][at]),
        )

    def stop(self, ramp: Ramp) -> None:
        """Stop along the ramp, and wait until the axis is in position."""
        pieces = change(ramp, abs(self.velocity), 0.0)
        if ramp.kind == "exponential" and pieces:
            pieces = [replace(pieces[0], duration=self._fades(ramp))]
        self._append(pieces, math.copysign(1.0, self.velocity))
        self.velocity = 0.0
        self.wait()

    def to(self, position: float, feedrate: float, ramp: Ramp) -> None:
        """Move to a position from rest, and wait until the axis is in position."""
        distance = position - self.position
        if distance != 0.0:
            size, count = abs(distance), self.axis.machine.position_count
            pieces = (
                exponential_pieces(size, [(0.0, feedrate)], ramp, count)
                if ramp.kind == "exponential"
                else leg(size, feedrate, ramp)
            )
            self._append(pieces, math.copysign(1.0, distance))
            self.position = position
        self.wait()

    def wait(self) -> None:
        """Wait until the axis is in position, checked at every servo sample."""
        self._append([Piece(self.axis.servo_period, kind=IN_POSITION)], 1.0)
        self._waits += 1

    def run(self) -> Motion:
        """Run the whole command."""
        return self.stopped_by or self._run([])

    def _run(self, rows: Sequence[float]) -> Motion:
        whole = [*self._rows, *rows]
        end = whole[-WIDTH] + whole[-WIDTH + 1] if whole else 0.0
        _, last = _state(whole, end)
        profile = [*whole, end, math.inf, last, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
        patience = self._waits * (SETTLE / self.axis.position_rate + LONGEST_WAIT)
        until = Until(end + patience + 0.1, settle_time=0.05)
        return run_axis(self.axis, profile, until, thin=True)

    def _placed(self, pieces: Sequence[Piece], sign: float) -> list[float]:
        """Return the rows of pieces after the command so far."""
        flat = profile_of(pieces, length(pieces), sign)[:-WIDTH]
        for k in range(0, len(flat), WIDTH):
            flat[k] += self._time
            flat[k + 2] += self.position
        return flat

    def _append(self, pieces: Sequence[Piece], sign: float) -> None:
        rows = self._placed(pieces, sign)
        if rows:
            self._rows += rows
            self._time = rows[-WIDTH] + rows[-WIDTH + 1]
            self.position += sign * length(pieces)

    def _cut(self, rows: list[float], sign: float, position: float) -> None:
        """End the command where it is at ``position``, on its way in these rows."""
        low, high = self._time, rows[-WIDTH] + rows[-WIDTH + 1]
        end = [*rows, high, math.inf, 0.0, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if sign * (_state(end, middle)[1] - position) < 0.0:
                low = middle
            else:
                high = middle
        velocity, _ = _state(end, high)
        piece = piece_at(end, 0, high)
        self._rows += rows[: piece * WIDTH]
        if high > rows[piece * WIDTH]:
            self._rows += [
                rows[piece * WIDTH],
                high - rows[piece * WIDTH],
                *rows[piece * WIDTH + 2 : (piece + 1) * WIDTH],
            ]
        self._time, self.position, self.velocity = high, position, velocity

    def _fades(self, ramp: Ramp) -> float:
        """Return how long an exponential stop lasts: until less than a count of it is left, s."""
        left = abs(self.velocity) * ramp.time
        count = max(self.axis.machine.position_count, 1e-6 * left)
        return ramp.time * math.log(max(left / count, 1.0))


def _state(rows: Sequence[float], time: float) -> tuple[float, float]:
    """Return velocity and position of a command at a moment."""
    if not rows:
        return 0.0, 0.0
    io = [0.0] * (max(COMMAND, COMMAND_VELOCITY, COMMAND_ACCELERATION) + 1)
    last = len(rows) // WIDTH - 1
    piece = 0
    while piece < last and time >= rows[piece * WIDTH] + rows[piece * WIDTH + 1]:
        piece += 1
    command(list(rows), piece, time, io)
    return io[COMMAND_VELOCITY], io[COMMAND]
