"""The printed tables of a manual, for a person who looks a value up."""

from __future__ import annotations

import textwrap
from itertools import zip_longest

from amp_studio.schema import Parameter, Schema, Table, unit_text, write_number

_WIDTH = 100
_INDENT = "  "


def tables_of(schema: Schema, parameter: Parameter) -> list[Table]:
    """Return the printed tables in which the value of a parameter is looked up."""
    return [table for table in schema.tables.values() if parameter.id in table.params]


def cells_of(table: Table) -> list[list[str]]:
    """Return the cells of a table as texts, the head with its units first."""
    units = table.units or ("",) * len(table.head)
    head = [
        f"{name} ({unit_text(unit)})" if unit else name for name, unit in zip(table.head, units, strict=True)
    ]
    return [head, *([c if isinstance(c, str) else write_number(c) for c in row] for row in table.rows)]


def table_lines(table: Table) -> list[str]:
    """Return the lines of a printed table; a cell that is too long for its column goes on below."""
    head, *rows = cells_of(table)
    room = _WIDTH - len(_INDENT) - 2 * (len(head) - 1)
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    while sum(widths) > room:  # the widest column becomes narrower
        widths[widths.index(max(widths))] -= 1
    lines = [line for row in (head, *rows) for line in _row(row, widths)]
    lines.insert(len(_row(head, widths)), "-" * (sum(widths) + 2 * (len(widths) - 1)))
    return lines + textwrap.wrap(table.note, _WIDTH - len(_INDENT))


def _row(cells: list[str], widths: list[int]) -> list[str]:
    parts = [textwrap.wrap(cell, width) or [""] for cell, width in zip(cells, widths, strict=True)]
    rows = zip_longest(*parts, fillvalue="")
    return ["  ".join(t.ljust(w) for t, w in zip(row, widths, strict=True)).rstrip() for row in rows]
