"""Parameter files on disk.

The format is YAML: a header, then one line a value (``home.calibration@1: 0 mm``),
closed by the document end mark ``...``, without which a file counts as cut
off. Comments and keys that this program does not know survive every save.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from amp_studio.schema import (
    Address,
    FileError,
    InvalidValueError,
    Parameter,
    Schema,
    UnitError,
    UnknownFamilyError,
    Value,
    dimension,
    load_schema,
    not_readable,
    read_address,
    read_number,
    read_value,
    shown,
    unit_named,
    write_value,
    written,
)
from amp_studio.schema.described import DescriptionError, described_schema
from amp_studio.schema.file_error import text_of
from amp_studio.schema.quoting import quoted, short
from amp_studio.schema.regular_file import read_file
from amp_studio.schema.values import checked
from amp_studio.schema.yaml_reader import YamlError, read_yaml, spelled_scalar, text_scalar

from .atomic import Notify, SaveError, digest, write_atomic
from .parameter_file import Header, ParameterFile

FORMAT = 1
"""Version of the file format; a file of a newer one is refused."""

_HEADER = ("name", "application", "revision", "machine", "units", "notes", "signature")
_SECTIONS = ("values", "forced")
_DESCRIPTION = "description"
"""The description that the control gave of itself, in lines, where its schema is made of that: so the file opens without it."""
_KNOWN = {"amp_studio", "family", _DESCRIPTION, *_SECTIONS, *_HEADER}
_REMEMBERED = 200
"""Signs of the longest text whose meaning is remembered."""


class ParameterFileError(FileError):
    """A parameter file or project that cannot be used; nothing was changed."""


class Opened(NamedTuple):
    """A file as it was read: its content, and its state on disk."""

    file: ParameterFile
    path: Path
    digest: str


def open_file(path: Path) -> Opened:
    """Read a parameter file; raises ParameterFileError and changes nothing when it cannot be used."""
    content = file_content(path)
    return Opened(read_content(path, content), path, digest(content))


def file_content(path: Path) -> bytes:
    """Return the bytes of a file; raises ParameterFileError."""
    try:
        return read_file(path)
    except OSError as error:
        raise ParameterFileError(path, None, f"cannot be read: {error.strerror}") from None


def read_content(path: Path, content: bytes, schema: Schema | None = None) -> ParameterFile:
    """Read the content of a parameter file; ``path`` is for messages. Raises ParameterFileError.

    With the ``schema`` of a family its id need not be looked up.
    """
    return _FileReader(path, text_of(path, content, ParameterFileError), schema).read()


class _FileReader:
    """Reads the text of one parameter file."""

    def __init__(self, path: Path, text: str, schema: Schema | None) -> None:
        self.path, self.text, self.schema = path, text, schema
        self.data: dict[str, Any] = {}

    def read(self) -> ParameterFile:
        self._parse()
        self.file = ParameterFile(self._family())
        self._read_header()
        self._read_values(self._section("values", "parameters with values"))
        for key, why in self._section("forced", "parameters with the reason").items():
            if not isinstance(why, str):
                raise self._fault(f"{short(key)} has no reason", "forced", key)
            self.file.forced[read_address(key)] = why
        return self.file

    def _fault(self, what: str, *place: str) -> ParameterFileError:
        """Return what is wrong with an entry, and its line."""
        line = read_yaml(self.text, text_scalar, spans=True).line(place) if place else None
        return ParameterFileError(self.path, line, what)

    def _parse(self) -> None:
        try:
            document = read_yaml(self.text, text_scalar)
        except YamlError as error:
            if error.is_syntax and "amp_studio" in self.text and not self.text.rstrip().endswith("\n..."):
                raise self._cut_off() from None
            raise ParameterFileError(self.path, error.line, error.what) from None
        if not isinstance(document.data, dict) or "amp_studio" not in document.data:
            raise self._fault("is not an AMP Studio parameter file")
        self.data, version = document.data, document.data["amp_studio"]
        if not isinstance(version, str) or not re.fullmatch(r"[0-9]{1,9}", version):
            shown_version = quoted(version) if isinstance(version, str) else "this"
            raise self._fault(f"{shown_version} is no version of the file format", "amp_studio")
        if int(version) > FORMAT:
            raise self._fault(
                f"was written by a newer AMP Studio (file format {version}, known: {FORMAT})", "amp_studio"
            )
        if not document.is_closed:
            raise self._cut_off()

    def _cut_off(self) -> ParameterFileError:
        line = self.text.count("\n") + 1
        return ParameterFileError(self.path, line, "ends without its end mark '...': it has been cut off")

    def _family(self) -> Schema:
        family = self.data.get("family")
        if not isinstance(family, str):
            raise self._fault("names no control family", *(["family"] if "family" in self.data else []))
        try:
            return self._schema(family)
        except UnknownFamilyError as error:
            raise self._fault(str(error), "family") from None
        except DescriptionError as error:
            raise self._fault(
                f"the description of its control cannot be used: {error}", _DESCRIPTION
            ) from None

    def _schema(self, family: str) -> Schema:
        """Return the schema of the family, or of the control that the file describes."""
        lines, given = self.data.get(_DESCRIPTION), self.schema
        if lines is None:
            is_given = given is not None and given.family.family == family and not given.description
            return given if is_given and given is not None else load_schema(family)
        if not isinstance(lines, list) or not all(isinstance(line, str) for line in lines):
            raise self._fault("the description of its control is no list of lines", _DESCRIPTION)
        description = "".join(f"{line}\n" for line in lines[1:]).encode("utf-8", "replace")
        if lines[:1] != [_seal(description)]:
            raise self._fault(
                "the description of its control is not the one that it was saved with: "
                "read the control again, or take the backup",
                _DESCRIPTION,
            )
        return (
            given
            if given is not None and given.description == description
            else described_schema(family, description)
        )

    def _read_header(self) -> None:
        header, family = self.file.header, self.file.schema.family
        header.extra = _extra(self.text, self.data)
        for key in _HEADER:
            text = self.data.get(key)
            if not isinstance(text, (str, type(None))):
                raise self._fault(f"{key} is no text", key)
            if text is not None:
                setattr(header, key, text)
        for key, known in (("machine", [m.key for m in family.machines]), ("units", list(family.units))):
            text = self.data.get(key)
            if text is not None and known and text not in known:
                raise self._fault(f"{key} is {quoted(text)}; known here: {', '.join(known)}", key)

    def _section(self, name: str, of_what: str) -> dict[str, Any]:
        entries = self.data.get(name) or {}
        if not isinstance(entries, dict):
            raise self._fault(f"'{name}' is not a list of {of_what}", name)
        return entries

    def _read_values(self, entries: dict[str, Any]) -> None:
        file = self.file
        values: dict[Address, Value] = {}
        machine = file.schema.family.machine_parameter
        ordered = sorted(entries, key=lambda k: k != machine)  # the machine type decides what the others are
        for key in ordered:
            address, text = read_address(key), entries[key]
            if not isinstance(text, str):
                raise self._fault(f"{short(key)} has no single value", "values", key)
            if address in values or key in file.unknown:  # "x" and "x@"
                raise self._fault(f"{quoted(written(address))} occurs twice", "values", key)
            try:
                value = _value(file, address, text)
            except InvalidValueError as error:
                raise self._fault(f"{short(key)}: {error}", "values", key) from None
            if value is None:
                file.unknown[key] = text
            else:
                values[address] = value
                if key == machine:
                    file.take(values)
        file.take(values)


def _seal(description: bytes) -> str:
    """Return the first line of a description in a file, by which a change in it is noticed: it bounds what is sent."""
    return f"sha256 {hashlib.sha256(description).hexdigest()}"


def _extra(text: str, data: dict[str, Any]) -> dict[str, object]:
    """Return the keys this program does not know with their values as YAML means them, so that a save keeps their kind."""
    if not set(data) - _KNOWN:
        return {}
    typed = read_yaml(text, spelled_scalar).data
    return {key: value for key, value in typed.items() if key not in _KNOWN}


def _value(file: ParameterFile, address: Address, text: str) -> Value | None:
    """Return the value, None for an address the schema does not have; raises InvalidValueError."""
    schema = file.schema
    parameter = schema.parameters.get(address[0])
    if parameter is None or address not in file.machine_schema.places:
        return None
    try:
        if len(text) > _REMEMBERED:
            return read_stored(schema, parameter, text)
        return _stored(schema, parameter.id, text)
    except InvalidValueError as error:
        raise InvalidValueError(not_readable(parameter, error)) from None


@lru_cache(maxsize=16_384)
def _stored(schema: Schema, parameter_id: str, text: str) -> Value:
    """Return what a text in a file means; the files of a shop have most of them in common."""
    return read_stored(schema, schema.parameters[parameter_id], text)


def read_stored(schema: Schema, parameter: Parameter, text: str) -> Value:
    """Read a stored value, which names its own unit; raises InvalidValueError."""
    if parameter.type == "text":
        return checked(
            parameter, Value(text)
        )  # with the blanks at its ends, which a person's entry would lose
    if parameter.choices or parameter.type == "format":
        return read_value(parameter, text, "")
    units = schema.units_of(parameter)
    named = "" if text.startswith(("0x", "0X", "$")) else read_number(text)[1]
    if not named and "" not in units:
        raise InvalidValueError(f"{quoted(text)} has no unit: write {short(text)} {shown(units[0])}")
    unit = named if named in units else units[0]
    return read_value(parameter, text, _alike(units, named, unit))


def _alike(units: tuple[str, ...], named: str, unit: str) -> str:
    """Return the unit of the parameter that measures the same as the one named, so that it is accepted."""
    try:
        wanted = dimension(unit_named(named))
    except UnitError:
        return unit
    return next((u for u in units if dimension(u) == wanted), unit)


def content_of(file: ParameterFile, previous: bytes | None = None) -> bytes:
    """Return a file's content; with the ``previous`` content what did not change stays as it is written there."""
    header: dict[str, Any] = {"amp_studio": str(FORMAT), "family": file.schema.family.family}
    header |= {key: getattr(file.header, key) for key in _HEADER if getattr(file.header, key)}
    header |= file.header.extra
    wanted: dict[str, Any] = header | {"values": _entries(file)}
    wanted |= {"forced": {written(a): why for a, why in file.forced.items()}}
    if file.schema.description:
        description = file.schema.description
        wanted[_DESCRIPTION] = [_seal(description), *description.decode("utf-8").split("\n")[:-1]]
    text = None if previous is None else _amended(file, previous, wanted)
    if text is None:
        from .yaml_text import new_text  # what only opens files does not write any

        wanted |= {"amp_studio": FORMAT}  # a number: everything else that is one is a text
        text = new_text({key: value for key, value in wanted.items() if value or key not in _SECTIONS}, "...")
    return text.encode("utf-8")


