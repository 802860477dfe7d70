"""Saving that cannot lose a file.

The new content is written to a temporary file beside the old one, forced to
the disk, and only then renamed over it; before that the old file is read once
more, so that no changes of another program are overwritten unseen.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from amp_studio.errors import AmpStudioError
from amp_studio.schema import HARMLESS, NO_LINK, demand_file, read_file

from .paths import RECORD, TUNINGS, backup_path, companions, destination, real_path, same_file

if sys.platform != "win32":
    from .attributes import keep_attributes

Notify = Callable[[str], None]
"""Takes one sentence about what a save could not keep."""


class ChangedOnDiskError(AmpStudioError, OSError):
    """The file on disk is not the one that was opened."""


class SaveError(AmpStudioError, OSError):
    """A file that could not be written; the old one is untouched. The text is one clear sentence."""


@contextlib.contextmanager
def in_temporary_folder() -> Iterator[None]:
    """Raise SaveError where a temporary file without a name takes no more: its OSError names no file."""
    try:
        yield
    except OSError as error:
        raise SaveError(f"the folder for temporary files takes no more: {error.strerror}") from error


def digest(content: bytes) -> str:
    """Return the SHA-256 of a file's content in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def digest_of(path: Path) -> str | None:
    """Return the digest of a file, or None when there is none."""
    content = _content_of(path)
    return None if content is None else digest(content)


def _content_of(path: Path) -> bytes | None:
    try:
        return read_file(path)
    except FileNotFoundError:
        return None


_OF_A_FOLDER = {"project.yaml", "rules.yaml", RECORD, TUNINGS}


def check_output(path: Path, *inputs: Path) -> None:
    """Refuse an output that cannot be written, or with which one of the inputs would be lost;
    raises SaveError.
    """
    with _as_save_error(path):
        real = destination(path)
    # In any case of letters: on Windows and macOS Rules.yaml is rules.yaml.
    if real.name.casefold() in _OF_A_FOLDER:
        raise SaveError(f"{path} is read with every file of its folder: choose another name for the output")
    for source in inputs:
        message = ""
        if same_file(real, source):
            message = f"is the input {source} itself"
        elif any(same_file(real, kept) for kept in companions(source)):
            message = f"belongs to the input {source}"
        elif any(same_file(source, kept) for kept in companions(real)):
            message = f"would put its backup or its lock in the place of the input {source}"
        if message:
            raise SaveError(f"{path} {message}: choose another name for the output")


def write_atomic(
    path: Path,
    content: bytes | Callable[[bytes | None], bytes] | Iterator[bytes],
    expected: str | None = "",
    keep_backup: bool = True,
    *,
    companion_of: Path | None = None,
    notify: Notify = lambda _message: None,
) -> str:
    """Replace a file by new content, all or nothing.

    ``content`` may be worked out from the previous content, None where there is no file, or come in parts, of
    which no digest is returned. ``expected`` is the digest the file on disk must still have (None: there must
    be no file; "": do not look). The previous file becomes the backup. A companion is readable by those who
    may read its file, and takes the place of a link instead of following it. ``notify`` is called after the
    save with each thing of the old file that could not be kept. Returns the digest of the new content; raises
    ChangedOnDiskError, SaveError, and what ``content`` raises.
    """
    notes: list[str] = []
    with _as_save_error(path):
        real = real_path(path.parent) / path.name if companion_of else destination(path)
        looks = expected != "" or callable(content)
        previous = _content_of(real) if looks or keep_backup else None
        if expected != "" and _digest(previous) != expected:
            raise ChangedOnDiskError(f"{path.name} {_CHANGED if expected else 'exists already'}")
    # Outside of the clause below: what ``content`` raises goes on as it is.
    made = content(previous) if callable(content) else content
    with _as_save_error(path), contextlib.ExitStack() as stack:
        like = real if os.path.lexists(real) and not companion_of else companion_of
        temporary = stack.enter_context(_staged(real, made, like, notes))
        kept = None
        if keep_backup and previous is not None:
            kept = backup_path(real)
            kept_temporary = stack.enter_context(_staged(kept, previous, real, []))
        # Once more, as late as can be: between this look and the rename another program has some microseconds
        # left. No system call compares and renames in one.
        if looks and _digest(_content_of(real)) != _digest(previous):
            raise ChangedOnDiskError(f"{path.name} has been changed by another program while it was saved")
        if kept is not None:
            # The backup first: a program that is killed between the two renames leaves the old content twice,
            # never the file without a backup.
            stack.enter_context(_put_back_unless_saved(kept, temporary))
            os.replace(kept_temporary, kept)
        _replace(temporary, real, path, is_new=expected is None)
    # The rename is on the disk only when its folder is: a power cut before that brings the old file back,
    # whole.
    with contextlib.suppress(OSError):  # the file is the new one already: a fault here is not one of the save
        _sync_folder(real.parent)
    for message in notes:
        notify(f"{path.name}: {message}")
    return digest(made) if isinstance(made, bytes) else ""


