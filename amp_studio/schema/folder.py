"""Where the facts are, and what is kept of them."""

from __future__ import annotations

import os
import sys
from pathlib import Path

_PROGRAM = "amp-studio"


def database_folder() -> Path:
    """Return the folder of facts: inside the installed package, or at the top of the checkout."""
    package = Path(__file__).resolve().parent.parent
    inside = package / "parameter_db"
    return inside if inside.is_dir() else package.parent / "parameter_db"


def cache_folder() -> Path:
    """Return the user's folder of caches: that of platformdirs, which is loaded where it knows better only.

    It loads tempfile with all of Python's compressions, a fiftieth of a check.
    """
    if sys.platform == "linux":
        places = (Path(os.environ.get("XDG_CACHE_HOME", "")), Path(os.environ.get("HOME", ""), ".cache"))
        # A relative path in the variable is to be ignored (XDG Base Directory Specification).
        found = next((place for place in places if place.is_absolute()), None)
        if found is not None:
            return found / _PROGRAM
    import platformdirs

    return Path(platformdirs.user_cache_dir(_PROGRAM))
