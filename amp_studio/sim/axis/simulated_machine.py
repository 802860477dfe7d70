"""A machine that lives: its axes are stepped in their own time, get orders, and can fault.

It is what an emulated control moves (DESIGN: one machine): the same axes, homing and limits as in the
scenarios, made from the parameters that the control contains.
Positions are in the coordinates of the control.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from amp_studio.sim.command.events import Homing, Ramp, Surroundings, Travel
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AlarmText, AxisLaw
from amp_studio.sim.rounding import page_text, rounded_up, value_text

from .homing import NOT_IN_POSITION, Homed, home_axis
from .moves import time_to_speed
from .moving_axis import MovingAxis
from .orders import GoOrder, MoveOrder, Orders, StopOrder, Watch, one

_COAST = 10.0
"""s in which an axis that has lost its drive may run out."""
_FIRST_MARKER = 0.25
"""Turns from where the axis began to a marker, as in `_usual_around`."""
_AWAKE = 0.5
"""s after the last order in which an axis is still stepped; then it is at rest and costs nothing."""
_SLICE = 0.02
"""s of the machine's time between two looks at what its drive and its markers do."""
RUNAWAY = "RUNAWAY"
"""Code of an axis whose loop is not stable, where the control itself stops it with none."""
_LONGEST_ADVANCE = 1.0
"""s of the machine's time that are made up at most, after its process had no processor."""


