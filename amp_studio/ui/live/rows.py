"""The rows of Live: each value in the file and in the control, and what differs or was turned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import NamedTuple

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QIcon, QKeyEvent
from PySide6.QtWidgets import QHeaderView, QTableWidget, QTableWidgetItem

from amp_studio.files import ParameterFile, in_one_unit
from amp_studio.schema import Address, Parameter, Value, same_value
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.theme import ROW, colour, font, scheme, severity_icon
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.table_items import item_at

NUMBER, NAME, FILE, CONTROL, REMARK = range(5)
_FIGURE = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_MAX_REMARK, _MIN_REMARK = 232, 168
"""Pixels for what differs, where there is room and where there is not."""


class TurnedValue(NamedTuple):
    """A value that was written into the control from here: what it was, and until when."""

    before: Value | None
    until: datetime


class LiveRows(QTableWidget):
    """The values of one axis, and those of the whole control; read only."""

    chosen = Signal(object)
    """The address of the current row; None where there is none."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__(0, 5)
        self._workspace = workspace
        self.addresses: list[Address] = []
        self._present: ParameterFile | None = None
        self._turned: Mapping[Address, TurnedValue] = {}
        self._is_narrow = False
        self.setAccessibleName(self.tr("Values in the file and in the control"))
        self.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        self.setSelectionMode(QTableWidget.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setWordWrap(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.setHorizontalHeaderLabels(
            [
                self.tr("No."),
                self.tr("Parameter"),
                self.tr("In the file"),
                self.tr("In the control, live"),
                "",
            ]
        )
        head = self.horizontalHeader()
        head.setHighlightSections(False)
        head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        head.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Stretch)
        head.setSectionResizeMode(REMARK, QHeaderView.ResizeMode.Fixed)
        head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        for column in (FILE, CONTROL):
            self.horizontalHeaderItem(column).setTextAlignment(_FIGURE)
        self.currentCellChanged.connect(lambda *_: self.chosen.emit(self.address))
        scheme().changed.connect(self.refresh)

    @property
    def address(self) -> Address | None:
        """The address of the current row."""
        row = self.currentRow()
        return self.addresses[row] if 0 <= row < len(self.addresses) else None

    def show_parameters(self, parameters: Sequence[Parameter], axis: str) -> None:
        """List parameters, those of axes with their value in one; the current one stays where it is."""
        file, before = self._workspace.file, self.address
        self.addresses = [
            found
            for each in parameters
            if (found := _address_in(file, each, axis)) is not None
            and file.evaluation.state(found).state != "hidden"
        ]
        self.setRowCount(len(self.addresses))
        self.refresh()
        # By the parameter, not the address: with another axis the same parameter stays the current one.
        wanted = next((n for n, each in enumerate(self.addresses) if before and each[0] == before[0]), 0)
        if self.addresses:
            self.setCurrentCell(wanted, NAME)
        self.chosen.emit(self.address)

    def select(self, parameter_id: str) -> None:
        """Make the row of a parameter the current one, where it is listed."""
        row = next((n for n, each in enumerate(self.addresses) if each[0] == parameter_id), None)
        if row is not None:
            self.setCurrentCell(row, NAME)

    def show_control(self, present: ParameterFile | None, turned: Mapping[Address, TurnedValue]) -> None:
        """Show what the control contains; None for not known."""
        self._present, self._turned = present, turned
        self.refresh()

    def show_short_words(self, is_narrow: bool) -> None:
        """Say in few words what differs, where there is little room."""
        self._is_narrow = is_narrow
        self.setColumnWidth(REMARK, _MIN_REMARK if is_narrow else _MAX_REMARK)
        head = self.tr("In the control") if is_narrow else self.tr("In the control, live")
        self.horizontalHeaderItem(CONTROL).setText(head)
        self.refresh()

    def refresh(self, *_: object) -> None:
        """Show every row as it is now."""
        file, secrets = self._workspace.file, self._workspace.secrets
        for row, address in enumerate(self.addresses):
            parameter = file.schema.parameters[address[0]]
            own = file.get(address)
            theirs = self._present.get(address) if self._present is not None else None
            # In one unit: 1 in beside 25.4 mm would look like a difference.
            shown_own, shown_theirs = in_one_unit((own, theirs), self._workspace.typed_unit(address))
            texts = (
                file.machine_schema.number(address) or "",
                parameter.name,
                show_value(parameter, shown_own, secrets=secrets) if own else self.tr("not set"),
                self._text_of_control(parameter, shown_theirs),
            )
            for column, text in enumerate(texts):
                item = item_at(self, row, column)
                item.setText(text)
                item.setToolTip(text if column == NAME else "")
                if column in (FILE, CONTROL):
                    item.setTextAlignment(_FIGURE)
            differs = self._present is not None and not same_value(own, theirs)
            item_at(self, row, NUMBER).setForeground(colour("dim"))
            item_at(self, row, CONTROL).setForeground(colour("text" if differs else "dim"))
            item_at(self, row, CONTROL).setFont(font("text", own=differs))
            self._show_remark(item_at(self, row, REMARK), address, differs)
        self.setColumnHidden(NUMBER, not any(map(file.machine_schema.number, self.addresses)))

    def _text_of_control(self, parameter: Parameter, value: Value | None) -> str:
        if self._present is None:
            return "–"
        return show_value(parameter, value, secrets=self._workspace.secrets) if value else self.tr("not set")

    def _show_remark(self, item: QTableWidgetItem, address: Address, differs: bool) -> None:
        """Show what is to be minded: a value that was turned here, or one that is another in the file."""
        turned = self._turned.get(address)
        # A value that was turned here differs on purpose.
        item.setIcon(severity_icon("warning") if differs and turned is None else QIcon())
        item.setForeground(colour("chg" if turned is not None else "text"))
        text = ""
        if turned is not None:
            parameter = self._workspace.file.schema.parameters[address[0]]
            before = show_value(parameter, turned.before, secrets=self._workspace.secrets)
            text = self.tr("turned, was {value}").format(value=before)
            if not self._is_narrow:
                text = self.tr("turned, was {value} until {time}").format(
                    value=before, time=f"{turned.until:%H:%M:%S}"
                )
        elif differs:
            text = self.tr("differs") if self._is_narrow else self.tr("differs from the file")
        item.setText(text)
        item.setToolTip(text)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave Space to the page: it starts and stops the recorder."""
        if event.key() == Qt.Key.Key_Space:
            event.ignore()
        else:
            super().keyPressEvent(event)


def _address_in(file: ParameterFile, parameter: Parameter, axis: str) -> Address | None:
    """Return where a parameter is seen for an axis: in it, or in the whole control; None for one of another
    kind (points of a table).
    """
    instances = file.machine_schema.instances(parameter)
    if axis in instances:
        return parameter.id, axis
    return (parameter.id, instances[0]) if len(instances) == 1 else None
