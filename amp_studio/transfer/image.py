"""The control image: a parameter file as the line carries it and the control keeps it.

UTF-8 text, one record a line, so that two images can be compared byte for byte. ``docs/protocols/image.md``
specifies it. Numbers travel with the unit they were entered in; choices as the code the control stores, where
one is printed, else as their key.

A file has exactly one image: what would not be written the same again is no image, however it came about.
"""

from __future__ import annotations

import re
from functools import lru_cache

from amp_studio.errors import AmpStudioError
from amp_studio.files import Header, ParameterFile, read_stored
from amp_studio.schema import (
    MASKED,
    Address,
    Choice,
    InvalidValueError,
    Parameter,
    Schema,
    UnknownParameterError,
    Value,
    choice_key,
    choice_value,
    family_ids,
    load_schema,
    not_readable,
    read_address,
    read_number,
    read_value,
    value_of_stored,
    write_number,
    written,
)

MAGIC = "AMP-IMAGE 1"
_HEAD = ("family", "signature", "machine", "application", "revision")
_LONGEST = 200
"""Characters of a value that is no text; the longest that is written has far fewer."""
_SHOWN = 60
"""Characters of a damaged line that a message shows."""

_CONTROL_CHARACTER = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f]"
)  # none but TAB and the line feed are in an image
_ESCAPED_CHARACTER = re.compile(r"[\x00-\x1f\x7f-\x9f\\]")
_ESCAPE = re.compile(r"\\(?:x([0-9a-f]{2})|(.))", re.DOTALL)
_ADDRESS = re.compile(r"[a-z][a-z0-9_]*\.[a-z][a-z0-9_.]*(?:@[A-Za-z0-9.]+)?")
_LETTERS = {"\\": "\\", "\n": "n", "\t": "t"}
_CHARACTERS = {letter: character for character, letter in _LETTERS.items()}


class ImageError(AmpStudioError, ValueError):
    """Bytes that are not a whole control image, or a file that has none; one clear sentence."""


class PatchError(InvalidValueError):
    """A value that cannot be keyed in at the control; one clear sentence."""


def encode_image(file: ParameterFile) -> bytes:
    """Return the image of a file: every value that is set, in the manual's order; raises ImageError."""
    schema, here = file.schema, file.machine_schema
    lines = head_of(file)
    order = file.machine_schema.places
    values = sorted((a for a in file.values if a in order), key=order.__getitem__)
    for address in values:
        number = here.number(address)
        label = "-" if number is None or here.is_disputed(address[0]) else number
        lines.append(
            f"{label}\t{written(address)}\t{_field(schema.parameters[address[0]], file.values[address])}"
        )
    lines.append(f"end {len(values)}")
    try:
        return ("\n".join(lines) + "\n").encode("utf-8")
    except UnicodeEncodeError:
        raise ImageError("a text of the file contains half a character, which no image can carry") from None


def head_of(file: ParameterFile) -> list[str]:
    """Return the lines of a file's image before the first record."""
    header = file.header
    return [
        MAGIC,
        f"family {file.schema.family.family}",
        f"signature {file.schema.signature}",
        f"machine {file.machine}",
        f"application {_escaped(header.application)}",
        f"revision {_escaped(header.revision)}",
    ]


def decode_image(image: bytes) -> ParameterFile:
    """Return the file of an image, whose image is exactly this one; raises ImageError."""
    head, records = _split(image)
    schema = _schema(head)
    file = ParameterFile(
        schema,
        Header(
            application=_unescaped(head["application"]),
            revision=_unescaped(head["revision"]),
            machine="" if schema.family.machine_parameter else head["machine"],
            signature=schema.signature,
        ),
    )
    values: dict[Address, Value] = {}
    for entry, field in records:
        address = read_address(entry)
        parameter = schema.parameters.get(address[0])
        if parameter is None:
            raise ImageError(f"the control image contains '{_short(entry)}', which the schema does not have")
        if address in values:
            raise ImageError(f"the control image contains {_short(entry)} twice")
        values[address] = _value(schema, parameter, entry, field)
    try:
        file.take(values)
    except UnknownParameterError as error:
        raise ImageError(f"the control image contains what does not exist: {_short(str(error))}") from None
    _check_form(file, image)
    return file


def _record(number: int, line: str) -> tuple[str, str]:
    """Return address and value of a line; raises ImageError."""
    parts = line.split("\t")
    if len(parts) != 3:
        match = _ADDRESS.search(line)
        entry = f" ({_short(match[0])})" if match else ""
        raise ImageError(f"line {number} of the control image{entry} is not number, address and value")
    return parts[1], parts[2]


def _whole_lines(image: bytes) -> list[str]:
    """Return the lines of an image that begins and ends as one; raises ImageError."""
    try:
        text = image.decode("utf-8")
    except UnicodeDecodeError:
        raise ImageError("the control image is not text") from None
    lines = text.split("\n")
    if lines[0] != MAGIC:
        raise ImageError("this is not a control image")
    if len(lines) < 8 or lines[-1] != "" or not lines[-2].startswith("end "):
        raise ImageError("the control image has been cut off")
    if match := _CONTROL_CHARACTER.search(text):
        number = text.count("\n", 0, match.start()) + 1
        raise ImageError(f"line {number} of the control image contains a control character")
    return lines


def _split(image: bytes) -> tuple[dict[str, str], list[tuple[str, str]]]:
    """Return the head and the records, address and value; raises ImageError."""
    lines = _whole_lines(image)
    head = {}
    for number, (key, line) in enumerate(zip(_HEAD, lines[1:6], strict=True), 2):
        if not line.startswith(f"{key} "):
            raise ImageError(f"line {number} of the control image is not its {key}")
        head[key] = line[len(key) + 1 :]
    records = [_record(number, line) for number, line in enumerate(lines[6:-2], 7)]
    if lines[-2] != f"end {len(records)}":
        raise ImageError(
            f"the control image contains {len(records)} records and ends with '{_short(lines[-2])}'"
        )
    return head, records


