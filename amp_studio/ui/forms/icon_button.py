"""A button that shows an icon alone; its words are its tip and the name that a screen reader speaks."""

from __future__ import annotations

from PySide6.QtWidgets import QToolButton

from amp_studio.ui.base.theme import icon


def icon_button(icon_name: str, tip: str, *, spoken: str = "", is_flat: bool = False) -> QToolButton:
    """Return a button; ``spoken`` is its name where the tip has more than that, such as the keys."""
    button = QToolButton()
    button.setIcon(icon(icon_name))
    button.setToolTip(tip)
    button.setAccessibleName(spoken or tip)
    button.setAutoRaise(is_flat)
    return button
