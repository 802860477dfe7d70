"""Axes by their letters, as a person at the machine calls them."""

from __future__ import annotations

import re

from amp_studio.files import ParameterFile, axis_letter
from amp_studio.report import place_of
from amp_studio.schema import Address

from .translated import sentenced, tr, worded

_AXIS = re.compile(r"\b([Aa]xis) (\d+)(?![\w.])")
"""An axis by its number in a sentence of the simulation."""


def place_in_words(file: ParameterFile, address: Address) -> str:
    """Return ``X axis``, the label of a spindle, gear or axis without a letter,
    or nothing for a value of the whole control.
    """
    if file.evaluation.scope(address) != "axis" or not (letter := axis_letter(file, address[1])):
        return worded(file.machine_schema.instance_label(address))
    place = place_of(file, address)
    return tr("{letter} axis").format(letter=letter) if place == letter else worded(place)


def short_place(file: ParameterFile, address: Address) -> str:
    """Return the letter of an axis alone; else as ``place_in_words``."""
    letter = axis_letter(file, address[1]) if file.evaluation.scope(address) == "axis" else ""
    return letter or worded(file.machine_schema.instance_label(address))


def sentenced_with_letters(file: ParameterFile, text: str) -> str:
    """Return a sentence about a file in the words of the window, its axes by their letters."""

    def called(found: re.Match[str]) -> str:
        return f"{found[1]} {axis_letter(file, found[2]) or found[2]}"

    return sentenced(_AXIS.sub(called, text), file.schema.family.family)
