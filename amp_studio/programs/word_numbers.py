"""The numbers of the words of a block, each for what it is: an axis, a center, a feed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from .block import BlockReader
from .expression import worth
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


class WordNumbers:
    """Reads them by the file's formats."""

    def __init__(
        self, reader: BlockReader, axes: Sequence[str], parameters: Mapping[int, float], notes: list[str]
    ) -> None:
        """``parameters`` are those that the program sets; ``notes`` gets what is assumed."""
        self._reader, self._axes, self._parameters, self._notes = reader, axes, parameters, notes

    def read(self, pairs: Sequence[tuple[str, str]], codes: BlockCodes) -> BlockNumbers:
        words = BlockNumbers()
        readings = codes.readings
        for letter, text in pairs:
            if letter in "GMN":
                continue
            reading = readings.get(letter)
            if reading is None:
                reading = readings[letter] = self._reading(letter, codes)
            if reading.plain and text and "(" not in text and text[0] not in "P#":
                value = float(text) * reading.scale
            elif reading.place < 0 and not reading.role and text[:1] in ("P", "#"):
                continue  # a value for the card, which moves no axis
            else:
                value = self._number(letter, text, reading) * reading.scale
            if reading.bounds and not reading.bounds[0] <= value <= reading.bounds[1]:
                low, high = reading.bounds
                raise BlockError(f"{letter}{text[:20]}: {low:g} to {high:g} are printed", "out-of-range")
            if not -LARGEST < value < LARGEST:
                raise BlockError(f"{letter}{text[:20]} is beyond every machine", "out-of-range")
            if reading.place < 0:
                into: dict[int, float] = {}
                if reading.role:
                    if reading.role in words.roles:
                        raise BlockError(f"{letter} is given twice in a block", "repeated")
                    words.roles[reading.role] = value
                continue
            into = (
                words.centers if reading.is_center else words.distances if reading.is_distance else words.axes
            )
            if reading.place in into:
                raise BlockError(f"{letter} is given twice in a block", "repeated")
            into[reading.place] = value
        return words

    def _number(self, letter: str, text: str, reading: WordReading) -> float:
        if "(" in text or text[:1] in ("P", "#"):
            sign = -1.0 if text.startswith("-") else 1.0
            return sign * worth(text.lstrip("+-"), self._parameters)
        word = TypedWord(letter, text, letter + text)
        number = self._reader.number(word, reading.form, reading.whole)
        if number.assumed:
            self._notes.append(sentence(number.assumed))
        if number.value is None:
            raise BlockError(f"{letter}{text}: {number.fault or 'no number'}", "no-number")
        return number.value

    def _reading(self, letter: str, codes: BlockCodes) -> WordReading:
        facts = self._reader.codes.facts
        self._reader.active = dict(codes.modal.active)
        here = {TypedWord(code.code[0], code.code[1:], "").code for code in codes.codes}
        use = self._reader.use(letter, here)
        if use is not None:
            is_inch = codes.feed_in_inch if use.role == "feed" else codes.modal.is_inch
            unit = use.unit if isinstance(use.unit, str) else use.unit["in" if is_inch else "mm"]
            scale = (
                INCH if unit.startswith("in") else 1e-3 if unit == "ms" else 60.0 if unit == "min" else 1.0
            )
            form = (use.format, "") if use.format else None
            plain = form is None and facts.zeros is None and not use.whole
            bounds = None if use.bounds is None else (scale * use.bounds[0], scale * use.bounds[1])
            return WordReading(
                role=use.role or "", scale=scale, plain=plain, form=form, whole=use.whole, bounds=bounds
            )
        for axis, meaning, _ in self._reader.axis_words(letter):
            if axis not in self._axes:
                break
            scale = INCH if self._reader.unit_of(axis) == "in" else 1.0
            form = (facts.axes.format, axis) if facts.axes and facts.axes.format else None
            return WordReading(
                self._axes.index(axis),
                meaning.startswith("center"),
                meaning.startswith("distance") and codes.modal.is_absolute,
                scale=scale,
                plain=form is None and facts.zeros is None,
                form=form,
            )
        raise BlockError(f"{letter}: this control has no such word", "unknown-word")
