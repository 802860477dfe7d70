"""Parameter files as they are read.

The format is YAML: a header, then one line a value (``home.calibration@1: 0 mm``),
closed by the document end mark ``...``, without which a file counts as cut
off. Comments and keys that this program does not know survive every save.
"""

from __future__ import annotations

import hashlib
import re
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from amp_studio.schema import (
    Address,
    DescriptionError,
    FileError,
    InvalidValueError,
    Parameter,
    Schema,
    UnitError,
    UnknownFamilyError,
    Value,
    YamlError,
    checked,
    described_schema,
    dimension,
    load_schema,
    not_readable,
    quoted,
    read_address,
    read_file,
    read_number,
    read_value,
    read_yaml,
    short,
    spelled_scalar,
    text_of,
    text_scalar,
    unit_named,
    unit_text,
    written,
)

from .atomic import digest
from .parameter_file import ParameterFile

FORMAT = 1
"""Version of the file format; a file of a newer one is refused."""

HEADER_KEYS = ("name", "application", "revision", "machine", "units", "notes", "signature")
NOTE_SECTIONS = ("value_notes", "group_notes")
HEADER_SECTIONS = ("done", *NOTE_SECTIONS)
"""Entries of the header that have a text for each of several things."""
SECTIONS = ("done", "values", "forced", *NOTE_SECTIONS)
DESCRIPTION = "description"
"""The description that the control gave of itself, in lines, where its schema is made of that:
so the file opens without it."""
_KNOWN_KEYS = {"amp_studio", "family", DESCRIPTION, *SECTIONS, *HEADER_KEYS}
_REMEMBERED = 200
"""Characters of the longest text whose meaning is remembered."""


class ParameterFileError(FileError):
    """A parameter file or project that cannot be used; nothing was changed."""


class Opened(NamedTuple):
    """A file as it was read: its content, and its state on disk."""

    file: ParameterFile
    path: Path
    digest: str


def open_file(path: Path | str) -> Opened:
    """Read a parameter file; raises ParameterFileError and changes nothing when it cannot be used."""
    path = Path(path)
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


