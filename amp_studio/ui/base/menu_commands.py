"""The commands of the menus, for who lists them."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QMenuBar


def commands(menu: QMenuBar | QMenu, path: str = "") -> Iterator[tuple[str, QAction]]:
    """Yield every command of a menu with its path: ``File › Save``; dynamic menus are filled first."""
    for action in menu.actions():
        name = action.text().replace("&&", "\0").replace("&", "").replace("\0", "&").rstrip("…")
        inner = action.menu()
        if isinstance(inner, QMenu):
            inner.aboutToShow.emit()
            yield from commands(inner, f"{path}{name} › ")
        elif name and not action.isSeparator():
            yield f"{path}{name}", action
