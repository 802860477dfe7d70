"""List, compare, name, copy, swap, add and remove axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import JSON, PATH, SECRETS
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import print_remarks
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import AxisDifference, Change, ParameterFile

_OPERATIONS = {
    "list": (0, 0),
    "compare": (2, 2),
    "copy": (2, 2),
    "swap": (2, 2),
    "name": (2, 2),
    "type": (2, 2),
    "add": (1, 2),
    "remove": (1, 1),
}
"""Operation -> the fewest and the most arguments it takes."""


VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "operation",
        nargs="?",
        choices=tuple(_OPERATIONS),
        default="list",
        help="compare A B, copy FROM TO, swap A B, name A LETTER, type A TYPE, add LETTER [PLACE], remove A",
    ),
    VerbArgument(
        "arguments",
        nargs="*",
        metavar="ARGUMENT",
        help="an axis by itself or by its letter, a letter, a type",
    ),
    JSON,
    SECRETS,
    writes=("path",),
    examples=(
        "amp-studio axis MILL_1394.amp",
        "amp-studio axis MILL_1394.amp copy X Y",
        "amp-studio axis MILL_1394.amp add C 3",
    ),
)


def run(options: Options) -> int:
    """List, compare or change the axes of a file; 1 where two axes differ."""
    from amp_studio import edit

    least, most = _OPERATIONS[options.operation]
    if not least <= len(options.arguments) <= most:
        raise UsageError(f"axis {options.operation} takes {_expected(least, most)}: amp-studio axis --help")
    # Without a lock: a file that the window is editing can be listed.
    if options.operation in ("list", "compare"):
        file = opened(options.path).file
        if options.operation == "list":
            return _list(file, as_json=options.json)
        first, second = (_axis(file, text) for text in options.arguments)
        return _compare(file, first, second, options)
    with edit(options.path) as machine:
        file = machine.file
        changes = _change(file, options.operation, options.arguments)
        if changes:
            machine.save(verb=f"axis {options.operation}")
        print_remarks(machine.notes)
        _print_changes(file, changes, options)
    return 0


def _expected(least: int, most: int) -> str:
    from amp_studio.report import counted

    if most == 0:
        return "no argument"
    return counted(least, "argument") if least == most else f"{least} or {most} arguments"


def _axis(file: ParameterFile, text: str) -> str:
    """Return the axis that is named by itself or by its letter; raises UnknownParameterError."""
    from amp_studio.files import axis_instances
    from amp_studio.schema import resolve_axis

    return resolve_axis(file.evaluation, axis_instances(file), text)


def _change(file: ParameterFile, operation: str, arguments: Sequence[str]) -> list[Change]:
    """Do an operation, all or nothing, and return what it changed; raises AxisError."""
    from amp_studio.files import (
        add_axis,
        axis_profile,
        copy_axis,
        delete_axis,
        rename_axis,
        retype_axis,
        swap_axes,
    )

    if operation == "add":
        return add_axis(file, *arguments)
    if operation == "remove":
        return delete_axis(file, _axis(file, arguments[0]))
    first = _axis(file, arguments[0])
    if operation == "name":
        return rename_axis(file, first, arguments[1])
    if operation == "type":
        address = (axis_profile(file).type, first)
        # Read as a value of that parameter: its label, letter and code all name the type.
        return retype_axis(file, first, str(file.read(address, arguments[1]).value))
    act: Callable[[ParameterFile, str, str], list[Change]] = copy_axis if operation == "copy" else swap_axes
    return act(file, first, _axis(file, arguments[1]))


def _print_changes(file: ParameterFile, changes: Sequence[Change], options: Options) -> None:
    """Print each value that is another one now; one that was changed and changed back is none."""
    from amp_studio.schema import show_value

    after = {change.address: change.new for change in changes}
    # Backwards: an operation may change a value twice, and what it was before the first time counts.
    before = {change.address: change.old for change in reversed(changes)}
    changed = []
    for address, last in after.items():
        parameter = file.schema.parameters[address[0]]
        old, new = (show_value(parameter, v, secrets=options.secrets) for v in (before[address], last))
        if old != new:
            changed.append((address, old, new))
    if options.json:
        short = file.machine_schema.short
        entries = [{"param": short(address), "old": old, "new": new} for address, old, new in changed]
        print_json({"changes": entries, "axes": _axes_json(file)})
        return
    for address, old, new in changed:
        print(f"{file.machine_schema.named(address)}: {old} -> {new}")
    if not changed:
        print_remark("no change")


def _axes_json(file: ParameterFile) -> list[dict[str, object]]:
    """Return the fitted axes as ``--json`` lists them."""
    from amp_studio.files import axis_kind, axis_letter, fitted_axes
    from amp_studio.schema import axis_group

    return [
        {
            "axis": a,
            "name": axis_letter(file, a) or None,
            "type": axis_kind(file, a) or None,
            "group": axis_group(file.evaluation, a) or None,
        }
        for a in fitted_axes(file)
    ]


def _list(file: ParameterFile, *, as_json: bool) -> int:
    """Print the fitted axes."""
    from amp_studio.files import axis_instances, axis_title, fitted_axes

    instances = axis_instances(file)
    if as_json:
        print_json({"axes": _axes_json(file), "most": len(instances)})
        return 0
    for axis in fitted_axes(file):
        print(axis_title(file, axis))
    print(f"{len(fitted_axes(file))} of {len(instances)} axes")
    return 0


def _compare(file: ParameterFile, first: str, second: str, options: Options) -> int:
    """Print what differs between two axes; 1 where anything does."""
    from amp_studio.files import axis_title, compare_axes

    found = compare_axes(file, first, second)
    rows = [_row(file, each, options.secrets) for each in found]
    if options.json:
        print_json({"differences": [{"param": p, "a": a, "b": b} for p, _, a, b in rows]})
    else:
        for _, name, a, b in rows:
            print(f"{name:52} {a}  |  {b}")
        print(f"{axis_title(file, first)} and {axis_title(file, second)}: {len(rows)} differ")
    return 1 if rows else 0


def _row(file: ParameterFile, difference: AxisDifference, secrets: bool) -> tuple[str, str, str, str]:
    """Return parameter, name and both values of a difference."""
    from amp_studio.schema import MASKED, show_value

    parameter, here = file.schema.parameters[difference.first[0]], file.machine_schema
    # Both axes are bits of one word: the word is the same value for both, so the bits are compared.
    if difference.bits is not None:
        value = file.get(difference.first)
        word = int(float(value.value)) if value else 0
        a, b = ("yes" if word >> bit & 1 else "no" for bit in difference.bits)
        return f"{here.short(difference.first)}.{difference.bits[0]}", parameter.name, a, b
    masked = parameter.secret and not secrets
    write = (lambda _, v: MASKED if v else "not set") if masked else show_value
    sides = [write(parameter, file.get(a)) for a in (difference.first, difference.second)]
    return here.short(difference.first), here.named(difference.first), sides[0], sides[1]
