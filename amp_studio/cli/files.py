"""Verbs that make, change, read, compare and merge parameter files."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from amp_studio.files import (
    Comparison,
    Difference,
    Document,
    ParameterFile,
    RangeError,
    compare,
    merge,
    new_file,
    open_file,
)
from amp_studio.files.by_schema import by_schema
from amp_studio.files.lock import now
from amp_studio.report.wording import counted, state_name
from amp_studio.schema import (
    MASKED,
    Address,
    Meant,
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
from amp_studio.schema.storage import stored_number

from .console import assignments, family, note, print_json, progress
from .errors import UsageError
from .output import check_new, note_all, write_new

NOT_SET = "not-set"
"""The value of an assignment that clears a parameter."""


def new_verb(options: argparse.Namespace) -> int:
    """Make a parameter file with the family's defaults."""
    schema = family(options.family)
    axes = [a.strip() for a in options.axes.split(",")] if options.axes else []
    file = new_file(options.family, options.machine, axes, options.path.stem)
    check_new(options.path, "a new file")
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
                value = None if _clears(text) else trial.read(address, text)
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


def _row(file: ParameterFile, address: Address, secrets: bool) -> dict[str, Any]:
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
    } | ({"secret": True, "set": value is not None} if parameter.secret else {}) | _real(file, address)  # fmt: skip


def _real(file: ParameterFile, address: Address) -> dict[str, Any]:
    """Return what a value in internal units is in mm or degrees."""
    real = real_value(file.evaluation, address, file.get(address))
    return {} if real is None else {"real": {"value": real.value, "unit": real.unit}}


def get_verb(options: argparse.Namespace) -> int:
    """Print values."""
    file = open_file(options.path).file
    if options.params:
        found = [m for p in options.params for m in all_meant(file.evaluation, p)]
    else:
        found = [Meant(a) for a in file.addresses()
                 if options.all or (a in file.values and file.evaluation.state(a).state != "hidden")]  # fmt: skip
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
        rows.append(_row(file, address, options.secrets))
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
            print(f"{file.machine_schema.named(address):52} {shown}{mark}{state}")
    if options.json:
        print_json({"values": rows})
    return 0


def diff_verb(options: argparse.Namespace) -> int:
    """Compare two files, or a file and a control; 1 where they differ."""
    (a, a_digest), (b, b_digest) = _side(options.a), _side(options.b)
    if a.schema.family.family != b.schema.family.family:
        raise UsageError(f"{options.a} is for {a.schema.family.name}, {options.b} for {b.schema.family.name}")
    other = by_schema(b, a.schema)
    found = compare(a.schema, a.values, other.values)
    of_b = _of_other_schema(b, other)  # settings that only the control of B has
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
    """Print each difference and how many there are; ``file`` is one of the two sides.

    ``other`` is the second side with what only its schema has.
    """
    for difference in found.differences:
        print_difference(file, difference, secrets)
    second, of_second = other or (file, ())
    for difference in of_second:
        print_difference(second, difference, secrets)
    more = len(of_second)
    print(f"{len(found.differences) + more} differ, {found.same} are the same, {found.not_set_in_a + more} not set in A, "
          f"{found.not_set_in_b} not set in B")  # fmt: skip


def print_difference(file: ParameterFile, difference: Difference, secrets: bool) -> None:
    """Print one difference."""
    parameter = file.schema.parameters[difference.address[0]]
    sides = (show_value(parameter, v, secrets=secrets) for v in difference.in_one_unit())
    print(f"{file.machine_schema.named(difference.address):52} {'  |  '.join(sides)}")


def _side(text: str) -> tuple[ParameterFile, str | None]:
    """Return a side of a comparison, with the digest of its image where it is a control's."""
    from amp_studio.transfer.links.endpoint import is_endpoint

    if not is_endpoint(text):
        return open_file(Path(text)).file, None
    from amp_studio.transfer.client.parameters import fetch_image, sha256
    from amp_studio.transfer.content import decode_content

    image = fetch_image(text, progress())
    return decode_content(image), sha256(image)


def merge_verb(options: argparse.Namespace) -> int:
    """Merge three files by parameter; 1 where there are conflicts."""
    check_new(options.output, "a merge", options.base, options.ours, options.theirs)
    base, ours, theirs = (open_file(p).file for p in (options.base, options.ours, options.theirs))
    merged, conflicts = merge(base, ours, theirs)
    write_new(merged, options.output)
    for c in conflicts:
        p = base.schema.parameters.get(c.address[0])
        if p is None:  # an entry that the schema does not know
            print(f"conflict at {'@'.join(filter(None, c.address))}: ours is kept")
            continue
        was, mine, wanted = (show_value(p, v, secrets=options.secrets) for v in (c.base, c.ours, c.theirs))
        print(f"conflict at {base.schema.on(ours.machine).named(c.address)}: base {was}, "
              f"ours {mine}, theirs {wanted}; ours is kept")  # fmt: skip
    print(f"{options.output}: {counted(len(conflicts), 'conflict')}")
    return 1 if conflicts else 0
