"""Verbs that make, change and read parameter files."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from amp_studio.files import (
    Document,
    ParameterFile,
    RangeError,
    new_file,
)
from amp_studio.files.lock import now
from amp_studio.report.wording import counted, state_name
from amp_studio.schema import (
    Address,
    Meant,
    Parameter,
    UnknownParameterError,
    Value,
    all_meant,
    fault,
    field_at,
    field_value,
    meant,
    real_value,
    show_value,
    with_field,
    write_value,
)
from amp_studio.schema import shown as unit_shown
from amp_studio.schema.bit_fields import labels_of_word
from amp_studio.schema.storage import stored_number
from amp_studio.validate.cell_expression import enter

from .console import assignments, family, note, print_json
from .errors import UsageError
from .like import file_like
from .marked import marks_asked, with_marks
from .opened import opened
from .output import check_new, note_all, write_new

NOT_SET = "not-set"
"""The value of an assignment that clears a parameter."""


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
        values, marks = wanted(file, options.assignments, notes.append), dict(file.forced)
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


def wanted(
    file: ParameterFile, texts: Sequence[str], notify: Callable[[str], object] = note
) -> dict[Address, Value | None]:
    """Read assignments in order, each in the light of those before it; the file itself is not changed.

    Raises UsageError that names everything that cannot be set. ``notify`` is called with which parameter a number means
    that is printed for several. A value is cleared by ``NOT_SET`` only: an empty text may be a variable without a value.
    """
    trial = file.copy()
    found: dict[Address, Value | None] = {}
    slips: list[str] = []
    for param, text in assignments(texts):
        try:
            found_here = meant(trial.evaluation, param)
            address, bit = found_here.address, found_here.bit
            if not text:
                raise ValueError(
                    f"no value is given ({param}={NOT_SET} clears it)" if bit is None else "no value is given"
                )
            if bit is not None:
                value: Value | None = _with_bit(trial, address, bit, text)
            else:
                value = None if _clears(text) else _entered(trial, address, text)
                if address in found and found[address] != value:
                    raise ValueError("it is given two values")
            found[address] = value
        except UnknownParameterError as error:
            slips.append(str(error))
            continue
        except ValueError as error:
            slips.append(f"{param}: {error}")
            continue
        if message := found_here.remark(trial.schema):
            notify(message)
        trial.set(address, found[address])
    if slips:
        faults = ((a, fault(trial.evaluation, a, v)) for a, v in found.items() if v is not None)
        slips += [f"{trial.machine_schema.short(a)}: {bad}" for a, bad in faults if bad]
        raise UsageError("; ".join(slips))
    return found


def _entered(file: ParameterFile, address: Address, text: str) -> Value | None:
    """Read a value, or an expression behind ``=``; raises InvalidValueError.

    Nobody sees the result before it is set, so that what only looks like one (``10-5``) is none.
    """
    if not text.lstrip().startswith("="):
        return file.read(address, text)
    return enter(file, address, text, lambda a: file.evaluation.unit(a, file.header.units)).value


def _clears(text: str) -> bool:
    """Return whether a text is ``NOT_SET``, also as ``get`` prints it: not set."""
    return "-".join(text.casefold().split()) == NOT_SET


def _with_bit(file: ParameterFile, address: Address, bit: int, text: str) -> Value:
    """Return the value of a word of bits with one field changed; a word that is not set counts as its default, or 0."""
    field = field_at(file.schema.parameters[address[0]], bit)
    word = file.get(address) or file.default(address) or Value(0)
    return Value(with_field(field, int(word.value), text), word.unit)


def _bit_row(file: ParameterFile, address: Address, bit: int) -> dict[str, Any]:
    """Return one field of a word of bits as ``get`` shows it."""
    field = field_at(file.schema.parameters[address[0]], bit)
    words = (file.get(address), file.default(address))
    word, default = (None if v is None else field_value(field, int(v.value)) for v in words)
    labels = {c.raw: c.label for c in field.choices or ()}
    return {"param": f"{file.machine_schema.short(address)}.{bit}", "id": address[0], "instance": address[1],
            "bit": bit, "label": field.label, "value": labels.get(word, word), "unit": "", "raw": word,
            "default": word == default, "state": file.evaluation.state(address).state,
            "forced": address in file.forced}  # fmt: skip


def value_row(file: ParameterFile, address: Address, secrets: bool) -> dict[str, Any]:
    """Return a value as ``get --json`` gives it; a secret that is set has neither value nor raw unless asked for."""
    parameter, value = file.schema.parameters[address[0]], file.get(address)
    masked = parameter.secret and not secrets
    plain = None if value is None or masked else value.value
    if isinstance(plain, (str, bool)):
        plain = write_value(parameter, value)
    raw = None
    if value is not None and not masked:
        raw = stored_number(parameter, value, turns=file.evaluation.turns(address))
    return {
        "param": file.machine_schema.short(address), "id": address[0], "instance": address[1],
        "value": plain, "unit": value.unit if value else file.evaluation.unit(address, file.header.units), "raw": raw,
        "default": file.is_default(address), "state": file.evaluation.state(address).state,
        "forced": address in file.forced,
    } | _labels(parameter, value) | ({"secret": True, "set": value is not None} if parameter.secret else {}) | _real(file, address)  # fmt: skip


def _labels(parameter: Parameter, value: Value | None) -> dict[str, str]:
    """Return what is set in a word of bits by its labels."""
    if not parameter.bits or value is None or not isinstance(value.value, int):
        return {}
    return {"labels": labels_of_word(parameter, value.value)}


def _real(file: ParameterFile, address: Address) -> dict[str, Any]:
    """Return what a value in internal units is in mm or degrees."""
    real = real_value(file.evaluation, address, file.get(address))
    return {} if real is None else {"real": {"value": real.value, "unit": real.unit}}


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
    file = opened(options.path)
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
            rows.append(_bit_row(file, address, bit))
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
