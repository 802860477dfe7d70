"""Words as the tasks of the 57C422B are written with: whole numbers,
decimal or hexadecimal (pages 4-48 and 5-5).
"""

from __future__ import annotations

import re

from amp_studio.schema import InvalidValueError, quoted

_DECIMAL = re.compile(r"[+-]?[0-9]{1,20}(?:\.0{0,20})?")
_HEXADECIMAL = re.compile(r"([0-9][0-9A-F]{0,19})H", re.IGNORECASE)


def write_hexadecimal(pattern: int) -> str:
    """Write the bits of a word as the tasks of the manual do: ``01414H``, ``02H``, ``01DH`` (page 5-5),
    ``0H``.
    """
    return f"0{pattern:X}H" if pattern else "0H"


def read_word(text: str) -> tuple[int, bool]:
    """Read a whole number, and return whether it is hexadecimal: the bits as they are.
    Raises InvalidValueError.
    """
    text = text.strip()
    if match := _HEXADECIMAL.fullmatch(text):
        return int(match[1], 16), True
    if _DECIMAL.fullmatch(text):
        return int(text.partition(".")[0]), False
    raise InvalidValueError(f"{quoted(text)} is no whole number, as 1984, -1 or 01414H")
