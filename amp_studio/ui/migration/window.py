"""A machine taken to another control, as a window: questions and what is less safe on the left, old, meaning
and new on the right; written only where nothing is open, or as a draft.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QFileDialog, QLabel, QPushButton, QScrollArea, QSplitter, QWidget

from amp_studio.files import ParameterFile
from amp_studio.meaning import (
    MeaningError,
    MigratedParameter,
    Migration,
    TargetError,
    less_safe,
    migrate,
    targets,
)
from amp_studio.report import write_migration_folder
from amp_studio.schema import load_schema
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.theme import GAP2, GAP3, colour, font
from amp_studio.ui.base.translated import language_of_window, sentenced, tr, written_to
from amp_studio.ui.forms.folder_view import show_in_folder
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.ui.forms.message_bar import MessageBar

from .rows import MigrationTree

_TYPING_MS = 300
"""After the last key the answers are taken."""
_TO = "to"
_QUESTION = ".question"


class MigrationWindow(QDialog):
    """Shows what becomes of a file at another control while its questions are answered."""

    def __init__(
        self,
        read: Callable[[], ParameterFile],
        source: Path,
        show_parameter: Callable[[str], object],
        parent: QWidget | None = None,
    ) -> None:
        """``read`` returns a copy of the file as it is now, ``source`` is its path."""
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._read, self._file, self._source = read, read(), source
        self.migration: Migration | None = None
        self.setWindowTitle(tr("Migrate to Another Control"))
        self.setModal(False)
        known = [t for t in targets() if t != self._file.schema.family.family]
        target = Field(
            _TO,
            tr("&New control"),
            "choice",
            known[0] if known else "",
            [(t, load_schema(t).family.name) for t in known],
        )
        self.target, self.questions = FieldForm([target]), FieldForm()
        self.tree, self.bar = MigrationTree(), MessageBar()
        self.why, self.losses, self.summary = QLabel(), QLabel(), QLabel()
        for label in (self.why, self.losses, self.summary):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.write_button, self.draft_button = QPushButton(tr("&Write…")), QPushButton(tr("Write a &Draft…"))
        self._lay_out()
        self._timer = single_shot(self, self.migrate)
        self.target.entered.connect(lambda _: self.migrate())
        self.questions.changed.connect(lambda _: self._timer.start(_TYPING_MS))
        self.tree.currentItemChanged.connect(lambda *_: self._show_why())
        self.tree.itemDoubleClicked.connect(lambda *_: self._follow(show_parameter))
        self.write_button.clicked.connect(self.write)
        self.draft_button.clicked.connect(self.write)
        fit_to_screen(self, 1180, 660)
        self.migrate()

    def _lay_out(self) -> None:
        left = QWidget()
        column = in_column(self.target, on=left, margins=(0, 0, GAP2, 0))
        heads = {self.losses: tr("Less safe than before"), self.questions: tr("Questions")}
        for widget, title in heads.items():
            head = QLabel(title)
            head.setFont(font("text", own=True))
            column.addWidget(head)
            column.addWidget(widget)
        column.addStretch(1)
        scroll = QScrollArea()
        scroll.setWidget(left)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        right = QWidget()
        self.why.setMinimumHeight(48)
        in_column((self.tree, 1), self.why, on=right, margins=0)
        parts = QSplitter()
        parts.addWidget(scroll)
        parts.addWidget(right)
        parts.setSizes([360, 800])
        close = QPushButton(tr("&Close"))
        for button in (self.write_button, self.draft_button, close):
            button.setAutoDefault(False)
        close.clicked.connect(self.close)
        footer = in_row((self.summary, 1), self.write_button, self.draft_button, close)
        in_column(self.bar, (parts, 1), footer, on=self, margins=GAP3, gap=GAP2)

    # -- what becomes of it ----------------------------------------------------------

    def answers(self) -> dict[str, str]:
        """Return the answers that are given."""
        given = self.questions.answers()
        return {key: str(text) for key, text in given.items() if text}

    def migrate(self) -> None:
        """Show the file of now at the other control with the answers of now;
        a fault is shown, and what was there before stays.
        """
        self._timer.stop()
        self._file = self._read()
        target = self.target.answer(_TO)
        known = {q.id for q in self.migration.written.asked} if self.migration else set[str]()
        asked = {key: text for key, text in self.answers().items() if key in known}
        if self.migration is not None and self.migration.target != target:
            asked = {}  # the questions of the other control are asked first
        try:
            found = migrate(self._file, target, asked)
        except (TargetError, MeaningError) as error:
            self._show_summary(self._worded(str(error)))
            return
        self.migration = found
        self._ask(found)
        self.tree.show_migration(found, self._label, self._worded)
        self.losses.setText(
            "\n".join(f"• {self._worded(text)}" for text in less_safe(found)) or tr("nothing that is known")
        )
        self._show_summary()

    def _show_summary(self, fault: str = "") -> None:
        """Show how far it is, or what is wrong with an answer: then nothing can be written."""
        found = self.migration
        if found is not None and not fault:
            self.summary.setText(
                tr("{count} active parameters, {open} questions open").format(
                    count=len(found.entries), open=len(found.written.open)
                )
            )
        else:
            self.summary.setText(fault)
        self.summary.setStyleSheet(f"color: {colour('error' if fault else 'text').name()}")
        is_open = bool(found and found.written.open)
        self.write_button.setEnabled(found is not None and not fault and not is_open)
        self.draft_button.setEnabled(not fault and is_open)

    def _ask(self, found: Migration) -> None:
        fields: list[Field] = []
        for question in found.written.asked:
            fields.append(Field(question.id + _QUESTION, "", "words", self._worded(question.question)))
            fields.append(Field(question.id, tr("Answer"), tip=question.id))
        self.questions.offer(fields, keep=True)

    def _worded(self, text: str) -> str:
        """Return what the new control's or the file's family states, in the language of the window."""
        return sentenced(text, str(self.target.answer(_TO)), self._file.schema.family.family)

    def _label(self, entry: MigratedParameter) -> str:
        return self._file.machine_schema.label(entry.address)

    def _show_why(self) -> None:
        row = self.tree.row()
        self.why.setText("\n".join(filter(None, (row.old, row.why))) if row else "")

    def _follow(self, show_parameter: Callable[[str], object]) -> None:
        if (row := self.tree.row()) is not None:
            show_parameter(row.parameter)

    # -- writing -----------------------------------------------------------------------

    def write(self) -> None:
        """Ask for a new folder and write configuration, report and paper into it."""
        migration = self.migration
        if migration is None:
            return
        near = self._source.with_name(f"{self._source.stem}-{migration.target}")
        text, _ = QFileDialog.getSaveFileName(
            self, tr("Name of the new folder"), str(near), options=QFileDialog.Option.DontConfirmOverwrite
        )
        if not text:
            return
        folder, notes = Path(text), list[str]()
        try:
            written = in_background(
                self,
                tr("Migrate to Another Control"),
                lambda: write_migration_folder(
                    migration, folder, notes.append, language=language_of_window()
                ),
            )
        except OSError as error:
            self.bar.say(f"{folder}: {error.strerror or error}", "error")
            return
        message = "; ".join((written_to(folder), ", ".join(written), *notes))
        self.bar.say(message, "information", (tr("Show in &Folder"), lambda: show_in_folder(folder)))
