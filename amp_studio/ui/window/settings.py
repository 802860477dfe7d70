"""The stored settings of the program; it also starts when they are damaged."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from PySide6.QtCore import QByteArray, QRect, QSettings, QStandardPaths
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDockWidget, QMainWindow

from amp_studio.schema import read_file
from amp_studio.ui.base.known_controls import KnownControl, read_controls, stored_controls
from amp_studio.ui.base.theme import ThemeChoice, as_choice
from amp_studio.ui.pictures.split import PictureLayout

_NEVER_STORED = re.compile(rb"@\s*(?:Variant|DateTime)")
_REPORT = ("sort", "changed", "inactive", "units", "language", "without", "paper")
_MIN_SIZE = 320, 200
"""Least useful width and height of the window in pixels."""


class UserSettings:
    """The settings of one user; an unusable entry is ignored."""

    def __init__(self) -> None:
        folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.GenericConfigLocation)
        self._stored = stored_in(Path(folder) / "AMP Studio" / "AMP Studio.conf")

    # -- texts ---------------------------------------------------------------------

    def recent(self) -> list[Path]:
        """Return the recent files, also those that no longer exist."""
        kept = self._value("recent")
        return [
            Path(path)
            for path in (kept if isinstance(kept, list) else [kept])
            if isinstance(path, str) and path
        ]

    def keep_recent(self, paths: Iterable[Path]) -> None:
        """Store the recent files, the newest first."""
        self._stored.setValue("recent", [str(path) for path in paths])

    def pinned(self) -> list[Path]:
        """Return the files that are kept at the top of the recent ones."""
        kept = self._value("pinned")
        return [Path(p) for p in (kept if isinstance(kept, list) else [kept]) if isinstance(p, str) and p]

    def keep_pinned(self, paths: Iterable[Path]) -> None:
        """Store the pinned files."""
        self._stored.setValue("pinned", [str(path) for path in paths])

    def projects(self) -> list[Path]:
        """Return the folders of the projects that were open, the latest first."""
        kept = self._value("projects")
        return [Path(p) for p in (kept if isinstance(kept, list) else [kept]) if isinstance(p, str) and p]

    def keep_projects(self, folders: Iterable[Path]) -> None:
        """Store the folders of projects, the latest first."""
        self._stored.setValue("projects", [str(folder) for folder in folders])

    def session(self) -> list[Path]:
        """Return the files that were open when the program was left, the one in front last."""
        kept = self._value("session")
        return [Path(p) for p in (kept if isinstance(kept, list) else [kept]) if isinstance(p, str) and p]

    def beside(self) -> list[Path]:
        """Return which of those files were on the second side."""
        kept = self._value("beside")
        return [Path(p) for p in (kept if isinstance(kept, list) else [kept]) if isinstance(p, str) and p]

    def keep_session(self, paths: Iterable[Path], beside: Iterable[Path] = ()) -> None:
        """Store the open files, the one in front last, and which of them are on the second side."""
        self._stored.setValue("session", [str(path) for path in paths])
        self._stored.setValue("beside", [str(path) for path in beside])

    def control(self) -> str:
        """Return the address of the last control, or an empty text."""
        kept = self._value("control")
        return kept if isinstance(kept, str) else ""

    def keep_control(self, place: str) -> None:
        """Store the address of the control."""
        self._stored.setValue("control", place)

    def control_of(self, path: Path) -> str:
        """Return the address of the control that was chosen for a file, or an empty text."""
        kept = self._value(f"control-of/{_bookmarks_key(path).partition('/')[2]}")
        return kept if isinstance(kept, str) else ""

    def keep_control_of(self, path: Path, place: str) -> None:
        """Store the address of the control of a file."""
        self._stored.setValue(f"control-of/{_bookmarks_key(path).partition('/')[2]}", place)

    def language(self) -> str:
        """Return the language of the window: a code, or ``system``."""
        return str(self._value("language") or "system")

    def keep_language(self, choice: str) -> None:
        """Store the language; it is that of the next start."""
        self._stored.setValue("language", choice)

    def theme(self) -> ThemeChoice:
        """Return whether the window is light, dark, or as the system is."""
        return as_choice(self._value("theme"))

    def keep_theme(self, choice: ThemeChoice) -> None:
        """Store the theme."""
        self._stored.setValue("theme", choice)

    def left_side(self) -> object:
        """Return which side the left panel was turned to, as it was stored."""
        return self._value("left")

    def keep_left_side(self, side: str) -> None:
        """Store which side the left panel is turned to."""
        self._stored.setValue("left", side)

    def controls(self) -> list[KnownControl]:
        """Return the controls that were reached, the latest first."""
        return read_controls(self._value("controls"))

    def keep_controls(self, controls: Iterable[KnownControl]) -> None:
        """Store the controls that were reached."""
        self._stored.setValue("controls", stored_controls(controls))

    def pictures(self) -> PictureLayout:
        """Return the chosen place of pictures."""
        return PictureLayout.read(self._value("pictures"))

    def keep_pictures(self, layout: PictureLayout) -> None:
        """Store the chosen place of pictures."""
        self._stored.setValue("pictures", str(layout))

    def report(self) -> dict[str, str]:
        """Return what a report contains, as it was stored: name -> choice."""
        kept = {name: self._value(f"report/{name}") for name in _REPORT}
        return {name: choice for name, choice in kept.items() if isinstance(choice, str)}

    def keep_report(self, choices: Mapping[str, str]) -> None:
        """Store what a report contains."""
        for name in _REPORT:
            self._stored.setValue(f"report/{name}", choices[name])

    def bookmarks(self, path: Path) -> set[str]:
        """Return the ids of the parameters that this person has bookmarked in a file."""
        kept = self._value(_bookmarks_key(path))
        return {
            name for name in (kept if isinstance(kept, list) else [kept]) if isinstance(name, str) and name
        }

    def keep_bookmarks(self, path: Path, ids: Iterable[str]) -> None:
        """Store the bookmarks of a file."""
        names = sorted(ids)
        if names:
            self._stored.setValue(_bookmarks_key(path), names)
        else:
            self._stored.remove(_bookmarks_key(path))

    # -- windows -------------------------------------------------------------------

    def place(self, window: QMainWindow) -> None:
        """Restore position and size of the window on a screen that exists now."""
        before = window.geometry()
        kept = self._value("geometry")
        # Damaged bytes may have moved the window before they are refused.
        if isinstance(kept, QByteArray) and not window.restoreGeometry(kept):
            window.setGeometry(before)
        if not window.isMaximized() and not window.isFullScreen():
            window.setGeometry(on_screen(window.geometry(), _screens()))

    def keep_place(self, window: QMainWindow) -> None:
        """Store position and size of the window."""
        self._stored.setValue("geometry", window.saveGeometry())

    def arrangement(self) -> QByteArray | None:
        """Return the arrangement of the docks."""
        kept = self._value("layout")
        return kept if isinstance(kept, QByteArray) else None

    def keep_arrangement(self, kept: QByteArray) -> None:
        """Store the arrangement of the docks."""
        self._stored.setValue("layout", kept)

    def bring_back(self, docks: Iterable[QDockWidget]) -> None:
        """Dock a floating panel that is outside of all screens again."""
        for dock in docks:
            place = dock.geometry()
            if dock.isFloating() and on_screen(place, _screens()) != place:
                dock.setFloating(False)

    def _value(self, key: str) -> object:
        try:
            return self._stored.value(key)
        except (TypeError, ValueError, RuntimeError):  # a stored type that Python has no class for
            return None


def _bookmarks_key(path: Path) -> str:
    """Return the key of the bookmarks of a file: of its place, as settings take no path for a key."""
    return f"bookmarks/{hashlib.sha256(str(path.absolute()).encode()).hexdigest()[:16]}"


def is_there(path: Path) -> bool:
    """Return whether a path is an existing, accessible file."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def on_screen(place: QRect, screens: list[QRect]) -> QRect:
    """Return the nearest rectangle on the screen that shows most of it, not larger than that screen."""

    def common_area(screen: QRect) -> int:
        common = screen.intersected(place)
        return common.width() * common.height() if common.isValid() else 0

    screen = max(screens, key=common_area)
    width = min(max(place.width(), _MIN_SIZE[0]), screen.width())
    height = min(max(place.height(), _MIN_SIZE[1]), screen.height())
    left = min(max(place.left(), screen.left()), screen.right() + 1 - width)
    top = min(max(place.top(), screen.top()), screen.bottom() + 1 - height)
    return QRect(left, top, width, height)


def _screens() -> list[QRect]:
    return [screen.availableGeometry() for screen in QGuiApplication.screens()]


def stored_in(place: Path) -> QSettings:
    """Return the stored settings; where something lies in their place that Qt cannot bear, none are kept."""
    if is_usable(place):
        return QSettings("AMP Studio", "AMP Studio")
    nothing = QSettings(str(place / "none"), QSettings.Format.IniFormat)  # a name that cannot be
    nothing.clear()  # of what another window of this program has kept there in memory
    return nothing


def is_usable(place: Path) -> bool:
    """Return whether Qt can read the settings: it waits for a pipe or a device, and a damaged value of a type
    that is never stored here makes it ask for more memory than there is, which ends the program.
    """
    try:
        return not place.exists() or (place.is_file() and not _NEVER_STORED.search(read_file(place)))
    except OSError:
        return True  # Qt meets the same refusal and goes on without
