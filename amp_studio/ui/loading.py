"""What the window loads beside its work: one loader, so that no two threads import parts of one package at the same time.

A package imports its modules and they import it: while one thread is inside of that circle, another that begins at one of the modules waits
for the first, and Python hands out a module that is not ready rather than let both wait for ever.
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


def load_beside(module: str) -> None:
    """Import a module in another thread, if it is not there yet."""
    if module not in sys.modules:
        threading.Thread(target=load, args=(module,), daemon=True).start()
