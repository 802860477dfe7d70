"""Lines of measured points as cells: what separates them, what is a comment, and numbers without guessing.

A decimal comma is never taken for granted: 1,5 may be two numbers. It is refused until a person confirms it.
"""

from __future__ import annotations

import csv
import re
from fractions import Fraction

from .errors import MeasurementError

_MAX_LINES = 100_000
_LONGEST_LINE = 10_000
_COMMENT = re.compile(r"\s*(#|//|!|%|;|'|\*)")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,2})?")
_LONGEST_NUMBER = 40
# Two decimal commas with blanks between: as cells that commas separate, the middle one would be two
# numbers.
_COMMA_PAIR = re.compile(r"\s*[+-]?[0-9]+,[0-9]+(?:\s+[+-]?[0-9]+,[0-9]+)+\s*")
# 0,005 read as two cells gives 005: no program writes a number so.
_LEADING_ZERO = re.compile(r"[+-]?0[0-9]+")
_COMMA_NUMBER = re.compile(r"[+-]?[0-9]+,[0-9]+")
_ASK_COMMA = "name the decimal sign (a decimal comma is not guessed)"


def lines_of(text: str) -> list[tuple[int, str]]:
    """Return the lines that are no comments, with their numbers;
    raises MeasurementError for what is too long.
    """
    lines = text.removeprefix("\ufeff").splitlines()
    if len(lines) > _MAX_LINES:
        raise MeasurementError(f"{len(lines)} lines are too many: {_MAX_LINES} at most")
    kept = []
    for n, line in enumerate(lines, 1):
        if len(line) > _LONGEST_LINE:
            raise MeasurementError(f"the line has more than {_LONGEST_LINE} characters", n)
        if line.strip() and not _COMMENT.match(line):
            # Word processors and web pages put the typographic minus sign in place of the hyphen.
            kept.append((n, line.replace("\u2212", "-")))
    return kept


def separator_of(line: str, decimal: str) -> str:
    """Return what separates the cells of a line: a character, or "" for blanks."""
    # First: where the comma is the decimal separator, spreadsheets separate by semicolons.
    if ";" in line:
        return ";"
    if "\t" in line.strip():
        return "\t"
    if "," not in line or decimal == "comma" or _COMMA_PAIR.fullmatch(line):
        return ""
    return ","


def split(line: str, separator: str, number: int) -> list[str]:
    """Return the cells of a line; one empty cell at its end is none."""
    if not separator:
        return line.split()
    try:
        (cells,) = csv.reader([line.strip(" ")], delimiter=separator, strict=True)
    except (csv.Error, ValueError) as error:
        raise MeasurementError(f"this is no line of a table ({error})", number) from None
    if len(cells) > 1 and not cells[-1].strip():
        cells.pop()
    return [cell.strip() for cell in cells]


def is_number(cell: str) -> bool:
    """Return whether a cell is meant as a number, with point or comma."""
    return bool(_NUMBER.fullmatch(cell) or _COMMA_NUMBER.fullmatch(cell))


def number_of(cell: str, decimal: str, separator: str, line: int) -> Fraction:
    """Return the number of a cell, exact; raises MeasurementError."""
    text = _with_point(cell, decimal, line)
    if len(text) > _LONGEST_NUMBER or not _NUMBER.fullmatch(text):
        raise MeasurementError(f"'{cell[:40]}' is no number" if cell else "a cell is empty", line)
    if separator == "," and _LEADING_ZERO.fullmatch(text):
        raise MeasurementError(f"{cell[:40]} may be what follows a decimal comma: {_ASK_COMMA}", line)
    value = Fraction(text)
    if abs(value) > 10**9:
        raise MeasurementError(f"{cell} is too large", line)
    return value


def _with_point(cell: str, decimal: str, line: int) -> str:
    """Return a cell with a decimal point; raises MeasurementError where its sign is not the chosen one."""
    if "," in cell and _COMMA_NUMBER.fullmatch(cell):
        if decimal != "comma":
            raise MeasurementError(f"{cell[:40]} may have a decimal comma: {_ASK_COMMA}", line)
        return cell.replace(",", ".")
    if decimal == "comma" and "." in cell:
        raise MeasurementError(f"{cell[:40]} has a point, and the decimal sign is to be a comma", line)
    return cell
