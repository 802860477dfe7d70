"""What lies in a project folder: parameter files, their backups and the copies of controls,
and when each was last exchanged.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from amp_studio.files import BEFORE, ENDING, backup_path

from .kept import IMAGE
from .record import RecordedExchange, read_exchanges

RULES = "rules.yaml"


@dataclass(frozen=True)
class FolderFile:
    """One parameter file of a folder."""

    path: Path
    backup: Path | None
    """The file before the last save."""
    copies: tuple[Path, ...]
    """What controls contained before a download of it, the latest first."""
    exchange: RecordedExchange | None
    """The last exchange with a control."""


@dataclass(frozen=True)
class FolderContent:
    """The content of a project folder, or of any folder with parameter files."""

    folder: Path
    files: tuple[FolderFile, ...]
    deleted: tuple[Path, ...]
    """Backups of files that are gone."""
    rules: Path | None
    """A builder's own rules."""


def folder_content(folder: Path) -> FolderContent:
    """Return what is in a folder. Raises OSError."""
    names = sorted(folder.iterdir(), key=lambda p: p.name.casefold())
    files = [p for p in names if p.suffix.lower() == ENDING and BEFORE not in p.name]
    exchanges = {each.file: each for each in _exchanges(folder)}
    backups = {p for p in names if p.name.lower().endswith(f"{ENDING}.bak")}
    found = tuple(_file(path, names, backups, exchanges.get(path.name)) for path in files)
    others = backups - {f.backup for f in found}
    rules = folder / RULES
    return FolderContent(folder, found, tuple(sorted(others)), rules if rules in names else None)


def _exchanges(folder: Path) -> Iterable[RecordedExchange]:
    """Return the exchanges of a folder; none where the record cannot be read."""
    try:
        return read_exchanges(folder)
    except (OSError, ValueError):
        return []


def _file(path: Path, names: list[Path], backups: set[Path], exchange: RecordedExchange | None) -> FolderFile:
    try:
        backup: Path | None = backup_path(path)
    except OSError:
        backup = None
    copies = [p for p in names if p.name.startswith(f"{path.stem}{BEFORE}")]
    images = {p.stem for p in copies if p.suffix == IMAGE}
    listed = [p for p in copies if p.suffix == IMAGE or (p.suffix == ENDING and p.stem not in images)]
    return FolderFile(path, backup if backup in backups else None, tuple(reversed(listed)), exchange)
