"""How everything looks: the table of colours, light and dark, sizes, fonts, and icons of one hand.

Nothing else in the window names a colour. ``apply_style`` puts it all on the application; it follows the
desktop, or keeps to what the person chose, and views that have written a colour into a text listen to
``scheme().changed``.
"""

from __future__ import annotations

import functools
import json
from importlib.util import find_spec
from pathlib import Path
from typing import Literal, get_args

from PySide6.QtCore import QObject, QPoint, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
    QGuiApplication,
    QIcon,
    QIconEngine,
    QPainter,
    QPalette,
    QPixmap,
)
from PySide6.QtWidgets import QApplication, QStyleFactory

from .style_sheet import style_sheet

ThemeChoice = Literal["system", "light", "dark"]
FontRole = Literal["figure", "title", "text", "small", "caption"]
Token = Literal[
    "window",
    "panel",
    "base",
    "raised",
    "hover",
    "line",
    "line2",
    "grid",
    "edge",
    "text",
    "dim",
    "off",
    "sel",
    "onsel",
    "selbg",
    "selidle",
    "error",
    "errorbg",
    "warn",
    "warnbg",
    "rec",
    "recbg",
    "chg",
]

COLOURS: dict[Token, tuple[str, str]] = {
    # Grounds: the brighter, the nearer to the value.
    "window": ("#F2F3F5", "#1C1E22"),
    "panel": ("#F8F9FA", "#212429"),
    "base": ("#FFFFFF", "#17191C"),
    "raised": ("#FFFFFF", "#282B31"),
    "hover": ("#E9EBEF", "#2D3138"),
    # Lines: edges of panels, of buttons, the grid of cells and plots, the border of an input.
    "line": ("#DDE0E5", "#31353C"),
    "line2": ("#C5CAD2", "#4A505A"),
    "grid": ("#E8EAEE", "#26292E"),
    "edge": ("#7F8792", "#767E8A"),
    # Inks: the first, the second, and that of disabled controls alone.
    "text": ("#1A1E23", "#E3E6EA"),
    "dim": ("#58606B", "#A4ACB7"),
    "off": ("#676F7A", "#8C94A0"),
    # Focus, links and the one primary button; selected, and selected without the focus.
    "sel": ("#1D5BCB", "#7FADFF"),
    "onsel": ("#FFFFFF", "#0E1726"),
    "selbg": ("#DBE7FC", "#203A63"),
    "selidle": ("#E3E6EA", "#31353C"),
    # Meaning: ink and ground of each severity, and the bar of a change that is not saved.
    "error": ("#B3261E", "#FF8F85"),
    "errorbg": ("#FCE9E7", "#46231F"),
    "warn": ("#855000", "#F0BC5A"),
    "warnbg": ("#FFF1D0", "#3E3117"),
    "rec": ("#0A6A72", "#5FC9D0"),
    "recbg": ("#DDF2F3", "#15393C"),
    "chg": ("#7B3FC6", "#C4A3FF"),
}
"""Every colour of the window: its name -> what it is in light and in dark."""

GAP, GAP2, GAP3, GAP4, GAP6 = 4, 8, 12, 16, 24
"""Gaps in logical pixels; a grid of four."""
ROW, FINDING_ROW, TWO_LINE_ROW = 24, 30, 44
"""Heights of a row in a table or tree, of a finding, of a list with two lines."""
TOOLS, HEAD, COLUMN_HEAD, MESSAGE, STATUS = 38, 32, 28, 34, 24
"""Heights of the tool bar, the head of a panel, the head of a table, a message, the status bar."""
CONTROL, SMALL_CONTROL, RADIUS = 26, 22, 4
"""Height of a button or a field, of one in a row, and the radius of their corners."""
ICON, SMALL_ICON = 16, 14
"""Sizes of an icon in a bar and in a row."""

FIGURE_SPACE = "\u2007"
"""A space as wide as a digit, to align numbers of different length."""

_SEVERITY: dict[str, tuple[Token, str]] = {
    "error": ("error", "x-circle-fill"),
    "warning": ("warn", "warning-fill"),
    "advice": ("rec", "lightbulb-fill"),
    "information": ("dim", "info"),
}
"""Severity -> its ink and the shape that means the same without a colour."""
_PIXELS = {
    "figure": (20, 600),
    "title": (15, 600),
    "text": (13, 400),
    "small": (12, 400),
    "caption": (11, 400),
}
"""Size where the text of the system has 13 pixels, and weight."""


