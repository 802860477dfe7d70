"""What a file was made from: written into it, so that a check can compare the two."""

from __future__ import annotations

import contextlib
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.schema import YamlError, read_yaml, spelled_scalar

from .paths import real_path

if TYPE_CHECKING:
    from .parameter_file import ParameterFile

_MADE_FROM = "made_from"
"""Key of the header: the other file, as seen from the folder of this one."""

_ENTRY = re.compile(rb"^made_from:[ \t][^\r\n]*", re.MULTILINE)


def record_origin(file: ParameterFile, path: Path, origin: Path) -> None:
    """Write into a file that will be at ``path`` what it is made from; nothing where no way leads there."""
    with contextlib.suppress(ValueError, OSError):  # another drive; no such folder
        file.header.extra[_MADE_FROM] = Path(
            os.path.relpath(real_path(origin), real_path(path).parent)
        ).as_posix()


def origin_of(file: ParameterFile, path: Path) -> Path | None:
    """Return what a file at ``path`` was made from; None if it is not known."""
    return _path_of(file.header.extra.get(_MADE_FROM), path.parent)


def origin_named(content: bytes, folder: str) -> Path | None:
    """Return the same of the text of a file in a folder, without reading all of it."""
    # The expression looks at each line; few files have one with the word.
    found = _ENTRY.search(content) if b"made_from:" in content else None
    if found is None:
        return None
    try:  # by the reader of all files: a name may be in quotes, and a remark behind it
        source = read_yaml(found[0].decode("utf-8"), spelled_scalar).data.get(_MADE_FROM)
    except (UnicodeDecodeError, YamlError):
        return None
    return _path_of(source, Path(folder))


def _path_of(source: object, folder: Path) -> Path | None:
    """Return the file that an entry names as seen from a folder; None for an entry that names none."""
    # The system refuses a path with a NUL by a ValueError, not by an OSError.
    return folder / source if isinstance(source, str) and source and "\0" not in source else None
