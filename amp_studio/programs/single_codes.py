"""Codes that take the words of their block for themselves: dwells, reference points, coordinates, maps."""

from __future__ import annotations

import math

from amp_studio.schema import ProgramPath

from .codes import ControlCodes
from .flow import MACROS
from .modal import BlockCodes, ModalState
from .moves import PathMoves
from .toolpath import EXACT, RAPID
from .word_numbers import INCH, BlockNumbers
from .words import ProgramBlockError as BlockError

_CENTERS = ("incremental_negative", "incremental_positive", "absolute")


class SingleCodes:
    """Does them."""

    def __init__(self, path: ProgramPath, codes: ControlCodes, moves: PathMoves) -> None:
        self._path, self._moves, self._at = path, moves, moves.at
        self._systems = [code for code in codes.known.values() if code.facts.does == "work-system"]
        self._middle: list[float | None] = [None] * len(self._at.position)
        """The points on the way to a reference point."""

    def do(self, codes: BlockCodes, words: BlockNumbers) -> None:
        """Do the one of a block."""
        match codes.once:
            case "dwell":
                self._dwell(words)
            case "reference" | "reference-check" | "reference-other" | "reference-return":
                self._reference(codes.once, words, codes.modal)
            case "set-position" | "local-shift" if not words.axes:
                raise BlockError(f"{codes.codes[0].code} without an axis", "no-axes")
            case "set-position":
                self._moves.rest_at_shift()
                self._at.set_here(words.axes)
            case "local-shift":
                self._at.set_local(words.axes)
            case "set-data":
                self._set_data(words)
            case "centers":
                self._read_centers(words)
            case "scale":
                self._scale(words, codes.modal)
            case "turn":
                self._turn(words, codes.modal)
            case _:
                raise _not_done(codes)

    def _dwell(self, words: BlockNumbers) -> None:
        if "dwell" not in words.roles:
            raise BlockError("A dwell without its time", "no-number")
        if words.axes or words.distances or words.centers:
            raise BlockError("A dwell and a move in one block are not simulated")
        self._moves.dwell(words.roles["dwell"])

    def _read_centers(self, words: BlockNumbers) -> None:
        number = int(words.roles.get("centers", -1.0))
        if not 0 <= number < len(_CENTERS):
            raise BlockError("G200 takes F0, F1 or F2")
        self._moves.read_centers(_CENTERS[number])

    def _turn(self, words: BlockNumbers, modal: ModalState) -> None:
        """Turn the coordinates about a point, given or the one that the tool is at."""
        if modal.plane != 0:
            raise BlockError("A turn is printed with other axes than those of this plane: not simulated")
        a, b = self._at.axis("X"), self._at.axis("Y")
        if "turn" not in words.roles:
            raise BlockError("A turn without R, its angle", "no-number")
        here = self._at.programmed
        around = words.axes.get(a, here[a]), words.axes.get(b, here[b])
        self._at.turn(around, math.radians(words.roles.get("turn", 0.0)))

    def _scale(self, words: BlockNumbers, modal: ModalState) -> None:
        around = [words.axes.get(n, here) for n, here in enumerate(self._at.programmed)]
        factor = words.roles.get("scale", 1.0)
        unit = INCH if modal.is_inch else 1.0  # a factor has no unit, but I, J and K are read as lengths
        factors = [words.centers[n] / unit if n in words.centers else factor for n in range(len(around))]
        if not all(1e-6 < abs(each) < 1e6 for each in factors):
            raise BlockError("A scale must not be 0, and below a million", "out-of-range")
        self._at.scale(around, factors)

    def _set_data(self, words: BlockNumbers) -> None:
        kind, number = words.roles.get("set-kind"), int(words.roles.get("set-number", 0.0))
        if kind != 2.0 or not 1 <= number <= len(self._systems):
            raise BlockError("G10 is printed for L2 and the work coordinates alone: not simulated")
        system = self._systems[number - 1]
        if self._at.is_active(system):
            self._moves.rest_at_shift()
        self._at.set_system(system, words.axes)

    def _reference(self, does: str, words: BlockNumbers, modal: ModalState) -> None:
        """Move to a reference point over a middle point, back from it, or to check that it is reached."""
        number = int(words.roles.get("reference", 2.0)) if does == "reference-other" else 1
        if not 1 <= number <= len(self._path.references):
            raise BlockError(f"P{number}: there are reference points 2 to {len(self._path.references)}")
        point = self._at.positions([self._path.references[number - 1]], f"reference point {number}")
        if does != "reference-return" and self._at.has_length:
            raise BlockError("The reference point is not reached with an offset: cancel it first")
        target = self._at.target(words, is_absolute=modal.is_absolute)
        if does == "reference-check":
            stops = [self._at.to_program(point), target]
        elif does == "reference-return":
            stops = [self._at.to_program(self._remembered_middle()), target]
        else:
            middle = self._middle_of(words, self._at.to_machine(target))
            stops = [self._at.to_program(middle), self._at.to_program(point)]
        for stop in stops:
            self._moves.go(stop, RAPID, EXACT, modal)

    def _remembered_middle(self) -> list[float]:
        """Return the point on the way to the reference point; where there is none, where the axis is."""
        pairs = zip(self._middle, self._at.position, strict=True)
        return [here if found is None else found for found, here in pairs]

    def _middle_of(self, words: BlockNumbers, through: list[float]) -> list[float]:
        """Return the point on the way, which is remembered for axes that a later block does not name."""
        for place in range(len(through)):
            remembered = self._middle[place]
            if place in words.axes or place in words.distances or remembered is None:
                self._middle[place] = through[place]
            else:
                through[place] = remembered
        return through


def _not_done(codes: BlockCodes) -> BlockError:
    if codes.once in MACROS:
        macro = next(code.code for code in codes.codes if code.facts.does == codes.once)
        return BlockError(f"{macro} comes first in its block, whose other words are its variables")
    return BlockError(f"{codes.codes[0].code} is not simulated: {codes.codes[0].facts.meaning}")
