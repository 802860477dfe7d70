"""Verbs that compare and merge parameter files."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from amp_studio.files import (
    Comparison,
    Difference,
    Merge,
    ParameterFile,
    Row,
    backup_path,
    compare,
    is_there,
)
from amp_studio.files.by_schema import by_schema
from amp_studio.schema import MASKED, Value, show_value, write_value

from .console import note, print_json, progress
from .errors import UsageError
from .opened import opened


def diff_verb(options: argparse.Namespace) -> int:
    """Compare two files, or a file and a control, or a file with another version of itself; 1 where they differ."""
    _check_sides(options)
    a, a_digest = _side(options, options.a)
    b, b_digest, name = _other_side(options, a)
    if a.schema.family.family != b.schema.family.family:
        raise UsageError(f"{options.a} is for {a.schema.family.name}, {name} for {b.schema.family.name}")
    other = by_schema(b, a.schema)
    of_b = _of_other_schema(b, other)  # settings that only the control of B has
    if options.by_letter:
        other = matched_by_letter_noted(other, a)
    if options.base:
        return _print_three(options, Merge(a, other, _side(options, options.base)[0]))
    found = compare(a.schema, a.values, other.values)
    if options.output:
        _write_paper(options, a, found, name, (a_digest, b_digest), (b, of_b))
        return 1 if found.differences or of_b else 0
    if options.json:
        rows = [difference_json(a, d, options.secrets) for d in found.differences]
        rows += [difference_json(b, d, options.secrets) for d in of_b]
        digests = {"sha256": {"a": a_digest, "b": b_digest}} if a_digest or b_digest else {}
        print_json({"differences": rows, "same": found.same} | digests)
        return 1 if rows else 0
    print_comparison(a, found, options.secrets, (b, of_b))
    for digest in filter(None, (a_digest, b_digest)):
        print(f"sha256 {digest}")
    return 1 if found.differences or of_b else 0


def _write_paper(
    options: argparse.Namespace,
    a: ParameterFile,
    found: Comparison,
    name: str,
    digests: tuple[str | None, str | None],
    more: tuple[ParameterFile, list[Difference]],
) -> None:
    from amp_studio.report.differences import differences_paper
    from amp_studio.report.paper import write_paper

    facts = [
        (f"SHA-256 of {side}", digest)
        for side, digest in zip("AB", digests, strict=True)
        if digest is not None
    ]
    write_paper(
        differences_paper(a, found, (options.a, name), facts, more=more, language=options.language),
        options.output,
        notify=note,
    )
    print(options.output)


def _check_sides(options: argparse.Namespace) -> None:
    """Raise UsageError unless there is one other side that A can have."""
    from amp_studio.transfer.links.endpoint import is_endpoint

    named = [options.b, options.axes, options.defaults, options.backup, options.last_download]
    if sum(map(bool, named)) != 1:
        raise UsageError(
            "diff takes one other side: B, or one of --defaults, --backup, --last-download, --axes"
        )
    if (options.backup or options.last_download) and is_endpoint(options.a):
        raise UsageError(f"{options.a} is a control: a backup and a last download belong to a file")
    if options.backup and not is_there(backup_path(Path(options.a))):
        raise UsageError(f"{options.a} has no backup: the first change of it makes one")


def _other_side(options: argparse.Namespace, a: ParameterFile) -> tuple[ParameterFile, str | None, str]:
    """Return the second side of a comparison, the digest of its image where it is a control's, and its name."""
    if options.b:
        return *_side(options, options.b), options.b
    if options.defaults:
        from amp_studio.files.versions import with_defaults

        return with_defaults(a), None, "its defaults"
    if options.axes:
        return _other_axis(a, *options.axes), None, "the other axis"
    if options.backup:
        return *_side(options, str(backup_path(Path(options.a)))), "its backup"
    from amp_studio.transfer.client.last_download import last_download

    last = last_download(a, Path(options.a))
    note(f"last download: {last.when} to {last.control}")
    return last.file, None, "its last download"


def _other_axis(file: ParameterFile, target: str, source: str) -> ParameterFile:
    """Return a file in which the first axis has the values of the second; axes are named by number or letter."""
    from amp_studio.files.axis_match import as_axis, axis_letters

    named = {letter.casefold(): axis for axis, letter in axis_letters(file).items()}
    target, source = (named.get(axis.casefold(), axis) for axis in (target, source))
    return as_axis(file, source, target)


def matched_by_letter_noted(b: ParameterFile, a: ParameterFile) -> ParameterFile:
    """Return B with its axes at the numbers that their letters have in A; which moved is a note."""
    from amp_studio.files.axis_match import matched_by_letter

    matched = matched_by_letter(b, a)
    for letter, number, place in matched.moved:
        note(f"axis {letter} is axis {number} in B; it is compared as axis {place}")
    for letter in matched.left_out:
        note(f"axis {letter} of B is not compared: A has no free axis for it")
    return matched.file


