"""The number of a word by its word format: digits before and behind the point,
and the place of a number without a point.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from amp_studio.schema import quoted

Justified = Literal["", "right", "left", "both"]
"""The end of the format to which the digits of a number without a point are set:
``right`` with leading zeros left out."""


@dataclass(frozen=True)
class WordNumber:
    """What a control reads."""

    value: float | None
    fault: str = ""
    """Why it is none."""
    assumed: str = ""
    """What no page states of it."""


def digits_of(choice: str, inch: bool) -> tuple[int, int]:
    """Return the digits before and behind the point of a format: 3 and 4 of ``3.4-4.3`` in inch."""
    in_inch, _, metric = choice.partition("-")
    before, _, behind = (in_inch if inch or not metric else metric).partition(".")
    return int(before), int(behind or 0)


@dataclass(frozen=True)
class NumberFormat:
    """How the numbers of a word are read."""

    digits: tuple[int, int] | None = None
    """Before and behind the point; None where they are not known."""
    justified: Justified = ""
    assumed: str = ""
    """What no page states of it."""
    is_whole: bool = False
    """Whether it is a whole number of any size."""


def number_of(typed: str, form: NumberFormat) -> WordNumber:
    """Return the number of a word by its format."""
    if form.digits is None and not form.is_whole:
        return WordNumber(float(typed), assumed=form.assumed)
    figures = typed.lstrip("+-")
    whole, point, decimals = figures.partition(".")
    if form.justified == "both" and not point:
        return WordNumber(None, "both zero suppression modes are on: a number without a point has no place")
    if form.digits is None:
        if decimals.strip("0"):
            return WordNumber(None, f"{quoted(figures)} is no whole number")
        return WordNumber(float(typed))
    if not point:
        return _without_point(typed, figures, form.digits, form.justified)
    before, behind = form.digits
    # Zeros outside of the format change no number: they are taken, and named as assumed.
    if len(whole.lstrip("0")) > before or len(decimals.rstrip("0")) > behind:
        return _too_many(figures, form.digits)
    return WordNumber(float(typed), assumed=_zeros_assumed(whole, decimals, form.digits))


def _without_point(typed: str, figures: str, digits: tuple[int, int], justified: Justified) -> WordNumber:
    """Return a number by the place of its digits, which the zeros that are left out decide."""
    before, behind = digits
    if len(figures) > before + behind:
        return WordNumber(
            None,
            f"{quoted(figures)} has more than the {before + behind} digits of the format {before}.{behind}",
        )
    if justified:
        # Leading zeros left out: the last digit is the last decimal. Trailing ones: the first is the
        # highest.
        placed = figures if justified == "right" else figures.ljust(before + behind, "0")
        # By the text, so that 12345 with three decimals is 12.345 and no product that is off by a bit.
        return WordNumber(float(f"{'-' * typed.startswith('-')}{placed}e-{behind}"))
    if len(figures.lstrip("0")) > before:
        return _too_many(figures, digits)
    whole_units = "that a number without a point counts whole units while no zeros are left out"
    return WordNumber(float(typed), assumed=whole_units if behind else "")


def _too_many(figures: str, digits: tuple[int, int]) -> WordNumber:
    return WordNumber(
        None, f"{quoted(figures)} has more digits than the format {digits[0]}.{digits[1]} allows"
    )


def _zeros_assumed(whole: str, decimals: str, digits: tuple[int, int]) -> str:
    """Return what is assumed of zeros that the format has no place for; "" without such zeros."""
    before, behind = digits
    if len(whole) > max(before, 1) or len(decimals) > behind:
        return f"that the control takes zeros beyond the format {before}.{behind}"
    return ""
