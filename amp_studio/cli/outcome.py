"""What a verb that failed or was stopped has changed anyway: found by a look at the disk.

Memory decides only where the disk cannot be asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

FileIdentity = tuple[int, int, int, int] | str | None
"""What distinguishes one state of a file from another: device, number, size and time;
None where there is no file.

A text gives the reason why it cannot be examined.
"""


class Target(NamedTuple):
    """A file that a verb may replace, and its backup, as they were before it began."""

    path: Path
    identity: FileIdentity
    backup: Path
    backup_identity: FileIdentity

    def sentence(self) -> str:
        """Return what is true now where the file has been replaced; nothing where it is as it was."""
        now = _identity_of(self.path)
        # By device, number, size and time: a file that is replaced by a rename has another number.
        if now == self.identity:
            return ""
        if isinstance(now, str) or isinstance(self.identity, str):
            return self._remembered()
        if now is None:
            return f"{self.path} is no longer there"
        if self.identity is None:
            if now[2] == 0:
                return f"{self.path} has been made and is empty: remove it"
            return f"{self.path} has been written and is complete"
        kept = (
            f"; its previous content is in {self.backup}"
            if _identity_of(self.backup) != self.backup_identity
            else ""
        )
        return f"{self.path} has been changed and contains the new content{kept}"

    def _remembered(self) -> str:
        """Return what is true now where the disk could not be asked before or cannot be now."""
        from amp_studio.files import was_replaced

        return f"{self.path} has been written, and cannot be examined" if was_replaced(self.path) else ""


def targets(paths: Sequence[Path]) -> list[Target]:
    """Return the files that a verb may replace, to be asked later what has become of them."""
    if not paths:
        return []
    backups = [_backup(path) for path in paths]
    return [
        Target(path, _identity_of(path), backup, _identity_of(backup))
        for path, backup in zip(paths, backups, strict=True)
    ]


def _backup(path: Path) -> Path:
    """Return where the previous content of a file will be; any place where none can be kept."""
    from amp_studio.files import backup_path  # only a verb that writes needs it

    try:
        return backup_path(path)
    except OSError:
        return path.with_name(path.name + ".bak")


def _identity_of(path: Path) -> FileIdentity:
    try:
        found = path.stat()
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return None
    except OSError as error:
        return error.strerror or str(error)
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns
