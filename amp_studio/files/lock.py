"""The lock by which two programs on one file notice each other; it ends with its program.

It is the operating system's own call: a library would put another kind of lock, which outlives a killed
program, in its place where a file system has none, and cannot lock by a file that another user has left.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from datetime import UTC, datetime
from pathlib import Path

from amp_studio.errors import AmpStudioError
from amp_studio.schema import HARMLESS, NO_LINK, demand_file, read_file, visible

from .paths import hidden_path

if sys.platform == "win32":
    import msvcrt

    def _lock(handle: int) -> None:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(handle: int) -> None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


_TRIES = 100
"""How often a lock file may vanish while it is locked."""
_LONGEST_NOTE = 300
"""Characters of what the holder has left that a message shows."""


class InUseError(AmpStudioError, OSError):
    """Another program has the file open; the text contains which one, where and since when."""


class EditLock:
    """The right of one program to change one file; use it as a context, or ``take`` and ``release``."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.remark = ""
        """Why no other program is kept out, where the file system has no locks: a sentence for the user."""
        self.is_taken = False
        """Whether this object has the lock."""
        self._handle: int | None = None
        self._place = path

    def take(self) -> None:
        """Lock the file; raises InUseError. Where the file system has no locks there is a remark instead."""
        if self.is_taken:
            return
        self.remark = ""
        try:
            self._place = hidden_path(self.path, ".lock")
            self._handle = _locked(self._place)
        except BlockingIOError:
            raise InUseError(f"{self.path.name} is open in another program ({self._holder()})") from None
        except OSError as error:
            message = error.strerror or str(error)
            if not _is_open_to_us(self._place.parent):
                raise InUseError(
                    f"{self.path.name} cannot be changed: its folder cannot be written to"
                ) from None
            if error.errno == errno.ENAMETOOLONG or not _is_sound(self._place):
                raise InUseError(
                    f"{self.path.name} cannot be locked ({self._place.name}): {message}"
                ) from None
            self.remark = (
                f"{self.path.name} could not be locked ({message}): see that no other program changes it"
            )
        self.is_taken = True
        if self._handle is not None:
            self._write_owner()

    def release(self) -> None:
        """Give the file free. It never fails: what the lock was taken for has been done."""
        if not self.is_taken:
            return
        self.is_taken = False
        handle, self._handle = self._handle, None
        if handle is None:
            return
        with contextlib.suppress(OSError):
            self._holder_path().unlink(missing_ok=True)
        if (
            os.name == "posix"
        ):  # while it is locked: a program that waits for it looks whether it still has its name
            with contextlib.suppress(OSError):
                if _still_named(handle, self._place):
                    self._place.unlink()
        with contextlib.suppress(OSError):
            os.close(handle)

    def __enter__(self) -> EditLock:
        self.take()
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def _holder_path(self) -> Path:
        return self._place.with_name(self._place.name.removesuffix(".lock") + ".holder")

    def _holder(self) -> str:
        try:
            left = read_file(self._holder_path(), 4096, follow=False).decode("utf-8", "replace").strip()
        except OSError:
            return "it left no details"
        from .times import with_local_times  # the file keeps it in UTC, and only a refusal shows it

        return with_local_times(visible(left[:_LONGEST_NOTE]))

    def _write_owner(self) -> None:
        """Write who has the lock into a file of his own: a link that was put there is removed,
        not followed.
        """
        import socket  # only what edits a file has its lock

        who = f"{user()} on {socket.gethostname()}, process {os.getpid()}, since {now()}"
        with contextlib.suppress(OSError):
            self._holder_path().unlink(missing_ok=True)
            handle = os.open(self._holder_path(), os.O_WRONLY | os.O_CREAT | os.O_EXCL | NO_LINK, 0o666)
            try:
                os.write(handle, who.encode("utf-8", "replace"))
            finally:
                os.close(handle)


def _locked(place: Path) -> int:
    """Return the handle of the locked file, which is made where there is none; raises BlockingIOError,
    OSError.
    """
    for _ in range(_TRIES):
        is_new = not os.path.lexists(place)
        handle = _opened(place)
        try:
            demand_file(os.fstat(handle))
            try:
                _lock(handle)
            except PermissionError:  # so Windows, and some servers of files, report that it is taken
                raise BlockingIOError from None
            # Between opening and locking its holder may have removed it: then no other program would find
            # this one.
            if _still_named(handle, place):
                return handle
        except BlockingIOError:
            os.close(handle)
            raise
        except BaseException:
            os.close(handle)
            if is_new:  # where there are no locks, nothing of one is left
                place.unlink(missing_ok=True)
            raise
        os.close(handle)  # its holder removed it with the lock
    raise BlockingIOError


def _opened(place: Path) -> int:
    """Return the handle of a lock file, which is made where there is none; raises OSError."""
    flags = NO_LINK | HARMLESS
    try:
        return os.open(place, flags | os.O_RDWR | os.O_CREAT, 0o666)
    except PermissionError as error:
        try:
            return os.open(place, flags | os.O_RDONLY)  # another user's: it can be locked anyway
        except FileNotFoundError:
            raise error from None


def _still_named(handle: int, place: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(place))
    except FileNotFoundError:
        return False


def _is_open_to_us(folder: Path) -> bool:
    """Return whether a file in a folder can be saved; a path that is not a folder is reported elsewhere."""
    return os.access(folder, os.W_OK) or not folder.is_dir()


def _is_sound(place: Path) -> bool:
    """Return whether nothing but a lock file has its name: then it is the system that has no lock to give."""
    try:
        demand_file(os.lstat(place))
    except FileNotFoundError:
        return place.parent.is_dir()
    except OSError:
        return False
    return True


def user() -> str:
    """Return who is at work; a system may have no name for him."""
    import getpass

    try:
        return getpass.getuser()
    except (KeyError, OSError, ImportError):
        return "unknown"


def now() -> str:
    """Return the time as it is written into files."""
    return datetime.now(UTC).isoformat(timespec="seconds")
