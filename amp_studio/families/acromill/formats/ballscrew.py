"""The BSC input file of an ACR controller: ballscrew compensation,
a word of one position on each line (page 107).

``X0E.00325`` adds 0.00325 at position 0 of X, which is home;
the positions of an axis follow each other without a gap.
"""

from __future__ import annotations

import re

from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import Address, InvalidValueError, Schema, Value, checked, quoted

_TABLE = "ballscrew.table"
_WORD = re.compile(r"([A-Z])([0-9]{1,6})E-?\.[0-9]{5}")


def _recognises(text: str) -> bool:
    return bool(_WORD.fullmatch(text.lstrip().partition("\n")[0].strip()))


def _read(text: str, schema: Schema, _options: ReadOptions) -> TextRead:
    """Return the tables of a text; raises FormatError for a word out of its order."""
    table = schema.parameters[_TABLE]
    offered = schema.on(schema.family.default_machine).instances(table)
    tables: dict[str, list[str]] = {}
    first: dict[Address, int] = {}
    for n, line in enumerate(text.splitlines(), 1):
        word = line.strip()
        if not word:
            continue
        column = line.index(word) + 1
        match = _WORD.fullmatch(word)
        if match is None:
            raise FormatError(
                f"{quoted(word)} is no word like X0E.00325: letter, position, E, five decimals", n, column
            )
        axis, position = match[1], int(match[2])
        if axis not in offered:
            raise FormatError(f"there is no axis {axis}", n, column)
        words = tables.setdefault(axis, [])
        if position != len(words):
            raise FormatError(f"{word}: the next position of {axis} is {len(words)}", n, column)
        words.append(word)
        first.setdefault((_TABLE, axis), n)
    if not tables:
        raise FormatError("there is no word of compensation")
    try:
        return TextRead(
            {(_TABLE, axis): checked(table, Value(" ".join(words))) for axis, words in tables.items()},
            value_lines=first,
        )
    except InvalidValueError as error:
        raise FormatError(str(error)) from None


def _write(file: ParameterFile) -> str:
    tables = [
        value for a in file.addresses() if a[0] == _TABLE and (value := file.get(a)) and str(value.value)
    ]
    if not tables:
        raise FormatError("no axis has a table of ballscrew compensation")
    return "".join(f"{word}\n" for table in tables for word in str(table.value).split())


FORMAT = TextFormat(
    "bsc", "ballscrew compensation of an ACR controller", ".bsc", _recognises, _read, _write, newline="\r\n"
)