def _amended(file: ParameterFile, previous: bytes, wanted: dict[str, Any]) -> str | None:
    """Return the text of the previous content, amended; None where it cannot be."""
    try:
        text = previous.decode("utf-8")
        document = read_yaml(text, text_scalar, spans=True)
    except (UnicodeDecodeError, YamlError):
        return None
    if not isinstance(document.data, dict) or not document.is_closed or not document.data:
        return None
    known = document.data | _extra(text, document.data)
    wanted = wanted | {"values": _as_spelled(file, wanted["values"], known.get("values"))}
    marked = {written(read_address(key)): key for key in known.get("forced") or ()}
    wanted |= {"forced": {marked.get(name, name): why for name, why in wanted["forced"].items()}}
    if "units" not in known and wanted.get("units") == Header.units:
        del wanted["units"]  # what goes without saying is not added to what a person wrote
    for key in _SECTIONS + _HEADER:
        if not wanted.get(key) and not known.get(key):
            wanted.pop(key, None)
            if key in known:
                wanted[key] = known[key]  # an empty entry stays as it is written
        elif not wanted.get(key):
            wanted.pop(key, None)
    from .yaml_text import amended

    found = amended(document, known, wanted, _SECTIONS)
    return found if found is None or not text.startswith("\ufeff") else "\ufeff" + found


