"""What the pages of the tuning view share: their target, a table of rows, buttons that may fail."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QAbstractItemView, QPushButton, QTableWidget, QWidget

from amp_studio.ui.base.theme import ROW, scheme

from .tuning_target import TuningTarget


class TuningPart(QWidget):
    """A page that shows one target at a time, and is shown again with every change of it."""

    def __init__(self, guarded: Callable[[Callable[[], object]], object]) -> None:
        """``guarded`` runs what may fail and shows the error."""
        super().__init__()
        self._guarded = guarded
        self.target: TuningTarget | None = None
        self._is_stale = False
        scheme().changed.connect(self._follow)

    def show_target(self, target: TuningTarget) -> None:
        """Show the values of a file or a control."""
        if self.target is not None:
            self.target.changed.disconnect(self._follow)
        self.target = target
        target.changed.connect(self._follow)
        self._refresh()

    def _follow(self, *_: object) -> None:
        """Show what has changed, where it is seen: an edit in the table waits for no table behind it."""
        self._is_stale = not self.isVisible()
        if not self._is_stale:
            self._refresh()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self._follow()

    def _refresh(self, *_: object) -> None:
        """Show the target; each part has its own. ABCMeta cannot be the metaclass of a QWidget."""
        raise NotImplementedError

    def _button(self, text: str, act: Callable[[], object]) -> QPushButton:
        button = QPushButton(text)
        button.clicked.connect(lambda *_: self._guarded(act))
        return button


def table_of_rows(columns: int, name: str) -> QTableWidget:
    """Return an empty table in which one row is selected at a time; Tab leaves it."""
    table = QTableWidget(0, columns)
    table.setAccessibleName(name)
    table.setStyleSheet("QTableWidget::item { padding: 0 6px; }")
    table.verticalHeader().setDefaultSectionSize(ROW + 2)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setTabKeyNavigation(False)
    return table
