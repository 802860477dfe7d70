"""The file that a verb reads: a parameter file, or a control's own text in its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from .console import print_remark
from .errors import UsageError
from .verb import Options

if TYPE_CHECKING:
    from amp_studio import MachineParameters


def opened(
    path: Path, options: Options | None = None, notify: Callable[[str], None] = print_remark
) -> MachineParameters:
    """Return the machine of a file that is only read; notes about a control's own text go to standard error.

    ``options`` with ``arguments.TEXT`` name the family and the machine type of such a text; a verb without
    them does not offer to choose another. Raises UsageError, ParameterFileError.
    """
    from amp_studio import open as open_machine
    from amp_studio.schema import UnknownFamilyError

    family, machine = (options.family, options.machine) if options else (None, None)

    def pass_on(message: str) -> None:
        # What is behind the semicolon names options, which this verb does not have.
        notify(f"{path}: {message if options else message.partition('; --')[0]}")

    try:
        return open_machine(path, family=family, machine=machine or "", notify=pass_on)
    except UnknownFamilyError as error:
        raise UsageError(str(error)) from None
