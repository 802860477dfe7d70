"""The machine behind an emulated Grbl: its settings make the axes, blocks and jogs move them,
and $H homes them.

From machine_limits.c, motion_control.c and gcode.c of the grblHAL core. A block is moved when the one before
is at its end: the look-ahead of the planner is not emulated (corners are exact stops).
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from amp_studio.families.grblhal.law import LAW, homing, travel
from amp_studio.schema import load_schema
from amp_studio.sim import AxisLaw, AxisParameters, ParameterValue, SimulatedAxis, SimulatedMachine

from .stored_settings import CLASSIC, FAMILY, StoredSettings

_PHASES = range(44, 50)
"""Settings with the axes that are homed together, in their order (limits of the classic build: Z,
then X and Y)."""
_CLASSIC_PHASES = (0b100, 0b011)


@dataclass(frozen=True)
class MotionBlock:
    """One straight move in machine coordinates; ``feedrate`` in u/s, None for as fast as it can be."""

    targets: dict[str, float]
    feedrate: float | None
    is_jog: bool


class GrblMotion:
    """Axes of one control, its blocks that wait, and what it is doing."""

    def __init__(self, settings: StoredSettings, axes: str) -> None:
        self._settings, self._axes = settings, axes
        self._machine = SimulatedMachine()
        self._blocks: deque[MotionBlock] = deque()
        self._paused: MotionBlock | None = None
        self._moving: MotionBlock | None = None
        self._cycles: list[tuple[str, ...]] | None = None
        """Axes that are still homed, together in each; None while nothing is homed."""
        self._schema = load_schema(FAMILY).on(CLASSIC if settings.is_classic else FAMILY)
        self._bound: dict[int, float | str] = {}
        self.planned = dict.fromkeys(axes, 0.0)
        """Where the last block ends."""

    # -- what it is doing ------------------------------------------------------------------

    @property
    def state(self) -> str:
        """Idle, Run, Jog, Home or Hold:0."""
        if self._cycles is not None:
            return "Home"
        if self._paused is not None:
            return "Hold:0"
        block = self._moving
        return "Idle" if block is None else "Jog" if block.is_jog else "Run"

    @property
    def positions(self) -> list[float]:
        """Machine positions of all axes."""
        found = self._machine.axes
        return [found[axis].position if axis in found else self.planned[axis] for axis in self._axes]

    @property
    def feed(self) -> float:
        """Present speed along the path, u/min."""
        return float(sum(axis.velocity**2 for axis in self._machine.axes.values()) ** 0.5 * 60.0)

    @property
    def homed(self) -> str:
        """The axes that know where they are."""
        return "".join(name for name, axis in self._machine.axes.items() if axis.is_homed)

    # -- orders ----------------------------------------------------------------------------

    def add(self, block: MotionBlock) -> None:
        """Move along a block after those that wait; raises SimulationError for axes that cannot move."""
        for axis in block.targets:
            self._axis(axis)
        self._blocks.append(block)
        # The next block begins where this one ends, however far the machine is by now.
        self.planned |= block.targets
        self._next()

    def leaves_travel(self, targets: dict[str, float]) -> bool:
        """Return whether a homed axis would leave its travel, with soft limits on."""
        for name, to in targets.items():
            if not self._axis(name).is_homed:
                continue
            limits = travel(self._read(name)).limits.values()
            if any(not low <= to <= high for low, high in limits):
                return True
        return False

    def home(self, axes: str) -> None:
        """Begin to home; raises SimulationError where an axis cannot be homed."""
        wanted = self._phases(axes)
        # All axes before the first one moves: one that cannot be homed refuses the whole cycle.
        for name in (each for cycle in wanted for each in cycle):
            homing(self._read(name))
            self._axis(name)
        self._cycles = wanted
        self._home_next()

    def pause(self) -> None:
        """Stop along the ramp; the block can be taken up again."""
        if self._moving is not None and self._cycles is None:
            self._paused, self._moving = self._moving, None
            self._stop()

    def resume(self) -> None:
        """Take the block up again that was stopped."""
        if self._paused is not None:
            self._blocks.appendleft(self._paused)
            self._paused = None
            self._next()

    def cancel(self) -> bool:
        """Stop, and forget all blocks; returns whether anything was under way."""
        was = self.state != "Idle"
        self._blocks.clear()
        self._moving = self._paused = self._cycles = None
        self._stop()
        self._keep_place()
        return was

    def halt(self) -> None:
        """Stop at once, as an alarm does: an axis that moved has lost steps and its place."""
        self._blocks.clear()
        self._moving = self._paused = self._cycles = None
        for axis in self._machine.axes.values():
            if axis.is_busy:
                axis.switch_off()
                axis.reset()
                axis.is_homed = False
        self._keep_place()

    def switch_off(self) -> None:
        """Lose the power: the machine does not move, and its place is no longer known."""
        self._blocks.clear()
        self._machine.axes.clear()
        self._moving = self._paused = self._cycles = None
        self.planned = dict.fromkeys(self._axes, 0.0)

    # -- time ------------------------------------------------------------------------------

    def advance(self, duration: float) -> str | None:
        """Let time pass, s; returns what ended a homing: "" for done, else its alarm (``ALARM:9``)."""
        self._machine.advance(duration)
        if self._machine.is_busy:
            return None
        if self._cycles is not None:
            failed = [axis.alarm.code for axis in self._machine.axes.values() if axis.alarm is not None]
            if failed:
                for axis in self._machine.axes.values():
                    axis.reset()
                self._cycles = None
                self._keep_place()
                return failed[0]
            if self._cycles:
                self._home_next()
                return None
            self._cycles = None
            self._keep_place()
            return ""
        if self._moving is not None:
            self._moving = None
            self._next()
        elif self._paused is None:
            self._keep_place()  # a jog that was cancelled has come to rest
        return None

    # -- small parts -----------------------------------------------------------------------

    def _next(self) -> None:
        if self._moving is None and self._paused is None and self._blocks:
            self._moving = self._blocks.popleft()
            self._machine.line(self._moving.targets, self._moving.feedrate)

    def _stop(self) -> None:
        for axis in self._machine.axes.values():
            axis.stop(axis.law.ramps["linear"])

    def _keep_place(self) -> None:
        self.planned |= {name: axis.command for name, axis in self._machine.axes.items()}

    def _phases(self, axes: str) -> list[tuple[str, ...]]:
        masks = _CLASSIC_PHASES if self._settings.is_classic else [self._whole(number) for number in _PHASES]
        cycles = [tuple(a for n, a in enumerate(self._axes) if mask >> n & 1 and a in axes) for mask in masks]
        return [cycle for cycle in cycles if cycle]

    def _home_next(self) -> None:
        assert self._cycles is not None
        for name in self._cycles.pop(0):
            axis = self._axis(name)
            axis.home(homing(self._read(name)), axis.law.ramps["linear"])

    def _axis(self, name: str) -> SimulatedAxis:
        """Return an axis as the settings make it now."""
        now = self._settings.values()
        if now != self._bound and not self._machine.is_busy:
            self._bound = now
            for other, axis in self._machine.axes.items():
                axis.bind(self._law(other))
        if name not in self._machine.axes:
            # An axis that has not moved yet is where the blocks so far have put it.
            self._machine.axes[name] = SimulatedAxis(self._law(name), position=self.planned[name])
        return self._machine.axes[name]

    def _law(self, name: str) -> AxisLaw:
        return LAW.bind(self._read(name))

    def _read(self, name: str) -> AxisParameters:
        return AxisParameters(self._value, name, {})

    def _value(self, parameter: str, instance: str) -> ParameterValue:
        number = self._schema.plain_number((parameter, instance))
        found = self._settings.all.get(int(number)) if number else None
        if found is None or isinstance(found.value, str):
            return None
        return bool(found.value) if parameter == "limits.soft" else float(found.value)

    def _whole(self, number: int) -> int:
        found = self._settings.all.get(number)
        return int(found.value) if found is not None and not isinstance(found.value, str) else 0
