"""Waits for a person or for work: the only places where an event loop runs inside another one.

While it runs anything can happen: a file is closed, a menu is made again, the window goes. What follows the
wait belongs to the object that asked, and is left out where that object is gone.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QObject, QPoint
from PySide6.QtWidgets import QDialog, QMenu


class AskerGoneError(BaseException):
    """The object that waited is gone; it ends the action without a message, as its window did."""


def is_alive(made: QObject) -> bool:
    """Return whether an object of Qt still exists:
    what was waited for may have outlasted its window or its menu.
    """
    try:
        made.objectName()
    except RuntimeError:
        return False
    return True


@contextmanager
def waiting_for(asker: QObject | None) -> Iterator[None]:
    """Let an event loop run; raises AskerGoneError where the object that waits is gone by its end."""
    yield
    if asker is not None and not is_alive(asker):
        raise AskerGoneError


def run_dialog(dialog: QDialog) -> int:
    """Show a dialog until it is answered, and return the answer;
    raises AskerGoneError where its parent is gone by then.
    """
    with waiting_for(dialog.parent()):
        return dialog.exec()


def pop_up(menu: QMenu, place: QPoint) -> None:
    """Show a menu for one choice; its actions act on what they are bound to."""
    menu.aboutToHide.connect(menu.deleteLater)
    menu.popup(place)
