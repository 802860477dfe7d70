"""The simulated axis behind the registers of one axis of an emulated module."""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.families.servo57c422b.law import LAW
from amp_studio.families.servo57c422b.law_home import homing, travel
from amp_studio.families.servo57c422b.law_sample import SCAN
from amp_studio.families.servo57c422b.lines.content import AXIS_Y, RegisterContent, settings, written_content
from amp_studio.sim import AxisLaw, AxisParameters, Ramp, SimulatedAxis, SimulationError, bind_axis

SPEED, ACCELERATION = 65.536, 0.065536
"""Register 19, 20 for 1 count/s, 21 to 24 for 1 count/s2 (4-13, 4-14)."""


class ModuleMotion:
    """Moves one axis of a module; ``axis`` is X or Y.
    Without gains that can be simulated the axis does not follow at all.
    """

    def __init__(self, axis: str) -> None:
        self.name = axis
        self._first = 0 if axis == "X" else AXIS_Y
        self._words: tuple[int, ...] = ()
        self.simulated: SimulatedAxis | None = None
        self.commanded = 0.0
        """Commanded position while nothing can follow it."""

    @property
    def position(self) -> int:
        """Feedback position in counts."""
        return round(self.simulated.position) if self.simulated else 0

    @property
    def following_error(self) -> int:
        """Commanded less feedback position in counts."""
        return round(self.simulated.following_error if self.simulated else self.commanded)

    @property
    def is_stopped(self) -> bool:
        """Whether a limit or a fault stopped the axis."""
        return self.simulated is not None and self.simulated.alarm is not None

    @property
    def counts_a_scan(self) -> float:
        """Velocity in counts in a scan of 1.25 ms."""
        return self.simulated.velocity * SCAN if self.simulated else 0.0

    def bind(self, words: Sequence[int]) -> bool:
        """Take the registers of the module over while the axis is at rest;
        returns whether an axis can move with them.
        """
        # From 63 on the registers are commands and their answers, which make no other axis.
        own = tuple(words[self._first : self._first + AXIS_Y])
        if own[:63] == self._words or (self.simulated and self.simulated.is_busy):
            return self.simulated is not None
        self._words = own[:63]
        law = self._law(words)
        if law is None:
            self.simulated = None
        elif self.simulated is None:
            self.simulated = SimulatedAxis(law)
        else:
            self.simulated.bind(law)
        return self.simulated is not None

    def _law(self, words: Sequence[int]) -> AxisLaw | None:
        content = written_content({register: words[register] for register in settings()})
        file = RegisterContent().decode(content)
        try:
            return bind_axis(file, LAW, self.name)
        except SimulationError:
            return None

    def _read(self) -> AxisParameters | None:
        return getattr(self.simulated.law, "read", None) if self.simulated else None

    def ramp(self, words: Sequence[int]) -> Ramp:
        """Return the trapezoid of registers 21 to 24."""
        up, down = (double(words, self._first + n) / ACCELERATION for n in (21, 23))
        return Ramp("linear", acceleration=up, deceleration=down)

    def speed(self, words: Sequence[int]) -> float:
        """Return the command velocity in counts/s."""
        return double(words, self._first + 19) / SPEED

    def move(self, target: float, words: Sequence[int]) -> None:
        """Move to a position."""
        self.commanded = target
        if self.simulated:
            # A velocity of 0 would be a move without an end.
            self.simulated.move(target, max(self.speed(words), 1e-3), self.ramp(words))

    def run(self, sign: float, words: Sequence[int]) -> None:
        """Run at the command velocity, as velocity control does (4-25)."""
        if self.simulated:
            self.simulated.go(sign * self.speed(words), self.ramp(words))

    def stop(self, words: Sequence[int]) -> None:
        """Stop by the deceleration."""
        if self.simulated:
            self.simulated.stop(self.ramp(words))

    def home(self, words: Sequence[int]) -> bool:
        """Home by the sequence of register 2 (4-29); returns whether the registers allow it."""
        read = self._read()
        if self.simulated is None or read is None:
            return False
        try:
            self.simulated.home(homing(read), self.ramp(words))
        except SimulationError:
            return False
        return True

    def limit(self, words: Sequence[int]) -> bool:
        """Take the software overtravel over; False for limits in the wrong order, a motion fault (4-10)."""
        read = self._read()
        if self.simulated is None or read is None:
            return True
        try:
            self.simulated.travel = travel(read, self.ramp(words))
        except SimulationError:
            return False
        return True


def double(words: Sequence[int], register: int) -> int:
    """Return a signed double word."""
    word = words[register] << 16 | words[register + 1]
    return word - (1 << 32) if word >> 31 else word
