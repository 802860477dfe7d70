"""Machines side by side as a table: a row a value, a column a machine."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QSortFilterProxyModel, Qt

from amp_studio.report import MachineLine
from amp_studio.ui.base.figures import with_groups
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.theme import colour, font

_ROOT = QModelIndex()
_Role = Qt.ItemDataRole


class MachinesModel(QAbstractTableModel):
    """What the comparison has found; the head of a row is the value's number, name and axis."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.lines: Sequence[MachineLine] = ()
        self._names: Sequence[str] = ()
        self._paths: Sequence[Path] = ()

    def show_lines(self, lines: Sequence[MachineLine], names: Sequence[str], paths: Sequence[Path]) -> None:
        """Show other machines, or other rows of them."""
        self.beginResetModel()
        self.lines, self._names, self._paths = lines, names, paths
        self.endResetModel()

    def rowCount(self, parent: ModelIndex = _ROOT) -> int:
        """Return how many values there are."""
        return 0 if parent.isValid() else len(self.lines)

    def columnCount(self, parent: ModelIndex = _ROOT) -> int:
        """Return how many machines there are."""
        return 0 if parent.isValid() else len(self._names)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        """Return the name of a machine, or of a value."""
        if orientation == Qt.Orientation.Horizontal:
            if role == _Role.ToolTipRole:
                return str(self._paths[section])
            return self._names[section] if role == _Role.DisplayRole else None
        if role in (_Role.DisplayRole, _Role.ToolTipRole):
            number, name, place = self.lines[section].named
            return "   ".join(filter(None, (number, f"{name}, {place}" if place else name)))
        if role == _Role.TextAlignmentRole:
            return int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        return None

    def data(self, index: ModelIndex, role: int = _Role.DisplayRole) -> object:
        """Return a value; what most machines have is dim, what departs from it is loud."""
        line, column = self.lines[index.row()], index.column()
        if role in (_Role.DisplayRole, _Role.ToolTipRole):
            text = line.texts[column]
            return self.tr("not set") if text == "not set" else text if line.is_label else with_groups(text)
        if role == _Role.AccessibleTextRole:
            departs = self.tr(", unlike most") if column in line.departing else ""
            return f"{self._names[column]}: {line.texts[column]}{departs}"
        if column in line.departing:
            return _loud(role)
        return colour("dim") if role == _Role.ForegroundRole and line.departing else None


class MachinesFilter(QSortFilterProxyModel):
    """Leaves the rows in which each word of a text is somewhere: in the number, the name,
    the axis or a value.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._words: list[str] = []

    def set_filter(self, text: str) -> None:
        """Show the rows with these words."""
        self._words = text.casefold().split()
        self.invalidate()

    def filterAcceptsRow(self, source_row: int, source_parent: ModelIndex) -> bool:
        """Return whether a row has each word."""
        model = self.sourceModel()
        assert isinstance(model, MachinesModel)
        line = model.lines[source_row]
        text = " ".join((*line.named, *line.texts)).casefold()
        return all(word in text for word in self._words)


def _loud(role: int) -> object:
    if role == _Role.FontRole:
        loud = font("text")
        loud.setBold(True)
        return loud
    return colour("hover") if role == _Role.BackgroundRole else None
