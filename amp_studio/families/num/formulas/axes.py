"""Axes, their names and groups, and the pairs they make: chapter 4."""

from __future__ import annotations

from collections.abc import Sequence

_NAMES = ("X", "Y", "Z", "U", "V", "W", "A", "B", "C")
"""In the order of their codes in P9 (pages 4-3 and 4-24)."""
_NONE = 255


def axis_name(word: float) -> str:
    """Name and group that a word of P9 gives an axis (page 4-24): 0x15 is "W of group 2", 0xFF "no axis"."""
    code = _checked(word)
    if code == _NONE:
        return "no axis"
    group, name = divmod(code, 16)
    return f"{_NAMES[name] if name < len(_NAMES) else '?'} of group {group + 1}"


def assignment_word(name: str, group: int) -> int:
    """Word of P9 for an axis name and a group of 1 to 8 (page 4-24): C of group 3 is 0x28."""
    if name not in _NAMES:
        raise ValueError(f"An axis name is one of {', '.join(_NAMES)}, not {name!r}.")
    if not 1 <= group <= 8:
        raise ValueError(f"An axis group is 1 to 8, not {group}.")
    return (group - 1) * 16 + _NAMES.index(name)


def limited_in_force(modulo: float, limited: float) -> int:
    """Word P1N1 as the control takes it (page 4-12): an axis in both words of P1 is a modulo one.

    Modulo 0x20 and limited 0x120 leave 0x100.
    """
    return int(limited) & ~int(modulo)


def carried_partner(word: float) -> float:
    """Word of P9 of the axis that makes a carrier and carried pair with this one (page 4-34): U for X,
    X for U.

    -1 for an axis that has no such partner, a rotary one or none at all.
    """
    code = _checked(word)
    name = code % 16
    if name < 3:
        return float(code + 3)
    return float(code - 3) if name < 6 else -1.0


def follows_itself(axis: float, drives: Sequence[str | None]) -> bool:
    """Whether the drive axes of P27 lead from an axis back to it, so that none of them leads (page 4-30).

    With axis-1, axis-2 and axis-0 for the axes 0 to 2 each of them does.
    """
    at, passed = int(axis), set[int]()
    while at not in passed:
        passed.add(at)
        named = drives[at] if at < len(drives) else None
        if named is None or not named.startswith("axis-"):
            return False
        at = int(named.removeprefix("axis-"))
    return at == int(axis)


def indexing_increment(degrees: float) -> float:
    """Value of P65 for an indexing step in degrees (page 4-36): 0.5 degrees are 5000."""
    if degrees < 0.0:
        raise ValueError(f"A step is not negative, as {degrees:g} is.")
    # Rounded: 0.1 degrees are 1000, and not a hair less.
    return round(degrees * 10000.0, 6)


def _checked(word: float) -> int:
    if not 0.0 <= word <= _NONE or word != int(word):
        raise ValueError(f"A word of P9 has 8 bits, {word:g} does not fit.")
    return int(word)
