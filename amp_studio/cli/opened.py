"""The file that a verb reads: a parameter file, or a control's own text in its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from amp_studio.files import ENDING, ParameterFile, open_file

from .console import note


def opened(path: Path, notify: Callable[[str], None] = note) -> ParameterFile:
    """Return the parameters of a file that is only read; notes about a control's own text go to standard error."""
    if path.suffix.casefold() == ENDING:
        return open_file(path).file
    from amp_studio.formats.any_file import open_for_reading  # most files are parameter files

    return open_for_reading(path, lambda message: notify(f"{path}: {message}"))
