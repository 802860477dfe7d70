"""The list of differences between the open file and another one, or a control."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import Comparison, Difference, ParameterFile
from amp_studio.schema import Address, Value, show_value

from .workspace import Workspace

_DIFFERENCE = Qt.ItemDataRole.UserRole


class DifferenceList(QTreeWidget):
    """One row for each value that differs: parameter, axis, kind of difference and both values."""

    def __init__(
        self, file: ParameterFile, found: Comparison, other: str, *, tick: bool, secrets: bool
    ) -> None:
        super().__init__()
        self.setHeaderLabels(
            ["Parameter", "Axis", "Difference", "This file", other.replace("the control", "The control")]
        )
        self.setRootIsDecorated(False)
        self.setUniformRowHeights(True)
        self.setAlternatingRowColors(True)
        self.items: list[QTreeWidgetItem] = []
        schema, machine = file.schema, file.machine
        for difference in found.differences:
            item = QTreeWidgetItem([
                schema.on(machine).label(difference.address),
                schema.on(machine).instance_label(difference.address),
                "not in this file" if difference.a is None else "only in this file" if difference.b is None else "different",
                *(show_value(schema.parameters[difference.address[0]], v, secrets=secrets)
                  for v in difference.in_one_unit()),
            ])  # fmt: skip
            item.setData(0, _DIFFERENCE, difference)
            if tick:
                item.setCheckState(0, Qt.CheckState.Unchecked)
            self.items.append(item)
        self.addTopLevelItems(self.items)
        for column, width in enumerate((290, 70, 105, 190, 190)):
            self.setColumnWidth(column, width)

    def tick_all(self) -> None:
        """Tick every row, or none if all are ticked."""
        ticked = all(i.checkState(0) == Qt.CheckState.Checked for i in self.items)
        for item in self.items:
            item.setCheckState(0, Qt.CheckState.Unchecked if ticked else Qt.CheckState.Checked)

    def tick(self, addresses: Iterable[Address]) -> None:
        """Tick the rows of these addresses."""
        wanted = set(addresses)
        for item in self.items:
            if item.data(0, _DIFFERENCE).address in wanted:
                item.setCheckState(0, Qt.CheckState.Checked)

    def ticked(self) -> list[Difference]:
        """Return the differences whose rows are ticked."""
        return [i.data(0, _DIFFERENCE) for i in self.items if i.checkState(0) == Qt.CheckState.Checked]


def counts(found: Comparison, other: str) -> str:
    """Return the counts of a comparison in a sentence."""
    different = len(found.differences) - found.not_set_in_a - found.not_set_in_b
    not_set = f"{found.not_set_in_a} not set in this file, {found.not_set_in_b} not set in {other}"
    return f"{different} different, {found.same} the same, {not_set}."


class CompareDialog(QDialog):
    """Shows what differs; the values of ticked rows can be copied as one step. Stays open beside the table."""

    def __init__(
        self,
        workspace: Workspace,
        other_values: Mapping[Address, Value],
        other: str,
        show: Callable[[Address], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(f"Compare with {other}")
        self.resize(900, 500)
        self._workspace, self._values, self._other, self._show = workspace, dict(other_values), other, show
        self.text = QLabel()
        self.text.setWordWrap(True)
        self.list = DifferenceList(workspace.file, Comparison((), 0), other, tick=True, secrets=False)
        self.every = QPushButton("Select &All")
        self.take_button = QPushButton("&Copy Selected Values to This File")
        close = QPushButton("&Close")
        buttons = QHBoxLayout()
        for button, act in ((self.every, self._tick_all), (self.take_button, self.take), (close, self.close)):
            button.setAutoDefault(False)
            button.clicked.connect(act)
            buttons.addWidget(button)
        buttons.insertStretch(2)
        self._layout = QVBoxLayout(self)
        self._layout.addWidget(self.text)
        self._layout.addWidget(self.list)
        self._layout.addLayout(buttons)
        workspace.changed.connect(self._fill)
        workspace.closed.connect(self.close)
        self._fill()

    def _fill(self, *_: object) -> None:
        """Update the list after an edit; ticks are kept."""
        found = self._workspace.differences_to(self._values)
        ticked = {d.address for d in self.list.ticked()}
        fresh = DifferenceList(
            self._workspace.file, found, self._other, tick=True, secrets=self._workspace.secrets
        )
        self._layout.replaceWidget(self.list, fresh)
        self.list.deleteLater()
        self.list = fresh
        self.list.tick(ticked)
        self.list.itemActivated.connect(self._go)
        self.text.setText(counts(found, self._other))
        for button in (self.every, self.take_button):
            button.setEnabled(self._workspace.may_edit and bool(found.differences))

    def _go(self, item: QTreeWidgetItem) -> None:
        self._show(item.data(0, _DIFFERENCE).address)

    def _tick_all(self) -> None:
        self.list.tick_all()

    def take(self) -> None:
        """Copy the ticked values to the open file as one step; a value that is out of range is marked as forced."""
        wanted = {d.address: d.b for d in self.list.ticked()}
        if wanted:
            self._workspace.edit(
                f"Copy values from {self._other}", wanted, force=f"copied from {self._other}"
            )


class DownloadPreview(QDialog):
    """Shows what a download or a restore changes in the control, and asks before it starts."""

    def __init__(
        self,
        file: ParameterFile,
        found: Comparison,
        parent: QWidget | None = None,
        *,
        secrets: bool = False,
        title: str = "Download",
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(900, 500)
        text = QLabel(f"{counts(found, 'the control')} The download replaces all parameters in the control. Values that are not set in this file are "
                      "not sent. The control's present parameters are saved beside the file first.\n\nThe control must be in E-stop.")  # fmt: skip
        text.setWordWrap(True)
        self.list = DifferenceList(file, found, "the control", tick=False, secrets=secrets)
        self.send, cancel = QPushButton(f"&{title}"), QPushButton("Cancel")
        self.send.setDefault(True)
        self.send.clicked.connect(self.accept)
        cancel.clicked.connect(self.reject)
        buttons = QHBoxLayout()
        buttons.addStretch()
        buttons.addWidget(self.send)
        buttons.addWidget(cancel)
        layout = QVBoxLayout(self)
        layout.addWidget(text)
        layout.addWidget(self.list)
        layout.addLayout(buttons)
