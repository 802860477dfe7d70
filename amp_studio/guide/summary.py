"""A file in one line: what machine it is and how many findings it has. For lists of files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from amp_studio.files import axis_letter, fitted_axes, open_file
from amp_studio.validate import validator_of

from .delivered import found_in


@dataclass(frozen=True)
class FileSummary:
    """What a list of files shows of one."""

    name: str
    """The name of the machine, as its file has it."""
    family: str
    family_name: str
    """Its short name."""
    machine: str
    """The name of its machine type; "" in a family that has but one."""
    axes: tuple[str, ...]
    """The letters of its axes, or their numbers; none where the file does not declare them."""
    counts: Mapping[str, int]
    """Severity -> how many findings; a severity without any is left out."""


def summary_of(path: Path) -> FileSummary:
    """Return the summary of a file with the rules beside it. Raises ParameterFileError, OSError."""
    file = open_file(path).file
    family = file.schema.family
    names = {m.key: m.name for m in family.machines}
    findings = found_in(validator_of(file, path))
    return FileSummary(
        name=file.header.name,
        family=family.family,
        family_name=family.short or family.name,
        machine=names.get(file.machine, "") if len(names) > 1 else "",
        axes=tuple(axis_letter(file, a) or a for a in fitted_axes(file)),
        counts=Counter(f.severity for f in findings),
    )
