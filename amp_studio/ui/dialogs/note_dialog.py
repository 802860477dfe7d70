"""Notes about the selected value, its group, or the machine."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from amp_studio.files import (
    group_note,
    machine_note,
    note_fault,
    set_group_note,
    set_machine_note,
    set_value_note,
    value_note,
)
from amp_studio.schema import Address
from amp_studio.ui.base.translated import message_in_words, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.form import Field, FormDialog


class NoteDialog(FormDialog):
    """Edits one note after the other; each is a step to undo when the dialog is accepted."""

    def __init__(self, workspace: Workspace, address: Address | None, parent: QWidget | None = None) -> None:
        self._workspace, self._address = workspace, address
        file = workspace.file
        self._texts: dict[str, str] = {}
        self._names: dict[str, str] = {}
        if address is not None:
            group = file.schema.group_of[address[0]]
            self._group = group.key
            self._texts = {"value": value_note(file, address), "group": group_note(file, group.key)}
            self._names = {"value": workspace.name_of(address), "group": group.own_name}
        self._texts["machine"], self._names["machine"] = machine_note(file), tr("The whole machine")
        self._old, self._about = dict(self._texts), next(iter(self._texts))
        fields = (
            Field("about", tr("&About"), "choice", choices=[*self._names.items()]),
            Field("note", tr("&Note"), "lines", self._texts[self._about]),
        )
        super().__init__(tr("Note"), fields, tr("&Save Note"), parent)
        text = self.form.editor("note", QPlainTextEdit)
        text.setReadOnly(not workspace.may_edit)
        text.setFocus()
        self.form.entered.connect(self._turn)

    def problem(self) -> str:
        """Return why no note can be saved: a text that no file can contain stays here, to be shortened."""
        if not self._workspace.may_edit:
            return tr("The file is read-only: notes can be read.")
        texts = {**self._texts, self._about: self.form.answer("note")}
        fault = next(filter(None, map(note_fault, texts.values())), "")
        words = message_in_words(fault)
        return f"{words[:1].upper()}{words[1:]}." if fault else ""

    def _turn(self, _: str) -> None:
        self._texts[self._about] = self.form.answer("note")
        self._about = self.form.answer("about")
        self.form.set_answer("note", self._texts[self._about])

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
        self._texts[self._about] = self.form.answer("note")
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

        about = self._names[next(iter(changed), "machine")]
        self._workspace.do(self.tr("Note about {name}").format(name=about), put)
