"""Ballscrew compensation: appendix A.

A table is one text of words parted by blanks, as the lines of the file the control reads: ``X0E.00325``, the
letter of the axis, the position counted from home, and what is added there.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from amp_studio.validate import finite, whole

_WORD = re.compile(r"([A-Z])(\d+)E(-?\.\d{5})")


def ballscrew_mean(measured: Sequence[float]) -> float:
    """Mean of what was measured at a position (page 107): 1.996, 1.998, 1.995 and 1.998 give 1.99675."""
    if not measured:
        raise ValueError("A mean needs at least one measured position.")
    return sum(finite("A measured position", value) for value in measured) / len(measured)


def ballscrew_difference(position: float, measured: Sequence[float]) -> float:
    """Compensation at a position: where the axis should be less the mean of where it was (page 107)."""
    return finite("The position", position) - ballscrew_mean(measured)


def ballscrew_words(axis: str, differences: Sequence[float], home: float) -> str:
    """Table of an axis from the compensation at positions 0, 1, 2, …,
    begun at the position of home (page 107).

    Positions before home wrap around to its end. With home at 2 and 42 positions, position 2 is word 0 and
    positions 0 and 1 are words 40 and 41.
    """
    if not re.fullmatch("[A-Z]", axis):
        raise ValueError(f"{axis!r} is no letter of an axis.")
    first = whole("The position of home", home, least=0)
    if first >= len(differences):
        raise ValueError(f"Home at {first} lies outside the {len(differences)} positions.")
    turned = [*differences[first:], *differences[:first]]
    return " ".join(f"{axis}{n}E{_figure(difference)}" for n, difference in enumerate(turned))


def _figure(difference: float) -> str:
    """Write a compensation as the file does: five decimals and no digit before the point."""
    text = f"{finite('A compensation', difference):.5f}"
    sign, digits = ("-", text[1:]) if text.startswith("-") else ("", text)
    if not digits.startswith("0."):
        raise ValueError(
            f"A compensation of {difference!r} has digits before the point, for which no form is printed."
        )
    # No minus before a compensation that is rounded to nothing.
    return (sign if digits != "0.00000" else "") + digits[1:]


def is_ballscrew_table(axis: str, table: str) -> bool:
    """Whether a text is a table of this axis: a word for each position from 0 on, without a gap (page
    107).
    """
    words = [_WORD.fullmatch(word) for word in table.split()]
    return bool(words) and all(
        word is not None and word[1] == axis and word[2] == str(n) for n, word in enumerate(words)
    )


def ballscrew_positions(table: str) -> float:
    """Number of positions that a table has a word for; beyond its last one it wraps around (page 107)."""
    return float(len(table.split()))


def ballscrew_offset(primary: float, secondary: float, backlash: float) -> float:
    """Ballscrew compensation at work: secondary less primary setpoint,
    less backlash where it is used (page 107).
    """
    given = finite("The secondary setpoint", secondary) - finite("The primary setpoint", primary)
    return given - finite("Backlash", backlash)
