"""The title of the list in the table: its name, and as much of what else there is to know as has room."""

from __future__ import annotations

from html import escape

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy

from amp_studio.ui.base.theme import GAP2, GAP3, colour, font

_MIN_WIDTH, _MAX_WIDTH = 120, 300


class ListTitle(QLabel):
    """A line that is elided and has all of it in its tooltip."""

    def __init__(self) -> None:
        super().__init__()
        self._name = self._remark = ""
        self._strong = font("text")
        self._strong.setWeight(self._strong.Weight.Bold)
        self.setFont(font("text"))
        self.setContentsMargins(GAP3, 4, 6, 4)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    def show_title(self, name: str, remark: str) -> None:
        """Show a name, and what follows it where there is room."""
        self._name, self._remark = name, remark
        self.setText(f"<b>{escape(name)}</b> — {escape(remark)}")  # for screen readers
        self._show_tip()
        self.update()

    @property
    def needed(self) -> int:
        """The width that the name needs; a very long one is elided before the filters go."""
        wide = QFontMetrics(self._strong).horizontalAdvance(self._name) + GAP2 + GAP3
        return min(max(wide, _MIN_WIDTH), _MAX_WIDTH)

    def minimumSizeHint(self) -> QSize:
        return QSize(_MIN_WIDTH, super().minimumSizeHint().height())

    def _parts(self) -> tuple[str, int, str]:
        """Return the name as it is shown, its width, and the rest as it is shown."""
        strong, plain, room = (
            QFontMetrics(self._strong),
            QFontMetrics(self.font()),
            self.contentsRect().width(),
        )
        name = strong.elidedText(self._name, Qt.TextElideMode.ElideRight, room)
        wide = strong.horizontalAdvance(name)
        parts = self._remark.split(", ")
        while parts and plain.horizontalAdvance(f" — {', '.join(parts)}") > room - wide:
            parts.pop()  # as much as has room, and no word of it is cut
        return name, wide, f" — {', '.join(parts)}" if parts else ""

    def _show_tip(self) -> None:
        name, _, rest = self._parts()
        is_whole = name == self._name and rest == f" — {self._remark}"
        self.setToolTip("" if is_whole else f"{self._name} — {self._remark}")

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show_tip()

    def paintEvent(self, event: QPaintEvent) -> None:
        name, wide, rest = self._parts()
        painter, box = QPainter(self), self.contentsRect()
        painter.setFont(self._strong)
        painter.setPen(colour("text"))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, name)
        painter.setFont(self.font())
        painter.setPen(colour("dim"))
        painter.drawText(QRect(box).adjusted(wide, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, rest)
