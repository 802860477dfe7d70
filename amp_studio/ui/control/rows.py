"""Rows of the page at the control: parts side by side, of one height."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP2, GAP3

FOOT = 44
"""Height of the row with the primary button, in logical pixels."""


def side_by_side(height: int, *parts: QWidget | None) -> QWidget:
    """Return widgets side by side; None is a stretch, and a height of 0 that of the parts."""
    whole = QWidget()
    in_row(*(1 if part is None else part for part in parts), on=whole, margins=(GAP3, 0, GAP3, 0), gap=GAP2)
    if height:
        whole.setFixedHeight(height)
    return whole
