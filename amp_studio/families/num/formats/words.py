"""The words of a NUM control: which number is which value of the schema, how a word is spelled,
what it means.

A word of a known parameter is spelled and understood by the storage the schema gives it: notation, bits,
sign, unit, scale and the control's code of its type. For a parameter that the schema does not have, the type
that the table names is used (page 1-3).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    InvalidValueError,
    Parameter,
    Schema,
    Storage,
    Value,
    angular,
    checked,
    code_of,
    dimension,
    from_stored,
    to_figure,
    write_number,
)

Word = tuple[int, int]
"""The numbers of parameter and word: (21, 3) for P21N3."""
Content = int | float | str
"""What is in a word."""
_NUMBER = re.compile(r"P([0-9]+)N([0-9]+)")


def name_of(word: Word) -> str:
    """Write the number of a word: ``P21N3``."""
    return f"P{word[0]}N{word[1]}"


# -- how words are spelled -------------------------------------------------------

_FLOATING = 9
_LARGEST_DECIMAL = 99_999_999
"""A decimal word of 32 bits has eight digits at most (page 1-3)."""


@dataclass(frozen=True, slots=True)
class Spelling:
    """How the words of a parameter are spelled."""

    code: int | None
    """Of the type; None where it is not known."""
    is_text: bool
    is_floating: bool
    low: int
    high: int
    base: int
    digits: int
    pattern: re.Pattern[str]

    @classmethod
    def of(cls, storage: Storage) -> Spelling:
        """Return how words are spelled that the control stores in such a way.

        Page 13-14 shows eight digits for hexadecimal words of 32 bits and no leading zeros
        for those of 8 bits.
        """
        bits = storage.bits or 32
        if storage.notation == "hex":
            pattern = re.compile(rf"[0-9A-F]{{1,{bits // 4}}}")
            return cls(storage.code, False, False, 0, (1 << bits) - 1, 16, 8 if bits == 32 else 1, pattern)
        high = _LARGEST_DECIMAL if bits == 32 else (1 << bits - storage.signed) - 1
        low = 0 if not storage.signed else -high if bits == 32 else -high - 1
        floating = storage.code == _FLOATING
        number = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:E[+-]?[0-9]+)?" if floating else "[+-]?[0-9]{1,10}"
        return cls(storage.code, storage.notation == "ascii", floating, low, high, 10, 1, re.compile(number))

    def read(self, text: str) -> Content:
        """Read one word as a table spells it; raises InvalidValueError with what is allowed."""
        if self.is_text:
            return text
        if self.pattern.fullmatch(text):
            number = float(text) if self.is_floating else int(text, self.base)
            if math.isfinite(number) if self.is_floating else self.low <= number <= self.high:
                return number
        if self.is_floating:
            raise InvalidValueError(f"'{text}' is not a number with a decimal point")
        if self.base == 16:
            raise InvalidValueError(f"'{text}' is not hexadecimal from 0 to {self.high:X}")
        raise InvalidValueError(f"'{text}' is not a whole number from {self.low} to {self.high}")

    def spell(self, content: Content) -> str:
        """Spell a word as the control does; raises InvalidValueError for what the word cannot contain."""
        if isinstance(content, str):
            self.read(spelled_text(content))
            return content
        if not math.isfinite(content):
            raise InvalidValueError(f"{content} is no number that a word can contain")
        if self.is_text or self.is_floating:
            return write_number(content).upper()
        number = round(content)
        if not self.low <= number <= self.high:
            raise InvalidValueError(
                f"{write_number(content)} is outside {self.low} to {self.high}, which the word can contain"
            )
        return f"{number:0{self.digits}X}" if self.base == 16 else str(number)


def spelled_text(text: str) -> str:
    """Return a text that a word may contain; raises InvalidValueError."""
    if not (text.isascii() and text.isprintable()):
        raise InvalidValueError(f"'{text}' contains characters that are not ASCII")
    return text


WORD_TYPES: dict[int, Spelling] = {
    form.code: Spelling.of(form)
    for form in (
        Storage(code=0, bits=8, notation="hex"),
        Storage(code=1, bits=16),
        Storage(code=2, bits=32),
        Storage(code=4, bits=32, signed=False),
        Storage(code=5, bits=16, signed=False),
        Storage(code=6, bits=32, notation="hex"),
        Storage(code=7, bits=16, notation="hex"),
        Storage(code=8, notation="ascii"),
        Storage(code=_FLOATING),
    )
    if form.code is not None
}
"""The types of words by their codes, as page 1-3 prints them."""


# -- which word is which value ---------------------------------------------------


@dataclass(frozen=True, slots=True)
class WordMeaning:
    """A value that a word may be."""

    address: Address
    parameter: Parameter
    unit: str | None
    """In which the control keeps it; None where other words decide:
    millimetres are degrees on an axis that turns."""

    @classmethod
    def of(cls, schema: Schema, address: Address) -> WordMeaning:
        """Return the meaning that a schema gives to one of its values."""
        parameter = schema.parameters[address[0]]
        storage = parameter.storage or Storage()
        straight = storage.unit if storage.unit is not None else schema.unit(parameter, "metric", turns=False)
        # A unit without an angular one (V, ms, %) is the same on every axis.
        fixed = straight == angular(straight) or (storage.unit is None and parameter.unit is not None)
        return cls(address, parameter, straight if fixed else None)

    def unit_in(self, file: ParameterFile) -> str:
        """Return the unit in which the control keeps the value, in the configuration of a file."""
        if self.unit is not None:
            return self.unit
        unit = self.parameter.storage.unit if self.parameter.storage else None
        if unit is None:
            return file.evaluation.unit(self.address, "metric")
        return angular(unit) if file.evaluation.turns(self.address) else unit

    def value(self, file: ParameterFile, content: Content) -> Value:
        """Return the value that the word means; raises InvalidValueError."""
        parameter = self.parameter
        if isinstance(content, str):
            if parameter.type != "text":
                raise InvalidValueError(f"{parameter.name} is no text")
            return checked(parameter, Value(content))
        return checked(parameter, from_stored(parameter, content, self.unit_in(file)))

    def content(self, file: ParameterFile, value: Value) -> Content:
        """Return what the word of a value contains, before it is made a whole number;
        raises InvalidValueError.
        """
        found = value.value
        if self.parameter.choices:
            return code_of(self.parameter, value)
        if isinstance(found, str):
            return found
        stored, entered = self.unit_in(file), value.unit
        if dimension(entered) != dimension(stored):  # the axis turns since, or no longer: the figure stays
            stored, entered = angular(stored), angular(entered)
        return to_figure(self.parameter, Value(found, entered), stored)


def active_meaning(file: ParameterFile, meanings: tuple[WordMeaning, ...]) -> WordMeaning:
    """Return the value a word is: the first that this configuration has, where several share the word."""
    if len(meanings) > 1:
        for meaning in meanings:
            if file.evaluation.state(meaning.address).state != "hidden":
                return meaning
    return meanings[0]


@dataclass(frozen=True)
class KnownWords:
    """The words that a schema has on a machine type."""

    meanings: dict[Word, tuple[WordMeaning, ...]]
    """More than one where the configuration decides what a word means."""
    counts: dict[int, int]
    """Parameter -> how many words it has."""
    forms: dict[int, Spelling]
    """Parameter -> how its words are spelled; those of which nothing is known are texts without a form."""
    heads: dict[int, tuple[int, int]]
    """Parameter -> type and number of its words, where the schema knows the type."""

    def form(self, parameter: int, heads: Mapping[int, tuple[int, int]]) -> Spelling | None:
        """Return how the words of a parameter are spelled: by the schema,
        else by the type that a table gives.
        """
        own = self.forms.get(parameter)
        if (own is None or own.code is None) and parameter in heads:
            return WORD_TYPES[heads[parameter][0]]
        return own


@lru_cache(maxsize=8)
def words_of(schema: Schema, machine: str) -> KnownWords:
    """Return the words of a schema, found by their numbers."""
    meanings: dict[Word, tuple[WordMeaning, ...]] = {}
    counts: dict[int, int] = {}
    forms: dict[int, Spelling] = {}
    here = schema.on(machine)
    for address in here.addresses:
        match = _NUMBER.fullmatch(here.number(address) or "")
        if match is None or here.is_disputed(address[0]):
            continue
        a, b = int(match[1]), int(match[2])
        meaning = WordMeaning.of(schema, address)
        meanings[a, b] = (*meanings.get((a, b), ()), meaning)
        counts[a] = max(counts.get(a, 0), b + 1)
        storage = meaning.parameter.storage or (None if meaning.parameter.type == "text" else Storage())
        # Words of a parameter share one form: the first that has a code of a type is known best.
        if storage is not None and (a not in forms or forms[a].code is None):
            forms[a] = Spelling.of(storage)
    heads = {a: (form.code, counts[a]) for a, form in forms.items() if form.code is not None}
    return KnownWords(meanings, counts, forms, heads)
