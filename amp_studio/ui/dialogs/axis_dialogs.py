"""The dialogs of the axis menu: which axis, which name, which type, which servo, which place."""

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

from amp_studio.files import (
    are_alike,
    axis_instances,
    axis_letter,
    axis_title,
    fitted_axes,
    letters_offered,
    places_offered,
    shown_axes,
)
from amp_studio.schema import Address, write_value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.choice_box import ChoiceBox


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
        self._form.addRow(self.tr("&Axis"), self.axis_box)
        self.note = QLabel()
        self.note.setWordWrap(True)
        self._buttons = buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        buttons.button(QDialogButtonBox.StandardButton.Ok).setText(title)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(self._form)
        layout.addWidget(self.note)
        layout.addWidget(buttons)
        self._wanted: list[str] = []

    def _axis_list(self, axis: str) -> QComboBox:
        box = QComboBox()
        file = self._workspace.file
        # An axis that is not there can be given a type; where axes have no types there is nothing to do with
        # it.
        for instance in axis_instances(file) if file.schema.family.axes else fitted_axes(file):
            box.addItem(axis_title(self._workspace.file, instance), instance)
        box.setCurrentIndex(max(box.findData(axis), 0))
        return box

    def ask_for(self, parameter_ids: list[str]) -> None:
        """Show a field for each of these parameters of the chosen axis; choices are lists."""
        self._wanted = parameter_ids
        self._fill()

    def ask_for_letter(self) -> QComboBox:
        """Show a field for the letter of the chosen axis and return it."""
        box = letter_box(self._workspace)
        self._form.addRow(self.tr("&Letter"), box)
        QWidget.setTabOrder(self.axis_box, box)

        def fill(*_: object) -> None:
            box.setCurrentText(axis_letter(self._workspace.file, self.axis()))

        self.axis_box.currentIndexChanged.connect(fill)
        fill()
        return box

    def ask_for_target(self, label: str) -> QComboBox:
        """Show a field for another axis and return it."""
        box = self._axis_list(self.axis())
        same = [
            n for n in range(box.count()) if n != box.currentIndex() and self._is_alike(str(box.itemData(n)))
        ]
        box.setCurrentIndex(same[0] if same else box.currentIndex())
        self._form.addRow(label, box)
        QWidget.setTabOrder(self.axis_box, box)
        return box

    def _is_alike(self, axis: str) -> bool:
        return are_alike(self._workspace.file, axis, self.axis())

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


class AddAxisDialog(QDialog):
    """Asks for the letter and the place of one more axis."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Add axis"))
        self.setMinimumWidth(380)
        file = workspace.file
        self._places = QComboBox()
        for place in places_offered(file):
            there = place in shown_axes(file)
            text = self.tr("Before {axis}").format(axis=axis_title(file, place)) if there else place
            self._places.addItem(text, place)
        self._letters = letter_box(workspace)
        if self._letters.count() == 0:
            self._letters.addItem(str(self._places.currentData()))
        taken = {axis_letter(file, axis) for axis in fitted_axes(file)}
        free = [n for n in range(self._letters.count()) if self._letters.itemText(n) not in taken]
        self._letters.setCurrentIndex(free[0] if free else 0)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.addButton(self.tr("A&dd Axis"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form = QFormLayout(self)
        form.addRow(self.tr("&Letter"), self._letters)
        form.addRow(self.tr("&Place"), self._places)
        form.addRow(buttons)

    def done(self, result: int) -> None:
        """Close the dialog; its input can be read until the next event."""
        super().done(result)
        self.deleteLater()

    def name(self) -> str:
        """Return the chosen letter."""
        return self._letters.currentText()

    def place(self) -> str:
        """Return the chosen place."""
        return str(self._places.currentData())


def letter_box(workspace: Workspace) -> QComboBox:
    """Return a list of the letters that an axis can have."""
    box = QComboBox()
    box.addItems(letters_offered(workspace.file.schema))
    return box
