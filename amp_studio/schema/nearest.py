"""The nearest known word, for messages about an unknown one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from difflib import get_close_matches
from functools import lru_cache

_LONGEST = 100
"""Characters of a word that a person mistyped; a longer one is no slip of the hand."""
_SHORT = 12
"""Characters of a word in which two wrong ones count for much."""


def did_you_mean(word: str, known: Iterable[str], *, found: Callable[[str], str] = str) -> str:
    """Return ``, did you mean 'x'?`` or nothing; ``found`` turns the nearest word into the one to show."""
    near = _nearest(word, tuple(known)) if len(word) <= _LONGEST else ""
    return f", did you mean '{found(near)}'?" if near else ""


@lru_cache(maxsize=1024)  # it takes milliseconds, and a file may have the same slip in every line
def _nearest(word: str, known: tuple[str, ...]) -> str:
    return next(iter(get_close_matches(word, known, 1, 0.6 if len(word) < _SHORT else 0.75)), "")
