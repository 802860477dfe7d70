"""How wide the columns of the parameter table are: as wide as their widest content, while there is room.

Where there is not, choices take their shorter texts first, then names are elided in the middle, and then
whole columns leave at the right: no digit and no unit is ever cut.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from heapq import nlargest
from itertools import accumulate

from PySide6.QtGui import QFontMetrics

from amp_studio.ui.base.theme import GAP2, GAP3, FontRole, font

from .cell_look import CellLook
from .cell_painter import CellPainter
from .more_columns import STRIP
from .parameter_table import ParameterTable

_MIN_COLUMN = 84
MIN_NAMES = 150
"""Width of the names in a table that is too narrow for its axes."""
_MAX_FROZEN = 1 / 3
"""Share of the table that numbers and names have at most: what stays while the axes scroll."""
_MAX_TEXT, _MIN_TEXT = 300, 120
"""Width of a column of texts that a user may have typed, which may be a page long."""
_MAX_FACT = 300


@dataclass(frozen=True, slots=True)
class ColumnWidths:
    """Widths in logical pixels."""

    number: int
    """Of the numbers; 0 where no row has one."""
    frozen: int
    """Of numbers and names together."""
    columns: list[int]
    slots: list[int]
    """Of the units, for each column."""
    block: int
    """Of the numbers in the block of the whole control, which is above the axes; 0 without it."""


@dataclass(frozen=True, slots=True)
class ContentWidths:
    """What the contents of a table need, whatever room there is; in logical pixels."""

    number: int
    names: int
    full: list[int]
    """Of each column."""
    short: list[int]
    """Of each column with the shorter texts of its choices."""
    slots: list[int]
    block: int


def content_widths(table: ParameterTable, painter: CellPainter) -> ContentWidths:
    """Measure every cell of a table: a thousand rows take 15 ms, so it is done once for what is in them."""
    every = range(len(table.rows))
    looks = _looks(table, every)
    slots = [max(map(painter.slot, column), default=0) for column in looks]
    block = _widest(painter, looks[0], slots[0]) if table.has_block else 0
    # A head has no shorter words: it is whole in a column of short texts too.
    full, short = (
        [
            max(_widest(painter, column, slot, is_short=is_short), _head(table, n))
            for n, (column, slot) in enumerate(zip(looks, slots, strict=True))
        ]
        for is_short in (False, True)
    )
    if table.has_block:
        full[0] = short[0] = _head_of_block(table)  # its cells lie across all columns
    for column in table.fact_columns:
        fact = _widest_text([column.title(), *(table.fact(n, column) for n in every)]) + 2 * GAP3
        full.append(min(fact, _MAX_FACT))
        short.append(min(fact, _MIN_TEXT))
    return ContentWidths(_number_width(table), _names_width(table, every), full, short, slots, block)


def widened(
    content: ContentWidths, table: ParameterTable, painter: CellPainter, rows: Collection[int]
) -> ContentWidths:
    """Return the widths with what the cells of some rows need now:
    an edit measures those that it has changed.
    """
    looks = _looks(table, rows)
    slots = [
        max(was, *map(painter.slot, column), 0) for was, column in zip(content.slots, looks, strict=True)
    ]
    wider = [
        now - was for now, was in zip(slots, content.slots, strict=True)
    ]  # of the numbers in other rows too
    needed = [_widest(painter, column, slot) for column, slot in zip(looks, slots, strict=True)]
    at_least = [
        _widest(painter, column, slot, is_short=True) for column, slot in zip(looks, slots, strict=True)
    ]
    block = max(content.block + wider[0], needed[0]) if table.has_block else 0
    if table.has_block:
        needed[0] = at_least[0] = _head_of_block(table)
    full, short = list(content.full), list(content.short)
    for n in range(len(looks)):
        full[n], short[n] = max(full[n] + wider[n], needed[n]), max(short[n] + wider[n], at_least[n])
    names = max(content.names, _names_width(table, rows))
    return ContentWidths(content.number, names, full, short, slots, block)


def column_widths(content: ContentWidths, room: int) -> ColumnWidths:
    """Return the widths for a table that is ``room`` wide; a room that is hardly there at all has none."""
    room = max(room, 0)
    number, short = content.number, content.short
    wanted = min(number + content.names, int(room * _MAX_FROZEN))
    # The columns have their short widths first, but names keep a width at which they can be read.
    frozen = max(min(wanted, room - sum(short)), min(wanted, number + MIN_NAMES))
    columns = _shared(content.full, short, room - frozen)
    # What the columns leave free that are seen whole beside the strip belongs to the names.
    frozen += min(_free_beside(columns, room - frozen), wanted - frozen)
    return ColumnWidths(number, frozen, columns, content.slots, content.block)


def _free_beside(columns: list[int], room: int) -> int:
    """Return the room that is left where not all columns fit, and those that do stay whole; 0 where all fit,
    or none does.
    """
    ends = [end for end in accumulate(columns) if end <= room - STRIP]
    return room - STRIP - ends[-1] if ends and sum(columns) > room else 0


def _shared(full: list[int], short: list[int], room: int) -> list[int]:
    """Return the width of each column between its short and its full one,
    each getting the same part of what it lacks.
    """
    lacking = sum(full) - sum(short)
    left = room - sum(short)
    share = 1.0 if not lacking or left >= lacking else max(0.0, left / lacking)
    return [few + int((most - few) * share) for most, few in zip(full, short, strict=True)]


def _looks(table: ParameterTable, rows: Collection[int]) -> list[list[CellLook]]:
    """Return the looks of the cells of each column that exist, in some rows."""
    return [
        [look for row in rows if (look := table.look(row, column)) and look.kind != "absent"]
        for column in range(len(table.columns))
    ]


def _head(table: ParameterTable, column: int) -> int:
    """Return the width of the head of an axis, its letter and what it is: ``B 4 rotary``."""
    letter, what = table.column_head(column)
    return _widest_text([letter]) + _widest_text([what], "caption") + 2 * GAP3 + GAP2


def _head_of_block(table: ParameterTable) -> int:
    """Return the width of the head of the control's column: its values lie across all columns, its word
    does not.
    """
    return _widest_text(["".join(table.column_head(0))], "caption") + 2 * GAP3


def _widest(painter: CellPainter, looks: list[CellLook], slot: int, *, is_short: bool = False) -> int:
    most = _MIN_COLUMN
    for look in looks:
        needed = painter.needed(look, slot, is_short=is_short)
        is_printed = bool(look.short) and (is_short or not look.unit)  # a choice; of a mask the shorter names
        if not look.is_number and look.kind == "value" and not is_printed:
            needed = min(needed, _MIN_TEXT if is_short else _MAX_TEXT)
        most = max(most, needed)
    return most


def _widest_text(texts: list[str], kind: FontRole = "text") -> int:
    metrics = QFontMetrics(font(kind))
    # Only the eight longest are measured: letters differ in width, but hardly by more than that.
    return max(map(metrics.horizontalAdvance, nlargest(8, set(texts), len)), default=0)


def _number_width(table: ParameterTable) -> int:
    if not table.has_numbers:
        return 0
    return max(42, _widest_text([table.number(n) for n in range(len(table.rows))], "small") + GAP3)


def _names_width(table: ParameterTable, rows: Collection[int]) -> int:
    """Return the width of the longest name of some rows, with the unit of its row."""
    names = _widest_text([table.row_name(n) for n in rows])
    units = _widest_text([table.unit_of_row(n) for n in rows], "small")
    return names + (units + GAP3 if units else 0) + 2 * GAP3