class SimulatedAxis:
    """One axis of a machine; ``around`` None puts its switch as far off as it needs
    to reach the homing speed.
    """

    def __init__(self, law: AxisLaw, around: Surroundings | None = None, position: float = 0.0) -> None:
        self.law, self._around = law, around
        self._moving = MovingAxis(law, engine="plain", keep=False, coast=_COAST)
        self._offset = position  # of the control's coordinates
        self._left = 0.0  # s that it is still stepped
        self._due = 0.0  # s that have passed and are less than a servo period, which are stepped later
        self._homed: Homed | None = None
        self._marker_waited: tuple[float, float, float] | None = None
        """Position to take, and the markers below and above the axis, u of the moving axis."""
        self._moved_zero = 0.0
        """How far the zero of the moving axis is from where the axis began."""
        self.is_homed = False
        self.is_enabled = True
        self._braking = 0.0  # s that are left of the braking of an emergency stop
        self._is_tripped = False  # without torque, which the control has not noticed
        self.alarm: AlarmText | None = None
        """What stopped it, until `reset`."""
        self.travel: Travel | None = None
        """Limits that stop it."""

    # -- what it is doing -----------------------------------------------------------------

    @property
    def position(self) -> float:
        """Measured position, u."""
        return self._moving.measured + self._offset

    @property
    def command(self) -> float:
        """Commanded position, u."""
        return self._moving.position + self._offset

    @property
    def following_error(self) -> float:
        """Commanded less measured position, u."""
        return self._moving.position - self._moving.measured

    @property
    def velocity(self) -> float:
        """Of the load, u/s."""
        return self._moving.speed if self._left > 0.0 else 0.0

    @property
    def is_busy(self) -> bool:
        """Whether an order is under way."""
        return self._moving.is_busy

    # -- orders ----------------------------------------------------------------------------

    def define(self, position: float) -> None:
        """Call the place where the command is by another position; the axis does not move."""
        self._offset = position - self._moving.position

    def define_at_marker(self, position: float, turn: float) -> None:
        """Call the place of the next marker by another position, once the axis passes it in any motion;
        markers are ``turn`` u apart, a quarter turn from where the axis began. Commands stay where they are.
        """
        first = _FIRST_MARKER * turn - self._moved_zero
        turns = math.floor((self._moving.measured - first) / turn)
        self._marker_waited = (position, first + turns * turn, first + (turns + 1) * turn)

    def bind(self, law: AxisLaw) -> None:
        """Take other parameters over, at rest."""
        at, moving = self.command, MovingAxis(law, engine="plain", keep=False, coast=_COAST)
        # The 0 of the new moving axis is where the old one is: switches and markers move by the same way.
        if self._around is not None:  # the switches stay where they are in the machine
            self._around = moved(self._around, -self._moving.position)
        self._moved_zero += self._moving.position
        if self._marker_waited is not None:
            position, below, above = self._marker_waited
            self._marker_waited = (position, below - self._moving.position, above - self._moving.position)
        self.law, self._moving, self._offset = law, moving, at

    def move(self, to: float, feedrate: float, ramp: Ramp) -> None:
        """Move to a position; an axis that moves stops first."""
        self._forget_limit()
        self._begin(self._moved(to - self._offset, feedrate, ramp))

    def go(self, velocity: float, ramp: Ramp, farthest: float = math.inf) -> None:
        """Move at a velocity until `stop`, or for ``farthest`` u."""
        if velocity == 0.0:
            self.stop(ramp)
            return
        self._forget_limit()
        # Ten minutes of a jog: an order without an end would be refused (`moving_axis.LONGEST`).
        far = min(farthest, abs(velocity) * 600.0)
        self._begin(self._jog_and_stop(velocity, ramp, far))

    def stop(self, ramp: Ramp) -> None:
        """Stop along a ramp."""
        self._begin(self._stopped(ramp))

    def home(self, homing: Homing, ramp: Ramp) -> None:
        """Home the axis; `is_homed`, or `alarm`, is set at its end."""
        self._forget_limit()
        self.is_homed, self._homed = False, Homed()
        if self._around is None:
            self._around = moved(_usual_around(self.law, homing, ramp), self._moving.position)
        self._begin(self._to_home(homing, ramp, self._around, self._homed))

    def switch_off(self) -> None:
        """Take the drive away: an emergency stop, or a fault of the drive."""
        self.is_enabled, self._homed = False, None
        if self._moving.is_busy or abs(self._moving.velocity) > 0.0 or self._left > 0.0:
            self._moving.emergency()
            self._left = _COAST

    def emergency_stop(self) -> None:
        """Have the drive brake, where it does so, and then be without torque."""
        has_lost_drive = self._is_tripped or (self.alarm is not None and not self.is_enabled)
        if not self.law.brakes or has_lost_drive:
            self.switch_off()
        elif self.is_enabled:
            self.is_enabled, self._homed = False, None
            # ASSUMED: it brakes with its torque limit, as a command that stops at once has it do.
            self._moving.begin(one(StopOrder(Ramp(), waits=False)))
            self._left = self._braking = self.law.brakes

    def fail(self, kind: str) -> None:
        """Have a fault of the machine, one of FAULTS. A control that is informed takes the drive away and
        shows its words; another one goes on until its following error shows it. Raises SimulationError for a
        fault that no page prints.
        """
        self.law.refuse_unknown_fault(kind)
        words = self.law.faults.get(kind)
        if words is not None:
            self.switch_off()
            self.alarm = words
            return
        self._is_tripped = True
        self._moving.trip()

    def reset(self) -> None:
        """Give the drive back, free of its fault; the command is where the axis is."""
        self.alarm, self.is_enabled, self._braking = None, True, 0.0
        if self._moving.stop_number or self._moving.is_over or self._is_tripped:
            self._moving.restart()
        self._is_tripped = False

    def _forget_limit(self) -> None:
        """Forget what stopped the axis with its drive on, a limit: the next order leaves it, or meets the
        other one.
        """
        if self.is_enabled:
            self.alarm = None

    def _moved(self, to: float, feedrate: float, ramp: Ramp) -> Orders:
        # A move begins from rest: its pieces are planned from velocity 0.
        if self._moving.velocity != 0.0:
            yield StopOrder(ramp)
        yield MoveOrder(to, feedrate, ramp)

    def _jog_and_stop(self, velocity: float, ramp: Ramp, farthest: float) -> Orders:
        # A jog in the other direction comes to rest first: the sign of a profile is one for all of it.
        if self._moving.velocity * velocity < 0.0:
            yield StopOrder(ramp)
        sign = math.copysign(1.0, velocity)
        yield GoOrder(velocity, ramp, Watch(sign * math.inf, sign), farthest)
        yield StopOrder(ramp)

    def _to_home(self, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed) -> Orders:
        # A homing begins at rest, whatever the axis was doing.
        if self._moving.velocity != 0.0:
            yield StopOrder(ramp)
        yield from home_axis(self._moving, homing, ramp, around, homed)

    @staticmethod
    def _stopped(ramp: Ramp) -> Orders:
        yield StopOrder(ramp)

    def _begin(self, orders: Orders) -> None:
        # One that never came into position is over without an alarm: it takes the next order up.
        if self.is_enabled and self.alarm is None and self._moving.is_over:
            self._moving.restart()
        if self.is_enabled and not self._moving.is_over:
            self._moving.begin(orders)
            self._left = _AWAKE

    # -- time ------------------------------------------------------------------------------

    def advance(self, duration: float) -> None:
        """Step the axis for a time, s."""
        left = min(duration, _LONGEST_ADVANCE)
        while left > 0.0 and self._left > 0.0:
            step = min(left, _SLICE)
            try:
                self._step(step)
            except (
                SimulationError
            ) as error:  # a loop that is not stable: the control goes on without this axis
                self._end_unbounded_motion(error.what)
                return
            left -= step
            self._left = _AWAKE if self._moving.is_busy else self._left - step
            self._brake(step)
            self._check_stops()
            self._check_marker()
        self._settle()

    def _brake(self, duration: float) -> None:
        """Take the drive away at the end of its braking; an axis that rests by then stays there."""
        if self._braking <= 0.0:
            return
        self._braking -= duration
        self._left = max(self._left, self._braking)
        if self._braking <= 0.0 and abs(self._moving.speed) > self.law.inposition_band:
            self.switch_off()

    def _step(self, duration: float) -> None:
        """Step the axis for a time, s, and stop it at the servo sample that sees a limit passed."""
        # Servo periods that are no part of a slice: what is left of one is due in the next slice, or the
        # axis would be slow by some per cent.
        self._due += duration
        while not self._moving.is_over and self._due > 0.5 * self.law.servo_period:
            before, limits = self._moving.time, self._limits()
            seen = self._moving.advance(self._due, [watch for watch, _, _ in limits])
            self._due -= self._moving.time - before
            if seen is None:
                break
            _, name, code = limits[seen.watch]
            self._stop_at(name, code)
        if self._moving.is_over:
            self._due = 0.0

    def _limits(self) -> list[tuple[Watch, str, str]]:
        """Return the next limit of the travel in each direction, with its name and its alarm."""
        travel = self.travel
        if travel is None or not self.is_enabled or self.alarm is not None or not self.is_busy:
            return []
        found = []
        for sign in (1.0, -1.0):
            ends = [(high if sign > 0.0 else low, name) for name, (low, high) in travel.limits.items()]
            edge, name = min(ends, key=lambda end: sign * end[0], default=(math.inf, ""))
            if math.isfinite(edge):
                code = travel.alarm if sign > 0.0 else travel.alarm_negative or travel.alarm
                found.append((Watch(edge - self._offset, sign, device=True), name, code))
        return found

    def _stop_at(self, name: str, code: str) -> None:
        """Stop at a limit that was passed, by the action of the travel."""
        travel = self.travel
        assert travel is not None
        self.alarm = AlarmText(code, f"The axis has passed {name} ({page_text(travel.page)})")
        self.switch_off() if travel.coasts else self.stop(travel.stop or Ramp())

    def _end_unbounded_motion(self, text: str) -> None:
        """Take the drive away from an axis whose motion has no bounds; it is where its command was."""
        at = self.command
        self._moving = MovingAxis(self.law, engine="plain", keep=False, coast=_COAST)
        self._offset, self._left, self._homed = at, 0.0, None
        self.alarm, self.is_enabled = AlarmText(RUNAWAY, text), False

    def _check_stops(self) -> None:
        """Note what the law stopped for."""
        if self._moving.stop_number > 0 and self.alarm is None:
            self.alarm, self.is_enabled = self.law.alarms.get(self._moving.stop_number), False
            self._left = _COAST  # without its drive it runs out, as after an E-stop

    def _check_marker(self) -> None:
        """Take the position of the first marker that the axis has passed, where one is waited for."""
        if self._marker_waited is None:
            return
        position, below, above = self._marker_waited
        passed = above if self._moving.measured >= above else below
        # Not strictly between its two markers: one of them has been passed, and which one is known by the
        # side.
        if not below < self._moving.measured < above:
            self._offset, self._marker_waited = position - passed, None

    def _settle(self) -> None:
        """Take over how a homing has ended, once its motion is over."""
        homed = self._homed
        if homed is None or self._moving.is_busy:
            return
        self._homed = None
        if homed.alarm:
            self.alarm = AlarmText(homed.alarm, homed.why)
        elif homed.coordinate is not None and homed.home is not None:
            self._offset = homed.coordinate - homed.home
            self.is_homed = True
        elif self._moving.is_over and self.alarm is None:
            band = value_text(self.law.inposition_band, self.law.unit)
            self.alarm = AlarmText("HOME", NOT_IN_POSITION.format(band))


