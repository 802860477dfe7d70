"""Several machines side by side: a row for each value that differs."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import TYPE_CHECKING, Any

from amp_studio.cli.arguments import BY_LETTER, JSON, LANGUAGE, OUTPUT, PATHS, TEXT
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address, Value

WIDTH = 110
"""Columns from which on a line about many machines is continued below."""

NAMES, VALUES = 12, 8
"""Machines of a group, and values of a row, before the rest is a number."""

VERB = Verb(
    __doc__,
    PATHS,
    VerbArgument("--everything", action="store_true", help="also what is the same on all of them"),
    VerbArgument(
        "--in-full",
        action="store_true",
        help="of many machines every name and every value; else the first of a long list, and how many more",
    ),
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
    from amp_studio.report import SIDE_BY_SIDE, alike_of, machine_groups, machine_names

    files = [opened(path, options).file for path in options.paths]
    # One number is another parameter in each family: only what parameters mean can be compared.
    if len({file.schema.family.family for file in files}) > 1:
        return _by_meaning(options, files)
    if options.by_letter:
        # All to the axes of the first: with pairs of their own two columns could be of different axes.
        files = [files[0], *(matched_by_letter_noted(file, files[0]) for file in files[1:])]
    names = machine_names([path.stem for path in options.paths])
    rows, same = _rows(files, everything=options.everything)
    alike = [alike_of(values) for _, values in rows]
    groups = machine_groups(alike) if rows else [tuple(range(len(files)))]
    if options.output:
        _write(options, files, names)
    elif options.json:
        print_json(_as_json(options, files[0], rows, same, groups))
    else:
        if len(files) > SIDE_BY_SIDE:
            _print_groups(files[0], names, rows, alike, groups, in_full=options.in_full)
        else:
            _print(files[0], rows)
        print(f"{len(rows)} listed, {same} are the same on all {len(files)}")
    # 0 is the value of the first machine: any other number in a row is a difference.
    return int(any(map(any, alike)))


def _rows(
    files: list[ParameterFile], *, everything: bool
) -> tuple[list[tuple[Address, tuple[Value | None, ...]]], int]:
    """Return ``machine_rows``; raises UsageError for what cannot be compared."""
    from amp_studio.report import machine_rows

    try:
        return machine_rows(files, everything=everything)
    except ValueError as error:
        raise UsageError(str(error)) from None


def _as_json(
    options: Options,
    file: ParameterFile,
    rows: Sequence[tuple[Address, Sequence[Value | None]]],
    same: int,
    groups: Sequence[Sequence[int]],
) -> dict[str, Any]:
    """Return the comparison as ``--json`` prints it."""
    return {
        "machines": [str(path) for path in options.paths],
        "same": same,
        "groups": [[str(options.paths[n]) for n in group] for group in groups],
        "rows": [_json_row(file, address, values) for address, values in rows],
    }


def _write(options: Options, files: list[ParameterFile], names: Sequence[str]) -> None:
    """Write the table as the document that is asked for."""
    from amp_studio.report import machines_paper, write_paper

    paper = machines_paper(files, names, everything=options.everything, language=options.language)
    write_paper(paper, options.output, notify=print_remark)
    print(options.output)


def _json_row(first: ParameterFile, address: Address, values: Sequence[Value | None]) -> dict[str, Any]:
    """Return one parameter with its value on each machine; a secret one is masked."""
    from amp_studio.schema import MASKED, write_value

    parameter = first.schema.parameters[address[0]]

    def text(value: Value | None) -> str | None:
        if value is None:
            return None
        # Also in JSON, and without an option for it: a comparison of machines goes to others.
        return MASKED if parameter.secret else write_value(parameter, value)

    return {
        "param": first.machine_schema.short(address),
        "id": address[0],
        "instance": address[1],
        "values": [text(value) for value in values],
    }


def _print(first: ParameterFile, rows: Sequence[tuple[Address, Sequence[Value | None]]]) -> None:
    """Print a line for each value, with that of each machine."""
    from amp_studio.schema import show_value

    for address, values in rows:
        texts = (show_value(first.schema.parameters[address[0]], value) for value in values)
        print(f"{first.machine_schema.named(address):52} {'  |  '.join(texts)}")


def _print_groups(
    first: ParameterFile,
    names: Sequence[str],
    rows: Sequence[tuple[Address, Sequence[Value | None]]],
    alike: Sequence[tuple[int, ...]],
    groups: Sequence[tuple[int, ...]],
    *,
    in_full: bool,
) -> None:
    """Print the groups of machines that agree, and a line for each value with the groups that have it."""
    from amp_studio.report import counted, groups_by_value
    from amp_studio.schema import show_value

    for number, group in enumerate(groups, 1):
        machines = _first_of([names[n] for n in group], 0 if in_full else NAMES)
        _print_wrapped(f"group {number}, {counted(len(group), 'machine')}: {', '.join(machines)}")
    for (address, values), same_as in zip(rows, alike, strict=True):
        parameter, name = first.schema.parameters[address[0]], first.machine_schema.named(address)
        texts = [
            f"{show_value(parameter, values[n])} ({_runs(numbers)})"
            for n, numbers in groups_by_value(same_as, groups)
        ]
        texts = _first_of(texts, 0 if in_full else VALUES)
        line = f"{name:52} {'  |  '.join(texts)}"
        if len(line) <= WIDTH:
            print(line)
            continue
        print(name)
        for text in texts:
            _print_wrapped(f"    {text}")


def _first_of(texts: list[str], most: int) -> list[str]:
    """Return the first texts and how many more there are, one of which would take no less room; all for 0."""
    return texts if not most or len(texts) <= most + 1 else [*texts[:most], f"… and {len(texts) - most} more"]


def _runs(numbers: Sequence[int]) -> str:
    """Return ascending numbers with those that follow each other as one: ``1-3, 7``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1][1:] = [number]
        else:
            runs.append([number])
    return ", ".join("-".join(map(str, run)) for run in runs)


def _print_wrapped(line: str) -> None:
    # A value is never broken: ``12`` at the end of a line and ``.5`` below it would be read as two.
    print(fill(line, WIDTH, subsequent_indent=" " * 8, break_long_words=False, break_on_hyphens=False))


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
