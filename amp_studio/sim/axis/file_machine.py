"""The machine that a parameter file makes, behind the panel of an emulated control: jog, home, move, stop,
and what it shows.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from amp_studio.files import ParameterFile
from amp_studio.schema import axis_name
from amp_studio.sim.command.events import Homing, Jogging, Ramp, Travel
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, Law
from amp_studio.sim.rounding import page_text, value_text

from .simulated_machine import SimulatedAxis, SimulatedMachine


@dataclass(frozen=True)
class PanelAxis:
    """What a panel shows of one axis; lengths in ``unit``."""

    letter: str
    position: float
    following_error: float
    velocity: float
    unit: str
    is_homed: bool
    is_busy: bool
    alarm: tuple[str, str] | None
    """Code and message of what stopped it."""


class FileMachine:
    """Axes of a file, made when they are first moved; the file is taken over while nothing moves.

    ``bind`` makes one axis of a file by its law.
    """

    def __init__(self, law: Law, bind: Callable[[ParameterFile, Law, str], AxisLaw]) -> None:
        self._law, self._bind = law, bind
        self._machine = SimulatedMachine()
        self._file: ParameterFile | None = None
        self._targets: list[dict[str, float]] = []
        self._led: dict[str, list[str]] | None = None
        """Axis -> those that its orders move too; None until an order asks for it."""

    # -- orders --------------------------------------------------------------------------

    def take(self, file: ParameterFile) -> None:
        """Have the machine be that of a file; places and homing stay.
        Raises SimulationError where an axis cannot be made.
        """
        if self._machine.is_busy:
            return
        self._file, self._led = file, None
        for name, axis in self._machine.axes.items():
            axis.bind(self._bind(file, self._law, name))

    def home(self, axis: str) -> str:
        """Begin to home an axis; returns its letter. Raises SimulationError."""
        name = self._ordered(axis)
        homings = [self._homing(each) for each in (name, *self._others(name))]
        self._targets = []
        for moving, homing in homings:
            # Limits count from the zero that homing finds: none while it is searched.
            moving.travel = None
            moving.home(homing, homing.ramp or self._ramp(moving, homes=True))
        return self._letter(name)

    def jog(self, axis: str, sign: float, speed: str = "", increment: str = "") -> str:
        """Jog until `stop`, or by an increment; returns what is done. Raises SimulationError."""
        name = self._ordered(axis)
        moving, jogging = self._axis(name), self._jogging(name)
        rate = _figure("speed", jogging.increment_speed if increment and not speed else speed, jogging.speeds)
        ramp = jogging.ramp or self._ramp(moving, homes=False)
        way = _figure("increment", increment, jogging.increments) if increment else 0.0
        self._targets = []  # an axis that is jogged goes nowhere after it
        for each in self._limited(name):
            if increment:
                each.move(each.command + sign * way, rate, ramp)
            else:
                each.go(sign * rate, ramp)
        return (
            f"{self._letter(name)}{'+' if sign > 0.0 else '-'} at"
            f" {value_text(rate * 60.0, f'{moving.law.unit}/min')}"
        )

    def move(
        self, targets: dict[str, float], feedrate: float | None, then: dict[str, float] | None = None
    ) -> None:
        """Move axes in a line, in u and u/s, and on to a second point; raises SimulationError."""
        names = {self._ordered(axis): to for axis, to in targets.items()}
        for name in names:
            self._limited(name)
        self._machine.line(names, feedrate, self._led)
        self._targets = [] if then is None else [{self._named(axis): to for axis, to in then.items()}]

    def stop(self) -> None:
        """Stop every axis along its ramp of manual moves."""
        self._targets = []
        for axis in self._machine.axes.values():
            if axis.is_busy:
                axis.stop(self._ramp(axis, homes=False))

    def switch_off(self) -> None:
        """Take the drives away, as E-stop does."""
        self._targets = []
        for axis in self._machine.axes.values():
            axis.emergency_stop()

    def fail(self, axis: str, kind: str) -> str:
        """Have a fault of an axis, a drive that has tripped or lost feedback; returns what happens. Raises
        SimulationError.
        """
        name = self._named(axis)
        moving = self._axis(name)
        moving.fail(kind)
        alarm = f": {moving.alarm.code}" if moving.alarm else ", which the control has not noticed"
        return f"{kind} fault of {self._letter(name)}{alarm}"

    @property
    def has_lost_drive(self) -> bool:
        """Whether an alarm has taken the drive of an axis away."""
        return any(axis.alarm is not None and not axis.is_enabled for axis in self._machine.axes.values())

    def reset(self) -> None:
        """Give the drives back, and forget alarms."""
        for axis in self._machine.axes.values():
            axis.reset()

    def forget(self) -> None:
        """Lose the power: no axis knows where it is."""
        self._machine.axes.clear()
        self._targets = []

    # -- what it shows ---------------------------------------------------------------------

    @property
    def is_busy(self) -> bool:
        """Whether anything moves."""
        return self._machine.is_busy or bool(self._targets)

    def is_homed(self, axis: str) -> bool:
        """Return whether an axis knows its place; raises SimulationError for an unknown one."""
        moving = self._machine.axes.get(self._named(axis))
        return moving is not None and moving.is_homed

    def home_position(self, axis: str) -> float:
        """Return what the home position is called, u; raises SimulationError."""
        moving = self._axis(self._named(axis))
        return moving.law.homing().coordinate if moving.law.homing else 0.0

    def number(self, parameter: str, axis: str) -> float:
        """Return a figure of the file for an axis, in its canonical unit; raises SimulationError for none."""
        name = self._named(axis)
        value = self._file_now().evaluation.canonical((parameter, name))
        if not isinstance(value, float):
            called = self._file_now().schema.parameters[parameter].name
            raise SimulationError(f"{called} is not set for axis {self._letter(name)}", parameter)
        return value

    def make_all(self) -> None:
        """Make the axes that have not moved yet, as far as they can be made."""
        fitted = tuple(self._law.axes(self._file)) if self._file is not None else ()
        for name in fitted:
            # An axis that the parameters do not make is not shown; the others are.
            with contextlib.suppress(SimulationError):
                self._axis(name)
        made = self._machine.axes
        # In the order of the file, without axes that are no longer fitted.
        self._machine.axes = {name: made[name] for name in fitted if name in made}

    def axes(self) -> Iterator[PanelAxis]:
        """Yield what is shown of each axis that has moved."""
        for name, axis in self._machine.axes.items():
            alarm = (axis.alarm.code, axis.alarm.message) if axis.alarm else None
            yield PanelAxis(
                self._letter(name),
                axis.position,
                axis.following_error,
                axis.velocity,
                axis.law.unit,
                axis.is_homed,
                axis.is_busy,
                alarm,
            )

    def screen(self) -> str:
        """Return a line for each axis that has moved, in one."""
        lines = [
            f"{each.letter} {each.position:.4f} {each.unit} error {each.following_error:.4f}"
            f"{' moving' if each.is_busy else ''}{' homed' if each.is_homed else ' not homed'}"
            f"{' ({} {})'.format(*each.alarm) if each.alarm else ''}"
            for each in self.axes()
        ]
        return "; ".join(lines) or "no axis has moved"

    def advance(self, duration: float) -> None:
        """Let time pass, s."""
        self._machine.advance(duration)
        # Only when every axis of the first line is at its end: the second line begins from rest.
        if self._targets and not self._machine.is_busy:
            self._machine.line(self._targets.pop(0), None, self._led)

    # -- small parts -------------------------------------------------------------------------

    def _file_now(self) -> ParameterFile:
        if self._file is None:
            raise SimulationError("The control has no parameters that make a machine")
        return self._file

    def _named(self, axis: str) -> str:
        fitted = tuple(self._law.axes(self._file_now()))
        found = next((each for each in fitted if self._letter(each) == axis.upper() or each == axis), None)
        if found is None:
            raise SimulationError(
                f"Axis {axis} is not fitted. Fitted: {', '.join(map(self._letter, fitted))}"
            )
        return found

    def _ordered(self, axis: str) -> str:
        """Return the axis that an order names; raises SimulationError for one that moves with another."""
        name = self._named(axis)
        by = self._axis(name).law.ordered_by
        if by is not None:
            raise SimulationError(
                f"Axis {self._letter(name)} moves with axis {self._letter(by[0])} ({page_text(by[1])}): give"
                " that one the order"
            )
        return name

    def _others(self, name: str) -> list[str]:
        """Return the axes that the orders of one move too, as far as they can be made."""
        if self._led is None:
            self._led = {}
            for each in self._law.axes(self._file_now()):
                with contextlib.suppress(SimulationError):
                    made = self._machine.axes.get(each)
                    law = made.law if made else self._bind(self._file_now(), self._law, each)
                    if law.ordered_by is not None:
                        self._led.setdefault(law.ordered_by[0], []).append(each)
        return self._led.get(name, [])

    def _limited(self, name: str) -> list[SimulatedAxis]:
        """Return an axis and those that move with it, with the limits of its travel; all have the same."""
        first = self._axis(name)
        first.travel = self._travel(first)
        for other in map(self._axis, self._others(name)):
            off = other.command - first.command
            other.travel = first.travel and replace(
                first.travel,
                limits={key: (low + off, high + off) for key, (low, high) in first.travel.limits.items()},
            )
        return [first, *map(self._axis, self._others(name))]

    def _homing(self, name: str) -> tuple[SimulatedAxis, Homing]:
        moving = self._axis(name)
        if moving.law.homing is None:
            raise SimulationError(f"Axis {name} is not homed by a sequence that is printed")
        return moving, moving.law.homing()

    def _letter(self, axis: str) -> str:
        return axis_name(self._file_now().evaluation, axis) or axis

    def _axis(self, name: str) -> SimulatedAxis:
        if name not in self._machine.axes:
            self._machine.axes[name] = SimulatedAxis(self._bind(self._file_now(), self._law, name))
        return self._machine.axes[name]

    def _jogging(self, name: str) -> Jogging:
        law = self._axis(name).law
        if law.jogging is None:
            raise SimulationError(f"No jog of axis {name} is printed")
        return law.jogging()

    @staticmethod
    def _ramp(axis: SimulatedAxis, *, homes: bool) -> Ramp:
        law = axis.law
        return law.manual_ramp(homes) if law.manual_ramp else next(iter(law.ramps.values()))

    @staticmethod
    def _travel(axis: SimulatedAxis) -> Travel | None:
        """Return the limits of an axis; they count once it is homed."""
        return axis.law.travel() if axis.law.travel and axis.is_homed else None


def _figure(what: str, name: str, known: Mapping[str, float]) -> float:
    if not name and known:
        return float(next(iter(known.values())))
    if name not in known:
        raise SimulationError(f"No jog {what} '{name}' is set. Set are: {', '.join(known) or 'none'}")
    if not (math.isfinite(known[name]) and known[name] > 0.0):
        raise SimulationError(f"The jog {what} {name} is {known[name]:g}; it must be above 0")
    return float(known[name])
