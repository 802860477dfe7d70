"""Three-way merge by parameter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.cli.arguments import DRY_RUN, JSON, OUTPUT, SECRETS, TEXT, path_of
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_new
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import Merge, MergeChoice, ParameterFile, Row, Side
    from amp_studio.validate import Finding

VERB = Verb(
    __doc__,
    VerbArgument("base", type=path_of, help="what both sides began with"),
    VerbArgument("ours", type=path_of, help="our side, which is kept in a conflict that is not settled"),
    VerbArgument("theirs", type=path_of, help="the other side"),
    OUTPUT.but(required=False, help="file to write; not needed with --dry-run"),
    VerbArgument(
        "--take",
        metavar="[PARAM=]SIDE",
        action="append",
        default=[],
        help="settle conflicts: ours, theirs or base, for all or for one parameter",
    ),
    DRY_RUN.but(help="write nothing, list the conflicts"),
    VerbArgument("--git", action="store_true", help="be git's merge driver: OUTPUT may be OURS"),
    VerbArgument("--window", action="store_true", help="merge in a window of the desktop program"),
    JSON,
    SECRETS,
    *TEXT,
    writes=("output",),
    sections=("PARAM",),
    examples=(
        "amp-studio merge MILL_1394.amp other.amp MILL_1394.amp -o merged.amp",
        "amp-studio merge MILL_1394.amp other.amp MILL_1394.amp --dry-run --take theirs --json",
    ),
)


_SIDES: dict[str, Side] = {"base": "base", "ours": "a", "theirs": "b"}
"""What a person calls a side -> the side."""

_NAMES = {side: name for name, side in _SIDES.items()}


def run(options: Options) -> int:
    """Merge three files by parameter; 1 where there are conflicts that are not settled."""
    from amp_studio.files import Merge
    from amp_studio.report import finding_text

    _check_paths(options)
    merge = Merge(*_sources(options))
    _settle(merge, options.take)
    if options.window:
        return _in_window(merge, options)
    result = merge.result()
    new = _new_findings(merge, result, options.ours)
    if refitted := merge.refitted(result):
        names = ", ".join(result.machine_schema.label(row.address) for row in refitted[:4])
        more = f" and {len(refitted) - 4} more" if len(refitted) > 4 else ""
        print_remark(
            "the axis moves otherwise in the result, and the unit follows with the same figure:"
            f" {names}{more}"
        )
    if not options.dry_run:
        _write(result, options)
    if options.json:
        print_json(_document(merge, result, new, options))
    else:
        _print(merge, options)
        for finding in new:
            print_remark(f"new in the result: {finding_text(result, finding)}")
    return 1 if merge.open_conflicts else 0


def _in_window(merge: Merge, options: Options) -> int:
    """Have a person merge in the window; 1 where the window was closed without a result."""
    if options.dry_run or options.json:
        raise UsageError("--window goes with neither --dry-run nor --json")
    from amp_studio.ui import MISSING, has_display

    if not has_display():
        raise UsageError(MISSING)
    from amp_studio.ui import merge_in_window

    is_written = merge_in_window(merge, options.ours, options.output, lambda result: _write(result, options))
    print(f"{options.output}: {'written' if is_written else 'not written'}")
    return 0 if is_written else 1


def _check_paths(options: Options) -> None:
    """Raise UsageError, SaveError where the result could not be written."""
    from amp_studio.files import check_output

    if options.output is None and not options.dry_run:
        raise UsageError("merge needs -o OUTPUT, or --dry-run to list only")
    if options.output is None or options.dry_run:
        return
    if options.git:
        check_output(options.output, options.base, options.theirs)
    else:
        check_new(options.output, "a merge", options.base, options.ours, options.theirs)


def _sources(options: Options) -> tuple[ParameterFile, ParameterFile, ParameterFile | None]:
    """Return ours, theirs and the base. git gives an empty file as the base of a file that both sides
    added.
    """
    from amp_studio.files import ParameterFile

    ours, theirs = (opened(path, options).file for path in (options.ours, options.theirs))
    if options.git and options.base.is_file() and options.base.stat().st_size == 0:
        return ours, theirs, ParameterFile(ours.schema)
    return ours, theirs, opened(options.base, options).file


def _settle(merge: Merge, texts: list[str]) -> None:
    """Take sides: ``theirs`` settles every conflict, ``1300=theirs`` one parameter; later ones count."""
    from amp_studio.schema import field_at, quoted, resolve_address

    for text in texts:
        param, equals, name = text.rpartition("=")
        side = _SIDES.get(name.strip())
        if side is None:
            raise UsageError(f"{quoted(name.strip())} is no side: {', '.join(_SIDES)}")
        if not equals:
            merge.take(side, merge.conflicts)
            continue
        resolved = resolve_address(merge.a.evaluation, param.strip())
        if resolved.bit is not None:
            label = field_at(merge.a.schema.parameters[resolved.address[0]], resolved.bit).label
            raise UsageError(
                f"{param.strip()} is one field ({label}) of a value: a side is taken for all of it"
            )
        rows = [row for row in merge.rows if row.id.part == "value" and row.address == resolved.address]
        if not any(row.kind != "same" for row in rows):
            print_remark(f"{param.strip()} is the same on all sides")
        merge.take(side, rows)


def _new_findings(merge: Merge, result: ParameterFile, beside: Path) -> list[Finding]:
    """Return the errors and warnings of the result that neither ours nor theirs has by itself."""
    from amp_studio.validate import Validator, new_findings, rules_beside

    own = rules_beside(beside, result)
    # Of both sides: what either of them has already was not brought in by the merge.
    before = [f for file in (merge.a, merge.b) for f in Validator(file, own).run()]
    return [f for f in new_findings(before, Validator(result, own).run()) if f.severity != "advice"]


def _write(result: ParameterFile, options: Options) -> None:
    """Write the result: ours with what changed in it, remarks and order as they are there.

    For git it takes the place of what is there, under the name that ours has, and without a backup:
    git has it.
    """
    from amp_studio.files import file_content, readable_content, text_of_name, write_atomic

    previous = file_content(options.ours)
    result.header.signature = result.schema.signature
    if not options.git:
        result.header.name = text_of_name(options.output.stem)
    content = readable_content(result, options.output, previous)
    expected = "" if options.git else None
    write_atomic(options.output, content, expected, keep_backup=False, notify=print_remark)


def _print(merge: Merge, options: Options) -> None:
    """Print each conflict and what the result has, and how many are open."""
    from amp_studio.cli.checks.comparing import named, value_text
    from amp_studio.report import counted

    for row in merge.conflicts:
        took = f"{_side_name(merge.choice(row))} is {'taken' if row not in merge.open_conflicts else 'kept'}"
        if row.id.part == "entry":  # it may be a secret of another schema
            print(f"conflict at {row.id.key}: {took}")
        elif row.id.part == "header":
            print(f"conflict at {row.id.key} of the file: {took}")
        else:
            was, mine, wanted = (
                value_text(merge.a, row, value, options.secrets) for value in (row.base, row.a, row.b)
            )
            print(f"conflict at {named(merge.a, row)}: base {was}, ours {mine}, theirs {wanted}; {took}")
    written = merge.a.header.name if options.git else ""  # git calls its files .merge_file_a7xQ2b
    where = "nothing written" if options.dry_run else written or options.output
    print(f"{where}: {counted(len(merge.open_conflicts), 'conflict')}")


def _side_name(choice: MergeChoice | None) -> str:
    """Return what a person calls a choice; where nothing was chosen ours is kept."""
    from amp_studio.files import Typed

    return "ours" if choice is None or isinstance(choice, Typed) else _NAMES[choice]


def _document(merge: Merge, result: ParameterFile, new: list[Finding], options: Options) -> dict[str, Any]:
    """Return the merge as ``--json`` prints it."""
    from amp_studio.report import finding_json

    changed = [row for row in merge.differing if merge.choice(row) not in ("a", None)]
    return {
        "output": None if options.dry_run else str(options.output),
        "conflicts": [_row(merge, row, result, options.secrets) for row in merge.conflicts],
        "changes": [_row(merge, row, result, options.secrets) for row in changed],
        "same": merge.same,
        "findings": [finding_json(result, finding) for finding in new],
    }


def _row(merge: Merge, row: Row, result: ParameterFile, secrets: bool) -> dict[str, Any]:
    """Return a row with the names of the sides; what an entry
    that the schema does not know contains is not shown.
    """
    from amp_studio.cli.checks.comparing import difference_json, row_json
    from amp_studio.files import Difference

    settled = {"taken": _side_name(merge.choice(row)) if merge.choice(row) else None}
    if row.id.part == "entry":
        return {"param": row.id.key} | settled
    if row.id.part == "header":
        sides = {name: None if (v := row.of(side)) is None else v.value for name, side in _SIDES.items()}
        return {"param": f"file.{row.id.key}"} | sides | settled
    found = row_json(merge, row, secrets)
    settled["result"] = difference_json(
        merge.a, Difference(row.address, result.get(row.address), None), secrets
    )["a"]
    return (
        {
            "param": found["param"],
            "id": found["id"],
            "instance": found["instance"],
            "base": found["base"],
            "ours": found["a"],
            "theirs": found["b"],
        }
        | settled
        | ({"secret": True} if found.get("secret") else {})
    )
