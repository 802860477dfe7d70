"""The numbers of the words of a block, each for what it is: an axis, a center, a feed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from amp_studio.schema import ProgramPath, WordUse

from .block import BlockReader
from .expression import evaluate
from .formats import NumberFormat
from .modal import BlockCodes, WordReading
from .words import ProgramBlockError as BlockError
from .words import TypedWord, sentence

LARGEST = 1e7
"""mm or deg: no machine is larger, and every figure below keeps its decimals."""
INCH = 25.4


@dataclass
class BlockNumbers:
    """The numbers of a block."""

    axes: dict[int, float] = field(default_factory=dict)
    distances: dict[int, float] = field(default_factory=dict)
    centers: dict[int, float] = field(default_factory=dict)
    roles: dict[str, float] = field(default_factory=dict)

    def put(self, letter: str, value: float, reading: WordReading) -> None:
        """Put a number where its kind is; that of a word that moves no axis and has no role is nowhere."""
        into: dict[Any, float]
        key: Any
        if reading.place < 0:
            into, key = self.roles, reading.role
        else:
            into = self.centers if reading.is_center else self.distances if reading.is_distance else self.axes
            key = reading.place
        if key in into:
            raise BlockError(f"{letter} is given twice in a block", "repeated")
        if key != "":
            into[key] = value


class WordNumbers:
    """Reads them by the file's formats."""

    def __init__(
        self,
        reader: BlockReader,
        axes: Sequence[str],
        parameters: Mapping[int, float],
        notes: list[str],
        path: ProgramPath,
    ) -> None:
        """``parameters`` are those that the program sets; ``notes`` gets what is assumed."""
        self._path = path
        self._reader, self._axes, self._parameters, self._notes = reader, axes, parameters, notes

    def read(self, pairs: Sequence[tuple[str, str]], codes: BlockCodes) -> BlockNumbers:
        words = BlockNumbers()
        readings = codes.readings
        if any(letter == "N" for letter, _ in pairs):
            self._check_numbers(pairs)
        for letter, text in pairs:
            if letter in "GMN":
                continue
            # Kept with the codes: the next block of the same shape reads its letters in the same way.
            reading = readings.get(letter)
            if reading is None:
                reading = readings[letter] = self._reading(letter, codes)
            if reading.place < 0 and not reading.role and text[:1] in ("P", "#"):
                continue  # a value for the card, which moves no axis
            value = self._number(letter, text, reading) * reading.scale
            _check_value(f"{letter}{text[:20]}", value, reading)
            words.put(letter, value, reading)
        return words

    def _check_numbers(self, pairs: Sequence[tuple[str, str]]) -> None:
        """Refuse numbers of blocks as the control does."""
        if sum(letter == "N" for letter, _ in pairs) > 1:
            raise BlockError("N is given twice in a block", "repeated")
        if any(letter == "N" and text[:1] == "-" for letter, text in pairs):
            raise BlockError("The number of a block is below 0", "negative")
        if self._path.number_first and pairs[0][0] != "N":
            raise BlockError("N is not at the beginning of its block")
        number = next(text for letter, text in pairs if letter == "N")
        if not number and (fault := self._reader.number_in("", NumberFormat()).fault):
            raise BlockError(f"N: {fault}", "no-digits")
        if 0 < self._path.most_number < float(number or 0.0):
            raise BlockError(f"N{number[:20]}: {self._path.most_number} is the greatest number", "too-high")

    def _number(self, letter: str, text: str, reading: WordReading) -> float:
        """Return the number that is written behind a letter, as the format of the file reads it."""
        if "(" in text or text[:1] in ("P", "#"):
            sign = -1.0 if text.startswith("-") else 1.0
            return sign * evaluate(text.lstrip("+-"), self._parameters)
        if reading.plain and text:
            return float(text)
        number = self._reader.number_in(text, reading.form)
        if number.assumed:
            self._notes.append(sentence(number.assumed))
        if number.value is None:
            raise BlockError(
                f"{letter}{text}: {number.fault or 'no number'}", "no-number" if text else "no-digits"
            )
        return number.value

    def _reading(self, letter: str, codes: BlockCodes) -> WordReading:
        """Return how the number of a letter is read under the codes of the block."""
        self._reader.active = dict(codes.modal.active)
        here = {TypedWord(code.code[0], code.code[1:], "").code for code in codes.codes}
        if self._reader.is_unused(letter, here):
            raise BlockError(f"{letter}: no code of the block uses this word", "unused-words")
        use = self._reader.use(letter, here)
        if use is not None:
            return self._reading_of_role(use, codes)
        axis, meaning, _ = next(self._reader.axis_words(letter), ("", "", ()))
        if axis not in self._axes and letter == "O":
            raise BlockError("O: numbers of programs and subroutines are not simulated", "unknown-word")
        if axis not in self._axes:
            raise BlockError(f"{letter}: no page here names such a word", "unknown-word")
        facts = self._reader.codes.facts
        form = (facts.axes.format, axis) if facts.axes and facts.axes.format else None
        return WordReading(
            self._axes.index(axis),
            meaning.startswith("center"),
            # Under incremental codes every number of an axis is a distance already.
            meaning.startswith("distance") and codes.modal.is_absolute,
            scale=INCH if self._reader.unit_of(axis) == "in" else 1.0,
            plain=form is None and facts.zeros is None,
            form=self._reader.number_format(form, False),
        )

    def _reading_of_role(self, use: WordUse, codes: BlockCodes) -> WordReading:
        """Return the same for a word with a role, as a feed: in mm and s."""
        is_inch = codes.feed_in_inch if use.role == "feed" else codes.modal.is_inch
        unit = use.unit if isinstance(use.unit, str) else use.unit["in" if is_inch else "mm"]
        scale = INCH if unit.startswith("in") else {"ms": 1e-3, "min": 60.0}.get(unit, 1.0)
        return WordReading(
            role=use.role or "",
            scale=scale,
            plain=use.format is None and self._reader.codes.facts.zeros is None and not use.whole,
            form=self._reader.number_format((use.format, "") if use.format else None, use.whole),
            # In the unit in which the number then is: the printed bounds are in that of the word.
            bounds=use.bounds and (scale * use.bounds[0], scale * use.bounds[1]),
        )


def _check_value(word: str, value: float, reading: WordReading) -> None:
    """Raise BlockError for a number that the control refuses in its place."""
    if reading.role == "feed" and value < 0.0:
        raise BlockError(f"{word} is no feed: it must be above 0", "negative")
    if reading.role == "spindle" and value < 0.0:
        raise BlockError(f"{word} is no speed: a spindle turns back by its code", "negative")
    if reading.bounds and not reading.bounds[0] <= value <= reading.bounds[1]:
        low, high = reading.bounds
        raise BlockError(f"{word}: {low:g} to {high:g} are printed", "out-of-range")
    if not -LARGEST < value < LARGEST:
        raise BlockError(f"{word} is beyond every machine", "out-of-range")
