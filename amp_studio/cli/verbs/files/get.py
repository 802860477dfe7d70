"""Values with unit, default, and whether changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, PATH, SECRETS, TEXT
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address, ResolvedAddress

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "params",
        nargs="*",
        metavar="PARAM",
        help="numbers or ids of parameters",
        completes=candidates.parameters,
    ),
    VerbArgument("--all", action="store_true", help="also what is hidden or not set"),
    VerbArgument("--changed", action="store_true", help="only values that are not the printed default"),
    VerbArgument(
        "--axes-differ", action="store_true", help="only parameters whose axes have different values"
    ),
    VerbArgument("--with-findings", action="store_true", help="only values that cause a finding"),
    VerbArgument(
        "--since-download", action="store_true", help="only what is not as in the last recorded download"
    ),
    VerbArgument("--restart", action="store_true", help="only values that take effect after a restart"),
    VerbArgument("--with-notes", action="store_true", help="only values with a note"),
    VerbArgument(
        "--not-set",
        action="store_true",
        help="only active values that are not set, step by step of the guide",
    ),
    JSON,
    SECRETS,
    *TEXT,
    sections=("PARAM",),
    examples=(
        "amp-studio get MILL_1394.amp 1300 home.calibration@Y",
        "amp-studio get MILL_1394.amp --all --json",
        "amp-studio get MILL_1394.amp --changed --axes-differ",
        "amp-studio get MILL_1394.amp --not-set",
    ),
)


def _print_not_set(options: Options, machine: MachineParameters, only: set[Address] | None) -> int:
    """Print the active values that are not set, those of the first step first; ``only`` these addresses,
    where given.
    """
    from amp_studio.guide import progress
    from amp_studio.schema import ResolvedAddress

    file, validator, rows = machine.file, machine.validator(), []
    for each in progress(validator, validator.run()).steps:
        found = each.open if only is None else tuple(filter(only.__contains__, each.open))
        values = (machine.row(ResolvedAddress(address), secrets=options.secrets) for address in found)
        rows += [value | {"step": each.step.number} for value in values]
        if found and not options.json:
            print(f"Step {each.step.number}: {each.step.title}")
            print("\n".join(_not_set_line(file, address) for address in found))
    if options.json:
        print_json({"values": rows})
    elif not rows:
        print("Every active value is set.")
    return 0


def _not_set_line(file: ParameterFile, address: Address) -> str:
    """Return name and unit of a value that is not set."""
    from amp_studio.schema import unit_text

    unit = file.evaluation.unit(address, file.header.units)
    return f"  {file.machine_schema.named(address):50} not set" + (f" (in {unit_text(unit)})" if unit else "")


def _values_asked_for(options: Options, file: ParameterFile) -> list[ResolvedAddress]:
    """Return the values of the named parameters; else those of the file that exist, or all there are."""
    from amp_studio.schema import ResolvedAddress, resolve_all

    if options.params:
        return [m for p in options.params for m in resolve_all(file.evaluation, p)]
    if options.all:
        return list(map(ResolvedAddress, file.addresses()))
    state = file.evaluation.state
    # What is hidden does not exist in this configuration; --all prints it.
    return [ResolvedAddress(a) for a in file.addresses() if a in file.values and state(a).state != "hidden"]


def run(options: Options) -> int:
    """Print values."""
    from amp_studio.cli.files.marked import marks_asked, with_marks

    machine = opened(options.path, options)
    file = machine.file
    found = _values_asked_for(options, file)
    if options.not_set:
        return _print_not_set(options, machine, {m.address for m in found} if options.params else None)
    if marks := marks_asked(options):
        found = with_marks(machine, options.path, found, marks)
    # Each remark once: a number that is several words has the same for each.
    for message in filter(None, dict.fromkeys(m.remark(file.schema) for m in found)):
        print_remark(message)
    rows = [machine.row(each, secrets=options.secrets) for each in found]
    if options.json:
        print_json({"values": rows})
        return 0
    for each, row in zip(found, rows, strict=True):
        print(_line(file, each, row, secrets=options.secrets))
    return 0


def _line(file: ParameterFile, each: ResolvedAddress, row: Mapping[str, Any], *, secrets: bool) -> str:
    """Return the line of one value, or of one bit of a word."""
    from amp_studio.report import state_name
    from amp_studio.schema import real_value, show_value, unit_text

    address = each.address
    if each.bit is not None:
        value = "not set" if row["value"] is None else row["value"]
        return f"{row['param']} {row['label']:40} {value}"
    parameter, entered = file.schema.parameters[address[0]], file.get(address)
    text = show_value(parameter, entered, secrets=secrets)
    # So that who sets it next knows in which unit a bare number would be read.
    if entered is None and row["unit"]:
        text += f" (in {unit_text(row['unit'])})"
    real = real_value(file.evaluation, address, entered)
    text += f" = {show_value(parameter, real)}" if real else ""
    text += f" ({row['labels']})" if "labels" in row else ""
    text += "" if row["default"] else " *"
    text += "" if row["state"] == "in-force" else f"  (inactive: {state_name(row['state'])})"
    return f"{file.machine_schema.named(address):52} {text}"
