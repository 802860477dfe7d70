"""The values of a file, to be found by what a person reads: a number with or without a unit, a choice,
a text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from amp_studio.files import ParameterFile, all_notes
from amp_studio.schema import (
    Address,
    InvalidValueError,
    UnitError,
    convert,
    dimension,
    read_address,
    read_number,
    unit_named,
)

from .entries import Entry
from .words import words_of

_HEX = re.compile("0[xX][0-9a-fA-F]{1,16}")


class Number(NamedTuple):
    """A number as it is asked for; ``unit`` is None where none was written."""

    value: float
    unit: str | None


def asked_number(query: str) -> Number | None:
    """Return the number that a question is: ``12.7``, ``12.7 mm``, ``0x0F``; None where it is something
    else.
    """
    if _HEX.fullmatch(query.strip()):
        # Without a unit, not with any: a length is not asked for in hexadecimal.
        return Number(int(query, 16), "")
    try:
        value, rest = read_number(query.strip())
        return Number(value, unit_named(rest) if rest.strip() else None)
    except (InvalidValueError, UnitError):
        return None


class FileValues:
    """The values of a file at one moment. A secret is not among them."""

    def __init__(self, file: ParameterFile) -> None:
        self._numbers: dict[tuple[float, str], list[Address]] = {}
        """Number and unit -> the addresses with this value."""
        self.choices: dict[tuple[str, str], list[Address]] = {}
        """Parameter and key of a choice -> the addresses that have it."""
        self._texts: list[tuple[Address, str]] = []
        parameters = file.schema.parameters
        for address, value in file.values.items():
            parameter = parameters[address[0]]
            # A search that finds a password by its value would confirm a guess.
            if parameter.secret:
                continue
            if isinstance(value.value, str) and parameter.choices:
                self.choices.setdefault((address[0], value.value), []).append(address)
            elif isinstance(value.value, str):
                self._texts.append((address, value.value))
            elif not isinstance(value.value, bool):
                self._numbers.setdefault((float(value.value), value.unit), []).append(address)

    def having(self, number: Number) -> list[Address]:
        """Return the addresses with a number in the unit it was entered in, or with the same length, time,
        … in another.
        """
        matching: list[Address] = []
        for (value, unit), addresses in self._numbers.items():
            sought = number.value
            if number.unit is not None and unit != number.unit:
                if dimension(unit) != dimension(number.unit):
                    continue
                sought = convert(number.value, number.unit, unit)
            # Not equal: a conversion, as from inches, rounds in the last bits.
            if abs(value - sought) <= 1e-9 * abs(sought):
                matching += addresses
        return matching

    def entries(self, file: ParameterFile) -> Iterator[Entry]:
        """Yield texts of the file and notes of people, to be searched by word."""
        for address, text in self._texts:
            if words_of(text):
                yield Entry("value", text, address[0], (("value", text),), address[1])
        for note in all_notes(file):
            note_text = " ".join(note.text.split())
            if note.subject == "group" and any(group.key == note.about for group in file.schema.groups):
                yield Entry("group", f"{note.label}: {note_text}", note.about, (("note", note_text),))
            elif (
                note.subject == "value"
                and (address := read_address(note.about)) in file.machine_schema.places
            ):
                yield Entry("note", note_text, address[0], (("note", note_text),), address[1])
