"""Quick edit: type a parameter's number, then its value, then the next number."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QFormLayout, QLabel, QLineEdit, QWidget

from amp_studio.report import state_name
from amp_studio.schema import Address, UnknownParameterError, resolve_address
from amp_studio.ui.base.places import place_in_words
from amp_studio.ui.base.translated import worded
from amp_studio.ui.forms.choice_box import ChoiceBox

from .parameter_table import ParameterTable
from .value_delegate import allowed_text


class QuickEdit(QDialog):
    """Asks for one parameter after the other; Enter continues, Escape closes."""

    def __init__(
        self,
        table: ParameterTable,
        commit: Callable[[Address, str], bool],
        show: Callable[[Address], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Quick Edit"))
        self.setMinimumWidth(480)
        self._table, self._workspace, self._commit, self._show = table, table.workspace, commit, show
        self._address: Address | None = None
        self.number = QLineEdit()
        self.number.setPlaceholderText(self.tr("1300, or home.calibration@1"))
        self.name = QLabel(
            self.tr("Type a number and press Enter, then a value and press Enter. Escape closes.")
        )
        self.name.setWordWrap(True)
        self.name.setMinimumHeight(3 * self.name.fontMetrics().height())
        self.name.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.editor: QLineEdit | ChoiceBox | None = None
        self._form = QFormLayout(self)
        self._form.addRow(self.tr("&Number"), self.number)
        self._form.addRow("", self.name)
        table.workspace.closed.connect(self.close)

    def look_up(self) -> None:
        """Find the parameter with this number and show its value."""
        try:
            resolved = resolve_address(self._workspace.file.evaluation, self.number.text())
        except UnknownParameterError as error:
            self._offer(None)
            self.name.setText(f"{error}.")
            self.number.selectAll()
            return
        self._offer(resolved.address, resolved.remark(self._workspace.file.schema))

    def _offer(self, address: Address | None, hint: str = "") -> None:
        if self.editor is not None:
            self._form.removeRow(self.editor)
            self.editor = None
        self._address = address
        if address is None:
            return
        self._show(address)
        file = self._workspace.file
        place = place_in_words(file, address) or self.tr("Control")
        state = file.evaluation.state(address)
        why = worded(state.why, file.schema.family.family)
        inactive = "" if state.is_active else f"\n{worded(state_name(state.state)).capitalize()}: {why}"
        allowed = allowed_text(self._workspace, address)
        bounds = self.tr("\nAllowed here: {allowed}").format(allowed=allowed) if allowed else ""
        self.name.setText(
            f"{file.machine_schema.label(address)}, {place}{bounds}{inactive}" + (f"\n{hint}" if hint else "")
        )
        if file.schema.parameters[address[0]].choices:
            self.editor = ChoiceBox(self._workspace, address, self)
        else:
            line = QLineEdit(self._table.typed_value(address))
            line.setPlaceholderText(allowed)
            if self._workspace.is_masked(address):
                line.setEchoMode(QLineEdit.EchoMode.Password)
            line.selectAll()
            self.editor = line
        self._form.addRow(self.tr("&Value"), self.editor)
        self.editor.show()  # the layout would show it later, and a hidden widget gets no focus
        self.editor.setFocus(Qt.FocusReason.OtherFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter moves from the number to its value, and from the value to the next number."""
        if event.key() not in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            super().keyPressEvent(event)
        elif self.number.hasFocus():
            self.look_up()
        else:
            self.enter()

    def enter(self) -> None:
        """Set the value and ask for the next number; a refused value stays for correction."""
        if self._address is None or self.editor is None:
            return
        if isinstance(self.editor, ChoiceBox):
            text = self.editor.currentData()
        else:  # a value that was only shown, perhaps rounded in another unit, is not written
            text = self.editor.text() if self.editor.isModified() else None
        if text is None or self._commit(self._address, str(text)):
            self._offer(None)
            self.name.setText(
                self.tr("{what}: value set. Type the next number, or press Escape to close.").format(
                    what=self.name.text().splitlines()[0]
                )
            )
            self.number.setFocus()
            self.number.selectAll()