_replaced: set[Path] = set()


def was_replaced(path: Path) -> bool:
    """Return whether this process has written a file, for where the disk cannot be asked."""
    return path.absolute() in _replaced


def _replace(temporary: Path, real: Path, path: Path, *, is_new: bool) -> None:
    """Rename over a file, which counts as written before that: an interrupt may come in between."""
    names = {real.absolute(), path.absolute()} - _replaced
    _replaced.update(names)
    try:
        if not is_new or not _named(temporary, real):
            os.replace(temporary, real)
    except OSError:
        _replaced.difference_update(names)
        raise


def _named(temporary: Path, real: Path) -> bool:
    """Give a file a name that nothing has; returns whether the file system can.
    Raises ChangedOnDiskError where it is taken.

    So no file is replaced that came at the last moment, and no empty file has to keep the name free.
    """
    try:
        os.link(temporary, real)
    except FileExistsError:
        raise ChangedOnDiskError(f"{real.name} exists already") from None
    except OSError:  # a file system without a second name for a file
        return False
    return True


_CHANGED = "has been changed by another program since it was opened"


def _digest(content: bytes | None) -> str | None:
    return None if content is None else digest(content)


@contextlib.contextmanager
def _as_save_error(path: Path) -> Iterator[None]:
    """Turn errors of the system into one clear sentence."""
    try:
        yield
    except (ChangedOnDiskError, SaveError):
        raise
    except OSError as error:
        at = Path(os.fsdecode(error.filename2)).name if error.filename2 else path.name
        where = f" ({at})" if at != path.name else ""  # its backup, or the file that a link leads to
        raise SaveError(f"{path} cannot be written{where}: {error.strerror or error}") from error


@contextlib.contextmanager
def _staged(
    path: Path, content: bytes | Iterator[bytes], like: Path | None, notes: list[str]
) -> Iterator[Path]:
    """Write and sync a temporary file beside ``path``, with owner and mode of ``like``;
    it is gone afterwards.
    """
    # Shortened, because a name may be as long as the system lets it be; the name is known before there is a
    # file, so that whatever stops the program finds it.
    temporary = path.with_name(f".{path.name[:24]}.{os.urandom(8).hex()}.tmp")
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | NO_LINK | HARMLESS
    try:
        # Closed to others until it has the mode of the file that it replaces.
        handle = os.open(temporary, flags, 0o666 if like is None else 0o600)
        try:
            for part in (content,) if isinstance(content, bytes) else content:
                write_all(handle, part)
            if like is not None and sys.platform != "win32":
                notes += keep_attributes(like, handle)
            # Before the rename: else the name could reach the disk before the content, and a power cut would
            # leave an empty file.
            os.fsync(handle)
        finally:
            os.close(handle)
        yield temporary
    finally:
        with contextlib.suppress(OSError):
            os.unlink(temporary)


@contextlib.contextmanager
def _put_back_unless_saved(kept: Path, temporary: Path) -> Iterator[None]:
    """Keep the older backup until the file itself has been replaced:
    a save that fails there has changed nothing.
    """
    older, has_older = kept.with_name(f".{kept.name[:24]}.{os.urandom(8).hex()}.tmp"), os.path.lexists(kept)
    with contextlib.suppress(OSError):  # a file system without a second name for a file
        os.link(kept, older, follow_symlinks=False)
    try:
        yield
    except OSError:
        with contextlib.suppress(OSError):
            if not os.path.lexists(temporary):
                pass  # it has become the file anyway
            elif has_older:
                os.replace(older, kept)
            else:
                os.unlink(kept)
        raise
    finally:
        with contextlib.suppress(OSError):
            os.unlink(older)


def write_all(handle: int, content: bytes) -> None:
    """Write all of a content, however little the system takes at once; raises OSError."""
    rest = memoryview(content)
    while rest:
        taken = os.write(handle, rest)
        # A system that takes nothing without an error would be asked for ever.
        if taken <= 0:
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        rest = rest[taken:]


def append_line(path: Path, content: bytes, like: Path) -> None:
    """Add lines to the end of a file that is made with the mode of ``like``;
    a last line that was cut off is closed. Raises OSError.
    """
    handle = os.open(
        # At the end as the system knows it, also where another program has added a line since.
        path,
        os.O_RDWR | os.O_APPEND | os.O_CREAT | NO_LINK | HARMLESS,
        like.stat().st_mode & 0o666,
    )
    try:
        found = os.fstat(handle)
        demand_file(found)
        if found.st_size and os.lseek(handle, -1, os.SEEK_END) >= 0 and os.read(handle, 1) != b"\n":
            content = b"\n" + content
        write_all(handle, content)
    finally:
        os.close(handle)


def _sync_folder(folder: Path) -> None:
    """Force a rename to the disk where the system lets folders be opened."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
