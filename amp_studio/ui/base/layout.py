"""Widgets beside or below one another: one call names the parts from first to last."""

from __future__ import annotations

from typing import TypeVar

from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

Part = QWidget | QLayout | int | tuple[QWidget | QLayout, int]
"""A widget or a layout, alone or with its share of the room that is left; a number is the share of a gap."""
Margins = int | tuple[int, int, int, int]
"""The same at every edge; or left, above, right and below."""
_Layout = TypeVar("_Layout", bound=QBoxLayout)


def in_row(
    *parts: Part, on: QWidget | None = None, margins: Margins | None = None, gap: int | None = None
) -> QHBoxLayout:
    """Return parts side by side, on a widget where one is named;
    margins and the gap between the parts are in logical pixels, those of the style where none are given.
    """
    return _filled(QHBoxLayout() if on is None else QHBoxLayout(on), parts, margins, gap)


def in_column(
    *parts: Part, on: QWidget | None = None, margins: Margins | None = None, gap: int | None = None
) -> QVBoxLayout:
    """Return parts below one another, as `in_row` does side by side."""
    return _filled(QVBoxLayout() if on is None else QVBoxLayout(on), parts, margins, gap)


def _filled(layout: _Layout, parts: tuple[Part, ...], margins: Margins | None, gap: int | None) -> _Layout:
    if margins is not None:
        layout.setContentsMargins(*((margins,) * 4 if isinstance(margins, int) else margins))
    if gap is not None:
        layout.setSpacing(gap)
    for part in parts:
        if isinstance(part, int):
            layout.addStretch(part)
            continue
        content, share = part if isinstance(part, tuple) else (part, 0)
        if isinstance(content, QWidget):
            layout.addWidget(content, share)
        else:
            layout.addLayout(content, share)
    return layout
