"""The lock by which two programs on one file notice each other; it ends with its program."""

from __future__ import annotations

import contextlib
import getpass
import os
import socket
from datetime import UTC, datetime
from pathlib import Path

import filelock


class InUse(OSError):
    """Another program has the file open; the text says which, where and since when."""


class EditLock:
    """The right of one program to change one file; use it as a context, or ``take`` and ``release``."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lock = filelock.FileLock(beside(path, ".lock"), timeout=0, thread_local=False)

    @property
    def is_taken(self) -> bool:
        """Whether this object holds the lock."""
        return self._lock.is_locked

    def take(self) -> None:
        """Lock the file; raises InUse."""
        if self.is_taken:
            return
        holder = beside(self.path, ".holder")
        try:
            self._lock.acquire()
        except filelock.Timeout:
            try:
                who = holder.read_text(encoding="utf-8")
            except OSError:
                who = "it left no details"
            raise InUse(f"{self.path.name} is open in another program ({who})") from None
        except OSError as error:
            raise InUse(f"{self.path.name} cannot be locked: {error.strerror or error}") from None
        with contextlib.suppress(OSError):
            holder.write_text(
                f"{user()} on {socket.gethostname()}, process {os.getpid()}, since {now()}", encoding="utf-8"
            )

    def release(self) -> None:
        """Give the file free."""
        if self.is_taken:
            with contextlib.suppress(OSError):
                beside(self.path, ".holder").unlink(missing_ok=True)
            if (
                os.name == "posix"
            ):  # while it is held: filelock asks whether the file it locked still has its name
                with contextlib.suppress(OSError):
                    beside(self.path, ".lock").unlink(missing_ok=True)
            self._lock.release()

    def __enter__(self) -> EditLock:
        self.take()
        return self

    def __exit__(self, *_: object) -> None:
        self.release()


def beside(path: Path, ending: str) -> Path:
    """Return the hidden companion of a file, ``.NAME.amp.lock``; one file has one, by whatever link it is reached."""
    path = path.resolve()
    return path.with_name(f".{path.name}{ending}")


def user() -> str:
    """Return who is at work; a system may have no name for him."""
    try:
        return getpass.getuser()
    except (KeyError, OSError, ImportError):
        return "unknown"


def now() -> str:
    """Return the time as it is written into files."""
    return datetime.now(UTC).isoformat(timespec="seconds")
