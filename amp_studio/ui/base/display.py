"""Whether there is a display; asked before Qt,
which ends the program with a dump of its memory where there is none.
"""

from __future__ import annotations

import os
import sys

MISSING = (
    "There is no display for the desktop program (neither DISPLAY nor WAYLAND_DISPLAY is set). "
    "All verbs work without one: amp-studio --help"
)


def has_display() -> bool:
    """Return whether a window can be opened here."""
    if sys.platform in ("win32", "darwin"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"))
