"""The file that a verb reads: a parameter file, or a control's own text in its place."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from amp_studio.files import ENDING, ParameterFile, open_file

from .console import note
from .errors import UsageError


def opened(
    path: Path, options: argparse.Namespace | None = None, notify: Callable[[str], None] = note
) -> ParameterFile:
    """Return the parameters of a file that is only read; notes about a control's own text go to standard error.

    ``options`` of ``text_options`` name the family and the machine type of such a text. Raises UsageError, ParameterFileError.
    """
    if path.suffix.casefold() == ENDING:
        return open_file(path).file
    from amp_studio.formats.any_file import open_for_reading  # most files are parameter files
    from amp_studio.schema import UnknownFamilyError

    family, machine = (options.family, options.machine) if options else (None, None)
    try:
        return open_for_reading(
            path, lambda message: notify(f"{path}: {message}"), family=family, machine=machine or ""
        )
    except UnknownFamilyError as error:
        raise UsageError(str(error)) from None
