"""Values of a file by their marks, for ``get``: changed, with findings, unlike on the axes,
newer than the last download.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.verb import Options
from amp_studio.schema import Address, ResolvedAddress

if TYPE_CHECKING:  # most verbs about files ask for no mark, and start without what finds them
    from amp_studio import MachineParameters
    from amp_studio.find import FilterName

_OPTIONS: dict[str, FilterName] = {
    "changed": "changed",
    "axes_differ": "axes-differ",
    "with_findings": "findings",
    "since_download": "since-download",
    "restart": "restart",
    "with_notes": "noted",
}


def marks_asked(options: Options) -> list[FilterName]:
    """Return the marks that the options name."""
    return [mark for option, mark in _OPTIONS.items() if getattr(options, option)]


def with_marks(
    machine: MachineParameters, path: Path, found: Sequence[ResolvedAddress], wanted: list[FilterName]
) -> list[ResolvedAddress]:
    """Return those of the values that have every mark; raises NoDownloadError where no download is known."""
    from amp_studio.find import ValueFilters, noted, rows_of_file

    file = machine.file
    marks = ValueFilters(file)
    if "findings" in wanted:
        from amp_studio.guide import found_in

        marks.take_findings(found_in(machine.validator()))
    if "since-download" in wanted:
        from amp_studio.transfer.client import last_download

        marks.downloaded = last_download(file, path).file.values
    marks.noted = noted(file)
    row_of = {address: row for row in rows_of_file(file) for address in row}

    def has(mark: FilterName, address: Address) -> bool:
        return marks.differs(row_of.get(address, ())) if mark == "axes-differ" else marks.has(mark, address)

    return [resolved for resolved in found if all(has(mark, resolved.address) for mark in wanted)]
