"""The model of the parameter table: one row for each parameter, one column for each axis.

A parameter with several instances that are not axes (gears, macro calls, processes) has one row for each, and so have the
points of a table of an axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QFont

from amp_studio.files import axis_title, shown_axes
from amp_studio.files.local_time import with_local_times
from amp_studio.report.wording import state_name
from amp_studio.schema import (
    Address,
    Parameter,
    UnitError,
    Value,
    convert,
    show_value,
    write_value,
)
from amp_studio.schema.address import whole_of

from .theme import FIGURE_SPACE, severity_colour, state_colour
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex
AddressRole = Qt.ItemDataRole.UserRole + 1
CONTROL = ""
"""The column of values that belong to no axis; every other column is an axis."""

_LONG = 14  # number of characters that fit into a cell
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


@dataclass(frozen=True, slots=True)
class TableRow:
    """One row: a parameter (or one part of it) with its axes, or one instance that belongs to no axis."""

    parameter: Parameter
    cells: dict[str, Address]
    """Column -> address."""
    instance: str = ""
    """The instance or part; empty where the columns show it and where there is only one."""


class ParameterTable(QAbstractTableModel):
    """The parameters of one group or search with the values of the open file. Numbers and names are the row heads."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self.rows: list[TableRow] = []
        self.columns: list[str] = []
        self.all_axes = False
        self.hidden_too = False
        """Whether hidden parameters are shown too."""
        self.hidden_rows = 0
        self.asked: list[Parameter] = []
        family = workspace.file.schema.family
        every = workspace.file.schema.parameters.values()
        self._commands = any((p.effect or family.effect).level == "command" for p in every)
        self._heads: dict[int, str] = {}
        """TableRow -> its head, for the rows that are shown."""
        self._machine = ""
        self._layouts: dict[str, list[TableRow]] = {}
        self._worst: dict[Address, str] = {}
        self._effective: dict[Address, Value] = {}
        self._bold, self._italic, self._both = (
            _font(*kind) for kind in ((True, False), (False, True), (True, True))
        )
        workspace.changed.connect(self._refresh)
        self._find_worst()

    # -- what is shown ---------------------------------------------------------

    def show_parameters(self, parameters: list[Parameter]) -> None:
        """Show these parameters, with the columns they need."""
        self.beginResetModel()
        self.asked = parameters
        self.columns = self._columns()
        self.rows = self._rows(self.columns)
        self._heads.clear()
        self.endResetModel()

    def show_again(self) -> None:
        """Show the same parameters again after an option has changed."""
        self.show_parameters(self.asked)

    def _layout(self, parameter: Parameter) -> list[TableRow]:
        """Return the rows of a parameter on this machine type."""
        schema, machine = self.workspace.file.schema, self.workspace.file.machine
        if machine != self._machine:
            self._machine, self._layouts = machine, {}
        found = self._layouts.get(parameter.id)
        if found is None:
            here = schema.on(machine)
            layout, instances = here.layout(parameter), here.instances(parameter)
            if layout and here.kin(layout.scope, "axis"):
                parts: dict[str, dict[str, Address]] = {}
                for i in instances:
                    parts.setdefault(i.partition(".")[2], {})[whole_of(i)] = (parameter.id, i)
                found = [TableRow(parameter, cells, part) for part, cells in parts.items()]
            else:
                found = [TableRow(parameter, {CONTROL: (parameter.id, i)}, i) for i in instances]
            self._layouts[parameter.id] = found
        return found

    def _columns(self) -> list[str]:
        file = self.workspace.file
        needed = dict.fromkeys(column for p in self.asked for row in self._layout(p) for column in row.cells)
        if not self.all_axes and file.schema.family.fits_axes:
            shown = set(shown_axes(file))
            needed = {c: None for c in needed if c == CONTROL or c in shown}
        return sorted(needed, key=lambda column: column != CONTROL)

    def _rows(self, columns: list[str]) -> list[TableRow]:
        """Return the rows with at least one value that is not hidden."""
        known = [row for p in self.asked for row in self._layout(p)]
        if self.hidden_too:
            shown = known
        else:
            here = set(columns)
            shown = [row for row in known if any(c in here and self._exists(a) for c, a in row.cells.items())]
        self.hidden_rows = len(known) - len(shown)
        return shown

    def _exists(self, address: Address) -> bool:
        return self.workspace.file.evaluation.state(address).state != "hidden"

    @property
    def shows_commands(self) -> bool:
        """Whether the last column shows the command that makes the control read a value."""
        return bool(self.columns) and self._commands

    def command(self, row: int) -> str:
        """Return the command that makes the control read the values of a row."""
        effect = self.rows[row].parameter.effect or self.workspace.file.schema.family.effect
        return effect.command or "" if effect.level == "command" else ""

    def address_at(self, row: int, column: int) -> Address | None:
        """Return the address a cell shows; None where the parameter has no such instance."""
        if column >= len(self.columns):
            return None
        return self.rows[row].cells.get(self.columns[column])

    def index_of(self, address: Address) -> QModelIndex:
        """Return the cell of an address, invalid when it is not shown."""
        for n, row in enumerate(self.rows):
            for column, shown in row.cells.items():
                if shown == address and column in self.columns:
                    return self.index(n, self.columns.index(column))
        return QModelIndex()

    def first_of(self, row: int) -> QModelIndex:
        """Return the first cell of a row whose value exists, invalid when none does."""
        for column in range(len(self.columns)):
            address = self.address_at(row, column)
            if address is not None and (self.hidden_too or self._exists(address)):
                return self.index(row, column)
        return QModelIndex()

    # -- values as they are shown ----------------------------------------------

    def cell_text(self, address: Address) -> str:
        """Return the text of a cell: the value, or a dot where it is hidden.

        An effective value that differs from the value in the file follows after an arrow.
        """
        if not self.hidden_too and not self._exists(address):
            return "·"
        used = self._effective.get(address)
        return self.shown_value(address) + ("" if used is None else f" → {self._shown(address, used)}")

    def shown_value(self, address: Address) -> str:
        """Return a value as the table shows it."""
        return self._shown(address, self.workspace.file.get(address))

    def _shown(self, address: Address, value: Value | None) -> str:
        if value is None:
            return "—"  # in a table a dash reads quicker than words
        parameter = self.workspace.file.schema.parameters[address[0]]
        return show_value(parameter, self._in_units(address, value), secrets=self.workspace.secrets)

    def typed_value(self, address: Address) -> str:
        """Return a value as text for editing; empty for a masked one."""
        if self.workspace.is_masked(address):
            return ""
        parameter = self.workspace.file.schema.parameters[address[0]]
        return write_value(parameter, self._in_units(address, self.workspace.file.get(address)))

    def _in_units(self, address: Address, value: Value | None) -> Value | None:
        """Return a value in the unit in which it is shown; a value in this unit is returned unchanged."""
        if value is None or isinstance(value.value, (str, bool)) or not value.unit:
            return value
        unit = self.workspace.typed_unit(address)
        if unit == value.unit:
            return value
        try:
            return Value(float(f"{convert(float(value.value), value.unit, unit):.9g}"), unit)
        except UnitError:
            return value

    # -- Qt --------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.columns) + self.shows_commands

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation == Qt.Orientation.Vertical:
            return self._row_head(section, role)
        if role == Qt.ItemDataRole.DisplayRole:
            return self.column_title(self.columns[section]) if section < len(self.columns) else "Read by"
        return None

    def column_title(self, column: str) -> str:
        """Return the head of a column: ``1 X linear``, ``Control``."""
        return "Control" if column == CONTROL else axis_title(self.workspace.file, column)

    def _row_head(self, row: int, role: int) -> Any:
        if role == Qt.ItemDataRole.DisplayRole:
            return self.head(row)
        if role == Qt.ItemDataRole.ToolTipRole:
            parameter = self.rows[row].parameter
            return f"{self.number(row)} {self.row_name(row)}  ({parameter.id})\n{parameter.help.what}"
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _LEFT
        return None

    def head(self, row: int) -> str:
        """Return the head of a row: its number and its name."""
        found = self._heads.get(row)
        if found is None:
            number = self.number(row).ljust(5, FIGURE_SPACE)
            found = self._heads[row] = f"{number} {self.row_name(row)}"
        return found

    def row_name(self, row: int) -> str:
        """Return the name of a row: the parameter, and the instance if there are several."""
        shown, file = self.rows[row], self.workspace.file
        first = next(iter(shown.cells.values()))
        place = file.machine_schema.instance_label(first) if shown.instance else ""
        if CONTROL not in shown.cells:
            place = place.rpartition(", ")[2]  # the column is the axis
        return f"{shown.parameter.name}, {place}" if place else shown.parameter.name

    def number(self, row: int) -> str:
        """Return the number of a row: that of its first value that exists, if it belongs to this parameter."""
        here = self.workspace.file.machine_schema
        first = self.first_of(row)
        address = self.address_at(row, first.column()) if first.isValid() else None
        if address is None or here.is_disputed(address[0]):
            return "–"
        return here.number(address) or "–"

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if not index.isValid():
            return None
        if index.column() == len(self.columns):
            return self.command(index.row()) if role == Qt.ItemDataRole.DisplayRole else None
        address = self.address_at(index.row(), index.column())
        return None if address is None else self._cell(address, role)

    def _cell(self, address: Address, role: int) -> Any:
        file = self.workspace.file
        if role == Qt.ItemDataRole.DisplayRole:
            return self.cell_text(address)
        if role == Qt.ItemDataRole.EditRole:
            return self.typed_value(address)
        if role == AddressRole:
            return address
        if role == Qt.ItemDataRole.TextAlignmentRole:
            parameter = file.schema.parameters[address[0]]
            return _RIGHT if parameter.type in ("real", "integer", "bits", "format") else _LEFT
        if role == Qt.ItemDataRole.BackgroundRole:
            worst = self._worst.get(address)
            return QBrush(severity_colour(worst)) if worst in ("error", "warning") else None
        if role == Qt.ItemDataRole.ForegroundRole:
            return None if file.evaluation.state(address).is_active else QBrush(state_colour())
        if role == Qt.ItemDataRole.FontRole:
            return self._font_of(address)
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._tip(address)
        return None

    def _font_of(self, address: Address) -> QFont | None:
        file = self.workspace.file
        bold = file.get(address) is not None and not file.is_default(address)
        italic = file.evaluation.state(address).state in ("ignored", "unusable")
        return self._both if bold and italic else self._bold if bold else self._italic if italic else None

    def _tip(self, address: Address) -> str:
        file = self.workspace.file
        state = file.evaluation.state(address)
        shown = self.shown_value(address)
        lines = [shown] if len(shown) > _LONG else []
        lines += [f.message for f in self.workspace.findings_of(address) if f.rule != "schema.unset"]
        if not state.is_active:
            lines.append(
                f"{state_name(state.state).capitalize()}: {state.why}"
                + (f" (page {state.page})" if state.page else "")
            )
        if address in self._effective:
            lines.append(f"Effective value in the control: {self._shown(address, self._effective[address])}")
        if address in file.forced:
            lines.append(f"Forced {with_local_times(file.forced[address])}")
        value = file.get(address)
        if value is not None and self._in_units(address, value) != value:
            entered = show_value(file.schema.parameters[address[0]], value, secrets=self.workspace.secrets)
            lines.append(f"Entered as {entered}")
        return "\n".join(lines)

    def flags(self, index: Index) -> Qt.ItemFlag:
        address = self.address_at(index.row(), index.column()) if index.isValid() else None
        if address is None:
            return Qt.ItemFlag.NoItemFlags
        flags = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        can_be_set = self.rows[index.row()].parameter.access != "read"
        if self.workspace.may_edit and can_be_set and (self.hidden_too or self._exists(address)):
            flags |= Qt.ItemFlag.ItemIsEditable
        return flags

    # -- following the file ----------------------------------------------------

    def _refresh(self, addresses: list[Address]) -> None:
        self._find_worst()
        columns = self._columns()
        if columns != self.columns or self._rows(columns) != self.rows:
            self.show_again()
        elif self.rows and self.columns:
            self._heads.clear()  # the number of a row is that of its first value that exists
            last = self.index(len(self.rows) - 1, len(self.columns) - 1)
            self.dataChanged.emit(self.index(0, 0), last)
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, last.column())

    def _find_worst(self) -> None:
        worst: dict[Address, str] = {}
        for finding in self.workspace.findings:  # errors come first
            for address in finding.causes:
                worst.setdefault(address, finding.severity)
        self._worst, self._effective = worst, self.workspace.effective()


def _font(bold: bool, italic: bool) -> QFont:
    font = QFont()
    font.setBold(bold)
    font.setItalic(italic)
    return font
