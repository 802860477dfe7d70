"""The control image: a parameter file as the line carries it and the control keeps it.

UTF-8 text, one record a line, so that two images can be compared byte for
byte. ``docs/protocols/image.md`` specifies it. Numbers travel with the unit
they were entered in; choices as the code the control stores, where one is
printed, else as their key.
"""

from __future__ import annotations

import re

from amp_studio.files import Header, ParameterFile
from amp_studio.schema import (
    Address,
    Parameter,
    UnknownParameter,
    Value,
    ValueFault,
    angular,
    load_schema,
    read_address,
    write_number,
    written,
)
from amp_studio.schema.units import UNITS
from amp_studio.schema.values import read_number

MAGIC = "AMP-IMAGE 1"


class ImageFault(ValueError):
    """Bytes that are not a whole control image; one clear sentence."""


class PatchFault(ValueError):
    """A value that cannot be keyed in at the control; one clear sentence."""


def encode_image(file: ParameterFile) -> bytes:
    """Return the image of a file: every value that is set, in the manual's order."""
    schema, machine = file.schema, file.machine
    lines = [MAGIC, f"family {schema.family.family}", f"signature {schema.signature}", f"machine {machine}",
             f"application {file.header.application}", f"revision {file.header.revision}"]  # fmt: skip
    order = {a: n for n, a in enumerate(file.addresses())}
    values = sorted((a for a in file.values if a in order), key=order.__getitem__)
    for address in values:
        number = schema.number(address, machine)
        shown = "-" if number is None or schema.is_disputed(address[0], machine) else number
        lines.append(
            f"{shown}\t{written(address)}\t{_field(schema.parameters[address[0]], file.values[address])}"
        )
    lines.append(f"end {len(values)}")
    return ("\n".join(lines) + "\n").encode("utf-8")


def decode_image(image: bytes) -> ParameterFile:
    """Return the file an image holds; raises ImageFault when it is cut off or of another schema."""
    head, records = _split(image)
    try:
        schema = load_schema(head["family"])
    except KeyError:
        raise ImageFault(
            f"the control image is for the family '{head['family']}', which is not known here"
        ) from None
    if head["signature"] != schema.signature:
        raise ImageFault(
            "the control's parameters are numbered by another schema than this program's; nothing was read"
        )
    file = ParameterFile(schema, Header(application=head["application"], revision=head["revision"],
                                        machine="" if schema.family.machine_parameter else head["machine"],
                                        signature=schema.signature))  # fmt: skip
    for entry, field in records:
        address = read_address(entry)
        parameter = schema.parameters.get(address[0])
        if parameter is None:
            raise ImageFault(f"the control image holds {entry}, which the schema does not have")
        file.values[address] = _value(parameter, field)
    file.situation.forget()
    return file


def _split(image: bytes) -> tuple[dict[str, str], list[tuple[str, str]]]:
    try:
        lines = image.decode("utf-8").split("\n")
    except UnicodeDecodeError:
        raise ImageFault("the control image is not text") from None
    if not lines or lines[0] != MAGIC:
        raise ImageFault("this is not a control image")
    if len(lines) < 8 or lines[-1] != "" or not lines[-2].startswith("end "):
        raise ImageFault("the control image has been cut off")
    head = {}
    for line in lines[1:6]:
        key, _, text = line.partition(" ")
        head[key] = text
    missing = {"family", "signature", "machine", "application", "revision"} - set(head)
    records = [line.split("\t") for line in lines[6:-2]]
    if missing or any(len(r) != 3 for r in records) or lines[-2] != f"end {len(records)}":
        raise ImageFault("the control image is damaged")
    return head, [(entry, field) for _, entry, field in records]


def _field(parameter: Parameter, value: Value) -> str:
    found = value.value
    if parameter.choices:
        key = ("yes" if found else "no") if isinstance(found, bool) else str(found)
        raw = next((c.raw for c in parameter.choices if c.key == key), None)
        return key if raw is None else f"raw:{raw}"
    if isinstance(found, str):
        return "text:" + found.replace("\\", "\\\\").replace("\n", "\\n").replace("\t", "\\t")
    return f"{write_number(found)} {value.unit}".rstrip()


def _value(parameter: Parameter, field: str) -> Value:
    if parameter.choices:
        yes_no = parameter.type == "boolean"
        for choice in parameter.choices:
            if field in (choice.key, f"raw:{choice.raw}"):
                return Value(choice.key == "yes" if yes_no else choice.key)
        if re.fullmatch(r"raw:-?\d+", field):
            return Value(field)
        raise ImageFault(f"'{field}' is no choice of {parameter.name}")
    if field.startswith("text:"):
        plain = field[5:]
        return Value(re.sub(r"\\(.)", lambda m: {"n": "\n", "t": "\t"}.get(m.group(1), m.group(1)), plain))
    number, _, unit = field.partition(" ")
    try:
        value = float(number)
    except ValueError:
        raise ImageFault(f"'{field}' is no value of {parameter.name}") from None
    if unit not in UNITS:
        raise ImageFault(f"'{unit}' is no unit")
    return Value(int(value) if parameter.type in ("integer", "bits") and value == int(value) else value, unit)


def patch_image(image: bytes, number: str, text: str) -> bytes:
    """Key one value into an image as at the control: by number, in the control's own unit, unchecked.

    Raises PatchFault for a number the control does not offer and for text that is no number.
    """
    file = decode_image(image)
    address, parameter = _patchable(file, number)
    try:
        value, rest = read_number(text)
    except ValueFault as error:
        raise PatchFault(str(error)) from None
    if rest.strip():
        raise PatchFault("patch values are plain numbers")
    file.values[address] = patched_value(file, address, parameter, value)
    file.situation.forget()
    return encode_image(file)


def _patchable(file: ParameterFile, number: str) -> tuple[Address, Parameter]:
    try:
        address = file.find(number)
    except UnknownParameter:
        raise PatchFault("PARAMETER NUMBER NOT FOUND") from None
    parameter = file.schema.parameters[address[0]]
    if not parameter.patchable:
        raise PatchFault("PARAMETER NUMBER NOT FOUND")
    return address, parameter


def patched_value(file: ParameterFile, address: Address, parameter: Parameter, value: float) -> Value:
    """Return the value that a stored number means: a choice by its code, a number in the unit the control keeps."""
    if parameter.choices:
        return _value(parameter, f"raw:{int(value)}")
    unit = (parameter.storage.unit if parameter.storage else None) or ""
    if file.situation.turns(address):
        unit = angular(unit)
    return Value(int(value) if parameter.type == "integer" and value == int(value) else value, unit)
