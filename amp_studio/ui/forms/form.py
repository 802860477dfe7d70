"""Forms are declared: a field is its key, label, tip, kind, default, check, and when it is visible.
``FieldForm`` makes the widgets of its fields, ``FormDialog`` a dialog of one form.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeVar

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QWidget,
)

from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import colour
from amp_studio.ui.base.translated import tr

FormAnswers = Mapping[str, Any]
"""Key -> what is given: the text of a line, the key of a choice, whether a box is checked."""

E = TypeVar("E", bound=QWidget)


@dataclass(frozen=True)
class Field:
    """One question of a form."""

    key: str
    label: str
    """With its Alt letter; of a ``check`` the text beside the box."""
    kind: Literal["line", "lines", "choice", "check", "words"] = "line"
    """``words`` are shown and not asked."""
    default: Any = ""
    """Text, key of the choice, or whether the box is checked."""
    choices: Sequence[tuple[Any, str]] = ()
    """Key and name of each."""
    tip: str = ""
    hint: str = ""
    """What an empty line shows."""
    head: str = ""
    """What is left of a ``check``, for the first one of several."""
    check: Callable[[Any], str] | None = None
    """Returns what is wrong with an answer, as a sentence; empty where nothing is."""
    visible: Callable[[FormAnswers], bool] | None = None
    enabled: bool = True
    editor: Callable[[], QWidget] | None = None
    """Makes another widget than the one of the kind, which is read as that one is."""
    browse: Callable[[QWidget, str], Path | None] | None = None
    """Asks for the path that a line has; it gets a button then."""


def fill_choices(box: QComboBox, choices: Sequence[tuple[Any, str]], chosen: object) -> None:
    """Fill a box without a signal, and choose an entry by its key, else the first."""
    # Filling is no choice: a signal for each entry would run what follows a choice.
    with QSignalBlocker(box):
        box.clear()
        for key, title in choices:
            box.addItem(title, key)
        box.setCurrentIndex(max(_row_of(box, chosen), 0))


def _row_of(box: QComboBox, key: object) -> int:
    """Return the row of a key, -1 without one; Qt finds an equal path only where it is the same object."""
    return next((n for n in range(box.count()) if box.itemData(n) == key), -1)


class FieldForm(QWidget):
    """The widgets of fields, one below the other."""

    changed = Signal(str)
    """The answer of a field is another one, also while a line is typed."""
    entered = Signal(str)
    """A choice was made, a box was switched, or Enter was pressed in a line."""

    def __init__(self, fields: Sequence[Field] = (), parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._fields: dict[str, Field] = {}
        self.editors: dict[str, QWidget] = {}
        """Key -> the widget with the answer."""
        self._rows: dict[str, QWidget] = {}
        self._layout = QFormLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self.offer(fields)

    # -- making ------------------------------------------------------------------

    def offer(self, fields: Sequence[Field], *, keep: bool = False) -> None:
        """Show these fields; one that is declared as before stays as it is.
        ``keep`` takes the answers of the same keys over into those that are made again.
        """
        answers = self.answers() if keep else {}
        same = {field.key for field in fields if self._fields.get(field.key) == field}
        # Only what has changed is made again: a field that stays keeps its text, its cursor and the focus.
        for key in [key for key in self._rows if key not in same]:
            self._layout.removeRow(self._rows.pop(key))
            del self.editors[key], self._fields[key]
        before: QWidget | None = None
        for n, field in enumerate(fields):
            if field.key not in same:
                self._insert(n, field)
                if field.key in answers:
                    self._show_answer(field, answers[field.key])
            # A field that was made later would else come last.
            if before is not None and field.kind != "words":
                QWidget.setTabOrder(before, self.editors[field.key])
            before = self.editors[field.key] if field.kind != "words" else before
        self._fields = {field.key: field for field in fields}
        self.show_visible()

    def _insert(self, row: int, field: Field) -> None:
        editor = self._made(field)
        editor.setToolTip(field.tip)
        editor.setEnabled(field.enabled)
        if field.kind != "check" and field.label and not editor.accessibleName():
            # Without the mark of the Alt letter, which a screen reader would read.
            editor.setAccessibleName(field.label.replace("&", ""))
        self._fields[field.key], self.editors[field.key] = field, editor
        self._rows[field.key] = whole = self._with_button(field, editor) if field.browse else editor
        label = QLabel(field.head if field.kind == "check" else field.label)
        label.setBuddy(editor)
        self._layout.insertRow(row, label, whole)
        if self.isVisible():  # a new row has no height before it is shown too
            label.show()
            whole.show()
        self._show_answer(field, field.default)
        self._connect(field, editor)

    def _made(self, field: Field) -> QWidget:
        if field.editor is not None:
            return field.editor()
        if field.kind == "choice":
            box = QComboBox()
            fill_choices(box, field.choices, field.default)
            return box
        if field.kind == "check":
            return QCheckBox(field.label)
        if field.kind == "lines":
            text = QPlainTextEdit()
            # No tabs in a note: Tab leaves the field as in every other one.
            text.setTabChangesFocus(True)
            return text
        if field.kind == "words":
            label = QLabel()
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            return label
        line = QLineEdit()
        line.setPlaceholderText(field.hint)
        return line

    def _with_button(self, field: Field, line: QWidget) -> QWidget:
        whole, button = QWidget(), QPushButton(tr("&Browse…"))
        # Enter in the line is for the dialog, and must not open a file dialog.
        button.setAutoDefault(False)
        button.clicked.connect(lambda *_: self.browse(field.key))
        in_row(line, button, on=whole, margins=0)
        return whole

    def browse(self, key: str) -> None:
        """Ask for the path of a line."""
        field = self._fields[key]
        if field.browse is not None and (path := field.browse(self, self.answer(key))):
            self.set_answer(key, str(path))

    def _connect(self, field: Field, editor: QWidget) -> None:
        key = field.key

        def change(*_: object) -> None:
            self.show_visible()
            self.changed.emit(key)

        def enter(*_: object) -> None:
            change()
            self.entered.emit(key)

        if isinstance(editor, QComboBox):
            editor.currentIndexChanged.connect(enter)
        elif isinstance(editor, QCheckBox):
            editor.toggled.connect(enter)
        elif isinstance(editor, QPlainTextEdit):
            editor.textChanged.connect(change)
        elif isinstance(editor, QLineEdit):
            editor.textChanged.connect(change)
            editor.returnPressed.connect(lambda: self.entered.emit(key))

    def show_visible(self) -> None:
        """Show the fields whose time it is."""
        conditions = [(key, f.visible) for key, f in self._fields.items() if f.visible is not None]
        if conditions:
            answers = self.answers()
            for key, is_visible in conditions:
                self._layout.setRowVisible(self._rows[key], is_visible(answers))

    # -- answers -----------------------------------------------------------------

    def editor(self, key: str, kind: type[E]) -> E:
        """Return the widget of a field, which is of a kind."""
        found = self.editors[key]
        assert isinstance(found, kind)
        return found

    def answer(self, key: str) -> Any:
        """Return what is given; texts without the spaces around them."""
        editor = self.editors[key]
        if isinstance(editor, QComboBox):
            return editor.currentData()
        if isinstance(editor, QCheckBox):
            return editor.isChecked()
        if isinstance(editor, QPlainTextEdit):
            return editor.toPlainText()
        return editor.text().strip() if isinstance(editor, QLineEdit | QLabel) else None

    def answers(self) -> dict[str, Any]:
        """Return what is asked and given, by the keys of the fields."""
        return {key: self.answer(key) for key, field in self._fields.items() if field.kind != "words"}

    def set_answer(self, key: str, answer: object) -> None:
        """Give an answer, as the user does."""
        self._show_answer(self._fields[key], answer)

    def show_answers(self, answers: FormAnswers) -> None:
        """Show answers without a signal."""
        with QSignalBlocker(self):
            for key, answer in answers.items():
                self.set_answer(key, answer)

    def _show_answer(self, field: Field, answer: object) -> None:
        editor = self.editors[field.key]
        if isinstance(editor, QComboBox):
            row = _row_of(editor, answer)
            # A box that was made by its dialog may have answers that are not listed: it keeps its own text.
            if field.editor is None or row >= 0:
                editor.setCurrentIndex(max(row, 0))
        elif isinstance(editor, QCheckBox):
            editor.setChecked(bool(answer))
        elif isinstance(editor, QPlainTextEdit):
            editor.setPlainText(str(answer))
        elif isinstance(editor, QLineEdit | QLabel):
            editor.setText(str(answer))

    def offer_choices(self, key: str, choices: Sequence[tuple[Any, str]], chosen: object) -> None:
        """Fill a field with other choices, without a signal."""
        fill_choices(self.editor(key, QComboBox), choices, chosen)

    def enable(self, key: str, can: bool, why_not: str = "") -> None:
        """Switch a field on or off; its tip has the reason."""
        self.editors[key].setEnabled(can)
        self.editors[key].setToolTip(self._fields[key].tip if can else why_not)

    def fault(self) -> str:
        """Return the first answer's fault as a sentence; empty where all are good."""
        checks = ((key, field.check) for key, field in self._fields.items() if field.check is not None)
        return next((found for key, check in checks if (found := check(self.answer(key)))), "")