# -- light and dark ----------------------------------------------------------------------------------


class Scheme(QObject):
    """Which of the two colours of each token is used now."""

    changed = Signal()
    """The other colours are used: a text with a colour in it is to be written again."""

    def __init__(self) -> None:
        super().__init__()
        self.choice: ThemeChoice = "system"
        hints = QGuiApplication.styleHints()
        self._system_is_dark = QGuiApplication.palette().color(QPalette.ColorRole.Window).lightness() < 128
        self.is_dark = self._is_dark_chosen()
        hints.colorSchemeChanged.connect(lambda _: self.choose(self.choice))

    def _is_dark_chosen(self) -> bool:
        if self.choice != "system":
            return self.choice == "dark"
        found = QGuiApplication.styleHints().colorScheme()
        return self._system_is_dark if found == Qt.ColorScheme.Unknown else found == Qt.ColorScheme.Dark

    def choose(self, choice: ThemeChoice) -> None:
        """Follow the system, or be light or dark whatever it is; every window changes at once."""
        if choice != self.choice:
            self.choice = choice
            wanted = {"light": Qt.ColorScheme.Light, "dark": Qt.ColorScheme.Dark}
            # The frames that the system draws follow too.
            QGuiApplication.styleHints().setColorScheme(wanted.get(choice, Qt.ColorScheme.Unknown))
        if self._is_dark_chosen() != self.is_dark:
            self.is_dark = not self.is_dark
            _apply_colours()
            self.changed.emit()


@functools.cache
def scheme() -> Scheme:
    """Return the scheme of the application, which must exist."""
    return Scheme()


def is_dark() -> bool:
    """Return whether the dark colours are used."""
    return scheme().is_dark


def as_choice(kept: object) -> ThemeChoice:
    """Return a stored choice of theme; anything else follows the system."""
    return next((choice for choice in get_args(ThemeChoice) if choice == kept), "system")


# -- colours -----------------------------------------------------------------------------------------


def colour(colour_name: Token) -> QColor:
    """Return a colour of the table as it is now."""
    return QColor(COLOURS[colour_name][is_dark()])


def severity_colour(severity: str) -> QColor:
    """Return the text colour of a severity."""
    return colour(_SEVERITY[severity][0])


def severity_mark(severity: str) -> tuple[str, Token]:
    """Return the name of the icon of a severity and its ink. For delegates."""
    colour_name, name = _SEVERITY.get(severity, _SEVERITY["information"])
    return name, colour_name


def severity_icon(severity: str) -> QIcon:
    """Return the icon of a severity, in its colour."""
    colour_name, name = _SEVERITY.get(severity, _SEVERITY["information"])
    return icon(name, colour_name)


def state_colour() -> QColor:
    """Return the text colour of an inactive parameter."""
    return colour("dim")


def palette() -> QPalette:
    """Return the colours for what Qt draws by itself."""
    role, group = QPalette.ColorRole, QPalette.ColorGroup
    made = QPalette()
    tokens: dict[QPalette.ColorRole, Token] = {
        role.Window: "window",
        role.Base: "base",
        role.AlternateBase: "panel",
        role.Button: "raised",
        role.Text: "text",
        role.WindowText: "text",
        role.ButtonText: "text",
        role.HighlightedText: "text",
        role.ToolTipBase: "raised",
        role.ToolTipText: "text",
        role.PlaceholderText: "dim",
        role.BrightText: "error",
        role.Highlight: "selbg",
        role.Accent: "sel",
        role.Link: "sel",
        role.LinkVisited: "sel",
        role.Light: "raised",
        role.Midlight: "line",
        role.Mid: "line2",
        role.Dark: "edge",
        role.Shadow: "line2",
    }
    for each, colour_name in tokens.items():
        made.setColor(each, colour(colour_name))
    made.setColor(group.Inactive, role.Highlight, colour("selidle"))
    made.setColor(group.Disabled, role.Highlight, colour("selidle"))
    for each in (role.Text, role.WindowText, role.ButtonText, role.HighlightedText, role.PlaceholderText):
        made.setColor(group.Disabled, each, colour("off"))
    return made


def apply_style(choice: ThemeChoice = "system") -> None:
    """Put style, colours and font on the application, once; after that only the choice is followed."""
    application = QApplication.instance()
    if application.property("worn"):
        scheme().choose(choice)
        return
    application.setProperty("worn", True)
    scheme().choose(choice)
    QApplication.setStyle(QStyleFactory.create("Fusion"))
    QApplication.setFont(font("text"))
    _apply_colours()