def _usual_around(law: AxisLaw, homing: Homing, ramp: Ramp) -> Surroundings:
    """Return switch and marker of a machine of which nothing is known: from the start at 0,
    far enough to reach the homing speed.
    """
    sign = math.copysign(1.0, homing.approach or homing.leave or 1.0)
    edge = sign * switch_ahead(law, homing, ramp) if homing.approach else 0.0
    marker = edge + math.copysign(0.25 * homing.turn, homing.leave or 1.0)
    return Surroundings(switch=edge if homing.approach else math.inf, marker=marker, scale=5.3 * homing.turn)


def moved(around: Surroundings, way: float) -> Surroundings:
    """Return the same surroundings, seen from another zero."""
    return replace(
        around,
        switch=around.switch + way,
        marker=around.marker + way,
        low=around.low + way,
        high=around.high + way,
        scale=around.scale - way,
    )


def reach(axis: AxisLaw, velocity: float, ramp: Ramp) -> float:
    """Return a distance in u over which the axis reaches a velocity and follows it."""
    speed = abs(velocity)
    return rounded_up(speed * (time_to_speed(ramp, speed) + 3.0 / axis.position_rate + 0.2), 2)


def switch_ahead(axis: AxisLaw, homing: Homing, ramp: Ramp) -> float:
    """Return how far the switch is where nothing is known of it, u: where the axis has its homing speed, but
    in the middle of the way at most, where the control searches no farther than that.
    """
    none = homing.failures.get("switch")
    return min(reach(axis, homing.approach, ramp), 0.5 * none.reach if none else math.inf)


