"""Notes about the selected value, its group, or the machine."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QComboBox, QDialog, QDialogButtonBox, QFormLayout, QPlainTextEdit, QWidget

from amp_studio.files import (
    group_note,
    machine_note,
    set_group_note,
    set_machine_note,
    set_value_note,
    value_note,
)
from amp_studio.schema import Address
from amp_studio.ui.base.workspace import Workspace


class NoteDialog(QDialog):
    """Edits one note after the other; each is a step to undo when the dialog is accepted."""

    def __init__(self, workspace: Workspace, address: Address | None, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace, self._address = workspace, address
        file = workspace.file
        self.setWindowTitle(self.tr("Note"))
        self.resize(460, 260)
        self.about, self.text = QComboBox(), QPlainTextEdit()
        self.text.setTabChangesFocus(True)
        self.text.setReadOnly(not workspace.may_edit)
        self.text.setAccessibleName(self.tr("Note"))
        self._texts: dict[str, str] = {"machine": machine_note(file)}
        if address is not None:
            group = file.schema.group_of[address[0]]
            self._group = group.key
            self._texts |= {"value": value_note(file, address), "group": group_note(file, group.key)}
            self.about.addItem(workspace.name_of(address), "value")
            self.about.addItem(group.section or group.name, "group")
        self.about.addItem(self.tr("The whole machine"), "machine")
        self._old = dict(self._texts)
        self._shown = str(self.about.currentData())
        self.text.setPlainText(self._texts[self._shown])
        self.about.currentIndexChanged.connect(self._turn)
        form = QFormLayout(self)
        form.addRow(self.tr("&About"), self.about)
        form.addRow(self.tr("&Note"), self.text)
        buttons = QDialogButtonBox()
        buttons.addButton(self.tr("&Save Note"), QDialogButtonBox.ButtonRole.AcceptRole).setEnabled(
            workspace.may_edit
        )
        buttons.addButton(self.tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form.addRow(buttons)
        self.text.setFocus()

    def _turn(self) -> None:
        self._texts[self._shown] = self.text.toPlainText()
        self._shown = str(self.about.currentData())
        self.text.setPlainText(self._texts[self._shown])

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Ctrl+Enter saves, as Enter is a new line of the note."""
        if (
            event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
            and event.modifiers() & Qt.KeyboardModifier.ControlModifier
        ):
            self.accept()
        else:
            super().keyPressEvent(event)

    def write(self) -> None:
        """Put the notes that were changed into the file, as one step; raises NoteError,
        and then nothing is changed.
        """
        self._texts[self._shown] = self.text.toPlainText()
        changed = {key: text for key, text in self._texts.items() if text.strip() != self._old[key]}
        file, address = self._workspace.file, self._address

        def put() -> None:
            for key, text in changed.items():
                if key == "machine":
                    set_machine_note(file, text)
                elif key == "group":
                    set_group_note(file, self._group, text)
                elif address is not None:
                    set_value_note(file, address, text)

        about = self.about.itemText(self.about.findData(next(iter(changed), "machine")))
        self._workspace.do(self.tr("Note about {name}").format(name=about), put)