def _apply_colours() -> None:
    sheet = style_sheet({colour_name: colour(colour_name).name() for colour_name in COLOURS}, is_dark())
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    # A style sheet in the place of another one is applied to each widget once for every widget that it is
    # in (QStyleSheetStyle::repolish): seven times on average. Without one before, once.
    application.setStyleSheet("")
    QApplication.setPalette(palette())
    application.setStyleSheet(sheet)


# -- type --------------------------------------------------------------------------------------------


def font(role: FontRole = "text", *, own: bool = False) -> QFont:
    """Return a font of the system in the size of a role, with figures of one width;
    ``own`` is the weight of an own value.
    """
    pixels, weight = _PIXELS[role]
    made = QFont(_system_font())
    if made.pointSizeF() > 0:
        made.setPointSizeF(made.pointSizeF() * pixels / 13)
    else:
        made.setPixelSize(max(1, round(made.pixelSize() * pixels / 13)))
    made.setWeight(QFont.Weight(500 if own else weight))
    made.setFeature(QFont.Tag("tnum"), 1)
    return made


@functools.cache
def _system_font() -> QFont:
    return QFontDatabase.systemFont(QFontDatabase.SystemFont.GeneralFont)


# -- icons -------------------------------------------------------------------------------------------


def icon(name: str, colour_name: Token = "text") -> QIcon:
    """Return an icon of the Phosphor set by its name, such as ``floppy-disk``;
    it follows light and dark by itself.
    """
    return QIcon(_Glyph(name, colour_name))


def paint_icon(painter: QPainter, place: QRect | QRectF, name: str, shade: QColor) -> None:
    """Paint an icon in the middle of a rectangle, as large as its shorter side. For delegates."""
    side = min(place.width(), place.height())
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.TextAntialiasing)
    letter = QFont(_icon_font())
    letter.setPixelSize(max(1, int(side)))
    painter.setFont(letter)
    painter.setPen(shade)
    painter.drawText(QRectF(place), Qt.AlignmentFlag.AlignCenter, _glyphs().get(name, ""))
    painter.restore()


def icon_html(name: str, colour_name: Token) -> str:
    """Return an icon as a letter in a page of HTML."""
    letter = f"&#{ord(found)};" if (found := _glyphs().get(name)) else ""
    return f'<span style="font-family:{_icon_font()}; color:{colour(colour_name).name()}">{letter}</span>'


def severity_html(severity: str) -> str:
    """Return the icon of a severity in a page of HTML."""
    colour_name, name = _SEVERITY.get(severity, _SEVERITY["information"])
    return icon_html(name, colour_name)


class _Glyph(QIconEngine):
    """A letter of the icon font, painted in the colours of the moment and sharp at every scale."""

    def __init__(self, name: str, colour_name: Token) -> None:
        super().__init__()
        self._name, self._colour_name = name, colour_name

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        paint_icon(
            painter, rect, self._name, colour("off" if mode == QIcon.Mode.Disabled else self._colour_name)
        )

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        found = QPixmap(size)
        if found.isNull():  # a window so small that nothing is left for the icon
            return found
        found.fill(Qt.GlobalColor.transparent)
        painter = QPainter(found)
        self.paint(painter, QRect(QPoint(0, 0), size), mode, state)
        painter.end()
        return found

    def clone(self) -> QIconEngine:
        return _Glyph(self._name, self._colour_name)


def _icon_files(pattern: str) -> Path | None:
    """Return a file of the icon package; it is not imported, for that would load all of its eleven fonts."""
    found = find_spec("qtawesome")
    places = found.submodule_search_locations if found else None
    return next((file for place in places or () for file in (Path(place) / "fonts").glob(pattern)), None)


@functools.cache
def _glyphs() -> dict[str, str]:
    """Return the letter of every icon; none without the package, the program starts anyway."""
    file = _icon_files("phosphor-charmap-*.json")
    codes = json.loads(file.read_text(encoding="utf-8")) if file else {}
    return {name: chr(int(code, 16)) for name, code in codes.items()}


@functools.cache
def _icon_font() -> str:
    file = _icon_files("phosphor-[0-9]*.ttf")
    families = (
        QFontDatabase.applicationFontFamilies(QFontDatabase.addApplicationFont(str(file))) if file else []
    )
    return families[0] if families else ""
