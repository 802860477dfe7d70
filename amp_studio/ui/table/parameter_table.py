"""The model of the parameter table: one row for each parameter, one column for each axis.

A parameter with several instances that are not axes (gears, macro calls, processes) has one row for each, and
so have the points of a table of an axis. Where several groups are shown each begins
with a row that has its name and no values.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from itertools import chain, groupby
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal

from amp_studio.files import axis_head, shown_axes
from amp_studio.schema import Address, Parameter, whole_of
from amp_studio.ui.base.figures import as_tip
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace

from .cell_look import CellLook, ShownValues, move_unit_to_head
from .fact_columns import FACT_COLUMNS, FactColumn, reading_command

AddressRole = Qt.ItemDataRole.UserRole + 1
CONTROL = ""
"""The column of values that belong to no axis; every other column is an axis."""
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_READABLE = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
_EDITABLE = _READABLE | Qt.ItemFlag.ItemIsEditable
_NO_NUMBER = "–"
_MIN_ROWS_OF_SECTION = 2
"""Rows that a section has at least on average; a search that finds one here and one there has none."""


@dataclass(frozen=True, slots=True)
class TableRow:
    """One row: a parameter (or one part of it) with its axes, or one instance that belongs to no axis."""

    parameter: Parameter
    cells: dict[str, Address]
    """Column -> address; empty for the head of a section."""
    instance: str = ""
    """The instance or part; empty where the columns show it and where there is only one."""
    section: str = ""
    """What the rows below are, for the head of a section, which has no values."""


def _is_of_axes(row: TableRow) -> bool:
    return CONTROL not in row.cells


RowFilter = Callable[[TableRow, list[Address]], bool]
"""Whether a row is shown, given it and its cells in the columns that are shown."""


class ParameterTable(QAbstractTableModel):
    """The parameters of one group or search with the values of the open file.
    Numbers and names are the row heads.
    """

    values_changed = Signal(list)
    """Values in the same rows are new; after this they are painted."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self.rows: list[TableRow] = []
        self.columns: list[str] = []
        self.shows_every_axis = False
        self.hidden_rows = 0
        self.asked: list[Parameter] = []
        self.outlined: frozenset[Address] = frozenset()
        """Cells of the selected finding that are not at fault."""
        self.outline_severity = ""
        self.values = ShownValues(workspace)
        self._filter: RowFilter | None = None
        self._unfiltered: list[list[Address]] | None = None
        """What ``unfiltered`` returns, until rows or columns may be others."""
        self._places: dict[Address, tuple[int, int]] | None = None
        """Where ``index_of`` finds each address, until rows or columns are others."""
        self.fact_columns: list[FactColumn] = []
        """The columns behind the values: those in which rows differ."""
        self._axis_heads: dict[str, tuple[str, str]] = {}
        """Column -> its head, until a value changes."""
        self._heads: dict[int, str] = {}
        """TableRow -> its head, for the rows that are shown."""
        self._numbers: dict[int, str] = {}
        self._machine = ""
        self._layouts: dict[str, list[TableRow]] = {}
        self._needed: dict[str, None] | None = None
        """The columns of the asked parameters, fitted or not."""
        self._looks: dict[Address, CellLook] = {}
        workspace.changed.connect(self._refresh)
        workspace.saved.connect(self._forget_looks)
        self.values.find_findings()

    @property
    def hidden_too(self) -> bool:
        """Whether hidden parameters are shown too."""
        return self.values.hidden_too

    @hidden_too.setter
    def hidden_too(self, hidden_too: bool) -> None:
        self.values.hidden_too = hidden_too

    # -- what is shown ---------------------------------------------------------

    def show_parameters(self, parameters: list[Parameter]) -> None:
        """Show these parameters, with the columns they need."""
        self.asked, self._needed = parameters, None
        self._lay_out(self._columns())

    def show_again(self) -> None:
        """Show the same parameters again after an option has changed."""
        self._lay_out(self._columns())

    def filter_rows(self, wanted: RowFilter | None) -> None:
        """Show only the rows that pass; None shows all of them again."""
        if wanted is not None or self._filter is not None:
            self._filter = wanted
            self.show_again()

    def unfiltered(self) -> list[list[Address]]:
        """Return the values of each row that the list has without the filter, in the columns that are
        shown.
        """
        if self._unfiltered is None:
            here, exists = set(self.columns), self.values.exists
            rows = (row for p in self.asked for row in self._layout(p))
            cells = ([a for c, a in row.cells.items() if c in here and exists(a)] for row in rows)
            self._unfiltered = [addresses for addresses in cells if addresses]
        return self._unfiltered

    def outline(self, addresses: frozenset[Address], severity: str) -> None:
        """Outline the cells of the selected finding, in the colour of its severity."""
        if (addresses, severity) != (self.outlined, self.outline_severity):
            others = (
                self.outlined ^ addresses if severity == self.outline_severity else self.outlined | addresses
            )
            self.outlined, self.outline_severity = addresses, severity
            for index in map(self.index_of, others):
                if index.isValid():
                    self.dataChanged.emit(index, index)

    @property
    def count(self) -> int:
        """How many rows have values."""
        return sum(not row.section for row in self.rows)

    def _lay_out(self, columns: list[str], rows: list[TableRow] | None = None) -> None:
        self.beginResetModel()
        self.columns = columns
        self.rows = self._rows(columns) if rows is None else rows
        self._places = None
        self.fact_columns = [c for c in FACT_COLUMNS if self.columns and len(self._facts(c)) > 1]
        self._forget_heads()
        self._axis_heads.clear()
        self._looks.clear()
        self.endResetModel()

    def _layout(self, parameter: Parameter) -> list[TableRow]:
        """Return the rows of a parameter on this machine type."""
        found = self._layouts.get(parameter.id)
        if found is None:
            here = self.workspace.file.machine_schema
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
        if file.machine != self._machine:
            self._machine, self._layouts, self._needed = file.machine, {}, None
        if self._needed is None:
            rows = chain.from_iterable(map(self._layout, self.asked))
            self._needed = dict.fromkeys(chain.from_iterable(row.cells for row in rows))
        columns = list(self._needed)
        if not self.shows_every_axis and file.schema.family.fits_axes:
            listed = set(shown_axes(file))
            columns = [c for c in columns if c == CONTROL or c in listed]
        # The sort is stable: the column of the control comes first, the axes keep their order.
        return sorted(columns, key=lambda column: column != CONTROL)

    def _rows(self, columns: list[str]) -> list[TableRow]:
        """Return the rows with at least one value that is not hidden, each group under its name."""
        self._unfiltered = None
        known = [row for p in self.asked for row in self._layout(p)]
        listed, exists, here = known, self.values.exists, set(columns)
        if not self.hidden_too:
            listed = [row for row in known if any(map(exists, _cells_in(row, here)))]
        self.hidden_rows = len(known) - len(listed)
        if self._filter is not None:
            wanted = self._filter
            listed = [row for row in listed if wanted(row, _cells_in(row, here))]
        return self._with_sections(listed)

    def _with_sections(self, rows: list[TableRow]) -> list[TableRow]:
        groups = self.workspace.file.schema.group_of
        blocks = [list(block) for _, block in groupby(rows, lambda row: id(groups[row.parameter.id]))]
        of_control = [row for row in rows if CONTROL in row.cells]
        if 1 < len(blocks) <= len(rows) / _MIN_ROWS_OF_SECTION:
            found: list[TableRow] = []
            for block in blocks:
                group = groups[block[0].parameter.id]
                found.append(TableRow(block[0].parameter, {}, "", group.own_name))
                found += sorted(block, key=_is_of_axes)
            return found
        if not 0 < len(of_control) < len(rows):
            return rows
        of_axes = [row for row in rows if CONTROL not in row.cells]
        return [
            TableRow(of_control[0].parameter, {}, "", self.column_head(0)[1] or self.tr("Control")),
            *of_control,
            TableRow(of_axes[0].parameter, {}, "", self.tr("Axes")),
            *of_axes,
        ]

    def _facts(self, column: FactColumn) -> set[str]:
        """Return what a column behind the values has of all rows."""
        return {self.fact(row, column) for row in range(len(self.rows)) if not self.rows[row].section}

    def fact(self, row: int, column: FactColumn) -> str:
        """Return what a column behind the values has of a row; nothing of the head of a section."""
        line = self.rows[row]
        return "" if line.section else column.text(self.workspace.file.schema, line.parameter)

    @property
    def common_command(self) -> str:
        """The command that makes the control read every row; empty where there is none, or not one for
        all.
        """
        schema = self.workspace.file.schema
        found = {reading_command(schema, row.parameter) for row in self.rows if not row.section}
        return found.pop() if len(found) == 1 else ""

    @property
    def has_block(self) -> bool:
        """Whether values of the whole control are a block above those of the axes;
        each of its cells has the whole width.
        """
        return len(self.columns) > 1 and CONTROL in self.columns

    def is_in_block(self, row: int) -> bool:
        """Return whether a row belongs to the block of the whole control."""
        return self.has_block and CONTROL in self.rows[row].cells

    @property
    def has_numbers(self) -> bool:
        """Whether any row has a number; a family may have names alone."""
        return any(self.number(n) not in ("", _NO_NUMBER) for n in range(len(self.rows)))

    def address_at(self, row: int, column: int) -> Address | None:
        """Return the address a cell shows; None where the parameter has no such instance."""
        if column >= len(self.columns):
            return None
        return self.rows[row].cells.get(self.columns[column])

    def index_of(self, address: Address) -> QModelIndex:
        """Return the cell of an address, invalid when it is not shown."""
        if self._places is None:
            columns = {name: n for n, name in enumerate(self.columns)}
            cells = ((n, c, a) for n, row in enumerate(self.rows) for c, a in row.cells.items())
            self._places = {a: (n, columns[c]) for n, c, a in cells if c in columns}
        place = self._places.get(address)
        return QModelIndex() if place is None else self.index(*place)

    def first_of(self, row: int) -> QModelIndex:
        """Return the first cell of a row whose value exists, invalid when none does."""
        for column in range(len(self.columns)):
            address = self.address_at(row, column)
            if address is not None and self.values.exists(address):
                return self.index(row, column)
        return QModelIndex()

    # -- values as they are shown ----------------------------------------------

    def look(self, row: int, column: int) -> CellLook | None:
        """Return how a cell is painted; None where the parameter has no such instance."""
        address = self.address_at(row, column)
        if address is None:
            return None
        found = self._looks.get(address)
        if found is None:
            here = set(self.columns)
            # The whole row at once: which axis is unlike the others needs all of them.
            looks = self.values.row_looks([a for c, a in self.rows[row].cells.items() if c in here])
            if len(self.columns) > 1 and CONTROL not in self.rows[row].cells:
                move_unit_to_head(looks.values())
            self._looks |= looks
            found = looks[address]
        return found

    def off_default(self, row: int) -> list[Address]:
        """Return the values of a row that can be set back to their printed default."""
        cells = ((self.look(row, n), self.address_at(row, n)) for n in range(len(self.columns)))
        return [address for look, address in cells if look and address and look.is_off_default]

    def unit_of_row(self, row: int) -> str:
        """Return the unit of all values of a row, for its head; empty where they differ or say it
        themselves.
        """
        if self.rows[row].section:
            return ""
        looks = (self.look(row, column) for column in range(len(self.columns)))
        return next((look.unit for look in looks if look is not None and look.is_unit_in_head), "")

    def cell_text(self, address: Address) -> str:
        """Return the text of a cell for a person who does not see it: ``11 mm``, ``not set``,
        nothing where it does not exist.
        """
        if not self.values.exists(address):
            return ""
        used = self.values.effective.get(address)
        return self.shown_value(address) + ("" if used is None else f" → {self.values.text(address, used)}")

    def shown_value(self, address: Address) -> str:
        """Return a value as the table shows it."""
        return self.values.text(address, self.workspace.file.get(address))

    def typed_value(self, address: Address) -> str:
        """Return a value as text for editing; empty for a masked one."""
        return self.values.typed(address)

    # -- Qt --------------------------------------------------------------------

    def rowCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.columns) + len(self.fact_columns)

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation == Qt.Orientation.Vertical:
            return self._row_head(section, role)
        if role == Qt.ItemDataRole.DisplayRole:
            return " ".join(filter(None, self.column_head(section)))
        return None

    def column_head(self, column: int) -> tuple[str, str]:
        """Return the head of a column, what is loud of it and what is not: ``("X", "1 linear")``, ``("",
        "Control")``.
        """
        if column >= len(self.columns):
            return "", self.fact_columns[column - len(self.columns)].title()
        name = self.columns[column]
        if name not in self._axis_heads:
            label = self.workspace.file.schema.family.scopes["global"].label
            letter, what = ("", label) if name == CONTROL else axis_head(self.workspace.file, name)
            self._axis_heads[name] = letter, worded(what)
        return self._axis_heads[name]

    @property
    def titles(self) -> list[str]:
        """The heads of the columns in words."""
        return [" ".join(filter(None, self.column_head(n))) for n in range(len(self.columns))]

    def _row_head(self, row: int, role: int) -> Any:
        if role == Qt.ItemDataRole.DisplayRole:
            return self.head(row)
        if role == Qt.ItemDataRole.ToolTipRole and not self.rows[row].section:
            parameter = self.rows[row].parameter
            text = f"{self.number(row)} {self.row_name(row)}  ({parameter.id})\n{parameter.help.what}"
            return as_tip("\n".join([text, *map(self.values.against_default, self.off_default(row))]))
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _LEFT
        return None

    def head(self, row: int) -> str:
        """Return the head of a row in words: its number and its name."""
        return f"{self.number(row)} {self.row_name(row)}".strip()

    def row_name(self, row: int) -> str:
        """Return the name of a row: the parameter, and the instance if there are several."""
        found = self._heads.get(row)
        if found is None:
            found = self._heads[row] = self._name(self.rows[row])
        return found

    def _name(self, line: TableRow) -> str:
        if line.section or not line.instance:
            return line.section or line.parameter.name
        place = worded(self.workspace.file.machine_schema.instance_label(next(iter(line.cells.values()))))
        if CONTROL not in line.cells:
            place = place.rpartition(", ")[2]  # the column is the axis
        return f"{line.parameter.name}, {place}" if place else line.parameter.name

    def number(self, row: int) -> str:
        """Return the number of a row: that of its first value that exists, if it belongs to this
        parameter.
        """
        found = self._numbers.get(row)
        if found is None:
            found = self._numbers[row] = self._number(row)
        return found

    def _number(self, row: int) -> str:
        if self.rows[row].section:
            return ""
        here = self.workspace.file.machine_schema
        first = self.first_of(row)
        address = self.address_at(row, first.column()) if first.isValid() else None
        if address is None or here.is_disputed(address[0]):
            return _NO_NUMBER
        return here.number(address) or _NO_NUMBER

    def data(self, index: ModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if not index.isValid():
            return None
        if index.column() >= len(self.columns):
            column = self.fact_columns[index.column() - len(self.columns)]
            return self.fact(index.row(), column) if role == Qt.ItemDataRole.DisplayRole else None
        address = self.address_at(index.row(), index.column())
        return None if address is None else self._cell(address, role)

    def _cell(self, address: Address, role: int) -> Any:
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return self.cell_text(address)
        if role == Qt.ItemDataRole.EditRole:
            return self.typed_value(address)
        if role == AddressRole:
            return address
        if role == Qt.ItemDataRole.TextAlignmentRole:
            parameter = self.workspace.file.schema.parameters[address[0]]
            return _RIGHT if parameter.type in ("real", "integer", "format") else _LEFT
        if role == Qt.ItemDataRole.ToolTipRole:
            return as_tip(self.values.tip(address))
        if role == Qt.ItemDataRole.AccessibleDescriptionRole:
            return self.values.tip(address)
        return None

    def flags(self, index: ModelIndex) -> Qt.ItemFlag:
        address = self.address_at(index.row(), index.column()) if index.isValid() else None
        if address is None or not self.values.exists(address):
            return Qt.ItemFlag.NoItemFlags  # keys pass over it
        can_be_set = self.rows[index.row()].parameter.access != "read"
        return _EDITABLE if self.workspace.may_edit and can_be_set else _READABLE

    # -- following the file ----------------------------------------------------

    def _refresh(self, addresses: list[Address]) -> None:
        heads = dict(self._axis_heads)
        self._axis_heads.clear()
        header, marks = self.values.header, self.values.marks
        self.values.find_findings()
        columns, decides = self._columns(), self.workspace.file.evaluation.decides_states
        is_about_all = not addresses or header != self.values.header or any(map(decides, addresses))
        if columns != self.columns or self._filter is not None or is_about_all:
            rows = self._rows(columns)
            # A reset loses scroll place, selection and open editor: only where rows or columns are others.
            if columns != self.columns or rows != self.rows:
                self._lay_out(columns, rows)
                return
            self._forget_heads()  # the number of a row is that of its first value that exists
        # Only another head: Qt lays and paints the whole table once more for it, after the cells.
        if any(self.column_head(n) != heads.get(name) for n, name in enumerate(columns) if name in heads):
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, max(0, len(columns) - 1))
        if is_about_all:
            self._forget_looks()
        else:
            self._forget_looks_of({*addresses, *(address for address, _ in marks ^ self.values.marks)})
        self.values_changed.emit(addresses)

    def _forget_heads(self) -> None:
        self._heads.clear()
        self._numbers.clear()

    def _forget_looks(self) -> None:
        self._looks.clear()
        self._repaint()

    def _forget_looks_of(self, addresses: set[Address]) -> None:
        """Paint the rows of some values once more, each as a whole: one value makes another unlike it."""
        for number, row in enumerate(self.rows):
            if not addresses.isdisjoint(row.cells.values()):
                for address in row.cells.values():
                    self._looks.pop(address, None)
                self.dataChanged.emit(self.index(number, 0), self.index(number, len(self.columns) - 1))

    def _repaint(self) -> None:
        if self.rows and self.columns:
            last = self.index(len(self.rows) - 1, len(self.columns) - 1)
            self.dataChanged.emit(self.index(0, 0), last)


def _cells_in(row: TableRow, columns: Collection[str]) -> list[Address]:
    """Return the addresses of a row that are in some columns."""
    return [address for column, address in row.cells.items() if column in columns]
