"""Quick edit: type a parameter's number, then its value, then the next number."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QDialog, QLabel, QLineEdit, QVBoxLayout, QWidget

from amp_studio.schema import Address, UnknownParameter, write_value

from .value_delegate import choice_box
from .workspace import Workspace


class QuickEdit(QDialog):
    """Stays open from parameter to parameter; Enter goes on, Escape ends."""

    def __init__(
        self,
        workspace: Workspace,
        commit: Callable[[Address, str], bool],
        show: Callable[[Address], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Quick Edit")
        self.setMinimumWidth(420)
        self._workspace, self._commit, self._show = workspace, commit, show
        self._address: Address | None = None
        self.number = QLineEdit()
        self.number.setPlaceholderText("Parameter number, or id@instance")
        self.number.returnPressed.connect(self.find)
        self.name = QLabel()
        self.name.setWordWrap(True)
        self._editor: QWidget | None = None
        self._layout = QVBoxLayout(self)
        for widget in (self.number, self.name):
            self._layout.addWidget(widget)

    def find(self) -> None:
        """Look up the number and offer its value."""
        try:
            address = self._workspace.file.find(self.number.text())
        except UnknownParameter as error:
            self._offer(None)
            self.name.setText(str(error))
            return
        self._offer(address)

    def _offer(self, address: Address | None) -> None:
        if self._editor is not None:
            self._layout.removeWidget(self._editor)
            self._editor.deleteLater()
            self._editor = None
        self._address = address
        if address is None:
            return
        self._show(address)
        file = self._workspace.file
        parameter = file.schema.parameters[address[0]]
        state = file.situation.state(address)
        told = "" if state.state == "in-force" else f"\n{state.state}: {state.why}"
        self.name.setText(f"{file.schema.label(address, file.machine)}  [{written_place(self._workspace, address)}]{told}")
        if parameter.choices:
            box = choice_box(self._workspace, address, self)
            box.activated.connect(lambda _: self.enter())
            self._editor = box
        else:
            line = QLineEdit(write_value(parameter, file.get(address)))
            line.selectAll()
            line.returnPressed.connect(self.enter)
            self._editor = line
        self._layout.addWidget(self._editor)
        self._editor.setFocus(Qt.FocusReason.OtherFocusReason)

    def enter(self) -> None:
        """Take the value and ask for the next number."""
        if self._address is None:
            return
        text = self._editor.currentData() if isinstance(self._editor, QComboBox) else self._editor.text()  # type: ignore[union-attr]
        if self._commit(self._address, str(text)):
            self._offer(None)
            self.number.setFocus()
            self.number.selectAll()


def written_place(workspace: Workspace, address: Address) -> str:
    """Return ``Axis 1`` or ``Control``."""
    return workspace.file.schema.instance_label(address, workspace.file.machine) or "Control"
