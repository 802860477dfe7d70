"""One guard around every method of this room that Qt calls: an error in it is reported,
and Qt gets a value that it can use.

An exception that leaves such a method (``data``, ``paintEvent``, ``sizeHint``, …) goes through C++. With
every PySide6 from 6.8 to 6.12 that ends the process where the error was raised by C code, as that of
``int("x")``. The guard is set on each class when it is made, so that none can be forgotten; it must be
imported before the first of them.
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from functools import wraps
from types import FunctionType
from typing import Any

from PySide6.QtCore import QModelIndex, QObject, QSize, Qt
from PySide6.QtGui import QIconEngine, QPixmap, QUndoCommand

from .modal import AskerGoneError

_AT_ERROR: dict[str, Callable[[], object]] = {
    "columnCount": int,
    "editorEvent": bool,
    "event": bool,
    "eventFilter": bool,
    "filterAcceptsRow": lambda: True,
    "flags": lambda: Qt.ItemFlag.NoItemFlags,
    "index": QModelIndex,
    "isEmpty": bool,
    "minimumSizeHint": QSize,
    "parent": QModelIndex,
    "pixmap": QPixmap,
    "rowCount": int,
    "sectionSizeFromContents": QSize,
    "sizeHint": QSize,
    "translate": str,
    "viewportEvent": bool,
}
"""Method -> what makes the value that Qt gets after an error; None for all others."""
_ENDED = (Exception, AskerGoneError)
_OF_PYTHON = frozenset({"setText"})
"""Methods that are no virtual ones: they are called by this program alone, which gets their errors."""


def guard_overrides() -> None:
    """Guard each class that is made from now on of one of Qt's."""
    for base in (QObject, QUndoCommand, QIconEngine):
        base.__init_subclass__ = classmethod(_guard_class)  # type: ignore[assignment, arg-type]  # a class method of every class that follows


def _guard_class(cls: type, **settings: Any) -> None:
    for name, member in tuple(vars(cls).items()):
        if isinstance(member, FunctionType) and is_override(cls, name):
            setattr(cls, name, guarded(member))
    object.__init_subclass__(**settings)


def is_override(cls: type, name: str) -> bool:
    """Return whether a method of a class takes the place of one that Qt calls."""
    if name.startswith("_") or name in _OF_PYTHON:
        return False
    return any(base.__module__.startswith("PySide6.") and hasattr(base, name) for base in cls.__mro__[1:])


def guarded(method: FunctionType) -> Callable[..., object]:
    """Return a method that reports its errors and then returns what Qt can use.

    It has as many parameters as the method: Qt passes as many arguments of a signal as it finds there.
    """
    name, code = method.__name__, method.__code__
    at_error = _AT_ERROR.get(name, lambda: None)
    call: Callable[..., object]
    # PySide6 counts the parameters of a slot to decide how many arguments of a signal it passes: a wrapper
    # with ``*arguments`` would get all of them. The three usual counts are written out, also for speed:
    # ``data`` is called for every cell that is painted.
    is_exact = not (method.__defaults__ or method.__kwdefaults__ or code.co_flags & 0x0C)
    if is_exact and code.co_argcount == 1:

        def call(self: object) -> object:
            try:
                return method(self)
            except _ENDED:
                return _after_error(at_error)

    elif is_exact and code.co_argcount == 2:

        def call(self: object, first: object) -> object:
            try:
                return method(self, first)
            except _ENDED:
                return _after_error(at_error)

    elif is_exact and code.co_argcount == 3:

        def call(self: object, first: object, second: object) -> object:
            try:
                return method(self, first, second)
            except _ENDED:
                return _after_error(at_error)

    else:

        def call(self: object, *arguments: object, **named: object) -> object:
            try:
                return method(self, *arguments, **named)
            except _ENDED:
                return _after_error(at_error)

    return wraps(method)(call)


def _after_error(at_error: Callable[[], object]) -> object:
    """Report the error at hand and return what Qt gets;
    a painter that its frames have open is closed with them.
    """
    kind, error, trace = sys.exc_info()
    assert kind is not None
    assert error is not None
    sys.excepthook(kind, error, trace)
    traceback.clear_frames(trace)
    return at_error()
