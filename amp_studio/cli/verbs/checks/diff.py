"""Differences by parameter; A or B may be a control's address."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import BY_LETTER, JSON, LANGUAGE, OUTPUT, SECRETS, TEXT, file_or_address
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import Comparison, Difference, Merge, ParameterFile

VERB = Verb(
    __doc__,
    VerbArgument("a", type=file_or_address, help="file, or address of a control"),
    VerbArgument("b", type=file_or_address, nargs="?", help="file, or address of a control"),
    VerbArgument("--defaults", action="store_true", help="compare with the printed defaults"),
    VerbArgument("--backup", action="store_true", help="compare with the backup beside the file"),
    VerbArgument(
        "--last-download",
        action="store_true",
        help="compare with what the last recorded download put into a control",
    ),
    VerbArgument(
        "--axes", nargs=2, metavar=("AXIS", "OTHER"), help="compare one axis of A with another one of it"
    ),
    VerbArgument(
        "--base", type=file_or_address, help="what both come from: shows which side changed a value"
    ),
    BY_LETTER,
    OUTPUT.but(required=False, help="the report of them, as .pdf, .html, .xlsx or .csv"),
    LANGUAGE,
    JSON,
    SECRETS,
    *TEXT,
    writes=("output",),
    sections=("ADDRESS",),
    at_control=True,
    examples=(
        "amp-studio diff MILL_1394.amp other.amp",
        "amp-studio diff MILL_1394.amp --axes X Y",
        "amp-studio diff MILL_1394.amp other.amp --base MILL_1394.amp",
        "amp-studio diff MILL_1394.amp other.amp -o differences.pdf",
    ),
)


def run(options: Options) -> int:
    """Compare two files, or a file and a control, or a file with another version of itself;
    1 where they differ.
    """
    from amp_studio.cli.checks.comparing import difference_json, matched_by_letter_noted, print_comparison
    from amp_studio.files import Merge, by_schema, compare, of_other_schema

    _check_sides(options)
    a, a_digest = _side(options, options.a)
    b, b_digest, name = _other_side(options, a)
    if a.schema.family.family != b.schema.family.family:
        raise UsageError(f"{options.a} is for {a.schema.family.name}, {name} for {b.schema.family.name}")
    # Controls that describe themselves have a schema each: B is read with that of A.
    other = by_schema(b, a.schema)
    of_b = of_other_schema(b, other)  # settings that only the control of B has
    if options.by_letter:
        other = matched_by_letter_noted(other, a)
    if options.base:
        return _print_three(options, Merge(a, other, _side(options, options.base)[0]))
    found = compare(a.schema, a.values, other.values)
    if options.output:
        _write_paper(options, a, found, name, (a_digest, b_digest), (b, of_b))
    elif options.json:
        rows = [difference_json(a, d, options.secrets) for d in found.differences]
        rows += [difference_json(b, d, options.secrets) for d in of_b]
        known = {"sha256": {"a": a_digest, "b": b_digest}} if a_digest or b_digest else {}
        print_json({"differences": rows, "same": found.same} | known)
    else:
        print_comparison(a, found, options.secrets, (b, of_b))
        for digest in filter(None, (a_digest, b_digest)):
            print(f"sha256 {digest}")
    # Settings that only B has make the machines differ too.
    return int(bool(found.differences or of_b))


def _write_paper(
    options: Options,
    a: ParameterFile,
    comparison: Comparison,
    name: str,
    digests: tuple[str | None, str | None],
    more: tuple[ParameterFile, list[Difference]],
) -> None:
    """Write the differences as the document that is asked for, with the digests of controls on it."""
    from amp_studio.report import differences_paper, write_paper

    facts = [
        (f"SHA-256 of {side}", digest)
        for side, digest in zip("AB", digests, strict=True)
        if digest is not None
    ]
    write_paper(
        differences_paper(a, comparison, (options.a, name), facts, more=more, language=options.language),
        options.output,
        notify=print_remark,
    )
    print(options.output)


def _check_sides(options: Options) -> None:
    """Raise UsageError unless there is one other side that A can have."""
    from amp_studio.files import backup_path, is_there
    from amp_studio.transfer.links import is_endpoint

    named = [options.b, options.axes, options.defaults, options.backup, options.last_download]
    if sum(map(bool, named)) != 1:
        raise UsageError(
            "diff takes one other side: B, or one of --defaults, --backup, --last-download, --axes"
        )
    if (options.backup or options.last_download) and is_endpoint(options.a):
        raise UsageError(f"{options.a} is a control: a backup and a last download belong to a file")
    if options.backup and not is_there(backup_path(Path(options.a))):
        raise UsageError(f"{options.a} has no backup: the first change of it makes one")


def _other_side(options: Options, a: ParameterFile) -> tuple[ParameterFile, str | None, str]:
    """Return the second side of a comparison, the digest of its image where it is a control's, and its
    name.
    """
    from amp_studio.files import backup_path

    if options.b:
        return *_side(options, options.b), options.b
    if options.defaults:
        from amp_studio.files import with_defaults

        return with_defaults(a), None, "its defaults"
    if options.axes:
        return _other_axis(a, *options.axes), None, "the other axis"
    if options.backup:
        return *_side(options, str(backup_path(Path(options.a)))), "its backup"
    from amp_studio.transfer.client import last_download

    last = last_download(a, Path(options.a))
    # It names the control: a file may have been sent to several, and only the last one is compared.
    print_remark(f"last download: {last.when} to {last.control}")
    return last.file, None, "its last download"


def _other_axis(file: ParameterFile, target: str, source: str) -> ParameterFile:
    """Return a file in which the first axis has the values of the second; axes are named by number or
    letter.
    """
    from amp_studio.files import as_axis, axis_letters

    named = {letter.casefold(): axis for axis, letter in axis_letters(file).items()}
    target, source = (named.get(axis.casefold(), axis) for axis in (target, source))
    return as_axis(file, source, target)


def _print_three(options: Options, merge: Merge) -> int:
    """Print what two sides changed of their base; 1 where anything differs."""
    from amp_studio.cli.checks.comparing import how_many, named, row_json, value_text

    # Notes, ticks and the header can be merged, but are no differences between machines.
    rows = [row for row in merge.differing if row.id.part == "value"]
    same = sum(row.id.part == "value" for row in merge.rows) - len(rows)
    if options.json:
        print_json({"differences": [row_json(merge, row, options.secrets) for row in rows], "same": same})
        return int(bool(rows))
    for row in rows:
        base, a, b = (value_text(merge.a, row, value, options.secrets) for value in (row.base, row.a, row.b))
        print(f"{named(merge.a, row):52} base {base}  |  A {a}  |  B {b}  ({_WHO[row.kind]})")
    conflicts = sum(row.kind == "conflict" for row in rows)
    print(f"{how_many(len(rows), same)}, {conflicts} changed by both to different values")
    return int(bool(rows))


_WHO = {
    "a": "A changed it",
    "b": "B changed it",
    "both": "both changed it alike",
    "conflict": "both changed it",
}
"""Kind of a row of three sources -> who changed it."""


def _side(options: Options, text: str) -> tuple[ParameterFile, str | None]:
    """Return a side of a comparison, with the digest of its image where it is a control's."""
    from amp_studio.transfer.links import is_endpoint

    if not is_endpoint(text):
        return opened(Path(text), options).file, None
    from amp_studio import connect

    control = connect(text, progress=progress())
    return control.upload().file, control.sha256
