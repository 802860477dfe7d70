"""An icon without a button, in the colours of the moment."""

from __future__ import annotations

from PySide6.QtWidgets import QLabel

from amp_studio.ui.base.theme import SMALL_ICON, Token, icon, scheme


class LiveSign(QLabel):
    """Painted again when the colours change: a pixmap keeps those in which it was made."""

    def __init__(self, icon_name: str, colour_name: Token = "text") -> None:
        super().__init__()
        self._icon_name, self._colour_name = icon_name, colour_name
        scheme().changed.connect(self._paint_again)
        self._paint_again()

    def _paint_again(self) -> None:
        self.setPixmap(icon(self._icon_name, self._colour_name).pixmap(SMALL_ICON, SMALL_ICON))
