"""Differences between files, printed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from amp_studio.cli.console import print_remark

if TYPE_CHECKING:
    from amp_studio.files import Comparison, Difference, Merge, ParameterFile, Row
    from amp_studio.schema import Value


def matched_by_letter_noted(b: ParameterFile, a: ParameterFile) -> ParameterFile:
    """Return B with its axes at the numbers that their letters have in A; which moved is a remark."""
    from amp_studio.files import matched_by_letter

    matched = matched_by_letter(b, a)
    for letter, number, place in matched.moved:
        print_remark(f"axis {letter} is axis {number} in B; it is compared as axis {place}")
    for letter in matched.left_out:
        print_remark(f"axis {letter} of B is not compared: A has no free axis for it")
    return matched.file


def named(file: ParameterFile, row: Row) -> str:
    """Return what a row is about for a person: ``1300 Home Calibration``, or the name of an entry."""
    return file.machine_schema.named(row.address) if row.id.part == "value" else row.id.key


def value_text(file: ParameterFile, row: Row, value: Value | None, secrets: bool) -> str:
    """Return a value of a row for a person."""
    from amp_studio.schema import show_value

    return show_value(file.schema.parameters[row.address[0]], value, secrets=secrets)


def row_json(merge: Merge, row: Row, secrets: bool) -> dict[str, Any]:
    """Return a row of three sources; null is not set, a mask is a secret that is."""
    from amp_studio.files import Difference

    found = difference_json(merge.a, Difference(row.address, row.a, row.b), secrets)
    # By the same function as the two sides: a secret of the base is masked like theirs.
    base = difference_json(merge.a, Difference(row.address, row.base, None), secrets)["a"]
    return found | {"base": base, "kind": row.kind}


def difference_json(file: ParameterFile, difference: Difference, secrets: bool) -> dict[str, Any]:
    """Return a difference as ``diff --json`` gives it; null is not set, a mask is a secret that is."""
    from amp_studio.schema import MASKED, write_value

    address = difference.address
    parameter = file.schema.parameters[address[0]]
    masked = parameter.secret and not secrets
    a, b = (
        None if v is None else MASKED if masked else write_value(parameter, v)
        for v in (difference.a, difference.b)
    )
    found = {
        "param": file.machine_schema.short(address),
        "id": address[0],
        "instance": address[1],
        "a": a,
        "b": b,
    }
    return found | ({"secret": True} if parameter.secret else {})


def print_comparison(
    file: ParameterFile,
    comparison: Comparison,
    secrets: bool,
    other: tuple[ParameterFile, Sequence[Difference]] | None = None,
) -> None:
    """Print each difference and how many there are, and print what the manual calls dangerous about them.

    ``file`` is one of the two sides, ``other`` is the second side with what only its schema has.
    """
    for difference in comparison.differences:
        print_difference(file, difference, secrets)
    second, of_second = other or (file, ())
    for difference in of_second:
        print_difference(second, difference, secrets)
    # What the manual warns of is printed where a value changes, not where both machines agree.
    if comparison.differences or of_second:
        _print_dangers((file, comparison.differences), (second, of_second))
    more = len(of_second)
    print(
        f"{how_many(len(comparison.differences) + more, comparison.same)},"
        f" {comparison.not_set_in_a + more} not set in A, {comparison.not_set_in_b} not set in B"
    )


def how_many(differ: int, same: int) -> str:
    """Return how many values differ and are the same, in words."""
    return (
        f"{differ} {'differs' if differ == 1 else 'differ'}, {same} {'is' if same == 1 else 'are'} the same"
    )


def _print_dangers(*sides: tuple[ParameterFile, Sequence[Difference]]) -> None:
    """Print what the manual calls dangerous about values that differ, one line each."""
    from amp_studio.report import dangers_of_change

    for file, differences in sides:
        for danger in dangers_of_change(file, differences):
            print_remark(f"danger: {danger.line}")


def print_difference(file: ParameterFile, difference: Difference, secrets: bool) -> None:
    """Print one difference."""
    from amp_studio.schema import show_value

    parameter = file.schema.parameters[difference.address[0]]
    sides = (show_value(parameter, v, secrets=secrets) for v in difference.in_one_unit())
    print(f"{file.machine_schema.named(difference.address):52} {'  |  '.join(sides)}")
