"""How wide the columns of the parameter table are: no value is measured, so that a list of all parameters is there at once."""

from __future__ import annotations

from heapq import nlargest

from PySide6.QtGui import QFontMetrics

from amp_studio.ui.base.theme import font

from .parameter_table import CONTROL, ParameterTable
from .table_heads import NUMBER

LEAST_NAMES = 240
"""Width of the numbers and names in a narrow table."""
_NAMES, _MOST_NAMES, _WIDE = 302, 420, 600
"""The same in a wide table, at most, and the width of a wide table."""
_AXIS, _MOST_AXIS = 92, 150
_ALONE, _MOST_ALONE = 240, 460
"""Width of the control's column where it is the only one."""
_BESIDE, _MOST_BESIDE = 120, 190
"""Width of the control's column beside axes."""
_COMMAND = 230
_PLACE = 110
"""Room behind a name for the gear or process."""


def column_widths(table: ParameterTable, room: int) -> tuple[int, list[int]]:
    """Return the width of the names and of each column, in logical pixels, for a table that is ``room`` wide."""
    least = _NAMES if room > _WIDE else LEAST_NAMES
    command = [_COMMAND] if table.shows_commands else []
    widths = [*_of_values(table.columns, room - least - sum(command)), *command]
    return max(least, min(_wanted_names(table), _MOST_NAMES, room - sum(widths))), widths


def _of_values(columns: list[str], room: int) -> list[int]:
    if columns == [CONTROL]:
        return [max(_ALONE, min(_MOST_ALONE, room))]
    axes = len(columns) - (CONTROL in columns)
    control = _BESIDE if CONTROL in columns else 0
    each = max(_AXIS, min(_MOST_AXIS, (room - control) // max(1, axes)))
    control = max(_BESIDE, min(_MOST_BESIDE, room - each * axes))
    return [control if column == CONTROL else each for column in columns]


def _wanted_names(table: ParameterTable) -> int:
    """Return the width of the longest name, with its gear, which is at its end."""
    longest = nlargest(8, {row.parameter.name for row in table.rows}, len)
    widest = max(map(QFontMetrics(font("text")).horizontalAdvance, longest), default=0)
    return widest + NUMBER + 20 + _PLACE * any(row.instance for row in table.rows)
