"""The size of a window that opens beside the table: no larger than the screen has room for."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

_FRAME = 40
"""Pixels that the frame of a window and a task bar may take."""


def fit_to_screen(window: QWidget, width: int, height: int) -> None:
    """Give a window its size, no larger than the screen on which its parent is."""
    parent = window.parentWidget()
    room = (parent.window() if parent is not None else window).screen().availableSize()
    window.resize(min(width, room.width() - _FRAME), min(height, room.height() - _FRAME))