class FormDialog(QDialog):
    """A form, what is wrong with it, a button for what it does, and Cancel."""

    def __init__(
        self,
        title: str,
        fields: Sequence[Field],
        does: str,
        parent: QWidget | None = None,
        *,
        hint: str = "",
        width: int = 480,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(width)
        self.form, self.hint, self.fault = FieldForm(fields), QLabel(hint), QLabel()
        self.fault.setTextFormat(Qt.TextFormat.PlainText)
        self.buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        self.ok = self.buttons.button(QDialogButtonBox.StandardButton.Ok)
        self.ok.setText(does)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        for label in (self.hint, self.fault):
            label.setWordWrap(True)
        in_column(self.hint, self.form, self.fault, self.buttons, on=self)
        self.hint.setVisible(bool(hint))
        self._is_touched = False
        self.form.changed.connect(self._follow_answer)
        self.check()

    def problem(self) -> str:
        """Return what is wrong with the answers together, as a sentence."""
        return ""

    def _follow_answer(self, _: str) -> None:
        self._is_touched = True
        self.check()

    def check(self) -> None:
        """Show what is wrong, dim before anything was typed; the button is on where nothing is."""
        fault = self.form.fault() or self.problem()
        self.fault.setText(fault)
        self.fault.setStyleSheet(f"color: {colour('error' if self._is_touched else 'dim').name()}")
        self.fault.setVisible(bool(fault))
        self.ok.setEnabled(not fault)

    def accept(self) -> None:
        """Close the dialog where nothing is wrong."""
        self._is_touched = True
        self.check()
        if self.ok.isEnabled():
            super().accept()

    def done(self, result: int) -> None:
        """Close the dialog; its answers can be read until the next event."""
        super().done(result)
        self.deleteLater()
