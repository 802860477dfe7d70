"""Where a file really lies, and the files that lie beside it: one set, by whatever link the file is
reached.
"""

from __future__ import annotations

import contextlib
import errno
import os
import re
import stat
from pathlib import Path

from amp_studio.schema import demand_file

ENDING = ".amp"
"""Of parameter files."""
BEFORE = ".before-"
"""In the name of a copy of what a control contained before a download."""
RECORD, TUNINGS = "exchanges.jsonl", "tunings.jsonl"
"""The record of exchanges of a folder, and that of tunings."""
_LONGEST_NAME = 255
"""Bytes of a file name, on nearly every file system."""
_BACKUP, _HISTORY = "{}.bak", "{}.history"
_COMPANIONS = (_BACKUP, _HISTORY, ".{}.lock", ".{}.holder", ".{}.unsaved")
_OF_A_FILE = re.compile(r"(.+\.amp)\.(?:bak|history)|\.(.+)\.(?:lock|holder|unsaved)", re.IGNORECASE)
"""Names that only the program itself writes to."""


def real_path(path: Path) -> Path:
    """Return the path with all links followed; the file itself need not be there, its folder must.

    ``Path.resolve`` would return a link unfollowed where it cannot follow it, and the link would be taken for
    the file. Raises OSError.
    """
    try:
        return Path(os.path.realpath(path, strict=True))
    except FileNotFoundError:
        real = Path(os.path.realpath(path))
        return Path(os.path.realpath(real.parent, strict=True)) / real.name


def is_of_machine(name: str) -> bool:
    """Return whether a file of this name has the parameters of a machine, and is no copy of what a control
    contained.
    """
    return name.endswith(ENDING) and BEFORE not in name


def parameter_files_in(folder: Path) -> list[Path]:
    """Return the parameter files of the machines in a folder, by name."""
    return sorted(path for path in folder.glob(f"*{ENDING}") if is_of_machine(path.name))


def is_there(path: Path) -> bool:
    """Return whether a name is taken, by a file, a link that leads nowhere, or anything else;
    raises OSError if this cannot be found out.
    """
    try:
        os.lstat(path)
    except FileNotFoundError:
        return False
    return True


def destination(path: Path) -> Path:
    """Return the file that writing to a path makes or replaces;
    raises OSError for a path that must not be written to.
    """
    real = real_path(path)
    if belongs := _OF_A_FILE.fullmatch(real.name):
        message = f"Belongs to {belongs[1] or belongs[2]}: choose another name"
        raise OSError(errno.EINVAL, message, str(path))
    try:
        found = os.lstat(real)
    except FileNotFoundError:
        if path.is_symlink():
            raise OSError(errno.ENOENT, "Is a link to a file that does not exist", str(path)) from None
        return real
    demand_file(found)
    if is_write_protected(real):
        raise OSError(errno.EACCES, "Is write-protected", str(path))
    return real


def is_write_protected(path: Path) -> bool:
    """Return whether a file that is there must not be written to."""
    may = os.access(path, os.W_OK, effective_ids=os.access in os.supports_effective_ids)
    return not may and os.path.lexists(path)


def same_file(a: Path, b: Path) -> bool:
    """Return whether two paths are one file, by whatever link, hard link or spelling."""
    try:
        return a.samefile(b)
    except OSError:
        # One of them is not there: then by their names.
        return os.path.normcase(a.absolute()) == os.path.normcase(b.absolute())


def backup_path(path: Path) -> Path:
    """Return where the previous file is kept: ``NAME.amp.bak``. Raises OSError."""
    return _beside(path, _BACKUP)


def history_path(path: Path) -> Path:
    """Return where the history of a file is kept: ``NAME.amp.history``. Raises OSError."""
    return _beside(path, _HISTORY)


def hidden_path(path: Path, ending: str) -> Path:
    """Return a hidden companion of a file, ``.NAME.amp.lock``. Raises OSError."""
    return _beside(path, f".{{}}{ending}")


def companions(path: Path) -> list[Path]:
    """Return all that may lie beside a file and belong to it."""
    found = []
    for pattern in _COMPANIONS:
        with contextlib.suppress(OSError):  # a name too long for one of them
            found.append(_beside(path, pattern))
    return found


def _beside(path: Path, pattern: str) -> Path:
    real = real_path(path)
    name = pattern.format(real.name)
    # Bytes, not characters: an ä is two of them.
    if len(os.fsencode(name)) > _LONGEST_NAME:
        message = "The name is too long for the files kept beside it (backup, lock): shorten it"
        raise OSError(errno.ENAMETOOLONG, message, str(path))
    return real.with_name(name)


def text_of_name(name: str) -> str:
    """Return a file name as text that every file can contain: bytes of it that are no text become a mark."""
    return os.fsencode(name).decode("utf-8", "replace")


def is_link(path: Path) -> bool:
    """Return whether a path is a link itself; raises OSError."""
    return stat.S_ISLNK(os.lstat(path).st_mode)