def value_lines(path: Path) -> dict[Address, int]:
    """Return the line of each value of a parameter file; nothing for a file that is none, or cannot be
    read.
    """
    try:
        document = read_yaml(text_of(path, file_content(path)), text_scalar, spans=True)
    except (FileError, YamlError):
        return {}
    values = document.data.get("values") if isinstance(document.data, dict) else None
    keys = values if isinstance(values, dict) else {}
    return {read_address(key): document.line(("values", key)) for key in keys}


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
        for name in NOTE_SECTIONS:
            notes = self._section(name, "notes")
            for key, note in notes.items():
                if not isinstance(note, str):
                    raise self._fault(f"the note about {short(key)} is no text", name, key)
            setattr(self.file.header, name, notes)
        done = self._section("done", "steps with who has done them")
        for key, who in done.items():
            if not isinstance(who, str):
                raise self._fault(f"{short(key)} does not say who has done it", "done", key)
        self.file.header.done = done
        return self.file

    def _fault(self, what: str, *place: str) -> ParameterFileError:
        """Return what is wrong with an entry, and its line."""
        line = read_yaml(self.text, text_scalar, spans=True).line(place) if place else None
        return ParameterFileError(self.path, line, what)

    def _parse(self) -> None:
        """Read the text as YAML; raises ParameterFileError for what is no whole file of this format."""
        try:
            document = read_yaml(self.text, text_scalar)
        except YamlError as error:
            if error.is_syntax and "amp_studio" in self.text and not self.text.rstrip().endswith("\n..."):
                raise self._cut_off() from None
            raise ParameterFileError(self.path, error.line, error.what) from None
        if not isinstance(document.data, dict) or "amp_studio" not in document.data:
            raise self._fault("is not an AMP Studio parameter file")
        self.data = document.data
        self._check_version(document.data["amp_studio"])
        if not document.is_closed:
            raise self._cut_off()

    def _check_version(self, version: object) -> None:
        """Raise ParameterFileError for what is no version of the format, and for a newer one."""
        if not isinstance(version, str) or not re.fullmatch(r"[0-9]{1,9}", version):
            shown_version = quoted(version) if isinstance(version, str) else "this"
            raise self._fault(f"{shown_version} is no version of the file format", "amp_studio")
        if int(version) > FORMAT:
            raise self._fault(
                f"was written by a newer AMP Studio (file format {version}, known: {FORMAT})", "amp_studio"
            )

    def _cut_off(self) -> ParameterFileError:
        line = self.text.count("\n") + 1
        return ParameterFileError(self.path, line, "ends without its end mark '...': it has been cut off")

    def _family(self) -> Schema:
        """Return the schema that the file names, or describes; raises ParameterFileError with the line of
        it.
        """
        family = self.data.get("family")
        if not isinstance(family, str):
            raise self._fault("names no control family", *(["family"] if "family" in self.data else []))
        try:
            return self._schema(family)
        except UnknownFamilyError as error:
            raise self._fault(str(error), "family") from None
        except DescriptionError as error:
            raise self._fault(
                f"the description of its control cannot be used: {error}", DESCRIPTION
            ) from None

    def _printed_schema(self, family: str) -> Schema:
        """Return the schema of a family whose facts are printed."""
        given = self.schema
        if given is not None and given.family.family == family and not given.description:
            return given
        return load_schema(family)

    def _schema(self, family: str) -> Schema:
        """Return the schema of the family, or of the control that the file describes."""
        lines, given = self.data.get(DESCRIPTION), self.schema
        if lines is None:
            return self._printed_schema(family)
        if not isinstance(lines, list) or not all(isinstance(line, str) for line in lines):
            raise self._fault("the description of its control is no list of lines", DESCRIPTION)
        # The first line is the seal: a hand that changed a line of the rest would change what numbers
        # mean.
        description = "".join(f"{line}\n" for line in lines[1:]).encode("utf-8", "replace")
        if lines[:1] != [seal_of(description)]:
            raise self._fault(
                "the description of its control is not the one that it was saved with: "
                "read the control again, or take the backup",
                DESCRIPTION,
            )
        if given is not None and given.description == description:
            return given
        return described_schema(family, description)

    def _read_header(self) -> None:
        """Read the texts of the header; raises ParameterFileError for what is none, or an unknown machine or
        unit.
        """
        header, family = self.file.header, self.file.schema.family
        header.extra = extra_entries(self.text, self.data)
        for key in HEADER_KEYS:
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
        """Read the values; what this machine type does not have stays as an entry."""
        file = self.file
        values: dict[Address, Value] = {}
        machine = file.schema.family.machine_parameter
        ordered = list(entries)
        if machine in entries:  # it decides what the others are
            ordered.remove(machine)
            ordered.insert(0, machine)
        places = file.machine_schema.places
        for key in ordered:
            address, text = _address(key), entries[key]
            if not isinstance(text, str):
                raise self._fault(f"{short(key)} has no single value", "values", key)
            if address in values or key in file.unknown:  # "x" and "x@"
                raise self._fault(f"{quoted(written(address))} occurs twice", "values", key)
            if address not in places:
                # Of the other machine type, or of a newer schema: kept, and written back as it is.
                file.unknown[key] = text
                continue
            try:
                values[address] = _read_once(file.schema, address[0], text)
            except InvalidValueError as error:
                raise self._fault(f"{short(key)}: {error}", "values", key) from None
            if key == machine:
                file.take_read(values)
                places = file.machine_schema.places
        file.take_read(values)


def seal_of(description: bytes) -> str:
    """Return the first line of a description in a file, by which a change in it is noticed:
    it bounds what is sent.
    """
    return f"sha256 {hashlib.sha256(description).hexdigest()}"


def extra_entries(text: str, data: dict[str, Any]) -> dict[str, object]:
    """Return the keys this program does not know with their values as YAML means them,
    so that a save keeps their kind.
    """
    if not set(data) - _KNOWN_KEYS:
        return {}
    typed = read_yaml(text, spelled_scalar).data
    return {key: value for key, value in typed.items() if key not in _KNOWN_KEYS}


def value_in_file(file: ParameterFile, address: Address, text: str) -> Value | None:
    """Return the value, None for an address the schema does not have; raises InvalidValueError."""
    if address not in file.machine_schema.places:
        return None
    return _read_once(file.schema, address[0], text)


def _read_once(schema: Schema, parameter_id: str, text: str) -> Value:
    """Return what a text in a file means; raises InvalidValueError in words for a person."""
    try:
        if len(text) > _REMEMBERED:
            return read_stored(schema, schema.parameters[parameter_id], text)
        return _stored(schema, parameter_id, text)
    except InvalidValueError as error:
        raise InvalidValueError(not_readable(schema.parameters[parameter_id], error)) from None


@lru_cache(maxsize=16_384)
def _address(key: str) -> Address:
    """Return the address that a key of a file means; one object for all files."""
    return read_address(key)


@lru_cache(maxsize=65_536)
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
        raise InvalidValueError(f"{quoted(text)} has no unit: write {short(text)} {unit_text(units[0])}")
    unit = named if named in units else units[0]
    return read_value(parameter, text, _alike(units, named, unit))


def _alike(units: tuple[str, ...], named: str, unit: str) -> str:
    """Return the unit of the parameter that measures the same as the one named, so that it is accepted."""
    try:
        wanted = dimension(unit_named(named))
    except UnitError:
        return unit
    return next((u for u in units if dimension(u) == wanted), unit)
