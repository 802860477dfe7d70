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


def number_of(typed: str, digits: tuple[int, int] | None, justified: Justified) -> WordNumber:
    """Return the number of a word; ``digits`` are those of its format, None where it is not known."""
    sign = "-" * typed.startswith("-")
    figures = typed.lstrip("+-")
    whole, point, decimals = figures.partition(".")
    if digits is None:
        return WordNumber(float(typed))
    before, behind = digits
    too_many = WordNumber(None, f"{quoted(figures)} has more digits than the format {before}.{behind} allows")
    if point:
        if len(whole.lstrip("0")) > before or len(decimals.rstrip("0")) > behind:
            return too_many
        return WordNumber(float(typed), assumed=_zeros_assumed(whole, decimals, digits))
    if justified == "both":
        return WordNumber(None, "both zero suppression modes are on: a number without a point has no place")
    if len(figures) > before + behind:
        return WordNumber(
            None,
            f"{quoted(figures)} has more than the {before + behind} digits of the format {before}.{behind}",
        )
    placed = {"right": figures, "left": figures.ljust(before + behind, "0")}
    if justified in placed:
        return WordNumber(float(f"{sign}{placed[justified]}e-{behind}"))
    if len(figures.lstrip("0")) > before:
        return too_many
    whole_units = "that a number without a point counts whole units while no zeros are left out"
    return WordNumber(float(typed), assumed=whole_units if behind else "")


def _zeros_assumed(whole: str, decimals: str, digits: tuple[int, int]) -> str:
    """Return what is assumed of zeros that the format has no place for; "" without such zeros."""
    before, behind = digits
    if len(whole) > max(before, 1) or len(decimals) > behind:
        return f"that the control takes zeros beyond the format {before}.{behind}"
    return ""
