"""The verb that puts several machines side by side."""

from __future__ import annotations

import argparse

from amp_studio.report.differences import machine_names, machine_rows, machines_paper
from amp_studio.report.paper import write_paper
from amp_studio.schema import MASKED, show_value, write_value

from .comparing import matched_by_letter_noted
from .console import note, print_json
from .errors import UsageError
from .opened import opened


def compare_verb(options: argparse.Namespace) -> int:
    """Print or write what differs between machines; 1 where anything does."""
    files = [opened(path) for path in options.paths]
    if options.by_letter:
        files = [files[0], *(matched_by_letter_noted(file, files[0]) for file in files[1:])]
    names = machine_names([path.stem for path in options.paths])
    try:
        rows, same = machine_rows(files, everything=options.everything)
    except ValueError as error:
        raise UsageError(str(error)) from None
    first, differs = files[0], any(len({str(v) for v in values}) > 1 for _, values in rows)
    if options.output:
        write_paper(
            machines_paper(files, names, everything=options.everything, language=options.language),
            options.output,
            notify=note,
        )
        print(options.output)
    elif options.json:
        parameters = first.schema.parameters
        print_json({"machines": [str(path) for path in options.paths], "same": same, "rows": [
            {"param": first.machine_schema.short(address), "id": address[0], "instance": address[1],
             "values": [None if v is None else MASKED if parameters[address[0]].secret else write_value(parameters[address[0]], v)
                        for v in values]}
            for address, values in rows]})  # fmt: skip
    else:
        for address, values in rows:
            shown = "  |  ".join(show_value(first.schema.parameters[address[0]], value) for value in values)
            print(f"{first.machine_schema.named(address):52} {shown}")
        print(f"{len(rows)} listed, {same} are the same on all {len(files)}")
    return 1 if differs else 0
