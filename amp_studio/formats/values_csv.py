"""Values as a table for a spreadsheet: one line a value, RFC 4180, UTF-8 with the mark Excel looks for.

Any table with the columns ``id``, ``value`` and ``unit`` can be read, the CSV of a report too; ``instance``
may be missing for values of the control as a whole. Other columns are ignored.
"""

from __future__ import annotations

import csv
import io
import re
from typing import Any

from amp_studio.files import ParameterFile, cell_text, note_fault, read_stored, text_cell, value_note
from amp_studio.schema import (
    Address,
    InvalidValueError,
    Parameter,
    Schema,
    Value,
    is_mask,
    read_address,
    short,
    write_value,
    written,
)

from .text_format import FormatError, ReadOptions, TextFormat, TextRead

_HEADS = ("number", "id", "instance", "name", "value", "unit")
_NOTE = "note"
"""A column more, where something is noted about a value of the table."""
_MARK = "\ufeff"
_SEPARATORS = ",;\t"
"""A spreadsheet writes the second one where the decimal separator is a comma, and the last one as Unicode."""

_NAMED = re.compile('"?sep=', re.IGNORECASE)
"""A first line that names to Excel what is between the cells."""


def _recognises(text: str) -> bool:
    return _separator(text) is not None


def _separator(text: str) -> str | None:
    """Return what is between the cells of a table; None for a text that is no table of values."""
    # The mark as latin-1 has it, in which texts are recognised.
    lines = io.StringIO(text.removeprefix(_MARK).removeprefix("ï»¿"))
    head = next(lines, "")
    head = (next(lines, "") if _NAMED.match(head) else head).strip().casefold()
    heads = {mark: {each.strip('" ') for each in head.split(mark)} for mark in _SEPARATORS}
    return next((mark for mark in _SEPARATORS if {"id", "value"} <= heads[mark]), None)


def _rows(text: str) -> Any:
    stream = io.StringIO(text.removeprefix(_MARK), newline="")
    rows = csv.reader(stream, strict=True, delimiter=_separator(text) or _SEPARATORS[0])
    if _NAMED.match(stream.getvalue()):
        next(rows)
    return rows


def _write(file: ParameterFile) -> str:
    """Return the table of a file's values, then of the entries that its schema does not know."""
    stream = io.StringIO(newline="")
    table = csv.writer(stream, lineterminator="\n")
    has_notes = any(value_note(file, address) for address in file.values)
    table.writerow((*_HEADS, _NOTE) if has_notes else _HEADS)
    for address in file.addresses():
        value = file.get(address)
        if value is not None:
            parameter = file.schema.parameters[address[0]]
            number = file.machine_schema.number(address) or ""
            # Without its unit, which has a column: a spreadsheet computes with the number.
            plain = write_value(parameter, Value(value.value))
            cells = (number, *address, parameter.name, plain, value.unit)
            noted = (value_note(file, address),) if has_notes else ()
            table.writerow(map(text_cell, (*cells, *noted)))
    for key, text in file.unknown.items():
        cells = ("", *read_address(key), "", text, "")
        table.writerow(map(text_cell, (*cells, *([""] if has_notes else []))))
    return _MARK + stream.getvalue()


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what a table contains; raises FormatError with line and column."""
    table = _rows(text)
    found = TextRead()
    try:
        heads = [head.strip().casefold() for head in next(table, [])]
        for needed in ("id", "value", "unit"):
            if needed not in heads:
                raise FormatError(f"there is no column '{needed}'", 1)
        for cells in table:
            if any(cell.strip() for cell in cells):
                _read_row(found, schema, heads, cells, table.line_num, options.keep_unknown)
    except csv.Error as error:
        raise FormatError(f"this is no line of a table: {error}", table.line_num) from None
    return found


def _has_all_ids(text: str, schema: Schema) -> bool:
    """Return whether a family has all ids of a table."""
    try:
        heads, *rows = _rows(text.casefold())
    except csv.Error:
        return False  # the reader names the line
    ids = (
        dict(zip(heads, cells, strict=False)).get("id", "") for cells in rows if any(map(str.strip, cells))
    )
    return bool(rows) and all(cell_text(each).strip() in schema.parameters for each in ids)


def _has_instance(schema: Schema, parameter: Parameter, instance: str) -> bool:
    """Return whether a parameter has an instance on some machine type."""
    machines = schema.family.machines
    return any(instance in schema.on(machine.key).instances(parameter) for machine in machines)


def _value_text(parameter: Parameter | None, row: dict[str, str]) -> tuple[str, bool]:
    """Return the text of a value with its unit, and whether it sets nothing."""
    # A text has no unit, its blanks are its own, and an empty one is a value.
    if parameter is not None and parameter.type == "text":
        return row["value"], False
    return f"{row['value']} {row['unit']}".strip(), not row["value"].strip()


def _read_row(
    result: TextRead, schema: Schema, heads: list[str], cells: list[str], line: int, keep_unknown: bool
) -> None:
    """Take one row of a table; raises FormatError with line and column."""
    # A decimal comma that is not quoted adds a cell: every value behind it would be in the wrong column.
    if len(cells) != len(heads):
        raise FormatError(f"{len(cells)} cells below {len(heads)} columns", line)
    row = dict(zip(heads, map(cell_text, cells), strict=True))
    address: Address = (row["id"].strip(), row.get("instance", "").strip())
    parameter = schema.parameters.get(address[0])
    text, is_empty = _value_text(parameter, row)
    column = heads.index("id") + 1
    if parameter is None or not _has_instance(schema, parameter, address[1]):
        if not keep_unknown:
            raise FormatError(f"{schema.family.name} has no {short(written(address))}", line, column)
        _keep_unknown(result, written(address), text, line, column)
        return
    if address in result.values:
        raise FormatError(f"{written(address)} occurs twice", line, column)
    if is_empty:
        return
    if is_mask(parameter, row["value"]):
        result.notes.append(f"{written(address)} is a secret that this table does not contain; it is not set")
        return
    try:
        result.values[address] = read_stored(schema, parameter, text)
        result.value_lines[address] = line
    except InvalidValueError as error:
        raise FormatError(f"{written(address)}: {error}", line, heads.index("value") + 1) from None
    if note := row.get(_NOTE, "").strip():
        result.value_notes[written(address)] = _checked_note(note, address, line, heads)


def _checked_note(note: str, address: Address, line: int, heads: list[str]) -> str:
    if problem := note_fault(note):
        raise FormatError(f"{written(address)}: {problem}", line, heads.index(_NOTE) + 1)
    return note


def _keep_unknown(result: TextRead, name: str, text: str, line: int, column: int) -> None:
    """Keep a value that the family does not have; raises FormatError where it occurs twice."""
    if name in result.unknown:
        raise FormatError(f"{short(name)} occurs twice", line, column)
    result.unknown[name] = text
    result.unknown_lines[name] = line


FORMAT = TextFormat(
    "csv",
    "table of values",
    ".csv",
    _recognises,
    _read,
    _write,
    newline="\r\n",
    is_of=_has_all_ids,
    otherwise="cp1252",
)
