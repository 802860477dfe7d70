"""What a verb writes: checked before anything is done, written whole or not at all,
with a note of what was not kept.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .console import print_remark
from .errors import UsageError

if TYPE_CHECKING:
    from amp_studio import MachineParameters


def check_replaced(output: Path, *inputs: Path) -> None:
    """Refuse an output that cannot be written, belongs to an input, or is where the results are printed.

    Raises UsageError, SaveError.
    """
    from amp_studio.files import check_output

    check_output(output, *inputs)
    # With ``> out.csv`` and ``-o out.csv`` two handles would write over each other.
    for printed in (1, 2):
        with contextlib.suppress(OSError):
            if os.path.samestat(os.fstat(printed), output.stat()):
                raise UsageError(
                    f"{output} is where the results are printed: choose another name for the output"
                )


def check_picture(output: Path, *inputs: Path) -> None:
    """Refuse what ``check_replaced`` does, and a picture that is no SVG."""
    check_replaced(output, *inputs)
    if output.suffix.lower() != ".svg":
        raise UsageError(f"A picture is drawn as SVG: name the file {output.stem}.svg")


def check_new(output: Path, what: str, *inputs: Path) -> None:
    """Refuse an output that is there already, or could not be written; raises UsageError, SaveError."""
    from amp_studio.files import check_output, is_there

    if is_there(output):
        raise UsageError(f"{output} exists already: {what} gets a new name")
    if not output.parent.is_dir():
        raise UsageError(f"there is no folder {output.parent}")
    check_output(output, *inputs)


def write_new(machine: MachineParameters, path: Path, *, named: bool = False) -> None:
    """Save a new machine, named as its file, or as it is already where it is ``named``; raises MachineError,
    SaveError.
    """
    if named and machine.file.header.name:
        machine.save(path)
    else:
        machine.save_new(path)
    print_remarks(machine.notes)


def print_remarks(notes: Sequence[str]) -> None:
    """Print what a save could not keep."""
    for message in notes:
        print_remark(message)
