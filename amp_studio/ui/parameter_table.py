"""The table in the middle: a row a parameter, a column an axis."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QFont

from amp_studio.files import axis_title, fitted_axes
from amp_studio.schema import Address, Parameter, UnitError, Value, convert, show_value, write_value

from .theme import severity_colour, state_colour
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex
AddressRole = Qt.ItemDataRole.UserRole + 1
_HEAD = ("No.", "Parameter")


class ParameterTable(QAbstractTableModel):
    """Parameters of one group or search, in the light of the open file."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self.rows: list[Parameter] = []
        self.columns: list[str] = []
        """Instances, one column each; ``""`` is the column of global parameters."""
        self.shown_units: str | None = None
        """Unit system of display; None shows every value in its unit of entry."""
        self.all_axes = False
        self.hidden_too = False
        """Show also what does not exist for this configuration."""
        self.hidden_rows = 0
        self._asked: list[Parameter] = []
        self._worst: dict[Address, str] = {}
        workspace.changed.connect(self._refresh)
        self._find_worst()

    # -- what is shown ---------------------------------------------------------

    def show_parameters(self, parameters: list[Parameter]) -> None:
        """Show these rows, with the columns they need."""
        self.beginResetModel()
        self._asked = parameters
        self.columns = self._columns()
        self.rows = self._rows()
        self.endResetModel()

    def show_again(self) -> None:
        """Show the same parameters anew, after an option changed."""
        self.show_parameters(self._asked)

    def _columns(self) -> list[str]:
        file = self.workspace.file
        ordered = dict.fromkeys(i for p in self._asked for i in file.schema.instances(p, file.machine))
        axes = set(ordered) if self.all_axes else set(fitted_axes(file))
        shown = [i for i in ordered if i == "" or i in axes or not self._is_axis_only(i)]
        return sorted(shown, key=lambda i: (i != "", list(ordered).index(i)))

    def _rows(self) -> list[Parameter]:
        """Return the rows that have at least one value that exists for this configuration."""
        file = self.workspace.file
        known = [p for p in self._asked if file.schema.instances(p, file.machine)]
        shown = known if self.hidden_too else [p for p in known if any(self._exists((p.id, i)) for i in self._shown(p))]
        self.hidden_rows = len(known) - len(shown)
        return shown

    def _shown(self, parameter: Parameter) -> list[str]:
        file = self.workspace.file
        return [i for i in file.schema.instances(parameter, file.machine) if i in self.columns]

    def _exists(self, address: Address) -> bool:
        return self.workspace.file.situation.state(address).state != "hidden"

    def _is_axis_only(self, instance: str) -> bool:
        schema, machine = self.workspace.file.schema, self.workspace.file.machine
        return all(
            (layout := schema.layout(p, machine)) is not None and layout.scope == "axis"
            for p in self._asked
            if instance in schema.instances(p, machine)
        )

    def address_at(self, index: Index) -> Address | None:
        """Return the address a cell shows; the first instance for the head columns."""
        if not index.isValid():
            return None
        parameter = self.rows[index.row()]
        instances = self.workspace.file.schema.instances(parameter, self.workspace.file.machine)
        column = index.column() - len(_HEAD)
        here = [c for c in self.columns if c in instances]
        instance = self.columns[column] if column >= 0 else next(
            (c for c in here if self._exists((parameter.id, c))), (here or list(instances))[0]
        )
        return (parameter.id, instance) if instance in instances else None

    def index_of(self, address: Address) -> QModelIndex:
        """Return the cell of an address, invalid when it is not shown."""
        for row, parameter in enumerate(self.rows):
            if parameter.id == address[0] and address[1] in self.columns:
                return self.index(row, self.columns.index(address[1]) + len(_HEAD))
        return QModelIndex()

    def shown_value(self, address: Address) -> str:
        """Return a value as the table shows it."""
        parameter = self.workspace.file.schema.parameters[address[0]]
        return show_value(parameter, self._in_units(address, self.workspace.file.get(address)))

    def _in_units(self, address: Address, value: Value | None) -> Value | None:
        if value is None or self.shown_units is None or isinstance(value.value, (str, bool)) or not value.unit:
            return value
        unit = self.workspace.file.situation.unit(address, self.shown_units)
        try:
            return Value(float(f"{convert(float(value.value), value.unit, unit):.9g}"), unit)
        except UnitError:
            return value

    # -- Qt --------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(_HEAD) + len(self.columns)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal or role != Qt.ItemDataRole.DisplayRole:
            return None
        if section < len(_HEAD):
            return _HEAD[section]
        instance = self.columns[section - len(_HEAD)]
        if instance == "":
            return "Control"
        if instance in self.workspace.file.schema.family.scopes["axis"].instances:
            return axis_title(self.workspace.file, instance)
        return instance

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if not index.isValid():
            return None
        if index.column() < len(_HEAD):
            return self._head(index, role)
        address = self.address_at(index)
        if address is None:
            return None
        return self._cell(address, role)

    def _head(self, index: Index, role: int) -> Any:
        parameter = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            if index.column() == 1:
                return parameter.name
            address = self.address_at(index)
            return (self.workspace.file.schema.number(address, self.workspace.file.machine) or "–") if address else "–"
        if role == Qt.ItemDataRole.ToolTipRole:
            return parameter.help.what
        if role == AddressRole:
            return self.address_at(index)
        return None

    def _cell(self, address: Address, role: int) -> Any:
        file = self.workspace.file
        if role == Qt.ItemDataRole.DisplayRole:
            return self.shown_value(address) if self.hidden_too or self._exists(address) else "·"
        if role == Qt.ItemDataRole.EditRole:
            parameter = file.schema.parameters[address[0]]
            return write_value(parameter, self._in_units(address, file.get(address)))
        if role == AddressRole:
            return address
        state = file.situation.state(address)
        if role == Qt.ItemDataRole.ForegroundRole:
            return None if state.state == "in-force" else QBrush(state_colour())
        if role == Qt.ItemDataRole.BackgroundRole:
            worst = self._worst.get(address)
            return QBrush(severity_colour(worst)) if worst in ("error", "warning") else None
        if role == Qt.ItemDataRole.FontRole:
            font = QFont()
            font.setBold(not file.is_default(address) and file.get(address) is not None)
            font.setItalic(state.state in ("ignored", "unusable"))
            return font
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._tip(address)
        return None

    def _tip(self, address: Address) -> str:
        state = self.workspace.file.situation.state(address)
        lines = [f.message for f in self.workspace.findings_of(address) if f.rule != "schema.unset"]
        if state.state != "in-force":
            lines.append(f"{state.state}: {state.why}" + (f" (page {state.page})" if state.page else ""))
        if address in self.workspace.file.forced:
            lines.append(f"forced {self.workspace.file.forced[address]}")
        return "\n".join(lines)

    def flags(self, index: Index) -> Qt.ItemFlag:
        flags = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        if index.column() >= len(_HEAD) and self.address_at(index) is not None and self.workspace.document.is_locked:
            flags |= Qt.ItemFlag.ItemIsEditable
        return flags

    # -- following the file ----------------------------------------------------

    def _refresh(self, addresses: list[Address]) -> None:
        self._find_worst()
        profile = self.workspace.file.schema.family.axes
        structural = {profile.type, self.workspace.file.schema.family.machine_parameter} if profile else set()
        if not addresses or any(a[0] in structural for a in addresses) or self._rows() != self.rows:
            self.show_parameters(self._asked)
            return
        if self.rows:
            self.dataChanged.emit(self.index(0, 0), self.index(len(self.rows) - 1, self.columnCount() - 1))
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, self.columnCount() - 1)

    def _find_worst(self) -> None:
        rank = {"error": 0, "warning": 1, "advice": 2}
        worst: dict[Address, str] = {}
        for finding in self.workspace.findings:
            for address in finding.addresses:
                if rank[finding.severity] < rank.get(worst.get(address, ""), 3):
                    worst[address] = finding.severity
        self._worst = worst