def _as_spelled(file: ParameterFile, entries: dict[str, str], known: object) -> dict[str, str]:
    """Return entries with those that mean the same already as a person spelled them: 0.50 in, control.type@."""
    found: dict[str, tuple[str, str]] = {}
    for key, text in known.items() if isinstance(known, dict) else ():
        address = read_address(key)
        value = file.values.get(address)
        try:
            if value is not None and _value(file, address, text) == value:
                found[written(address)] = key, text
        except InvalidValueError:
            continue
    return dict(found.get(name, (name, text)) for name, text in entries.items())


def _entries(file: ParameterFile) -> dict[str, str]:
    order = file.machine_schema.places
    known = sorted(file.values, key=lambda a: order.get(a, len(order)))
    entries = {written(a): write_value(file.schema.parameters[a[0]], file.values[a]) for a in known}
    return entries | {key: text for key, text in file.unknown.items() if key not in entries}


def save_file(
    file: ParameterFile, path: Path, expected: str | None = None, notify: Notify = lambda _message: None
) -> str:
    """Save a file, all or nothing; the previous file becomes the backup.

    ``expected`` is the digest the file had when it was opened, None for a new
    one; ``notify`` is called with what could not be kept. The content is read back before it replaces anything.
    Returns the new digest; raises ChangedOnDiskError or SaveError.
    """
    file.header.signature = file.schema.signature
    return write_atomic(
        path, lambda previous: readable_content(file, path, previous), expected, notify=notify
    )


