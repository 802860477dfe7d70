"""Verbs that make, change and read parameter files."""

from __future__ import annotations

import argparse

from amp_studio.files import (
    Document,
    ParameterFile,
    RangeError,
    new_file,
)
from amp_studio.files.lock import now
from amp_studio.machine import bit_row, read_assignments, value_row
from amp_studio.report.wording import counted, state_name
from amp_studio.schema import (
    Address,
    Meant,
    all_meant,
    real_value,
    show_value,
)
from amp_studio.schema import shown as unit_shown

from .console import assignments, family, note, print_json
from .errors import UsageError
from .like import file_like
from .marked import marks_asked, with_marks
from .opened import opened
from .output import check_new, note_all, write_new


def new_verb(options: argparse.Namespace) -> int:
    """Make a parameter file with the family's defaults."""
    schema = family(options.family)
    axes = [a.strip() for a in options.axes.split(",")] if options.axes else []
    check_new(options.path, "a new file")
    if options.like:
        file = file_like(options, axes)
    else:
        file = new_file(options.family, options.machine, axes, options.path.stem)
    write_new(file, options.path)
    print(f"{options.path}: {schema.family.name}, {file.machine}, {counted(len(file.values), 'value')}")
    return 0


def set_verb(options: argparse.Namespace) -> int:
    """Change values, all or none."""
    with Document.open(options.path) as document:
        file = document.file
        notes: list[str] = []
        values = read_assignments(file, assignments(options.assignments), notes.append)
        marks = dict(file.forced)
        try:
            changes = file.set_many(values, force=f"on {now()} by 'set --force'" if options.force else "")
        except RangeError as error:
            raise UsageError(f"{error}; nothing was changed (--force takes it and marks it)") from None
        if changes or file.forced != marks:
            document.save("set --force" if options.force else "set")
        for message in notes:
            note(message)
        note_all(document.notes)
        if not changes:
            note("no change")
        for change in changes:
            parameter = file.schema.parameters[change.address[0]]
            name = file.machine_schema.named(change.address)
            print(f"{name}: {show_value(parameter, change.old)} -> {show_value(parameter, change.new)}")
            state = file.evaluation.state(change.address)
            if not state.is_active:
                note(f"{name} is inactive ({state_name(state.state)}): {state.why}")
    return 0


def _print_not_set(options: argparse.Namespace, file: ParameterFile, only: set[Address] | None) -> int:
    """Print the active values that are not set, those of the first step first; ``only`` these addresses, where given."""
    from amp_studio.guide import progress
    from amp_studio.validate import Validator, rules_beside

    validator, rows = Validator(file, rules_beside(options.path, file.schema)), []
    for each in progress(validator, validator.run()).steps:
        found = [address for address in each.open if only is None or address in only]
        rows += [value_row(file, address, options.secrets) | {"step": each.step.number} for address in found]
        if found and not options.json:
            print(f"Step {each.step.number}: {each.step.title}")
            for address in found:
                unit = file.evaluation.unit(address, file.header.units)
                print(
                    f"  {file.machine_schema.named(address):50} not set"
                    + (f" (in {unit_shown(unit)})" if unit else "")
                )
    if options.json:
        print_json({"values": rows})
    elif not rows:
        print("Every active value is set.")
    return 0


def get_verb(options: argparse.Namespace) -> int:
    """Print values."""
    file = opened(options.path, options)
    if options.params:
        found = [m for p in options.params for m in all_meant(file.evaluation, p)]
    else:
        found = [Meant(a) for a in file.addresses()
                 if options.all or (a in file.values and file.evaluation.state(a).state != "hidden")]  # fmt: skip
    if options.not_set:
        return _print_not_set(options, file, {m.address for m in found} if options.params else None)
    if marks := marks_asked(options):
        found = with_marks(file, options.path, found, marks)
    for message in dict.fromkeys(message for m in found if (message := m.remark(file.schema))):
        note(message)
    rows = []
    for address, bit in ((m.address, m.bit) for m in found):
        if bit is not None:
            rows.append(bit_row(file, address, bit))
            if not options.json:
                shown = "not set" if rows[-1]["value"] is None else rows[-1]["value"]
                print(f"{rows[-1]['param']} {rows[-1]['label']:40} {shown}")
            continue
        rows.append(value_row(file, address, options.secrets))
        if not options.json:
            mark = "" if rows[-1]["default"] else " *"
            state = (
                "" if rows[-1]["state"] == "in-force" else f"  (inactive: {state_name(rows[-1]['state'])})"
            )
            parameter = file.schema.parameters[address[0]]
            shown = show_value(parameter, file.get(address), secrets=options.secrets)
            if file.get(address) is None and rows[-1]["unit"]:
                shown += f" (in {unit_shown(rows[-1]['unit'])})"
            real = real_value(file.evaluation, address, file.get(address))
            shown += f" = {show_value(parameter, real)}" if real else ""
            shown += f" ({rows[-1]['labels']})" if "labels" in rows[-1] else ""
            print(f"{file.machine_schema.named(address):52} {shown}{mark}{state}")
    if options.json:
        print_json({"values": rows})
    return 0