class SimulatedMachine:
    """Axes by name that live together."""

    def __init__(self) -> None:
        self.axes: dict[str, SimulatedAxis] = {}

    def advance(self, duration: float) -> None:
        """Step every axis for a time, s."""
        for axis in self.axes.values():
            axis.advance(duration)

    @property
    def is_busy(self) -> bool:
        """Whether any axis has an order under way."""
        return any(axis.is_busy for axis in self.axes.values())

    def line(
        self,
        targets: Mapping[str, float],
        feedrate: float | None,
        others: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        """Move axes in a straight line at a feedrate in u/s, or as fast as all of them can;
        each has its share of speed and ramp. ``others`` has the axes that go the way of one.
        """
        ways = {name: to - self.axes[name].command for name, to in targets.items()}
        length = math.sqrt(sum(way * way for way in ways.values()))
        ways = {name: way for name, way in ways.items() if way != 0.0}
        if not ways:
            return
        laws = {name: self.axes[name].law for name in ways}
        fastest = min((laws[name].feedrate or math.inf) * length / abs(way) for name, way in ways.items())
        speed = fastest if feedrate is None else min(feedrate, fastest)
        ramps = {name: next(iter(law.ramps.values())) for name, law in laws.items()}
        # The axis with the least acceleration for its share decides: only so do all stay on the line.
        rise = min(ramps[name].acceleration * length / abs(way) for name, way in ways.items())
        for name, way in ways.items():
            share = abs(way) / length
            ramp = replace(ramps[name], acceleration=rise * share, deceleration=rise * share)
            self.axes[name].move(targets[name], speed * share, ramp)
            for other in (others or {}).get(name, ()):
                self.axes[other].move(self.axes[other].command + way, speed * share, ramp)