def readable_content(file: ParameterFile, path: Path, previous: bytes | None = None) -> bytes:
    """Return a file's content that has been read back and means what the file does; raises SaveError."""
    try:
        content = content_of(file, previous)
        found = _fault_of(file, path, content)
        if found and previous is not None:
            from .yaml_text import without_stray_tabs

            content = without_stray_tabs(content)
            found = _fault_of(file, path, content)
    except UnicodeEncodeError as error:
        found = f"the sign U+{ord(error.object[error.start]):04X} is in no file"
    if found:
        raise SaveError(f"{path} was not written: {found}")
    return content


def _fault_of(file: ParameterFile, path: Path, content: bytes) -> str:
    """Return why a content does not mean what the file does; empty where it does."""
    try:
        return _difference(file, read_content(path, content, file.schema))
    except ParameterFileError as error:
        return f"it would be unreadable: {f'line {error.line}: ' if error.line else ''}{error.what}"


def _difference(file: ParameterFile, again: ParameterFile) -> str:
    """Return in what a file differs from what was read back; empty where it does not.

    An entry of the other machine type becomes a value when the machine type changes, or a value an entry.
    """
    for address, value in file.values.items():
        name = written(address)
        if address in again.values:
            if again.values[address] != value:
                return f"{name} would be read back as another value"
        elif again.unknown.get(name) != write_value(file.schema.parameters[address[0]], value):
            return f"{name} would be lost"
    lost = next(
        (k for k in file.unknown if k not in again.unknown and read_address(k) not in again.values), None
    )
    added = next((a for a in again.values if a not in file.values and written(a) not in file.unknown), None)
    if lost or added:
        return f"{short(lost or written(added or ('', '')))} would be another entry"
    kept = {key: text for key, text in file.unknown.items() if key in again.unknown}
    if any(again.unknown[key] != text for key, text in kept.items()):
        return "an entry that the schema does not know would be read back as another"
    if file.forced != again.forced:
        return "the marks of force would be read back as others"
    plain = replace(file.header, extra={}) == replace(again.header, extra={})
    if not plain or repr(file.header.extra) != repr(again.header.extra):
        return "the head of the file would be read back otherwise"
    return ""
