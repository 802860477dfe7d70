"""What the page of a control is made of: its widgets and where they lie. What they do is in the page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QApplication,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QSplitter,
    QStackedWidget,
    QWidget,
)

from amp_studio.files import write_atomic
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, GAP3, HEAD, font
from amp_studio.ui.base.translated import message_in_words, tr
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.forms.segment import Segment

from .conditions import ConditionLine
from .current_row import CurrentRow
from .danger_check import DangerCheck
from .differences import DifferenceTable
from .hand_sheet import HandSheet
from .heading import ControlHeading
from .history import ExchangeHistory
from .known_list import KnownList
from .rows import FOOT, side_by_side
from .session import ControlSession
from .several import SeveralControls
from .steps import ExchangeSteps
from .value_ends import EndBar

WIDE = 1200
"""Width in logical pixels of a window with room for the steps beside the table."""


class ControlPageParts(QWidget):
    """The widgets of the page: the known controls at the left, and at the right one control, several, the
    sheet or what was exchanged before.
    """

    def __init__(self, save: Callable[[], bool]) -> None:
        super().__init__()
        self.known = KnownList()
        self.several = SeveralControls(save)
        self.hand = HandSheet()
        self.history = ExchangeHistory()
        self.heading = ControlHeading()
        self.heading.setFont(font("text", own=True))
        self.directions = Segment(
            tr("Direction"),
            [
                ("compare", tr("Compare"), ""),
                ("send", tr("Send to the Control"), "arrow-line-down"),
                ("read", tr("Read From It"), "arrow-line-up"),
                ("hand", tr("By Hand"), "note-pencil"),
            ],
        )
        self.conditions = ConditionLine()
        self.bar = MessageBar()
        self.ends = EndBar()
        self.password = QLineEdit()
        self.password.setEchoMode(QLineEdit.EchoMode.Password)
        self.password.setPlaceholderText(tr("Password of the control; Enter tries it"))
        self.password.setAccessibleName(tr("Password of the control"))
        self.counts = QLabel()
        self.filter = QLineEdit()
        self.filter.setPlaceholderText(tr("Name or number"))
        self.filter.setAccessibleName(tr("Filter the differences"))
        hint = self.filter.fontMetrics().horizontalAdvance(self.filter.placeholderText())
        self.filter.setMinimumWidth(hint + 2 * GAP3)
        self.filter.setMaximumWidth(220)
        self.table = DifferenceTable()
        self.empty = QLabel()
        self.empty.setContentsMargins(GAP3, GAP2, GAP3, GAP2)
        self.empty.setWordWrap(True)
        self.middle = QStackedWidget()
        self.middle.addWidget(self.table)
        self.middle.addWidget(self.empty)
        self.steps = ExchangeSteps()
        self.steps_line = ElidedLabel()
        """The steps above the foot, where there is no room for them beside the table."""
        self.steps_line.setFont(font("small"))
        self.steps_line.setContentsMargins(GAP3, GAP2, GAP3, 0)
        self.steps_line.hide()
        self.steps.line_changed.connect(self.steps_line.setText)
        self.checked = DangerCheck(self.table)
        self.row = CurrentRow(self.table, self.checked)
        self.hint = ElidedLabel()
        self.progress = QProgressBar()
        self.progress.setMaximumWidth(200)
        self.cancel = QPushButton()
        self.proof = QPushButton(tr("Save Proof…"))
        self.again = QPushButton(tr("Read Again"))
        self.as_new = QPushButton(tr("Save as a New File…"))
        self.primary = QPushButton()
        self.primary.setProperty("primary", True)
        self._lay_out()

    def _lay_out(self) -> None:
        self.back = icon_button("x", tr("Back to the values (Escape)"), is_flat=True)
        self.past = icon_button("clock-counter-clockwise", tr("Exchanges of This File"), is_flat=True)
        self.past.setCheckable(True)
        parts = QSplitter(Qt.Orientation.Horizontal)
        parts.addWidget(self.middle)
        parts.addWidget(self.steps)
        parts.setStretchFactor(0, 1)
        parts.setChildrenCollapsible(False)
        self.one_control = _column(
            self.conditions,
            self.bar,
            self.ends,
            self.password,
            side_by_side(HEAD, self.counts, None, self.filter),
            parts,
            self.row,
            self.steps_line,
            side_by_side(
                FOOT,
                self.hint,
                None,
                self.progress,
                self.cancel,
                self.proof,
                self.again,
                self.as_new,
                self.primary,
            ),
        )
        self.states = QStackedWidget()
        for state in (self.one_control, self.several, self.hand, self.history):
            self.states.addWidget(state)
        head = side_by_side(HEAD, self.heading, None, self.directions, self.past, self.back)
        right = _column(head, self.states)
        in_row(self.known, (right, 1), on=self, margins=0, gap=0)
        self.setFocusProxy(self.states)
        # Else its width would be taken from the panels beside the table even while it is not in front.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the table the room of the steps in a small window, where they have one line."""
        super().resizeEvent(event)
        is_narrow = self.window().width() < WIDE
        self.steps.setHidden(is_narrow)
        self.steps_line.setVisible(is_narrow)
        self.table.show_short_words(is_narrow)
        self.directions.show_icons(not is_narrow)

    def enable_choices(self, *, has_file: bool) -> None:
        """Enable what needs a file, and what several controls can do."""
        several = self.known.several.isChecked()
        for direction, button in self.directions.buttons.items():
            button.setEnabled(not several if direction == "read" else has_file)
        self.past.setEnabled(has_file)
        self.known.several.setEnabled(has_file)

    def ask_password(self, *, needed: bool, is_busy: bool) -> None:
        """Show the field of the password while one is needed; it is not taken away while it is typed into."""
        if is_busy and not self.password.isHidden():  # it stays: what is typed on would go to another field
            self.password.setReadOnly(True)
        else:
            is_new, had_focus = needed and self.password.isHidden(), self.password.hasFocus()
            self.password.setReadOnly(False)
            # Before it is hidden: Qt would give the focus to the next field, with what is typed on.
            if had_focus and not needed:
                self.middle.currentWidget().setFocus()
            self.password.setVisible(needed)
            if is_new:  # once: an address may be typed beside it
                self.password.setFocus()

    def take_keyboard(self, session: ControlSession | None, *, is_lost: bool = False) -> None:
        """Put the keyboard where the next step is, where no part of the page has it; ``is_lost`` where the
        button that had it is gone.
        """
        here = QApplication.focusWidget()
        is_over = session is not None and session.phase in ("done", "failed")
        if (
            not (is_lost and is_over)
            and here is not self.states
            and here is not None
            and self.isAncestorOf(here)
        ):
            return
        next_step: QWidget = self.primary if self.primary.isVisible() else self.states
        if session is not None and session.is_busy:
            next_step = self.states
        elif self.middle.currentWidget() is self.table and not is_over:
            next_step = self.table
        next_step.setFocus()

    def show_text(self, text: str, *, is_proof: bool = False) -> None:
        """Show a text in the place of the table: a proof from its head on, in the middle what is one line."""
        align = Qt.AlignmentFlag
        self.empty.setAlignment(align.AlignTop | align.AlignLeft if is_proof else align.AlignCenter)
        if is_proof:
            head, *rest = map(escape, text.split("\n\n"))
            # Escaped above: names of files and controls are no markup.
            text = "".join((f"<p><b>{head}</b></p>", *(f"<p>{each}</p>" for each in rest)))
        self.empty.setTextFormat(Qt.TextFormat.RichText if is_proof else Qt.TextFormat.PlainText)
        self.empty.setText(text)
        self.middle.setCurrentWidget(self.empty)

    def write_proof(self, near: Path, lines: Sequence[str]) -> None:
        """Ask for a file and write a proof into it; an error is shown above the table."""
        path = ask_to_save(self, self.tr("Save Proof"), near, "Text (*.txt)")
        if path is None:
            return
        try:
            write_atomic(path, ("\n".join(lines) + "\n").encode())
        except OSError as error:
            self.bar.say(message_in_words(str(error)), "error")
        else:
            self.hint.setText(self.tr("{name} is saved.").format(name=path.name))

    def show_progress(self, stage: str, done: int, total: int) -> None:
        """Show how far an exchange is."""
        self.cancel.setEnabled(True)
        # A range without an end moves: nothing is known of how much there is.
        self.progress.setRange(0, max(total, 0))
        self.progress.setValue(done)
        self.steps.show_stage(stage, done, total)
        if stage in ("silent", "cut"):
            self.hint.setText(
                self.tr("The line is cut; trying again …")
                if stage == "cut"
                else self.tr("No answer for {done} s; trying again …").format(done=done)
            )


def _column(*parts: QWidget) -> QWidget:
    """Return parts below one another; what can use room gets it."""
    whole = QWidget()
    shares = ((part, int(isinstance(part, (QSplitter, QStackedWidget)))) for part in parts)
    in_column(*shares, on=whole, margins=0, gap=0)
    return whole
