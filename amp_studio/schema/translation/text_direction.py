"""Texts of people in Hebrew or Arabic beside what the program writes: neither tears the other apart.

Where a line has letters that are written from right to left, a number, its sign and its unit change places
by the rules of Unicode (UAX #9): ``-3.5 mm`` is seen as ``3.5- mm``. The characters for isolation keep them
together; they are not seen, and nothing but what is shown or printed contains them.
"""

from __future__ import annotations

import re
from pathlib import Path

_FIRST_STRONG, _LEFT_TO_RIGHT, _END = "\u2068", "\u2066", "\u2069"
_FROM_THE_RIGHT = re.compile("[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]")
_NUMBER = re.compile(r"(?<![\w.])[-+−±]?\d+(?:[.,\u202f]\d+)*(?:[ \u00a0\u202f]?[A-Za-zµ°%][A-Za-zµ°%/²]*)?")
"""A number with its sign and its unit; behind a Hebrew word (``ב-3.5 mm``, at 3.5 mm) a hyphen is no sign."""


def isolated(text: str) -> str:
    """Return a text in which each line with letters from right to left is for itself, and its numbers too."""
    if not _FROM_THE_RIGHT.search(text):
        return text
    return "\n".join(_isolated(line) if _FROM_THE_RIGHT.search(line) else line for line in text.split("\n"))


def isolated_path(path: Path) -> str:
    """Return a path in which each name is for itself."""
    return "".join(map(isolated, re.split(r"([/\\])", str(path))))


def _isolated(line: str) -> str:
    numbers = _NUMBER.sub(lambda number: f"{_LEFT_TO_RIGHT}{number[0]}{_END}", line)
    return f"{_FIRST_STRONG}{numbers}{_END}"
