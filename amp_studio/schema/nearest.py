"""The nearest known names, for messages about an unknown one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache

from .quoting import quoted

_LONGEST = 100
"""Characters of a word that a person mistyped; a longer one is no slip of the hand."""
_SHOWN = 3
"""Names that come near."""
_FEW = 12
"""Most names of which all are listed."""
_SHORT = 12
"""Characters of a word in which two wrong ones count for much."""


def close_matches(word: str, known: Iterable[str], most: int, ratio: float) -> list[str]:
    """Return the known words that are most alike, the nearest first."""
    from difflib import get_close_matches  # most starts meet no unknown name

    return get_close_matches(word, known, most, ratio)


def did_you_mean(word: str, known: Iterable[str], *, found: Callable[[str], str] = str) -> str:
    """Return ``, did you mean 'x'?`` or nothing; ``found`` turns the nearest word into the one to show."""
    near = _nearest(word, tuple(known)) if len(word) <= _LONGEST else ""
    return f", did you mean '{found(near)}'?" if near else ""


def unknown_name(what: str, name: str, known: Iterable[str]) -> str:
    """Return the message for an unknown name: the names that come near, and all of them where they are
    few.
    """
    names = list(dict.fromkeys(known))
    # Reversed, so that of two names that differ in case the first one is shown.
    by_small = {known_name.casefold(): known_name for known_name in reversed(names)}
    near = close_matches(name.strip().casefold()[:_LONGEST], by_small, _SHOWN, 0.6)
    parts = [f"Unknown {what} {quoted(name)}"]
    if len(names) <= _FEW:
        parts.append(f"Known: {', '.join(names)}" if names else "There are none")
    if near:
        parts.append(f"Did you mean: {', '.join(by_small[word] for word in near)}")
    return ". ".join(parts)


@lru_cache(maxsize=1024)  # it takes milliseconds, and a file may have the same slip in every line
def _nearest(word: str, known: tuple[str, ...]) -> str:
    return next(iter(close_matches(word, known, 1, 0.6 if len(word) < _SHORT else 0.75)), "")