def _schema(head: dict[str, str]) -> Schema:
    """Return the schema that an image was made for; raises ImageError where this program has another."""
    family = head["family"]
    if family not in family_ids():  # what a control sends is never looked up as a path
        raise ImageError(f"the control image is for the family '{_short(family)}', which is not known here")
    schema = load_schema(family)
    if head["signature"] != schema.signature:
        raise ImageError("the control's parameters are numbered by another schema than this program's")
    if head["machine"] not in schema.machines:
        raise ImageError(
            f"the control image is for the machine type '{_short(head['machine'])}', "
            f"which {schema.family.name} does not have"
        )
    return schema


def _check_form(file: ParameterFile, image: bytes) -> None:
    """Refuse an image that is not the one of the file it was read as: another order, number, unit sign,
    escape.
    """
    known = set(file.addresses())
    for address in file.values:
        if address not in known:
            raise ImageError(
                f"the control image contains {_short(written(address))}, "
                f"which does not exist on the machine type {file.machine}"
            )
    right = encode_image(file)
    if right == image:
        return
    pairs = zip(image.decode("utf-8").split("\n"), right.decode("utf-8").split("\n"), strict=True)
    number, (line, wanted) = next((n, pair) for n, pair in enumerate(pairs, 1) if pair[0] != pair[1])
    line, wanted = _masked(file.schema, line), _masked(file.schema, wanted)
    raise ImageError(f"line {number} of the control image is '{line}', which would be written '{wanted}'")


def _masked(schema: Schema, line: str) -> str:
    """Return a line as a message shows it, without the value of a secret."""
    parts = line.split("\t")
    parameter = schema.parameters.get(read_address(parts[1])[0]) if len(parts) == 3 else None
    return _short("\t".join([*parts[:2], MASKED]) if parameter and parameter.secret else line)


def _short(text: str) -> str:
    text = text.replace("\t", " ")
    return text if len(text) <= _SHOWN else text[: _SHOWN - 1] + "…"


def _escaped(text: str) -> str:
    return _ESCAPED_CHARACTER.sub(lambda m: "\\" + _LETTERS.get(m[0], f"x{ord(m[0]):02x}"), text)


def _unescaped(text: str) -> str:
    """Return the text that was escaped; what is no escape becomes something that is not written so."""
    return _ESCAPE.sub(lambda m: chr(int(m[1], 16)) if m[1] else _CHARACTERS.get(m[2], m[2]), text)


def _code(choice: Choice) -> str:
    return choice.key if choice.raw is None else f"raw:{choice.raw}"


def _field(parameter: Parameter, value: Value) -> str:
    if parameter.choices:
        key = choice_key(value)
        return next((_code(c) for c in parameter.choices if c.key == key), key)
    if isinstance(value.value, str):
        return "text:" + _escaped(value.value)
    return f"{write_number(value.value)} {value.unit}".rstrip()


def _value(schema: Schema, parameter: Parameter, entry: str, field: str) -> Value:
    """Return the value a field means, by the same reading as a file's; raises ImageError,
    which names the entry.
    """
    is_text = parameter.type in ("text", "format")
    if is_text != field.startswith("text:") or (len(field) > _LONGEST and parameter.type != "text"):
        field_text = MASKED if parameter.secret else f"'{_short(field)}'"
        raise ImageError(
            f"the control image contains {_short(entry)} with {field_text}, which is no value of it"
        )
    try:
        return _value_of_field(schema, parameter.id, field)
    except InvalidValueError as error:
        raise ImageError(
            f"the control image contains {_short(entry)} with a value it cannot have:"
            f" {not_readable(parameter, error)}"
        ) from None


@lru_cache(maxsize=16_384)
def _value_of_field(schema: Schema, parameter_id: str, field: str) -> Value:
    """Return the value of a field, which an exchange reads several times; raises InvalidValueError."""
    parameter = schema.parameters[parameter_id]
    if parameter.type in ("text", "format"):
        return read_stored(schema, parameter, _unescaped(field[5:]))
    return _choice(parameter, field) if parameter.choices else read_stored(schema, parameter, field)


def _choice(parameter: Parameter, field: str) -> Value:
    for choice in parameter.choices or ():
        if field == _code(choice):
            return choice_value(parameter, choice)
    if not field.startswith("raw:"):
        raise InvalidValueError(f"'{field}' is not a choice of {parameter.name}")
    return read_value(parameter, field, "")


def patch_image(image: bytes, number: str, text: str) -> bytes:
    """Key one value into an image as at the control: by number, in the control's own unit,
    its range unchecked.

    Raises PatchError for a number the control does not offer and for text that is no value of it, ImageError
    where the image cannot be read.
    """
    file = decode_image(image)
    address, parameter = _patchable(file, number)
    try:
        value, rest = read_number(text)
        if rest.strip():
            raise PatchError("patch values are plain numbers")
        file.take({address: value_of_stored(parameter, value, turns=file.evaluation.turns(address))})
    except InvalidValueError as error:
        raise PatchError(str(error)) from None
    changed = encode_image(file)
    decode_image(changed)  # the control's memory contains nothing that cannot be read again
    return changed


def _patchable(file: ParameterFile, number: str) -> tuple[Address, Parameter]:
    try:
        address = file.find(number)
    except UnknownParameterError:
        raise PatchError("PARAMETER NUMBER NOT FOUND") from None
    parameter = file.schema.parameters[address[0]]
    if not parameter.patchable:
        raise PatchError("PARAMETER NUMBER NOT FOUND")
    return address, parameter
