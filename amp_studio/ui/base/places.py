"""Axes by their letters and families by their short names, as a person at the machine calls them."""

from __future__ import annotations

import re

from amp_studio.files import ParameterFile, axis_letter, axis_letters
from amp_studio.report import place_of
from amp_studio.schema import Address, UnknownFamilyError, load_schema
from amp_studio.validate import Finding

from .figures import finding_in_words
from .translated import sentenced, tr, worded

_AXIS = re.compile(r"\b([Aa]xis|Achse) (\d+)(?![\w.])")
"""An axis by its number in a sentence."""


def family_name(key: str) -> str:
    """Return the short name of a family; an unknown key as it is."""
    try:
        found = load_schema(key).family
    except UnknownFamilyError:
        return key
    return found.short or found.name


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
    return sentenced(_with_letters(file, text), file.schema.family.family)


def finding_text(file: ParameterFile, finding: Finding) -> str:
    """Return the message of a finding of a file in the words of the window, its axes by their letters."""
    return _with_letters(file, finding_in_words(finding))


def _with_letters(file: ParameterFile, text: str) -> str:
    """Return a sentence with its axes by their letters; one that is about letters, as of two axes that
    have the same, keeps the numbers.
    """
    if not (named := {found[2] for found in _AXIS.finditer(text)}):
        return text
    letters = axis_letters(file)
    own, every = [letters.get(axis, axis) for axis in named], list(letters.values())
    if any(every.count(each) > 1 or re.search(rf"\b{re.escape(each)}\b", text) for each in own):
        return text
    return _AXIS.sub(lambda found: f"{found[1]} {letters.get(found[2], found[2])}", text)
