"""Axes by their letters, as a person at the machine calls them."""

from __future__ import annotations

from amp_studio.files import ParameterFile, axis_letter
from amp_studio.report import place_of
from amp_studio.schema import Address

from .translated import tr, worded


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
