"""Several machines side by side: a row for each value that differs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.arguments import BY_LETTER, JSON, LANGUAGE, OUTPUT, PATHS, TEXT
from amp_studio.cli.console import note, print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile

VERB = Verb(
    __doc__,
    PATHS,
    VerbArgument("--everything", action="store_true", help="also what is the same on all of them"),
    BY_LETTER,
    OUTPUT.but(required=False, help="the table, as .pdf, .html, .xlsx or .csv"),
    LANGUAGE,
    JSON,
    *TEXT,
    writes=("output",),
    examples=(
        "amp-studio compare MILL_1394.amp other.amp",
        "amp-studio compare MILL_1394.amp other.amp -o machines.xlsx",
    ),
)


def run(options: Options) -> int:
    """Print or write what differs between machines; 1 where anything does."""
    from amp_studio.cli.checks.comparing import matched_by_letter_noted
    from amp_studio.report import (
        SIDE_BY_SIDE,
        alike_of,
        counted,
        groups_by_value,
        machine_groups,
        machine_names,
        machine_rows,
        machines_paper,
        write_paper,
    )
    from amp_studio.schema import MASKED, show_value, write_value

    files = [opened(path, options).file for path in options.paths]
    if len({file.schema.family.family for file in files}) > 1:
        return _by_meaning(options, files)
    if options.by_letter:
        files = [files[0], *(matched_by_letter_noted(file, files[0]) for file in files[1:])]
    names = machine_names([path.stem for path in options.paths])
    try:
        rows, same = machine_rows(files, everything=options.everything)
    except ValueError as error:
        raise UsageError(str(error)) from None
    first, parameters = files[0], files[0].schema.parameters
    alike = [alike_of(values) for _, values in rows]
    groups = machine_groups(alike) if rows else [tuple(range(len(files)))]
    if options.output:
        write_paper(
            machines_paper(files, names, everything=options.everything, language=options.language),
            options.output,
            notify=note,
        )
        print(options.output)
    elif options.json:
        print_json(
            {
                "machines": [str(path) for path in options.paths],
                "same": same,
                "groups": [[str(options.paths[n]) for n in group] for group in groups],
                "rows": [
                    {
                        "param": first.machine_schema.short(address),
                        "id": address[0],
                        "instance": address[1],
                        "values": [
                            (
                                None
                                if v is None
                                else (
                                    MASKED
                                    if parameters[address[0]].secret
                                    else write_value(parameters[address[0]], v)
                                )
                            )
                            for v in values
                        ],
                    }
                    for address, values in rows
                ],
            }
        )
    else:
        is_grouped = len(files) > SIDE_BY_SIDE
        for number, group in enumerate(groups if is_grouped else (), 1):
            print(f"group {number}, {counted(len(group), 'machine')}: {', '.join(names[n] for n in group)}")
        for (address, values), same_as in zip(rows, alike, strict=True):
            shown = [show_value(parameters[address[0]], value) for value in values]
            if is_grouped:
                by_value = groups_by_value(same_as, groups)
                shown = [f"{shown[n]} ({', '.join(map(str, numbers))})" for n, numbers in by_value]
            print(f"{first.machine_schema.named(address):52} {'  |  '.join(shown)}")
        print(f"{len(rows)} listed, {same} are the same on all {len(files)}")
    return int(any(map(any, alike)))


def _by_meaning(options: Options, files: list[ParameterFile]) -> int:
    """Print what differs between machines of several families, by what their parameters mean;
    1 where anything does.
    """
    from amp_studio.meaning import MeaningError, compare_meanings

    if options.output:
        raise UsageError(
            "machines of several families are compared by meaning: print them, or --json; there is no paper"
            " of it"
        )
    try:
        rows = compare_meanings(files)
    except MeaningError as error:
        raise UsageError(str(error)) from None
    shown = rows if options.everything else [row for row in rows if not row.is_same]
    same = sum(row.is_same for row in rows)
    if options.json:
        print_json(
            {
                "machines": [str(path) for path in options.paths],
                "same": same,
                "groups": [],
                "rows": [
                    {"concept": row.concept, "axis": row.axis, "unit": row.unit, "values": list(row.values)}
                    for row in shown
                ],
            }
        )
    else:
        for row in shown:
            print(f"{f'{row.axis} {row.concept}'.strip():24} {' | '.join(row.texts())}")
        print(f"{same} of {len(rows)} the same")
    return int(any(not row.is_same for row in rows))
