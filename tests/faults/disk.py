"""What a power loss would leave of what was written: every write, fsync and rename of this process,
as the disk may see them.
"""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from unittest import mock

Inode = tuple[int, int]


class Disk:
    """Which files and folders have changes that no fsync has forced to the disk yet.

    ``faults`` are the names that a power loss could have left without a content:
    a file is forced to the disk before it gets one.
    """

    def __init__(self) -> None:
        self._changed: set[Inode] = set()
        self.faults: list[str] = []

    @contextlib.contextmanager
    def watched(self) -> Iterator[Disk]:
        """Watch the calls of the system; no fsync waits for the disk meanwhile."""
        write, replace, link, remove = os.write, os.replace, os.link, os.unlink

        def written(handle: int, data: bytes | memoryview) -> int:
            if stat.S_ISREG(os.fstat(handle).st_mode):
                self._changed.add(_inode(os.fstat(handle)))
            return write(handle, data)

        def synced(handle: int) -> None:
            self._changed.discard(_inode(os.fstat(handle)))

        def named(act: Callable[..., None], source: str | Path, target: str | Path, **options: bool) -> None:
            if _inode(Path(source).stat()) in self._changed:
                self.faults.append(f"{Path(target).name} is the name of a file that is not on the disk yet")
            act(source, target, **options)
            self._changed.add(_inode(Path(target).parent.stat()))

        def removed(path: str | Path, **options: int) -> None:
            with contextlib.suppress(OSError):
                found = os.lstat(path)
                if found.st_nlink == 1:  # its number goes to another file
                    self._changed.discard(_inode(found))
            remove(path, **options)

        with (
            mock.patch.object(os, "write", written),
            mock.patch.object(os, "fsync", synced),
            mock.patch.object(os, "replace", partial(named, replace)),
            mock.patch.object(os, "link", partial(named, link)),
            mock.patch.object(os, "unlink", removed),
        ):
            yield self

    def unsafe(self, *paths: Path) -> list[str]:
        """Return which of these files and folders a power loss now could change back."""
        return [
            f"{path.name} is not on the disk yet" for path in paths if _inode(path.stat()) in self._changed
        ]


def _inode(found: os.stat_result) -> Inode:
    return found.st_dev, found.st_ino
