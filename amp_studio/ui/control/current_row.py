"""The selected value of the page at the control: what it is about, and what can be done with it alone."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.theme import GAP2, GAP3

from .differences import DifferenceTable
from .next_step import PageState, why_not_written
from .rows import side_by_side


class CurrentRow(QWidget):
    """Its name and dangers, and two buttons: the control's value is kept, or this one is written now."""

    asked = Signal()
    """It is asked whether the value is to be written alone, or no longer."""

    def __init__(self, table: DifferenceTable, beside: QWidget) -> None:
        """``beside`` is shown at the right of the buttons."""
        super().__init__()
        self._table = table
        self.question = ""
        """What is asked of the value that is to be written alone; empty while nothing is."""
        self.detail = QLabel()
        self.detail.setWordWrap(True)
        self.detail.setTextFormat(Qt.TextFormat.RichText)
        self.detail.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.detail.setFixedHeight(84)  # four lines and the name: a long danger in a small window
        self.detail.setContentsMargins(GAP3, GAP2, GAP3, 0)
        self.keep = QPushButton()
        self.one = QPushButton(self.tr("Write This One Now"))
        for button in (self.keep, self.one):
            button.setAutoDefault(False)
        table.currentItemChanged.connect(lambda *_: self.ask(wanted=False))
        self.keep.clicked.connect(self._keep)
        self.one.clicked.connect(lambda: self.ask(wanted=True))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.detail)
        column.addWidget(side_by_side(0, self.keep, self.one, None, beside))

    def show_state(self, state: PageState, *, is_listed: bool) -> None:
        """Show the value that is selected in the table; nothing where the table is not seen."""
        session, row = state.session, self._table.current()
        is_sending = state.direction == "send"
        self.detail.setText(
            unbroken(self._table.current_in_words(with_dangers=is_sending)) if is_listed else ""
        )
        can_write = session is not None and session.phase == "ready" and not session.is_busy and is_sending
        is_sent = row is not None and can_write and row.takes_file
        can_keep = row is not None and is_sent and not row.is_fixed
        self.keep.setVisible(can_keep)
        if row is not None and can_keep:
            value = self._table.text_of(row.difference.address, row.difference.b)
            self.keep.setText(self.tr("Keep {value}").format(value=value))
        seen = session.seen if session is not None else None
        self.one.setVisible(is_sent and state.backup is None and seen is not None and seen.takes_one)
        self.one.setEnabled(session is not None and is_sent and not why_not_written(state, session))

    def ask(self, *, wanted: bool) -> None:
        """Ask whether the value is to be written alone, with its dangers, or take the question back."""
        row, text = self._table.current(), ""
        if wanted and row is not None:
            text = self.tr("Write this value alone, now? {change}")
            text = f"{text.format(change=self._table.change_in_words(row))}."
            text = " ".join((text, *(danger.says for danger in row.dangers)))
        if text != self.question:
            self.question = text
            self.asked.emit()

    def _keep(self) -> None:
        if (row := self._table.current()) is not None:
            self._table.take([row.difference.address], file=False)
