"""What a script contains besides settings: kept in the parameter file, and written back in its place.

Each line that is not understood is an unknown entry of the parameter file (``acr line 5: PLC0``). Where they
were is kept in the header, as the list of all lines of the script: a setting is there as a placeholder,
``{axes.pulses@X}``, so that its value is in one place only, and so is a line that is not understood,
``{line 5}``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from amp_studio.files import ParameterFile

from .text_format import FormatError, TextRead

T = TypeVar("T")


@dataclass(frozen=True)
class PassthroughLine:
    """A line of a script: text with placeholders, and the name it is kept by where it is not understood."""

    text: str
    kept_as: str = ""


def keep_lines(result: TextRead, kind: str, rows: Sequence[PassthroughLine], *, always: bool = False) -> None:
    """Keep the lines of a script where one of them is not understood, or ``always``;
    ``kind`` is a word for its format.
    """
    unknown = {f"{kind} line {row.kept_as}": row.text for row in rows if row.kept_as}
    if unknown or always:
        result.unknown = unknown
        result.unknown_lines = {
            f"{kind} line {row.kept_as}": n for n, row in enumerate(rows, 1) if row.kept_as
        }
        result.extra[f"{kind}_script"] = {"lines": [_row_text(row) for row in rows]}


def lines_kept(file: ParameterFile, kind: str) -> list[str] | None:
    """Return the lines of a file's script, with placeholders for its settings; None where nothing is kept.

    Raises FormatError for a kept line whose place is lost: what it does there is unknown.
    """
    start = f"{kind} line "
    unknown = {key.removeprefix(start): text for key, text in file.unknown.items() if key.startswith(start)}
    entry = file.header.extra.get(f"{kind}_script")
    lines = entry.get("lines") if isinstance(entry, dict) else None
    rows = []
    for line in lines if isinstance(lines, list) else []:
        match = re.fullmatch(r"\{line (.*)\}", str(line))
        if match is None:
            rows.append(str(line))
        elif match[1] in unknown:
            # Taken away: what is left at the end has no place in the script.
            rows.append(unknown.pop(match[1]))
    if unknown:
        lost = f"{start}{next(iter(unknown))}"
        raise FormatError(
            f"'{lost}' is kept in the file, and '{kind}_script' in its header does not show where it was"
        )
    return rows or None


def _row_text(row: PassthroughLine) -> str:
    return placeholder(f"line {row.kept_as}") if row.kept_as else row.text


# -- placeholders


def placeholder(what: str) -> str:
    """Return what is in the place of a setting."""
    return f"{{{what}}}"


def placeholder_in(text: str) -> str | None:
    """Return what a placeholder is for; None for text that is none."""
    text = text.strip()
    return text[1:-1] if text.startswith("{") and not text.startswith("{{") and text.endswith("}") else None


def escaped(text: str) -> str:
    """Return text so that it is not taken for a placeholder; ``unescaped`` gives it back."""
    at = len(text) - len(text.lstrip())
    return text[:at] + "{" + text[at:] if text[at:].startswith("{") else text


def unescaped(text: str) -> str:
    """Return the text that ``escaped`` made safe."""
    at = len(text) - len(text.lstrip())
    return text[:at] + text[at + 1 :] if text[at:].startswith("{{") else text


def neighbours(
    order: Iterable[T], there: Iterable[T], lines: Mapping[T, int] | None = None
) -> dict[T | None, list[T]]:
    """Return where what is not there yet belongs: behind the one before it in ``order``, None for the front.

    With the lines of those that are there it is that of all before it which comes last.
    """
    present, last = set(there), None
    found: dict[T | None, list[T]] = {}
    for one in order:
        if one in present:
            if lines is None or last is None or lines[one] > lines[last]:
                last = one
        else:
            found.setdefault(last, []).append(one)
    return found
