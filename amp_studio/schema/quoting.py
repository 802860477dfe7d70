"""How a message repeats what a user wrote: short, and without a character that a terminal would obey."""

from __future__ import annotations

from .visible_text import visible

LONGEST = 60


def quoted(text: str) -> str:
    """Return ``'text'`` for a message, cut to ``LONGEST`` characters, every one of them visible."""
    return f"'{short(text)}'"


def short(text: str) -> str:
    """Return a text for a message, cut to ``LONGEST`` characters, every one of them visible."""
    return visible(text if len(text) <= LONGEST else text[: LONGEST - 1] + "…")
