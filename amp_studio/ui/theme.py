"""Colours and fonts, for light and dark desktops alike."""

from __future__ import annotations

from PySide6.QtGui import QColor, QGuiApplication, QPalette


def is_dark() -> bool:
    """Tell whether the desktop uses a dark palette."""
    return QGuiApplication.palette().color(QPalette.ColorRole.Window).lightness() < 128


def severity_colour(severity: str | None) -> QColor:
    """Return the background that marks a cell with a finding."""
    light = {"error": "#ffd6d2", "warning": "#ffeec2", "advice": "#dcebff"}
    dark = {"error": "#6b2b28", "warning": "#5c4a17", "advice": "#1f3d5e"}
    return QColor((dark if is_dark() else light).get(severity or "", "#00000000"))


def severity_ink(severity: str) -> QColor:
    """Return the text colour of a severity."""
    light = {"error": "#b3261e", "warning": "#8a5a00", "advice": "#1a5fb4"}
    dark = {"error": "#ff8a80", "warning": "#ffd166", "advice": "#8ab4f8"}
    return QColor((dark if is_dark() else light)[severity])


def state_colour() -> QColor:
    """Return the text colour of a parameter that is out of force."""
    return QColor("#8f8f8f")
