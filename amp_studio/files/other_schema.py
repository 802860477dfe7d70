"""A file by another schema of its family: controls that describe themselves have schemas of their own."""

from __future__ import annotations

from amp_studio.schema import (
    Address,
    InvalidValueError,
    Parameter,
    Schema,
    StorageError,
    Value,
    checked,
    choice_of,
    code_of,
    write_value,
    written,
)

from .parameter_file import Header, ParameterFile


def by_schema(file: ParameterFile, schema: Schema) -> ParameterFile:
    """Return a file as another schema of its family has it; itself if it has that schema already.

    What that schema does not have, or has with another type, becomes an entry that it does not know.
    """
    if file.schema is schema:
        return file
    header = {**vars(file.header), "extra": dict(file.header.extra), "signature": schema.signature}
    machine = file.machine if file.machine in schema.machines else schema.family.default_machine
    found = ParameterFile(schema, Header(**{**header, "machine": machine}))
    found.unknown.update(file.unknown)
    for address, value in file.values.items():
        parameter = file.schema.parameters[address[0]]
        other = _value(parameter, _parameter_at(found, address), value)
        if other is None:
            found.unknown[written(address)] = write_value(parameter, value)
        else:
            found.take({address: other})
    return found


def _parameter_at(found: ParameterFile, address: Address) -> Parameter | None:
    parameter = found.schema.parameters.get(address[0])
    is_there = parameter is not None and address[1] in found.machine_schema.instances(parameter)
    return parameter if is_there else None


def _value(parameter: Parameter, other: Parameter | None, value: Value) -> Value | None:
    """Return the same value of another parameter; None where it has none."""
    if other is None or other.type != parameter.type:
        return None
    try:
        if not parameter.choices:
            return checked(other, value)
        try:
            return choice_of(other, code_of(parameter, value))
        except StorageError:  # no code is printed: by what it is called
            return checked(other, value)
    except InvalidValueError:
        return None
