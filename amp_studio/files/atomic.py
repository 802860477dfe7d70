"""Saving that cannot lose a file.

The new content is written to a temporary file beside the old one, forced to
the disk, and only then renamed over it; before that the old file is read once
more, so that nobody's changes are overwritten unseen.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import tempfile
from pathlib import Path


class ChangedOnDisk(OSError):
    """The file on disk is not the one that was opened."""


class SaveFault(OSError):
    """A file that could not be written; the old one is untouched. The text is one clear sentence."""


def digest(content: bytes) -> str:
    """Return the SHA-256 of a file's content in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def digest_of(path: Path) -> str | None:
    """Return the digest of a file, or None when there is none."""
    try:
        return digest(path.read_bytes())
    except FileNotFoundError:
        return None


def backup_path(path: Path) -> Path:
    """Return where the previous file is kept: ``NAME.amp.bak``."""
    return path.with_name(path.name + ".bak")


def write_atomic(path: Path, content: bytes, expected: str | None = "", keep_backup: bool = True) -> str:
    """Replace a file by new content, all or nothing.

    ``expected`` is the digest the file on disk must still have (None: there
    must be no file; "": do not look). The previous file becomes the backup.
    Returns the digest of the new content; raises ChangedOnDisk, SaveFault.
    """
    path = path.resolve()
    try:
        if expected != "" and digest_of(path) != expected:
            raise ChangedOnDisk(f"{path.name} has been changed by another program since it was opened")
        temporary = _write_beside(path, content, like=path)
    except ChangedOnDisk:
        raise
    except OSError as error:
        raise SaveFault(f"{path} cannot be written: {error.strerror or error}") from error
    try:
        if expected != "" and digest_of(path) != expected:
            raise ChangedOnDisk(f"{path.name} has been changed by another program while it was saved")
        if keep_backup and path.exists():
            _replace_copy(path, backup_path(path))
        os.replace(temporary, path)
    except ChangedOnDisk:
        raise
    except OSError as error:
        raise SaveFault(f"{path} cannot be written: {error.strerror or error}") from error
    finally:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
    with contextlib.suppress(OSError):  # the file is the new one already: a fault here is none of the save
        sync_folder(path.parent)
    return digest(content)


def _write_beside(path: Path, content: bytes, like: Path) -> str:
    """Write and sync a temporary file in the same folder, as readable as ``like``; leaves nothing behind when it fails."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        if like.exists():
            shutil.copymode(like, temporary)
        else:
            os.chmod(temporary, 0o666 & ~_umask())
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise
    return temporary


def _replace_copy(source: Path, target: Path) -> None:
    temporary = _write_beside(target, source.read_bytes(), like=source)
    try:
        os.replace(temporary, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def sync_folder(folder: Path) -> None:
    """Force a rename to the disk where the system lets folders be opened."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
