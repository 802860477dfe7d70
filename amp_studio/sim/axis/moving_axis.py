"""An axis that is stepped in its own time: its command changes while it moves,
and places in its way are watched.

One uninterrupted motion over the kernel of every scenario (`kernel.py`): homing, limits, and the machine
behind an emulated control use this class, so that an axis moves at the desk as it does behind a control.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from amp_studio.sim.command.pieces import Piece, change, length
from amp_studio.sim.command.ramps import exponential_pieces, leg, profile_of
from amp_studio.sim.engine import kernel
from amp_studio.sim.engine.compiled import can_compile, compiled, pays_off, plain
from amp_studio.sim.engine.machine import (
    POSITION_COUNT,
    POSITION_COUNTS,
    TORQUE_NEGATIVE,
    TORQUE_POSITIVE,
    Machine,
)
from amp_studio.sim.engine.profiles import IN_POSITION, POLYNOMIAL, WIDTH, command, piece_at
from amp_studio.sim.engine.signals import COMMAND, COMMAND_ACCELERATION, COMMAND_VELOCITY, STOP
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, Ramp

from .motion import (
    AFTER,
    BEFORE,
    IO,
    MAX_ROWS,
    STATE,
    TIMING,
    Engine,
    Motion,
    RunEnd,
    machine_vectors,
    prepared,
    steps,
)
from .orders import GoOrder, MoveOrder, Order, Orders, PauseOrder, Seen, StopOrder, Watch, one

_LAGS = 5.0
"""Time constants of the position loop by which a command goes on beyond the farthest place of an event."""
_SETTLE = 20.0
"""Time constants of the position loop that each wait for in position may take."""
_LONGEST_WAIT = 5.0
"""s more than that."""
_REST = 0.05
"""s at rest after the last command of a scenario."""
_POSITIONS = (1, 3, 4)
"""Columns of the rows that are positions."""
_CHUNK = 4096
"""Servo samples of one call of the kernel."""
_LONGEST = 3600.0
"""s of one order that are simulated."""
_ROUNDED = 8.0
"""Last digits of a position that the sums of a profile may be off."""
LAW_STATE, MACHINE, PROFILE = 1, 3, 9
"""Places among the vectors of the kernel."""


class MovingAxis:
    """One axis, at rest at position 0 at the start; lengths in u, velocities in u/s with their sign.

    Without ``keep`` no rows are kept: for a machine that lives as long as its control.
    """

    def __init__(self, axis: AxisLaw, *, engine: Engine = "auto", keep: bool = True, coast: float = 0.0):
        # An axis that follows another one is moved by orders here, not by the motion of its leader.
        self.axis = replace(axis, after=None)
        self.position = self.velocity = 0.0
        """Of the command, now."""
        self.speed = 0.0
        """Of the load, u/s."""
        self.is_over = False
        """Whether an alarm ended the motion, or the axis did not get in position in time."""
        self._engine, self._keep = engine, keep
        self._orders: Orders | None = None
        self._order: Order | None = None
        self._patience = math.inf  # moment up to which the order may take
        self._origin = 0.0  # where the kernel has its 0
        samples, substeps = steps(axis)
        self._steps, self._samples = samples * substeps, samples
        vectors, self._rows = prepared(self.axis, [], RunEnd(axis.servo_period * _CHUNK), substeps)
        self._vectors: list[Any] = [*vectors]
        """Lists, or arrays once machine code runs."""
        self._chunks: list[npt.NDArray[np.float64]] = []
        self._count = 0  # rows that are kept
        self._alarm_row: int | None = None
        self._end: float | None = None
        self._last_steps = 0.0  # physics steps of the last call
        self._is_compiled = False
        timing = self._vectors[TIMING]
        timing[kernel.COAST_TIME] = coast
        # The kernel ends no run by itself: orders do.
        timing[kernel.REST_TIME] = timing[kernel.SETTLE_TIME] = math.inf
        self._stand_still()

    # -- what it is doing ---------------------------------------------------------------

    @property
    def time(self) -> float:
        """Seconds since it was made."""
        return float(self._vectors[STATE][kernel.SAMPLE]) * self.axis.servo_period

    @property
    def load(self) -> float:
        """Where the load is, u."""
        return self._origin + float(self._vectors[STATE][kernel.PLANT + 2])

    @property
    def measured(self) -> float:
        """What the position device measures, u."""
        x = self._vectors[STATE]
        at = float(x[kernel.PLANT + 2 if self.axis.machine.load_sensor else kernel.PLANT])
        return self._origin + float(
            kernel.counted(self._vectors[MACHINE], at, POSITION_COUNT, POSITION_COUNTS)
        )

    @property
    def torque(self) -> float:
        """Of the drive, now, in its unit."""
        return float(self._vectors[STATE][kernel.PLANT + 4])

    @property
    def stop_number(self) -> int:
        """Number of the alarm that stopped it; 0 for none."""
        return int(self._vectors[IO][STOP])

    # -- orders that are carried out at once --------------------------------------------

    def go(self, velocity: float, ramp: Ramp, watch: Watch, farthest: float) -> Seen | None:
        """Go at a velocity until a place is passed, at most ``farthest`` u; None where that does not come,
        or an alarm does.
        """
        return self.follow(one(GoOrder(velocity, ramp, watch, farthest)))

    def stop(self, ramp: Ramp) -> None:
        """Stop along the ramp, and wait until the axis is in position."""
        self.follow(one(StopOrder(ramp)))

    def to(self, position: float, feedrate: float, ramp: Ramp) -> None:
        """Move to a position from rest, and wait until the axis is in position."""
        self.follow(one(MoveOrder(position, feedrate, ramp)))

    def follow(self, orders: Orders) -> Seen | None:
        """Carry out orders to their end, or to an alarm; returns what the last of them saw."""
        self.begin(orders)
        return self.finish()

    def finish(self) -> Seen | None:
        """Carry the orders that are under way out, to their end or to an alarm; returns what the last of them
        saw.
        """
        seen: Seen | None = None
        while self.is_busy:
            seen = self._work(math.inf)
        while self.stop_number and not self.is_over:
            self._step(math.inf, (), to_end=False)  # it runs out
        return seen

    def motion(self) -> Motion:
        """Return all that it did so far, with a moment of rest; one that is over ends where it was."""
        if not self.is_over:
            self._end = self.time
            self._stand_still()
            self.advance(_REST + self.axis.servo_period)
        whole = np.concatenate(self._chunks) if self._chunks else self._rows[:0]
        names = [*kernel.COLUMNS, *(name for name, _ in self.axis.monitors)]
        return Motion(
            dict(zip(names, np.ascontiguousarray(whole.T), strict=True)),
            self.stop_number,
            self._samples,
            self._alarm_row,
            self._end,
        )

    def passed(self, place: float, sign: float) -> float:
        """Return how far the load has been beyond a place in a direction, u; where no rows are kept,
        how far it is.
        """
        if not self._chunks:
            return sign * (self.load - place)
        return max(float((sign * (rows[:, 3] - place)).max()) for rows in self._chunks)

    # -- orders that go on while it is stepped ------------------------------------------

    @property
    def is_busy(self) -> bool:
        """Whether orders are under way."""
        return self._orders is not None and not self.is_over

    def begin(self, orders: Orders) -> None:
        """Take orders up in the place of those that are under way."""
        self._orders = orders
        self._next(None, first=True)

    def drop(self) -> None:
        """Forget the orders; the command goes on as it is."""
        self._orders = self._order = None

    def advance(self, duration: float, watches: Sequence[Watch] = ()) -> Seen | None:
        """Step on for a time, s, with the orders that are under way; ends at a watched place,
        which is returned.
        """
        last = self.time + duration
        # Half a period: what rounding leaves of a duration is no sample.
        while not self.is_over and last - self.time > 0.5 * self.axis.servo_period:
            seen = self._work(last, watches) if self._order else self._step(last, watches, to_end=False)
            if seen is not None and seen.watch >= 0:
                return seen
        return None

    def _work(self, last: float, watches: Sequence[Watch] = ()) -> Seen | None:
        """Step on to the end of the order or to a moment;
        what the order watched for is returned with a number below 0.
        """
        order = self._order
        own = (order.watch,) if isinstance(order, GoOrder) else ()
        limit = min(last, self._patience)
        seen = self._step(limit, (*own, *watches), to_end=True)
        if seen is not None and own:
            seen = replace(seen, watch=seen.watch - 1)
        # A watch of the caller ends the step, and the order goes on with the next one.
        if self.is_over or (seen is not None and seen.watch >= 0):
            return seen
        if seen is not None or self._is_at_end():
            self._next(seen)
        elif self.time > self._patience - 0.5 * self.axis.servo_period:  # not in position in all that time
            self.is_over, self._orders = True, None
        return seen

    def _next(self, seen: Seen | None, *, first: bool = False) -> None:
        """Begin the next order."""
        assert self._orders is not None
        try:
            order = next(self._orders) if first else self._orders.send(seen)
        except StopIteration:
            self._orders = self._order = None
            return
        self._order = order
        self._patience = math.inf
        if isinstance(order, GoOrder):
            self.order(self._going(order), math.copysign(1.0, order.velocity))
            return
        pieces, sign = self._resting(order)
        if not isinstance(order, PauseOrder) and (not isinstance(order, StopOrder) or order.waits):
            pieces.append(Piece(self.axis.servo_period, kind=IN_POSITION))
            lasts = sum(piece.duration for piece in pieces)
            # Twice the command and some time constants: an axis that is not there then does not come.
            self._patience = self.time + 2.0 * lasts + _SETTLE / self.axis.position_rate + _LONGEST_WAIT
        self.order(pieces, sign)

    def _going(self, order: GoOrder) -> list[Piece]:
        speed = abs(order.velocity)
        pieces = change(order.ramp, abs(self.velocity), speed)
        # The axis is behind the command, which does not end before the axis is there.
        far = max(order.farthest + self.behind(speed) - length(pieces), 0.0) / speed
        self._refuse_longer(far)
        return [*pieces, Piece(far, speed)]

    def _refuse_longer(self, lasts: float) -> None:
        """Raise SimulationError for a command of more s than are simulated, or than there is room for."""
        room = MAX_ROWS * self.axis.servo_period / self._samples if self._keep else math.inf
        longest = min(_LONGEST, room)
        if not lasts < longest:
            raise SimulationError(
                f"The move of axis {self.axis.axis} takes more than {longest:g} s: give a shorter distance or"
                " a higher speed"
            )

    def _resting(self, order: StopOrder | MoveOrder | PauseOrder) -> tuple[list[Piece], float]:
        """Return the pieces of an order that begins, or ends, at rest, and its direction."""
        if isinstance(order, PauseOrder):
            return [Piece(order.time)], 1.0
        if isinstance(order, MoveOrder):
            distance = order.position - self.position
            if distance == 0.0:
                return [], 1.0
            pieces = way(distance, order.feedrate, order.ramp, self.axis)
            if self._keep:  # one that lives in a control goes as far as it is sent
                self._refuse_longer(sum(piece.duration for piece in pieces))
            return pieces, math.copysign(1.0, distance)
        pieces = change(order.ramp, abs(self.velocity), 0.0)
        if order.ramp.kind == "exponential" and pieces:
            pieces = [replace(pieces[0], duration=self._exponential_stop_time(order.ramp))]
        return pieces, math.copysign(1.0, self.velocity)

    def order(self, pieces: Sequence[Piece], sign: float) -> None:
        """Put these pieces in the place of the command, from where it is now."""
        flat = profile_of(pieces, length(pieces), sign)
        # The time of the command goes on over all orders, so that the new pieces begin now.
        moment = float(self._vectors[STATE][kernel.MOMENT])
        for k in range(0, len(flat), WIDTH):
            flat[k] += moment
            flat[k + 2] += self.position - self._origin
        self._set_profile(flat)

    def behind(self, velocity: float) -> float:
        """Return by how much a command at a velocity goes beyond the farthest place of its event, u."""
        return _LAGS * abs(velocity) / self.axis.position_rate

    def switch_off(self) -> None:
        """Take the output away from the drive, as an emergency stop does,
        and let the axis run out for the coasting time.
        """
        self.emergency()
        while not self.is_over:
            self._step(math.inf, (), to_end=False)

    def emergency(self) -> None:
        """Take the output away at the next servo sample; the axis runs out while it is stepped."""
        self.drop()
        self._vectors[TIMING][kernel.EMERGENCY] = self.time

    def change(self, machine: Machine) -> None:
        """Go on with another machine, as where a cut begins; it is no stiffer than the first one."""
        fresh = machine_vectors(machine, self.axis.servo_period / self._steps)
        for place, vector in zip((MACHINE, BEFORE, AFTER), fresh, strict=True):
            self._vectors[place][:] = vector

    def trip(self) -> None:
        """Take the torque away from the drive, which the control does not notice by itself."""
        for place in (MACHINE, BEFORE, AFTER):  # of a whole step, and of its parts
            vector = self._vectors[place]
            vector[TORQUE_POSITIVE] = vector[TORQUE_NEGATIVE] = 0.0

    def restart(self) -> None:
        """Take the axis up again where it came to rest after an alarm,
        the command being where the device measures it.
        """
        x, at = self._vectors[STATE], self.measured
        motor, load = float(x[kernel.PLANT]), float(x[kernel.PLANT + 2])
        fresh, _ = prepared(self.axis, [], RunEnd(self.axis.servo_period), self._steps // self._samples)
        # The brake is open again, and a drive that has tripped has torque. Time, delay line and rows go on.
        for place in (LAW_STATE, IO, MACHINE, BEFORE, AFTER):
            self._vectors[place][:] = fresh[place]
        shift, self._origin = at - self._origin, at  # a law begins at 0
        x[kernel.PLANT : kernel.PLANT + 7] = [motor - shift, 0.0, load - shift, 0.0, 0.0, 0.0, 0.0]
        x[kernel.COASTING], x[kernel.ALARM_ROW] = 0.0, -1.0
        self._vectors[TIMING][kernel.EMERGENCY] = math.inf
        self.is_over, self.position = False, at
        self.drop()
        self._stand_still()

    # -- small parts --------------------------------------------------------------------

    def _stand_still(self) -> None:
        """Have the command stay where it is."""
        self.velocity = 0.0
        self._set_profile([0.0, math.inf, self.position - self._origin, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0])

    def _set_profile(self, flat: list[float]) -> None:
        self._profile = flat
        x = self._vectors[STATE]
        x[kernel.PIECE], x[kernel.ENDED] = 0.0, -1.0
        self._vectors[PROFILE] = np.array(flat) if self._is_compiled else flat

    def _is_at_end(self) -> bool:
        return int(self._vectors[STATE][kernel.PIECE]) == len(self._profile) // WIDTH - 1

    def _step(self, until: float, watches: Sequence[Watch], *, to_end: bool) -> Seen | None:
        """Run the kernel to a moment, to the end of the command if asked, to a watched place, or to an
        alarm.
        """
        timing, x = self._vectors[TIMING], self._vectors[STATE]
        # A quarter of a period off, so that rounding makes no sample more or less of it.
        last = until / self.axis.servo_period - 0.25 if math.isfinite(until) else math.inf
        timing[kernel.TO_END], timing[kernel.WATCHES] = float(to_end), float(len(watches))
        for n, watch in enumerate(watches):
            k = kernel.WATCH + n * kernel.WATCH_WIDTH
            timing[k] = kernel.AT_DEVICE if watch.device else kernel.AT_LOAD
            timing[k + 1], timing[k + 2] = watch.sign, watch.at - self._origin
            # The last digits of a command at rest are no way towards the place.
            hair = _ROUNDED * math.ulp(max(abs(self.position), abs(self._origin)))
            timing[k + 3] = self.position - self._origin + watch.sign * hair
        found: Seen | None = None
        while not self.is_over:
            before = x[kernel.SAMPLE]
            # In pieces: the rows of a call have a fixed room.
            timing[kernel.LAST_SAMPLE] = min(last, before + _CHUNK)
            self._call()
            # Other objects, if the call has just changed lists into arrays.
            x, timing = self._vectors[STATE], self._vectors[TIMING]
            if x[kernel.SEEN]:
                found = Seen(int(x[kernel.SEEN]) - 1, self.time, self.load, self.measured)
            if found or x[kernel.SAMPLE] >= last or x[kernel.SAMPLE] < before + _CHUNK:
                break
        self._take_command()
        return found

    def _call(self) -> None:
        """Run the kernel until its rows are full or the motion ends; an alarm takes the drive away."""
        law = self.axis.position_sample, self.axis.velocity_sample
        wanted = self._engine == "compiled" or (self._engine == "auto" and pays_off(*law, self._last_steps))
        if not self._is_compiled and wanted and can_compile():
            # Once, when machine code begins to pay: lists are faster for the plain engine.
            self._vectors = [np.array(each, dtype=np.float64) for each in self._vectors]
            self._is_compiled = True
        x = self._vectors[STATE]
        before = x[kernel.SAMPLE]
        try:
            filled = (compiled if self._is_compiled else plain)(*law)(*self._vectors, self._rows)
        except OverflowError:  # a count of a position without bounds
            raise SimulationError(f"Axis {self.axis.axis} runs away: its loop is not stable") from None
        self._last_steps = float(x[kernel.SAMPLE] - before) * self._steps
        self._keep_rows(filled)
        if self._vectors[IO][STOP] != 0.0:
            self.drop()
            self.is_over = self._vectors[STATE][kernel.COASTING] == 0.0

    def _keep_rows(self, filled: int) -> None:
        rows = self._rows[:filled]
        if not np.isfinite(rows).all():
            raise SimulationError(
                f"The figures of axis {self.axis.axis} are too large or too small to be computed with. Check"
                " its gains and model.*"
            )
        if filled:
            self.speed = float(rows[-1, 6])
        if not self._keep:
            return
        if self._vectors[STATE][kernel.ALARM_ROW] >= 0.0 and self._alarm_row is None:
            self._alarm_row = self._count + int(self._vectors[STATE][kernel.ALARM_ROW])
        # The next call of the kernel fills the same rows.
        kept = rows.copy()
        kept[:, _POSITIONS] += self._origin
        self._chunks.append(kept)
        self._count += filled

    def _take_command(self) -> None:
        """Read position and velocity of the command at this moment."""
        io = [0.0] * (max(COMMAND, COMMAND_VELOCITY, COMMAND_ACCELERATION) + 1)
        moment = float(self._vectors[STATE][kernel.MOMENT])
        command(self._profile, piece_at(self._profile, 0, moment), moment, io)
        self.position, self.velocity = self._origin + io[COMMAND], io[COMMAND_VELOCITY]

    def _exponential_stop_time(self, ramp: Ramp) -> float:
        """Return how long an exponential stop lasts: until less than a count of it is left, s."""
        left = abs(self.velocity) * ramp.time
        count = max(self.axis.machine.position_count, 1e-6 * left)
        return ramp.time * math.log(max(left / count, 1.0))


def way(distance: float, feedrate: float, ramp: Ramp, axis: AxisLaw) -> list[Piece]:
    """Return the pieces of a move from rest to rest, without its sign."""
    size, count = abs(distance), axis.machine.position_count
    if ramp.kind == "exponential":
        return exponential_pieces(size, [(0.0, feedrate)], ramp, count)
    return leg(size, feedrate, ramp)
