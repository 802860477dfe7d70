"""Where a compiled family is kept: JSON below a digest over it, which is rebuilt where it is anything else.

JSON and not pickle: a cache must not be able to run code. What lies there and cannot be used is named in a
warning of the log, once a start; a cache that cannot be written costs time only.
"""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from .model import Model
from .model.compiled_json import record_text, text_record
from .regular_file import read_file

_log = logging.getLogger(__name__)
_PROGRAM = "amp-studio"
_MOST_BYTES = 64 * 2**20
R = TypeVar("R", bound=Model)


def cache_folder() -> Path:
    """Return the user's folder of caches: that of platformdirs, which is loaded where it knows better only.

    It loads tempfile with all of Python's compressions, a fiftieth of a check.
    """
    if sys.platform == "linux":
        places = (Path(os.environ.get("XDG_CACHE_HOME", "")), Path(os.environ.get("HOME", ""), ".cache"))
        found = next((place for place in places if place.is_absolute()), None)
        if found is not None:
            return found / _PROGRAM
    import platformdirs

    return Path(platformdirs.user_cache_dir(_PROGRAM))


def read_cached(path: Path) -> bytes | None:
    """Return what was kept at a path; None where there is nothing, or nothing that can be used."""
    try:
        content = read_file(path, _MOST_BYTES)
    except FileNotFoundError:
        return None
    except OSError as error:
        _report_unusable(path, error.strerror or str(error))
        return None
    digest, _, kept = content.partition(b"\n")
    if digest != _digest(kept):
        _report_unusable(path, "its content is not what was kept there")
        return None
    return kept


def cached_record(path: Path, kind: type[R], name: str, make: Callable[[], R]) -> R:
    """Return the record that is kept at a path; where there is none, ``make`` one and keep it there.

    ``name`` is that of the family, or of its texts in a language: older ones of the same name are removed.
    """
    kept = read_cached(path)
    if kept is not None:
        try:
            found = text_record(kept)
        except ValueError:
            found = None
        if isinstance(found, kind):
            return found
        _report_unusable(path, "it contains no facts")
    made = make()
    write_cached(path, record_text(made).encode(), name)
    return made


def _report_unusable(path: Path, why: str) -> None:
    """Name a cache file that cannot be used."""
    _log.warning("%s cannot be used and is made again: %s", path, why)


def write_cached(path: Path, kept: bytes, family: str) -> None:
    """Keep the compiled form of a family, and remove what older facts of it left."""
    import tempfile  # most starts keep nothing

    temporary = ""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "wb") as stream:
            stream.write(_digest(kept) + b"\n" + kept)
        os.replace(temporary, path)
        older = re.compile(rf"{re.escape(family)}-[0-9a-f]{{24}}\.json")
        for old in path.parent.iterdir():
            if old != path and older.fullmatch(old.name):
                old.unlink(missing_ok=True)
    except OSError as error:
        _log.info("%s cannot be kept: %s", path, error.strerror or error)
        if temporary:
            with contextlib.suppress(OSError):
                os.unlink(temporary)


def _digest(kept: bytes) -> bytes:
    return hashlib.sha256(kept).hexdigest().encode()
