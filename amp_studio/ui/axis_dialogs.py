"""The dialogs of the axis menu: which axis, which name, which type, which servo."""

from __future__ import annotations

from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import axis_instances, axis_title, axis_type
from amp_studio.schema import Address, write_value

from .choice_box import ChoiceBox
from .workspace import Workspace


class AxisDialog(QDialog):
    """Asks for an axis and then for its choices and texts, or for a second axis."""

    def __init__(self, workspace: Workspace, title: str, axis: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(380)
        self._workspace = workspace
        self._fields: dict[str, ChoiceBox | QLineEdit] = {}
        self.axis_box = self._axis_list(axis)
        self.axis_box.currentIndexChanged.connect(lambda _: self._fill())
        self._form = QFormLayout()
        self._form.addRow("&Axis", self.axis_box)
        self.note = QLabel()
        self.note.setWordWrap(True)
        self._buttons = buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(self._form)
        layout.addWidget(self.note)
        layout.addWidget(buttons)
        self._wanted: list[str] = []

    def _axis_list(self, axis: str) -> QComboBox:
        box = QComboBox()
        for instance in axis_instances(self._workspace.file):
            box.addItem(axis_title(self._workspace.file, instance), instance)
        box.setCurrentIndex(max(box.findData(axis), 0))
        return box

    def ask_for(self, parameter_ids: list[str]) -> None:
        """Show a field for each of these parameters of the chosen axis; choices are lists."""
        self._wanted = parameter_ids
        self._fill()

    def ask_for_target(self) -> QComboBox:
        """Show a field for the target axis and return it."""
        box = self._axis_list(self.axis())
        same = [
            n for n in range(box.count()) if n != box.currentIndex() and self._is_alike(str(box.itemData(n)))
        ]
        box.setCurrentIndex(same[0] if same else box.currentIndex())
        self._form.addRow("&To axis", box)
        QWidget.setTabOrder(self.axis_box, box)
        return box

    def _is_alike(self, axis: str) -> bool:
        return axis_type(self._workspace.file, axis) == axis_type(self._workspace.file, self.axis())

    def _fill(self) -> None:
        for box in self._fields.values():
            self._form.removeRow(box)
        self._fields = {}
        for parameter_id in self._wanted:
            file, address = self._workspace.file, (parameter_id, self.axis())
            parameter = file.schema.parameters[parameter_id]
            field: ChoiceBox | QLineEdit
            if parameter.choices:
                field = ChoiceBox(self._workspace, address)
            else:
                field = QLineEdit(write_value(parameter, file.get(address)))
            self._form.addRow(parameter.name, field)
            self._fields[parameter_id] = field
        before: QWidget = self.axis_box
        for after in (*self._fields.values(), self._buttons):  # fields are made after the buttons
            QWidget.setTabOrder(before, after)
            before = after

    def done(self, result: int) -> None:
        """Close the dialog; its input can be read until the next event."""
        super().done(result)
        self.deleteLater()

    def axis(self) -> str:
        """Return the chosen axis."""
        return str(self.axis_box.currentData())

    def texts(self) -> dict[Address, str]:
        """Return the chosen label, or the text, of each parameter."""
        found = {}
        for parameter_id, field in self._fields.items():
            if isinstance(field, QLineEdit):
                found[parameter_id, self.axis()] = field.text()
            elif field.currentIndex() >= 0:
                found[parameter_id, self.axis()] = str(field.currentData())
        return found