def _print_three(options: argparse.Namespace, merge: Merge) -> int:
    """Print what two sides changed of their base; 1 where anything differs."""
    rows = [row for row in merge.differing if row.id.part == "value"]
    same = sum(row.id.part == "value" for row in merge.rows) - len(rows)
    if options.json:
        print_json({"differences": [row_json(merge, row, options.secrets) for row in rows], "same": same})
        return 1 if rows else 0
    for row in rows:
        base, a, b = (shown(merge.a, row, value, options.secrets) for value in (row.base, row.a, row.b))
        print(f"{named(merge.a, row):52} base {base}  |  A {a}  |  B {b}  ({WHO[row.kind]})")
    conflicts = sum(row.kind == "conflict" for row in rows)
    print(f"{len(rows)} differ, {same} are the same, {conflicts} changed by both to different values")
    return 1 if rows else 0


WHO = {
    "a": "A changed it",
    "b": "B changed it",
    "both": "both changed it alike",
    "conflict": "both changed it",
}
"""Kind of a row of three sources -> who changed it."""


def named(file: ParameterFile, row: Row) -> str:
    """Return what a row is about for a person: ``1300 Home Calibration``, or the name of an entry."""
    return file.machine_schema.named(row.address) if row.id.part == "value" else row.id.key


def shown(file: ParameterFile, row: Row, value: Value | None, secrets: bool) -> str:
    """Return a value of a row for a person."""
    return show_value(file.schema.parameters[row.address[0]], value, secrets=secrets)


def row_json(merge: Merge, row: Row, secrets: bool) -> dict[str, Any]:
    """Return a row of three sources; null is not set, a mask is a secret that is."""
    found = difference_json(merge.a, Difference(row.address, row.a, row.b), secrets)
    base = difference_json(merge.a, Difference(row.address, row.base, None), secrets)["a"]
    return found | {"base": base, "kind": row.kind}


def _of_other_schema(b: ParameterFile, by_a: ParameterFile) -> list[Difference]:
    """Return the values of a file that it does not have by another schema."""
    return [Difference(a, None, b.values[a]) for a in b.values if a not in by_a.values]


def difference_json(file: ParameterFile, difference: Difference, secrets: bool) -> dict[str, Any]:
    """Return a difference as ``diff --json`` gives it; null is not set, a mask is a secret that is."""
    address = difference.address
    parameter = file.schema.parameters[address[0]]
    masked = parameter.secret and not secrets
    a, b = (
        None if v is None else MASKED if masked else write_value(parameter, v)
        for v in (difference.a, difference.b)
    )
    found = {"param": file.machine_schema.short(address), "id": address[0], "instance": address[1],
             "a": a, "b": b}  # fmt: skip
    return found | ({"secret": True} if parameter.secret else {})


def print_comparison(
    file: ParameterFile, found: Comparison, secrets: bool,
    other: tuple[ParameterFile, Sequence[Difference]] | None = None,
) -> None:  # fmt: skip
    """Print each difference and how many there are, and note what the manual calls dangerous about them.

    ``file`` is one of the two sides, ``other`` is the second side with what only its schema has.
    """
    for difference in found.differences:
        print_difference(file, difference, secrets)
    second, of_second = other or (file, ())
    for difference in of_second:
        print_difference(second, difference, secrets)
    if found.differences or of_second:
        _note_dangers((file, found.differences), (second, of_second))
    more = len(of_second)
    print(f"{len(found.differences) + more} differ, {found.same} are the same, {found.not_set_in_a + more} not set in A, "
          f"{found.not_set_in_b} not set in B")  # fmt: skip


def _note_dangers(*sides: tuple[ParameterFile, Sequence[Difference]]) -> None:
    """Note what the manual calls dangerous about values that differ, one line each."""
    from amp_studio.report import dangers_of_change

    for file, differences in sides:
        for danger in dangers_of_change(file, differences):
            note(f"danger: {danger.line}")


def print_difference(file: ParameterFile, difference: Difference, secrets: bool) -> None:
    """Print one difference."""
    parameter = file.schema.parameters[difference.address[0]]
    sides = (show_value(parameter, v, secrets=secrets) for v in difference.in_one_unit())
    print(f"{file.machine_schema.named(difference.address):52} {'  |  '.join(sides)}")


def _side(options: argparse.Namespace, text: str) -> tuple[ParameterFile, str | None]:
    """Return a side of a comparison, with the digest of its image where it is a control's."""
    from amp_studio.transfer.links.endpoint import is_endpoint

    if not is_endpoint(text):
        return opened(Path(text), options), None
    from amp_studio.transfer.client.parameters import fetch_image, sha256
    from amp_studio.transfer.content import decode_content
    from amp_studio.transfer.exchange import Exchange

    image = fetch_image(text, Exchange(progress()))
    return decode_content(image), sha256(image)
