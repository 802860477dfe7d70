"""How values are keyed in at a control: what it takes, how it spells them,
and what a person does before and after.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    StorageError,
    Value,
    choice_key,
    exact,
    label_of,
    load_part,
    registration_of,
    shown_number,
    stored_number,
    stored_unit,
    to_stored,
    unit_text,
    write_number,
)

NOT_OFFERED = "it cannot be keyed in at the control"


@dataclass(frozen=True)
class Keyed:
    """What a person keys in for a value, or reads on the screen: the text, its unit as it is shown,
    the base of its digits.
    """

    text: str
    unit: str = ""
    base: int = 10
    is_rounded: bool = field(default=False, compare=False)
    """The value itself has more decimals than the control shows."""

    def number(self, text: str) -> Fraction | None:
        """Return the number that a text on the screen is, where this value is shown as one;
        None for a text that is none.
        """
        unit_text = text.strip()
        if self.base == 16:
            return Fraction(int(unit_text, 16)) if re.fullmatch("[0-9A-Fa-f]{1,16}", unit_text) else None
        # Who reads a screen may type the decimal comma of his own keyboard.
        plain = unit_text.replace(",", ".", 1) if "." not in unit_text else unit_text
        return (
            Fraction(plain)
            if re.fullmatch(r"[+-]?([0-9]{1,30}(\.[0-9]{0,30})?|\.[0-9]{1,30})", plain)
            else None
        )

    def shows(self, text: str) -> bool:
        """Return whether a text on the screen is this value: the same number, or the same text."""
        own = self.number(self.text)
        return self.text == text.strip() if own is None else own == self.number(text)


@dataclass(frozen=True)
class Instruction:
    """What a person does before or after; ``page`` of the family's manual,
    "" where it prints nothing about it.
    """

    text: str
    page: str = ""


@dataclass(frozen=True)
class Stage:
    """Values that are keyed in together, why they come here, and the page for it."""

    title: str
    why: str = ""
    page: str = ""


def plain_text(file: ParameterFile, address: Address, value: Value) -> Keyed | None:
    """Return the number a control stores, where the manual prints its form,
    else the value in the file's own unit system.
    """
    parameter, turns = file.schema.parameters[address[0]], file.evaluation.turns(address)
    stored = stored_number(parameter, value, turns=turns)
    if stored is not None:
        unit = stored_unit(parameter, turns=turns)
        is_rounded = exact(stored) != to_stored(parameter, value, unit)
        return Keyed(_plain_digits(stored), unit_text(unit), is_rounded=is_rounded)
    if parameter.choices:
        return Keyed(label_of(parameter, choice_key(value)))
    if isinstance(value.value, str):
        return Keyed(value.value)
    unit = file.evaluation.unit(address, file.header.units)
    try:
        return Keyed(
            _plain_digits(shown_number(parameter, to_stored(parameter, value, unit))), unit_text(unit)
        )
    except StorageError:
        return Keyed(_plain_digits(value.value), unit_text(value.unit))


def _plain_digits(number: float) -> str:
    """Return a number as keys take it: shortest round trip, never with an exponent."""
    return format(Decimal(write_number(number)), "f")


def _nothing_left_out(_file: ParameterFile, _address: Address) -> str:
    """Return no reason why a value could not be keyed in."""
    return ""


def _one_stage(_before: ParameterFile, _after: ParameterFile, _address: Address) -> int:
    """Return the only stage."""
    return 0


@dataclass(frozen=True)
class Keying:
    """How the controls of one family are keyed into.

    ``title``   of the sheet
    ``obstacle`` the reason why a value cannot be keyed in at the control, "" where it can
    ``text``    what is keyed in for a value, which the screen shows afterwards; None where the manual prints
                no form
    ``stages``, ``stage``  the order in which values are keyed in where no rule needs another one: the stage
                           of a value by what the control contains before and after
    ``before``, ``after``  what a person does around it
    """

    title: str = "Sheet for entering values"
    obstacle: Callable[[ParameterFile, Address], str] = _nothing_left_out
    text: Callable[[ParameterFile, Address, Value], Keyed | None] = plain_text
    stages: tuple[Stage, ...] = (Stage(""),)
    stage: Callable[[ParameterFile, ParameterFile, Address], int] = _one_stage
    before: tuple[Instruction, ...] = ()
    after: tuple[Instruction, ...] = ()


def keying_of(family: str) -> Keying:
    """Return how a family's controls are keyed into: its own record, or the plain one."""
    place = registration_of(family).sheet
    found = load_part(place) if place else Keying()
    assert isinstance(found, Keying)
    return found
