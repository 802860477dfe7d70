"""What a control that takes single values contains after a break, from what it is read to contain."""

from __future__ import annotations

from collections.abc import Mapping

from .errors import AtControl

_MAX_NAMED = 20


def _shortened(names: list[str]) -> tuple[str, ...]:
    """Return so many names as a sentence can have, and how many more there are."""
    more = [f"{len(names) - _MAX_NAMED} more"] if len(names) > _MAX_NAMED else []
    return (*names[:_MAX_NAMED], *more)


def state_after_break(
    current: Mapping[str, str], wanted: Mapping[str, str], now: Mapping[str, str]
) -> tuple[AtControl, tuple[str, ...]]:
    """Return what the control contains, and the numbers of what is new already if that is a part of it.

    ``current`` is what it contained, ``wanted`` what it was to contain, ``now`` what it was read to contain.
    Something that is neither old nor new is not known for either.
    """
    names = sorted({*current, *wanted, *now}, key=_by_numbers)
    changed = [name for name in names if current.get(name) != wanted.get(name)]
    other = [name for name in names if now.get(name) not in (current.get(name), wanted.get(name))]
    if other:
        return "unknown", ()
    new = [name for name in changed if now.get(name) == wanted.get(name)]
    if len(new) == len(changed):
        return "new", ()
    if not new:
        return "old", ()
    return "mixed", _shortened(new)


def _by_numbers(name: str) -> tuple[object, ...]:
    """Order P9N2 before P10N0."""
    parts, digits = [], ""
    for character in f"{name} ":
        if character.isdigit():
            digits += character
            continue
        if digits:
            parts.append((1, int(digits), ""))
            digits = ""
        parts.append((0, 0, character))
    return tuple(parts)
