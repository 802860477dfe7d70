"""The end of a tab: the family in small letters, a dot for unsaved changes, and what closes it."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QToolButton, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP, SMALL_ICON, colour, font, icon


class _Dot(QWidget):
    """The colour of a change; the tab's accessible name has the words."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedSize(8, 16)
        policy = self.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.setSizePolicy(policy)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour("chg"))
        painter.drawEllipse(QRectF(0.5, 4.5, 7, 7))


class TabEnd(QWidget):
    """At the right of the name on a tab."""

    close_clicked = Signal()

    def __init__(self, family: str) -> None:
        super().__init__()
        label = QLabel(family)
        label.setFont(font("caption"))
        label.setForegroundRole(label.palette().ColorRole.PlaceholderText)
        self.dot = _Dot()
        self.dot.setToolTip(self.tr("Unsaved changes"))
        close = QToolButton()
        close.setIcon(icon("x", "dim"))
        close.setIconSize(QSize(SMALL_ICON - 2, SMALL_ICON - 2))
        close.setToolTip(self.tr("Close (Ctrl+W)"))
        close.setAccessibleName(self.tr("Close"))
        close.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        close.setFixedSize(20, 20)
        close.clicked.connect(self.close_clicked)
        in_row(label, self.dot, close, on=self, margins=(0, 0, 2, 0), gap=GAP)

    def show_unsaved(self, is_unsaved: bool) -> None:
        """Show or hide the dot; its place stays, so that no tab moves."""
        self.dot.setVisible(is_unsaved)
