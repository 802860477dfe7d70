"""Several machines side by side: a row for each value that differs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from amp_studio.cli.arguments import BY_LETTER, JSON, LANGUAGE, OUTPUT, PATHS, TEXT
from amp_studio.cli.console import note, print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address, Value

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
    from amp_studio.report import alike_of, machine_groups, machine_names, machine_rows

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
    alike = [alike_of(values) for _, values in rows]
    groups = machine_groups(alike) if rows else [tuple(range(len(files)))]
    if options.output:
        _write(options, files, names)
    elif options.json:
        print_json(
            {
                "machines": [str(path) for path in options.paths],
                "same": same,
                "groups": [[str(options.paths[n]) for n in group] for group in groups],
                "rows": [_json_row(files[0], address, values) for address, values in rows],
            }
        )
    else:
        _print(files[0], names, rows, alike, groups)
        print(f"{len(rows)} listed, {same} are the same on all {len(files)}")
    return int(any(map(any, alike)))


def _write(options: Options, files: list[ParameterFile], names: Sequence[str]) -> None:
    """Write the table as the document that is asked for."""
    from amp_studio.report import machines_paper, write_paper

    paper = machines_paper(files, names, everything=options.everything, language=options.language)
    write_paper(paper, options.output, notify=note)
    print(options.output)


def _json_row(first: ParameterFile, address: Address, values: Sequence[Value | None]) -> dict[str, Any]:
    """Return one parameter with its value on each machine; a secret one is masked."""
    from amp_studio.schema import MASKED, write_value

    parameter = first.schema.parameters[address[0]]

    def text(value: Value | None) -> str | None:
        if value is None:
            return None
        return MASKED if parameter.secret else write_value(parameter, value)

    return {
        "param": first.machine_schema.short(address),
        "id": address[0],
        "instance": address[1],
        "values": [text(value) for value in values],
    }


def _print(
    first: ParameterFile,
    names: Sequence[str],
    rows: Sequence[tuple[Address, Sequence[Value | None]]],
    alike: Sequence[tuple[int, ...]],
    groups: Sequence[tuple[int, ...]],
) -> None:
    """Print a line for each value: those of all machines, or of the groups of many machines."""
    from amp_studio.report import SIDE_BY_SIDE, counted, groups_by_value
    from amp_studio.schema import show_value

    is_grouped = len(names) > SIDE_BY_SIDE
    for number, group in enumerate(groups if is_grouped else (), 1):
        print(f"group {number}, {counted(len(group), 'machine')}: {', '.join(names[n] for n in group)}")
    for (address, values), same_as in zip(rows, alike, strict=True):
        texts = [show_value(first.schema.parameters[address[0]], value) for value in values]
        if is_grouped:
            by_value = groups_by_value(same_as, groups)
            texts = [f"{texts[n]} ({', '.join(map(str, numbers))})" for n, numbers in by_value]
        print(f"{first.machine_schema.named(address):52} {'  |  '.join(texts)}")


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
    different = [row for row in rows if not row.is_same]
    listed = rows if options.everything else different
    same = len(rows) - len(different)
    if options.json:
        print_json(
            {
                "machines": [str(path) for path in options.paths],
                "same": same,
                "groups": [],
                "rows": [
                    {"concept": row.concept, "axis": row.axis, "unit": row.unit, "values": list(row.values)}
                    for row in listed
                ],
            }
        )
    else:
        for row in listed:
            print(f"{f'{row.axis} {row.concept}'.strip():24} {' | '.join(row.texts())}")
        print(f"{same} of {len(rows)} the same")
    return int(bool(different))
