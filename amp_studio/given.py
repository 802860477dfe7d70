"""Refuses what a caller of the library gives in the place of another type, before anything is done."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from typing import TypeVar, cast

from .errors import AmpStudioError

_Called = TypeVar("_Called", bound=Callable[..., object])
_CALLED = {"Progress", "Notify"}
_NAMED = {"str": "a text", "Path": "a path", "None": "None", **dict.fromkeys(_CALLED, "a function")}
_CHECKED = {
    *_NAMED,
    *_CALLED,
    "bytes",
    "Event",
    "Copy",
    "MachineParameters",
    "SweepWay",
    "Trace",
    "Validator",
}
"""Types that are checked; an argument that may be of another one too is left to its function."""


class GivenTypeError(AmpStudioError, TypeError):
    """An argument that is of none of the types that it may be of; nothing was changed."""


def checked_types(function: _Called) -> _Called:
    """Return a function that looks at its arguments first; raises GivenTypeError for one that its annotation
    does not allow, and for a path that no file can have.
    """
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    kinds = {
        name: parts
        for name, annotation in function.__annotations__.items()
        if (parts := annotation.split(" | ")) and _CHECKED.issuperset(parts)
    }

    @wraps(function)
    def look(*arguments: object, **named: object) -> object:
        for name, value in (*zip(names, arguments, strict=False), *named.items()):
            if name in kinds and not _is_instance(value, kinds[name]):
                allowed = " or ".join(_NAMED.get(kind, f"a {kind}") for kind in kinds[name])
                raise GivenTypeError(f"{name} is {allowed}, not {value!r:.80}")
        return function(*arguments, **named)

    return cast(_Called, look)


def _is_instance(value: object, kinds: list[str]) -> bool:
    """Return whether a value is of one of these types, by their names: a start does not load them for it."""
    own = {"None"} if value is None else {kind.__name__ for kind in type(value).__mro__}
    if callable(value) and not _CALLED.isdisjoint(kinds):
        return True
    if "Path" not in kinds or not isinstance(value, (str, os.PathLike)):
        return not own.isdisjoint(kinds)
    try:
        return b"\0" not in os.fsencode(value)
    except UnicodeEncodeError:  # half a character
        return False
