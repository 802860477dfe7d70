"""The head of the page at the control: the file, the way, and the control."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetrics

from amp_studio.ui.forms.elided_label import ElidedLabel

_MIN_FILE = 72
"""Pixels that the name of the file keeps beside the place of the control."""


class ControlHeading(ElidedLabel):
    """One line. The name of the control is never cut: its place goes first, then the middle of the file."""

    def __init__(self) -> None:
        super().__init__()
        self._sides = ("", "", "")

    def show_sides(self, file: str, way: str, control: str) -> None:
        """Show the file, an arrow and the control, ``CNC_1 (10.0.0.2:9600)`` where another is called so."""
        self._sides = (file, way, control)
        self.setText(f"{file}  {way}  {control}")

    def _elided(self) -> str:
        letters, room = QFontMetrics(self.font()), self.contentsRect().width()
        if letters.horizontalAdvance(self.text()) <= room:
            return self.text()
        file, way, control = self._sides
        end = f"  {way}  {control}"
        if room - letters.horizontalAdvance(end) < min(_MIN_FILE, letters.horizontalAdvance(file)):
            end = f"  {way}  {control.partition(' (')[0]}"
        left = max(room - letters.horizontalAdvance(end), 0)
        return letters.elidedText(file, Qt.TextElideMode.ElideMiddle, left) + end
