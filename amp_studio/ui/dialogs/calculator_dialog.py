"""The published formulas as calculators; a result that is a number can become the value of a parameter."""

from __future__ import annotations

import re
from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QDialog, QFormLayout, QLabel, QLineEdit, QPushButton, QWidget

from amp_studio.schema import Address, shown
from amp_studio.ui.base.workspace import Workspace
from amp_studio.validate import calculate, calculators, shown_result


class CalculatorDialog(QDialog):
    """Evaluates a formula while its arguments are typed."""

    def __init__(
        self,
        workspace: Workspace,
        address: Address | None,
        commit: Callable[[Address, str], bool],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Calculator"))
        self.setMinimumWidth(520)
        self._workspace, self._address, self._commit = workspace, address, commit
        self._family = workspace.file.schema.family.family
        self._known = calculators(self._family)
        own = workspace.file.schema.parameters[address[0]].formulas if address else ()
        self.formula = QComboBox()
        for name in (*own, *(name for name in sorted(self._known) if name not in own)):
            self.formula.addItem(self._known[name].title, name)
        self.description, self.outcome = QLabel(), QLabel()
        for label in (self.description, self.outcome):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.use = QPushButton()
        self.use.clicked.connect(self._use)
        self.fields: dict[str, QLineEdit] = {}
        self._form = QFormLayout(self)
        self._form.addRow(self.tr("&Formula"), self.formula)
        self._form.addRow(self.description)
        self._form.addRow(self.tr("Result"), self.outcome)
        self._form.addRow(self.use)
        self.formula.currentTextChanged.connect(self._choose)
        workspace.closed.connect(self.close)
        self._choose()

    def _choose(self, *_: object) -> None:
        for field in self.fields.values():
            self._form.removeRow(field)
        self.fields.clear()
        calculator = self._known[self.formula.currentData()]
        self.description.setText(calculator.description)
        for n, argument in enumerate(calculator.arguments):
            field = self.fields[argument.name] = QLineEdit()
            field.setPlaceholderText(argument.default or argument.example)
            field.textChanged.connect(self._work_out)
            self._form.insertRow(2 + n, argument.title, field)
        self._work_out()

    def _work_out(self, *_: object) -> None:
        texts = {name: field.text() for name, field in self.fields.items()}
        self.use.setEnabled(False)
        self.use.setText(self.tr("Use the result as a value"))
        arguments = self._known[self.formula.currentData()].arguments
        missing = [a.title for a in arguments if a.default is None and not texts[a.name].strip()]
        if missing:
            self.outcome.setText(self.tr("Still needed: {names}").format(names="; ".join(missing)))
            return
        try:
            result = calculate(self._family, self.formula.currentData(), texts)
        except ValueError as error:
            self.outcome.setText(self._titled(f"{error}.".replace("..", ".")))
            return
        self.outcome.setText(shown_result(result))
        if self._address and isinstance(result, (int, float)) and not isinstance(result, bool):
            label = self._workspace.file.machine_schema.label(self._address)
            unit = shown(self._workspace.typed_unit(self._address))
            self.use.setText(
                self.tr("Use the result as the value of {label}{what}").format(
                    label=label, what=f", in {unit}" if unit else ""
                )
            )
            self.use.setEnabled(self._workspace.may_edit)

    def _titled(self, text: str) -> str:
        """Return a message with the titles of the formula and of its arguments for their names."""
        calculator = self._known[self.formula.currentData()]
        titles = {calculator.name: calculator.title, **{a.name: a.title for a in calculator.arguments}}
        for name, title in titles.items():
            text = re.sub(rf"\b{name}\b", title, text) if "_" in name else text
        return text

    def _use(self) -> None:
        if self._address and self._commit(self._address, self.outcome.text()):
            self.close()
