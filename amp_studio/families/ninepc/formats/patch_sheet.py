"""The sheet for keying values in at the control: its number, what it stores, in the control's own unit.

Lines are ``number``, ``stored value``, ``unit`` and ``name`` between tabs; what comes after ``#`` is for the
reader, but for ``# machine``, which decides what the numbers mean. Only values that the control lets one key
in are in it; a choice without a printed code is a remark.
"""

from __future__ import annotations

import re

from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import (
    Address,
    InvalidValueError,
    Schema,
    UnitError,
    UnknownParameterError,
    Value,
    angular,
    checked,
    dimension,
    quoted,
    read_number,
    show_value,
    stored_number,
    unit_named,
    value_of_stored,
    write_number,
)

_HEAD = "# Patch sheet"


def _recognises(text: str) -> bool:
    return text.startswith(_HEAD)


def _line(file: ParameterFile, address: Address, value: Value) -> str:
    """Return the line of a value; a remark for one of which no code is printed."""
    parameter = file.schema.parameters[address[0]]
    number = file.machine_schema.number(address) or ""
    name = f"{parameter.name} {file.machine_schema.instance_label(address)}".rstrip()
    turns = file.evaluation.turns(address)
    stored = stored_number(parameter, value, turns=turns)
    if stored is None:
        return f"# {number}\t{show_value(parameter, value)}: no code is printed\t\t{name}"
    unit = (parameter.storage.unit if parameter.storage else None) or ""
    return f"{number}\t{write_number(stored)}\t{angular(unit) if turns else unit}\t{name}"


def _write(file: ParameterFile) -> str:
    """Return the sheet of a file."""
    lines = [
        f"{_HEAD} of {file.header.name or 'a machine'}, {file.schema.family.name}",
        f"# machine {file.machine}",
        "# number\tvalue\tunit\tname",
    ]
    for address in file.addresses():
        parameter, value = file.schema.parameters[address[0]], file.get(address)
        if value is not None and parameter.patchable and file.evaluation.state(address).state != "hidden":
            lines.append(_line(file, address, value))
    for key, text in file.unknown.items():
        if key.isdecimal():  # a number that was kept from such a sheet
            figure, _, named = text.partition(" ")
            lines.append(f"{key}\t{figure}\t{named}\t")
    return "\n".join(lines) + "\n"


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return the values of a sheet; raises FormatError with line and column."""
    machine = _machine_of(text, schema)
    found = TextRead(machine=machine)
    # A number means what it means on the machine of the sheet: it is looked up in a file of that type.
    file = ParameterFile(schema)
    if schema.family.machine_parameter:
        file.set((schema.family.machine_parameter, ""), Value(machine))
    for n, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        number, *cells = line.split("\t")
        if not cells:
            raise FormatError("a line is number, value, unit and name, with tabs between them", n)
        try:
            address = file.find(number)
        except UnknownParameterError as error:
            if not options.keep_unknown:
                raise FormatError(str(error), n, 1) from None
            _keep(found, number.strip(), cells, n)
            continue
        if not schema.parameters[address[0]].patchable:
            raise FormatError(f"{number} cannot be keyed in at the control", n, 1)
        if address in found.values:
            raise FormatError(f"{number} occurs twice", n, 1)
        found.values[address] = _value(file, address, cells, n, len(number) + 2)
        found.value_lines[address] = n
    return found


def _machine_of(text: str, schema: Schema) -> str:
    """Return the machine type that a sheet names; raises FormatError."""
    named = re.search(r"^# machine (\S+)$", text, re.MULTILINE)
    machine = named[1] if named else schema.family.default_machine
    if machine not in schema.machines:
        raise FormatError(f"{schema.family.name} has no machine type {quoted(machine)}")
    return machine


def _keep(result: TextRead, number: str, cells: list[str], line: int) -> None:
    """Keep a number that the family does not have, with its value and unit."""
    if number in result.unknown:
        raise FormatError(f"{quoted(number)} occurs twice", line, 1)
    result.unknown[number] = " ".join(cell for cell in cells[:2] if cell)
    result.unknown_lines[number] = line


def _value(file: ParameterFile, address: tuple[str, str], cells: list[str], line: int, column: int) -> Value:
    """Return what a stored figure means, in the unit beside it; raises FormatError."""
    parameter = file.schema.parameters[address[0]]
    try:
        number, rest = read_number(cells[0])
        if rest.strip():
            raise InvalidValueError(f"{quoted(cells[0])} is no plain number")
        value = checked(parameter, value_of_stored(parameter, number, turns=file.evaluation.turns(address)))
    except InvalidValueError as error:
        raise FormatError(str(error), line, column) from None
    if parameter.choices or len(cells) < 2 or not cells[1].strip():
        return value
    try:
        unit = unit_named(cells[1])
    except (InvalidValueError, UnitError) as error:
        raise FormatError(str(error), line, column + len(cells[0]) + 1) from None
    if dimension(unit) not in (dimension(value.unit), dimension(angular(value.unit))):
        message = f"{parameter.name} is stored in {value.unit or 'a bare number'}, not in {unit}"
        raise FormatError(message, line, column + len(cells[0]) + 1)
    return Value(value.value, unit)


FORMAT = TextFormat("patch", "patch sheet", ".patch", _recognises, _read, _write)
