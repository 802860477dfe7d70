"""Coordinates of a program and of the machine: work systems, offsets, scale and turn."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from amp_studio.files import ParameterFile
from amp_studio.schema import ProgramPath

from .codes import KnownCode
from .modal import OFF
from .word_numbers import BlockNumbers
from .words import ProgramBlockError as BlockError


class ProgramCoordinates:
    """Where the axes are, in the machine and to the program; in mm or deg."""

    def __init__(
        self,
        file: ParameterFile,
        path: ProgramPath,
        axes: Sequence[str],
        letters: Sequence[str],
        start: Sequence[float],
        zero: Mapping[str, float] | None,
        notes: list[str],
    ) -> None:
        """``zero`` by axis letter is in the place of work coordinates of the file; ``notes`` gets what is
        assumed.
        """
        self._file, self._path, self._axes, self._notes = file, path, axes, notes
        self.letters = letters
        count = len(axes)
        self.position = list(start)
        """In the coordinates of the machine."""
        self._has_zero = zero is not None
        self._length, self._length_sign = 0, 0.0
        self._work: dict[str, list[float]] = {
            name: [0.0] * count for name in ("system", "local", "set", "length")
        }
        self._system = ""
        self._systems: dict[str, list[float]] = {}
        self._shift = [0.0] * count
        self._scale, self._around = [1.0] * count, [0.0] * count
        self._turn, self._turn_around = 0.0, (0.0, 0.0)
        self.has_map = False
        """Whether a scale or a turn is on."""
        if zero is not None:
            self.set_shift("system", [zero.get(letter, 0.0) for letter in letters])
        self.programmed = self.to_program(self.position)

    # -- shifts ------------------------------------------------------------------

    def set_shift(self, name: str, shift: Sequence[float]) -> None:
        self._work[name] = list(shift)
        # Summed here once: every move needs the sum, and shifts are rare.
        self._shift = [sum(parts) for parts in zip(*self._work.values(), strict=True)]
        self.programmed = self.to_program(self.position)

    def start_in(self, code: KnownCode) -> None:
        """Take the work system of a code for the one that is active at the start, if it is one whose zero is
        at the control alone.
        """
        if code.facts.does == "work-system" and not code.facts.params:
            self._system = code.code

    def is_other_system(self, code: KnownCode) -> bool:
        """Return whether a code selects a work system that is not the active one."""
        return code.facts.does == "work-system" and not self.is_active(code)

    def is_active(self, code: KnownCode) -> bool:
        """Return whether the work system of a code is the active one."""
        return self._system == code.code

    def select(self, does: str, code: KnownCode) -> None:
        if does.startswith("length"):
            self._length_sign = 1.0 if does == "length-plus" else -1.0
            self._apply_length()
            return
        if does in OFF:
            self._switch_off(OFF[does])
            return
        self._system = code.code if does == "work-system" else ""
        # The zero that was asked for stays, whatever work system the program selects.
        if self._has_zero:
            return
        if not self._system:
            shift = [0.0] * len(self._axes)
        elif self._system in self._systems or not code.facts.params:
            shift = self._systems.get(self._system, [0.0] * len(self._axes))
        else:
            shift = self.positions(code.facts.params[:1], "work coordinate")
        self._work["local"] = [0.0] * len(self._axes)
        self.set_shift("system", shift)

    def choose_length(self, number: int) -> None:
        """Take the offset of a number for the tool length."""
        self._length = number
        self._apply_length()

    def _apply_length(self) -> None:
        """Move the coordinates by the length of the tool that is chosen; number 0 has none."""
        if self._length_sign == 0.0:
            return
        third = self.axis("Z")
        total = 0.0
        for part in self._path.length_offsets if self._length else ():
            value = self._file.evaluation.canonical((part, str(self._length)))
            if not isinstance(value, float | int):
                title = self._file.schema.parameters[part].name
                raise BlockError(f"{title} {self._length} is not set")
            total += value
        shift = [0.0] * len(self._axes)
        shift[third] = self._length_sign * total
        self.set_shift("length", shift)

    def _switch_off(self, what: str) -> None:
        """Cancel the length of the tool, a scale or a turn."""
        if what == "length":
            self._length_sign = 0.0
            self.set_shift("length", [0.0] * len(self._axes))
            return
        if what == "scale":
            self._scale = [1.0] * len(self._axes)
        else:
            self._turn = 0.0
        self._mapped()

    def positions(self, params: Sequence[str], what: str) -> list[float]:
        """Return the values of the axes of one parameter; an axis without one counts as 0."""
        found = []
        for axis, letter in zip(self._axes, self.letters, strict=True):
            value = self._file.evaluation.canonical((params[0], axis)) if params else None
            if not isinstance(value, float | int):
                self._notes.append(f"The {what} of {letter} is not set: 0 is taken.")
                value = 0.0
            found.append(float(value))
        return found

    def set_here(self, values: Mapping[int, float]) -> None:
        """Give the present position other coordinates."""
        if self.has_map:
            raise BlockError("Other coordinates for a position under a scale or a turn are not printed")
        shift = list(self._work["set"])
        for place, value in values.items():
            shift[place] += self.programmed[place] - value
        self.set_shift("set", shift)

    def set_local(self, values: Mapping[int, float]) -> None:
        """Shift the coordinates of the work system."""
        local = list(self._work["local"])
        for place, value in values.items():
            local[place] = value
        self.set_shift("local", local)

    def set_system(self, code: KnownCode, values: Mapping[int, float]) -> None:
        """Give a work system another zero."""
        # What the program itself has set counts more than the file.
        shift = self._systems.get(code.code) or self.positions(code.facts.params[:1], "work coordinate")
        for place, value in values.items():
            shift[place] = value
        self._systems[code.code] = shift
        if self.is_active(code) and not self._has_zero:
            self.set_shift("system", shift)

    @property
    def has_length(self) -> bool:
        """Whether a tool length is on."""
        return any(self._work["length"])

    # -- scale and turn -------------------------------------------------------------

    def turn(self, around: tuple[float, float], angle: float) -> None:
        """Turn the plane of X and Y around a point, by rad."""
        self._turn_around, self._turn = around, angle
        self._mapped()

    def scale(self, around: list[float], factors: list[float]) -> None:
        """Scale each axis around its place."""
        self._around, self._scale = around, factors
        self._mapped()

    def _mapped(self) -> None:
        self.has_map = self._turn != 0.0 or any(scale != 1.0 for scale in self._scale)
        self.programmed = self.to_program(self.position)

    def scale_of(self, first: int, second: int) -> float:
        """Return the scale of two axes; raises ProgramBlockError where an arc in them is none."""
        if self.has_map and (len({self._scale[first], self._scale[second]}) > 1 or self._scale[first] <= 0.0):
            raise BlockError("An arc under different scales of its axes is no arc")
        return self._scale[first]

    # -- from one to the other ------------------------------------------------------

    def to_machine(self, point: Sequence[float]) -> list[float]:
        if self.has_map:
            # Scaled first, then turned; the way back undoes them in the opposite order.
            point = [
                middle + (value - middle) * scale
                for value, middle, scale in zip(point, self._around, self._scale, strict=True)
            ]
            if self._turn:
                a, b = self.axis("X"), self.axis("Y")
                u, v = point[a] - self._turn_around[0], point[b] - self._turn_around[1]
                cosine, sine = math.cos(self._turn), math.sin(self._turn)
                point[a] = self._turn_around[0] + u * cosine - v * sine
                point[b] = self._turn_around[1] + u * sine + v * cosine
        return [value + shift for value, shift in zip(point, self._shift, strict=True)]

    def to_program(self, point: Sequence[float]) -> list[float]:
        found = [value - shift for value, shift in zip(point, self._shift, strict=True)]
        if self.has_map:
            if self._turn:
                a, b = self.axis("X"), self.axis("Y")
                u, v = found[a] - self._turn_around[0], found[b] - self._turn_around[1]
                cosine, sine = math.cos(self._turn), math.sin(self._turn)
                found[a] = self._turn_around[0] + u * cosine + v * sine
                found[b] = self._turn_around[1] - u * sine + v * cosine
            found = [
                middle + (value - middle) / scale
                for value, middle, scale in zip(found, self._around, self._scale, strict=True)
            ]
        return found

    def axis(self, letter: str) -> int:
        if letter not in self.letters:
            raise BlockError(f"The machine has no axis {letter}")
        return self.letters.index(letter)

    def target(self, words: BlockNumbers, *, is_absolute: bool) -> list[float]:
        """Return the programmed end of a block."""
        target = list(self.programmed)
        for place, value in words.axes.items():
            target[place] = value if is_absolute else target[place] + value
        for place, value in words.distances.items():
            target[place] += value
        return target

    def in_machine(self, words: BlockNumbers) -> list[float]:
        """Return the programmed end of a block whose words are places of the machine."""
        # From the position in the machine: axes without a word stay where they are there.
        end = list(self.position)
        for place, value in words.axes.items():
            end[place] = value
        return self.to_program(end)
