"""Where compiled facts are kept: JSON below a digest over it, which is rebuilt where it is anything else.

JSON and not pickle: a cache must not be able to run code. What lies there and cannot be used is named in a
warning of the log, once a start; a cache that cannot be written costs time only.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from .folder import cache_folder
from .regular_file import read_file

_log = logging.getLogger(__name__)
_MAX_BYTES = 64 * 2**20


def read_cached(path: Path) -> bytes | None:
    """Return what was kept at a path; None where there is nothing, or nothing that can be used."""
    try:
        content = read_file(path, _MAX_BYTES)
    except FileNotFoundError:
        return None
    except OSError as error:
        report_unusable(path, error.strerror or str(error))
        return None
    digest, _, kept = content.partition(b"\n")
    # A disk that was full, or a program that was killed, leaves a part of the text.
    if digest != _digest(kept):
        report_unusable(path, "its content is not what was kept there")
        return None
    return kept


def cached_data(name: str, sources: Sequence[Path], make: Callable[[], Any]) -> Any:
    """Return plain data that ``make`` reads out of files, kept under a name as long as ``sources`` are the
    same: these files, and those of the code that makes the data. No family has a name that begins with ``_``.
    """
    digest = hashlib.sha256()
    for source in sources:
        content = source.read_bytes()
        # With its length: a text that moves from one file to the next makes another digest.
        digest.update(f"{len(content)}:".encode())
        digest.update(content)
    path = cache_folder() / f"{name}-{digest.hexdigest()[:24]}.json"
    kept = read_cached(path)
    if kept is None:
        kept = json.dumps(make(), ensure_ascii=False).encode()
        write_cached(path, kept, name)
    return json.loads(kept)


def report_unusable(path: Path, why: str) -> None:
    """Name a cache file that cannot be used."""
    _log.warning("%s cannot be used and is made again: %s", path, why)


def write_cached(path: Path, kept: bytes, name: str) -> None:
    """Keep compiled facts under a name, and remove what older ones of it left."""
    import tempfile  # most starts keep nothing

    temporary = ""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # In the same folder, so that a rename is enough: of two starts at once each keeps a whole file.
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "wb") as stream:
            stream.write(_digest(kept) + b"\n" + kept)
        os.replace(temporary, path)
        # Only of this name: the folder has the files of other families, and of other versions being
        # written.
        older = re.compile(rf"{re.escape(name)}-[0-9a-f]{{24}}\.json")
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
