"""The memory of an emulated control: a folder whose files are replaced all or nothing.

Every change is a few steps on the disk, and ``on_step`` is called with each before
it is done, so that a test can pull the plug at any of them.
"""

from __future__ import annotations

import contextlib
import errno
import os
from collections.abc import Callable, Iterator
from pathlib import Path

from amp_studio.files import write_all
from amp_studio.schema import HARMLESS, NO_LINK, demand_file, read_file

_TEMPORARY = ".tmp"
LARGEST = 1 << 26
"""Bytes of a file, as of an image in an exchange."""


class Memory:
    """Files by name in one folder, which is made when it is missing. Raises OSError as the system does."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self.on_step: Callable[[str], None] = lambda _: None
        self.full_at: int | None = None  # a file that is added to cannot grow past this many bytes

    def names(self) -> list[str]:
        """Return the names of all files."""
        return sorted(path.name for path in self.folder.iterdir() if path.is_file())

    def read(self, name: str) -> bytes | None:
        """Return a file's content, or None when there is no such file."""
        try:
            return read_file(self.folder / name, LARGEST)
        except FileNotFoundError:
            return None

    def size(self, name: str) -> int:
        """Return a file's length in bytes, 0 when there is no such file."""
        try:
            return (self.folder / name).stat().st_size
        except FileNotFoundError:
            return 0

    def replace(self, name: str, content: bytes) -> None:
        """Give a file new content: after a crash at any step it contains the old content or the new,
        whole.
        """
        temporary = self.folder / (name + _TEMPORARY)
        try:
            self.on_step(f"write {temporary.name}")
            temporary.unlink(missing_ok=True)  # whatever was put there is not written to
            with self._open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL) as handle:
                write_all(handle, content)
                self.on_step(f"sync {temporary.name}")
                os.fsync(handle)
            self.move(temporary.name, name)
        except OSError:
            with contextlib.suppress(OSError):
                temporary.unlink()
            raise

    def append(self, name: str, content: bytes) -> None:
        """Add to the end of a file, or leave it as it was."""
        self.on_step(f"append to {name}")
        with self._open(self.folder / name, os.O_WRONLY | os.O_APPEND | os.O_CREAT) as handle:
            before = os.fstat(handle).st_size
            try:
                if self.full_at is not None and before + len(content) > self.full_at:
                    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
                write_all(handle, content)
            except OSError:
                os.ftruncate(handle, before)
                raise

    def sync(self, name: str) -> None:
        """Force a file to the disk."""
        self.on_step(f"sync {name}")
        with self._open(self.folder / name, os.O_RDWR) as handle:
            os.fsync(handle)

    def move(self, name: str, to: str) -> None:
        """Rename a file over another in one step, and force the folder to the disk."""
        self.on_step(f"rename {name} to {to}")
        os.replace(self.folder / name, self.folder / to)
        self._sync_folder()

    def remove(self, name: str) -> None:
        """Remove a file if it is there."""
        self.on_step(f"remove {name}")
        (self.folder / name).unlink(missing_ok=True)

    def clear_temporaries(self) -> None:
        """Remove what an interrupted ``replace`` has left."""
        for name in self.names():
            if name.endswith(_TEMPORARY):
                self.remove(name)

    @contextlib.contextmanager
    def _open(self, path: Path, flags: int) -> Iterator[int]:
        """Open a file to write to it; raises OSError for a link,
        a pipe or a device that was put in its place.
        """
        try:
            handle = os.open(path, flags | NO_LINK | HARMLESS, 0o666)
            try:
                demand_file(os.fstat(handle))
                yield handle
            finally:
                os.close(handle)
        except OSError as error:
            raise OSError(error.errno, error.strerror or str(error), str(path)) from None

    def _sync_folder(self) -> None:
        self.on_step("sync the folder")
        if os.name != "posix":
            return  # Windows keeps its folders itself
        handle = os.open(self.folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
