"""Cells of a CSV file that a spreadsheet takes for the text they are.

A spreadsheet takes a cell that begins with ``=``, ``+``, ``-`` or ``@`` for a formula, which may start
programs or call addresses (OWASP, "CSV Injection"). An apostrophe before it makes it a text;
reading the file back takes it off.
"""

from __future__ import annotations

import re

_FORMULA = re.compile("[\\s']*[=+\\-@\\t\\r\\n\uff1d\uff0b\uff0d\uff20]")
_NUMBER = re.compile(r"[+-]?[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]+)?")
_SAFE = re.compile("'" + _FORMULA.pattern)


def text_cell(text: str) -> str:
    """Return a cell with ``text``: with an apostrophe before what would be a formula.
    A plain number stays one.
    """
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text


def cell_text(cell: str) -> str:
    """Return the text of a cell that ``text_cell`` has written."""
    return cell[1:] if _SAFE.match(cell) and not _NUMBER.fullmatch(cell[1:]) else cell
