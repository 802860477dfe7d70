"""What the window loads beside its work: one loader,
so that no two threads import parts of one package at the same time.

The page of a package imports its modules, and an import of a module takes the lock of the module first, then
asks for the page: two threads that begin at either end wait for each other, and Python hands out a module
that is not ready rather than let both wait for ever.
"""

from __future__ import annotations

import sys
import threading
from importlib import import_module

_LOADING = threading.Lock()


def load(*modules: str) -> None:
    """Import modules, one thread at a time."""
    with _LOADING:
        for module in modules:
            import_module(module)


def is_loaded(*modules: str) -> bool:
    """Return whether modules have been imported, and nothing is just being loaded."""
    return not _LOADING.locked() and all(module in sys.modules for module in modules)


def load_beside(*modules: str) -> None:
    """Import modules in another thread, if they are not there yet."""
    if not is_loaded(*modules):
        threading.Thread(target=load, args=modules, daemon=True).start()
