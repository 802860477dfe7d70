"""The front page of a room: what other rooms may import from it, each name loaded when it is first asked for.

A page is the ``__init__`` of the room. It lists its names once, as the imports that a type checker reads::

    if TYPE_CHECKING:
        from .values import Value, read_value
    else:
        __getattr__ = front_page(__name__)

So a start loads only the modules that it needs,
and a name that is not on the page is an error to the type checker too.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module

TYPE_CHECKING = False  # the typing module is not loaded for it: every start loads this one
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any


def front_page(room: str) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a room's page (PEP 562):
    it gives what a module of the room has at that time.
    """

    def given(name: str) -> Any:
        place = places(room).get(name)
        if place is None:
            raise AttributeError(f"{room} has no {name} on its front page")
        module, own = place
        # sys.modules has a module that another thread is still loading; import waits for it.
        return getattr(import_module(module), own)

    return given


@cache
def places(room: str) -> dict[str, tuple[str, str]]:
    """Return name -> module and name there, of what a page lists. Its source is read once in a process."""
    source = sys.modules[room].__spec__.loader.get_source(room)  # type: ignore[union-attr]  # a package has both
    return {name: (f"{room}.{module}", own) for name, module, own in listed(source)}


def listed(source: str) -> Iterator[tuple[str, str, str]]:
    """Yield name, module and name there of each import for type checkers in the source of a page."""
    import ast

    for block in ast.parse(source).body:
        if (
            isinstance(block, ast.If)
            and isinstance(block.test, ast.Name)
            and block.test.id == "TYPE_CHECKING"
        ):
            for node in block.body:
                if isinstance(node, ast.ImportFrom) and node.level:
                    for alias in node.names:
                        yield alias.asname or alias.name, str(node.module), alias.name
