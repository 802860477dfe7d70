"""The moves of a drilling cycle from its printed steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from amp_studio.files import ParameterFile
from amp_studio.schema import ProgramPath

from .codes import ControlCodes
from .modal import ModalState
from .moves import PathMoves
from .toolpath import LINE, MAX_ROWS, PLANES, RAPID
from .word_numbers import BlockNumbers
from .words import ProgramBlockError, TypedWord

_MAX_PECKS = 10_000
_MAX_REPEATS = 10_000


@dataclass
class CycleWords:
    """What a cycle keeps from block to block; lengths in mm, the dwell in s."""

    depth: float | None = None
    level: float | None = None
    peck: float | None = None
    dwell: float | None = None


@dataclass(frozen=True)
class CycleMove:
    """One move or dwell."""

    to: float | None = None
    """Along the axis of the tool."""
    is_rapid: bool = False
    shift: float | None = None
    """In X."""
    seconds: float | None = None


@dataclass(frozen=True)
class CycleHole:
    """One hole of a cycle; positions along the axis of the tool, in mm."""

    initial: float
    level: float
    depth: float
    words: CycleWords
    clearance: float | str
    """D of the cycle, or why there is none."""
    retract: float | str
    """Of a chip-breaking cycle, or why there is none."""
    to_initial: bool
    """Whether the cycle returns to its first level."""

    def moves(self, steps: Sequence[str]) -> Iterator[CycleMove]:
        """Yield what a cycle does at its hole.
        Raises ProgramBlockError for a word or a length that is missing.
        """
        for n, step in enumerate(steps):
            if step == "feed by Q":
                yield from self._pecks(steps[n + 1 :])
            # Only the approach: a later "rapid to R" is between pecks, and those are made in `_pecks`.
            elif step != "rapid to R" or n < 2:
                yield from self._moves_of(step)

    def _moves_of(self, step: str) -> Iterator[CycleMove]:
        """Yield the move of a step, if it is one."""
        match step:
            case "rapid to R":
                yield CycleMove(self.level, is_rapid=True)
            case "feed to the depth":
                yield CycleMove(self.depth)
            case "feed to R":
                yield CycleMove(self.level)
            case "rapid back":
                yield CycleMove(self.initial if self.to_initial else self.level, is_rapid=True)
            case "to the first level in rapid with G98" if self.to_initial:
                yield CycleMove(self.initial, is_rapid=True)
            case "dwell P":
                yield CycleMove(seconds=_needed(self.words.dwell, "P, the seconds of its dwell"))
            case "shift by Q in X":
                yield CycleMove(shift=_needed(self.words.peck, "Q, its shift"), is_rapid=True)

    def _pecks(self, steps: Sequence[str]) -> Iterator[CycleMove]:
        """Yield feeds by Q with what is between them, until the depth is reached."""
        peck = self.words.peck
        if peck is None or peck <= 0.0:
            raise ProgramBlockError("The cycle needs Q, the depth of a peck, above 0", "no-number")
        if (self.level - self.depth) / peck > _MAX_PECKS:
            raise ProgramBlockError(f"The cycle needs more than {_MAX_PECKS} pecks")
        between = [*takewhile(lambda step: step != "again to the depth", steps)]
        at = self.level
        while True:
            # The last peck is what is left: a feed never goes below the depth.
            at = max(at - peck, self.depth)
            yield CycleMove(at)
            if at <= self.depth:
                return
            yield from self._between_pecks(between, at)

    def _between_pecks(self, steps: Sequence[str], at: float) -> Iterator[CycleMove]:
        """Yield the rapid moves between two pecks, the first one done down to ``at``."""
        for step in steps:
            if step == "rapid to R":
                yield CycleMove(self.level, is_rapid=True)
            elif step == "rapid back by the retract distance":
                # Not above R: the first pecks may be shorter than the distance of the retract.
                yield CycleMove(min(at + _length(self.retract), self.level), is_rapid=True)
            elif step == "rapid to D before the depth reached":
                yield CycleMove(min(at + _length(self.clearance), self.level), is_rapid=True)


def _needed(number: float | None, what: str) -> float:
    if number is None:
        raise ProgramBlockError(f"The cycle needs {what}", "no-number")
    return number


def _length(found: float | str) -> float:
    if isinstance(found, str):
        raise ProgramBlockError(f"A cycle cannot be worked out: {found}")
    return found


class CycleRuns:
    """Runs the cycle that is active at each position."""

    def __init__(
        self,
        file: ParameterFile,
        path: ProgramPath,
        codes: ControlCodes,
        moves: PathMoves,
        retract: float | None,
    ) -> None:
        """``retract``: mm of a chip-breaking cycle, where its page is not printed."""
        self._file, self._path, self._codes, self._moves = file, path, codes, moves
        self._retract, self._words = retract, CycleWords()
        self._initial = 0.0
        self.has_run = False

    def run(self, words: BlockNumbers, modal: ModalState, *, begins: bool) -> None:
        """Run it; the block that ``begins`` the cycle has the first level, where the tool is before it."""
        known = self._codes.known[TypedWord(modal.cycle[0], modal.cycle[1:], "").code]
        *_, third = (self._moves.at.axis("XYZ"[n]) for n in PLANES[modal.plane])
        repeats = int(words.roles.get("repeats", 1.0))
        if not 1 <= repeats <= _MAX_REPEATS:
            raise ProgramBlockError(f"L{repeats}: a cycle is repeated 1 to {_MAX_REPEATS} times")
        hole = self._hole(words, modal, known.facts.steps, third, begins=begins)
        # Once for all repeats, and before the first: a word that is missing is refused before anything
        # moves.
        moves = tuple(hole.moves(known.facts.steps))
        for _ in range(repeats):
            target = list(self._moves.at.programmed)
            for place, value in words.axes.items():
                # The word along the tool is the depth, no position of the hole.
                if place != third:
                    target[place] = value if modal.is_absolute else target[place] + value
            self._moves.go(target, RAPID, modal.corner, modal)
            for move in moves:
                self._do(move, third, modal)
            # Repeats of pecks make many rows of one block, and the interpreter counts only between blocks.
            if self._moves.rows.count > MAX_ROWS:
                raise ProgramBlockError(f"The program has more than {MAX_ROWS} moves")

    def _hole(
        self, words: BlockNumbers, modal: ModalState, steps: Sequence[str], third: int, *, begins: bool
    ) -> CycleHole:
        """Return the hole of a block, whose words are kept for the next one."""
        stored = self._words
        stored.depth = words.axes.get(third, stored.depth)
        for role in words.roles.keys() & {"level", "peck", "dwell"}:
            setattr(stored, role, words.roles[role])
        if stored.depth is None or stored.level is None:
            raise ProgramBlockError(
                f"{modal.cycle} needs the depth and R, in its block or before it", "no-depth"
            )
        if begins:
            self._initial = self._moves.at.programmed[third]
        self.has_run, initial = True, self._initial
        if "shift by Q in X" in steps and third == self._moves.at.axis("X"):
            raise ProgramBlockError(f"{modal.cycle} shifts in X, along which it bores in this plane")
        # Incremental: R counts from the first level, and the depth from R.
        level = stored.level if modal.is_absolute else initial + stored.level
        depth = stored.depth if modal.is_absolute else level + stored.depth
        if not depth < level:
            raise ProgramBlockError(f"{modal.cycle}: the depth {depth:g} is not below R, {level:g}")
        clearance = self._length_of(self._path.peck_clearance, None, "D of the cycle")
        retract = self._length_of(self._path.retract, self._retract, "retract distance of the cycle")
        return CycleHole(initial, level, depth, stored, clearance, retract, modal.to_initial)

    def _do(self, move: CycleMove, third: int, modal: ModalState) -> None:
        """Make one move of a cycle: a dwell in s, or a way along the third axis, or aside."""
        if move.seconds is not None:
            self._moves.dwell(move.seconds)
            return
        target = list(self._moves.at.programmed)
        if move.shift is not None:
            target[self._moves.at.axis("X")] += move.shift
        if move.to is not None:
            target[third] = move.to
        self._moves.go(target, RAPID if move.is_rapid else LINE, modal.corner, modal)

    def _length_of(self, parameter: str | None, given: float | None, what: str) -> float | str:
        """Return a length of a cycle, or why there is none."""
        if given is not None:
            return given
        if parameter is None:
            return f"the {what} is printed nowhere: give it"
        value = self._file.evaluation.canonical((parameter, ""))
        if isinstance(value, float | int):
            return float(value)
        return f"{self._file.schema.parameters[parameter].name} is not set"
