"""The configuration file of LinuxCNC, byte for byte: what was not changed is written back as it was read.

Its lines are kept in the parameter file, with those of the files that it includes. A changed value is another
one in its line; what is behind a number, the order of the lines and every remark stay.
A new value becomes a line at the end of its section.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from operator import itemgetter

from amp_studio.families.linuxcnc.figures import (
    TYPE,
    UNITS,
    addresses_by_name,
    is_rotary_axis,
    number_in,
    read_figure,
    unit_of,
    write_figure,
)
from amp_studio.families.linuxcnc.hal_text import references
from amp_studio.families.linuxcnc.ini_text import IniEntry, IniText, read_ini, with_value
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import Address, InvalidValueError, Schema, Value, close_matches, same_value, written

FAMILY = "linuxcnc"
_KIND = "ini"
"""Key of the header under which the lines are kept."""
_HEAD = "# LinuxCNC configuration"
_SECTIONS = re.compile(
    r"(?m)^(?:[ \t]*\[(?:EMC|KINS|TRAJ|EMCMOT|EMCIO|RS274NGC|HAL"
    r"|JOINT_[0-9]+|AXIS_[XYZABCUVW0-8]|SPINDLE_[0-9])\]"
    r"|#INCLUDE[ \t]+\S+\.inc)"
)
_LISTS, _SCREENS = "lists", "screens"
"""The tables of keys of which every line counts, and of those that a screen alone reads."""


@dataclass(frozen=True)
class _Row:
    """One entry and what it is: a value of ``address``, an ``unknown`` name,
    or a line that sets nothing here.
    """

    entry: IniEntry
    address: Address | None = None
    value: Value | None = None
    unit: str = ""
    unknown: str = ""


# -- reading


def _recognises(text: str) -> bool:
    return _SECTIONS.search(text) is not None


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what an INI file and those that it includes contain."""
    text, encoding, newline = _plain(text)

    def beside(name: str) -> str | None:
        found = options.beside(name)
        return None if found is None else _plain(found)[0]

    ini = read_ini(text, beside)
    machine = options.machine or _likely_machine(ini, schema)
    hal = _hal_references(ini, options.beside)
    found = TextRead(machine=machine, name=_name(ini))
    for row in _rows(ini, schema, machine, frozenset(hal)):
        if row.address is not None and row.value is not None:
            found.values[row.address] = row.value
            if not row.entry.file:
                found.value_lines[row.address] = row.entry.line + 1
            if places := hal.get(row.entry.name):
                found.value_notes[written(row.address)] = f"HAL: {', '.join(places)}"
        elif row.unknown:
            found.unknown[row.unknown] = row.entry.text
            found.unknown_lines[row.unknown] = row.entry.line + 1
        else:
            found.kept.append(f"{row.entry.name} = {row.entry.text}")
    found.notes += _notes(ini, schema, machine, options)
    included = {name: lines for name, lines in ini.lines.items() if name}
    further = {
        "encoding": encoding if encoding != "utf-8" else "",
        "newline": "crlf" if newline == "\r\n" else "",
        "included": included,
        "hal": sorted(hal),
    }
    found.extra[_KIND] = {"lines": ini.lines[""], **dict(filter(itemgetter(1), further.items()))}
    return found


def _plain(text: str) -> tuple[str, str, str]:
    """Return a text whose bytes were read one by one, its encoding, and what its lines end with.

    Where only some lines end with a return, it stays in them.
    """
    try:
        # Read as latin-1, every byte is one character: so the bytes are known here, and UTF-8 can be tried.
        text, encoding = text.encode("latin-1").decode("utf-8"), "utf-8"
    except UnicodeError:
        encoding = "latin-1"
    if "\r\n" in text and "\n" not in text.replace("\r\n", ""):
        return text.replace("\r\n", "\n"), encoding, "\r\n"
    return text, encoding, "\n"


def _name(ini: IniText) -> str:
    entry = ini.counting().get(("EMC", "MACHINE"))
    return entry.text if entry else ""


def _likely_machine(ini: IniText, schema: Schema) -> str:
    """Return the version that reads most of the keys, the usual one where several do."""
    default = schema.family.default_machine
    names = [entry.name for entry in ini.entries if not entry.shadow]

    def known(machine: str) -> int:
        table = addresses_by_name(schema, machine)
        return sum(name in table for name in names)

    return max(schema.machines, key=lambda machine: (known(machine), machine == default))


def _notes(ini: IniText, schema: Schema, machine: str, options: ReadOptions) -> Iterator[str]:
    if ini.missing:
        yield f"included and not found beside the file: {', '.join(ini.missing)}"
    if not options.machine:
        name = schema.family.machine_name(machine)
        others = ", ".join(m.key for m in schema.family.machines)
        yield f"read as {name}, as no version was given. Known: {others}"


def _hal_references(ini: IniText, beside: Callable[[str], str | None]) -> dict[str, list[str]]:
    """Return ``[SECTION]KEY`` -> the pins that HAL files beside the configuration set to it."""
    found: dict[str, list[str]] = {}
    for entry in (each for each in ini.entries if each.section == "HAL"):
        if entry.key.endswith("HALFILE"):
            name = next(iter(entry.text.split()), "")
            # Files of the library come with LinuxCNC: they are not beside the configuration.
            text = "" if name.startswith("LIB:") else beside(name)
            for line, where, pin in references(text or ""):
                place = f"{name} line {line}"
                found.setdefault(where, []).append(f"{pin} ({place})" if pin else place)
        elif entry.key == "HALCMD":
            for _, where, pin in references(entry.text):
                found.setdefault(where, []).append(pin or "HALCMD")
    return found


def _rows(ini: IniText, schema: Schema, machine: str, hal: frozenset[str]) -> Iterator[_Row]:
    """Yield every entry with what it is."""
    known = addresses_by_name(schema, machine)
    lists, screens = (
        {(section, key) for section, key, _ in schema.tables[name].rows} for name in (_LISTS, _SCREENS)
    )
    counting = ini.counting()
    system = _system(counting, schema)
    for entry in ini.entries:
        if (entry.section, entry.key) in lists or (entry.section, "*") in lists:
            yield _Row(entry)
        elif entry.shadow:
            yield _Row(entry, unknown=f"{_placed(entry)} ({entry.shadow})")
        elif address := known.get(entry.name):
            unit = unit_of(schema, address, system, turns=_turns(schema, address, counting))
            try:
                value = read_figure(schema.parameters[address[0]], entry.text, unit)
            except InvalidValueError as error:
                yield _Row(entry, unknown=f"{_placed(entry)} ({error})")
            else:
                yield _Row(entry, address, value, unit)
        elif entry.name in hal or (entry.section, entry.key) in screens:
            yield _Row(entry)
        else:
            yield _Row(entry, unknown=_unknown_name(entry, schema, machine, known))


def _placed(entry: IniEntry) -> str:
    return f"{entry.name} in {entry.file + ' ' if entry.file else ''}line {entry.line + 1}"


def _unknown_name(entry: IniEntry, schema: Schema, machine: str, known: Mapping[str, Address]) -> str:
    """Return an entry as it is named among the unknown ones, with the machine or key that may be meant."""
    others = [
        m.name
        for m in schema.family.machines
        if m.key != machine and entry.name in addresses_by_name(schema, m.key)
    ]
    if others:
        return f"{_placed(entry)} (read by {', '.join(others)} alone)"
    of_section = [name for name in known if name.startswith(f"[{entry.section}]")]
    near = close_matches(entry.name, of_section, 1, 0.8)
    return f"{_placed(entry)} ({near[0]}?)" if near else _placed(entry)


def _system(counting: Mapping[tuple[str, str], IniEntry], schema: Schema) -> str:
    """Return the unit system of the figures."""
    entry = counting.get(("TRAJ", "LINEAR_UNITS"))
    try:
        return str(read_figure(schema.parameters[UNITS], entry.text, "").value) if entry else "metric"
    except InvalidValueError:
        return "metric"


def _turns(schema: Schema, address: Address, counting: Mapping[tuple[str, str], IniEntry]) -> bool:
    """Return whether a value is of an axis or joint that turns, by the file itself."""
    scope = (
        schema.on(schema.family.default_machine).scopes.get(address[0])
        or schema.parameters[address[0]].scopes[0]
    )
    if scope == "axis":
        return is_rotary_axis(address[1])
    entry = counting.get((f"JOINT_{address[1]}", "TYPE")) if scope == "group" else None
    try:
        return entry is not None and read_figure(schema.parameters[TYPE], entry.text, "").value == "angular"
    except InvalidValueError:
        return False


# -- writing


def texts_of(file: ParameterFile) -> dict[str, str]:
    """Return the text of a configuration under "", and those of the files that it includes by their names.

    Raises FormatError for a value that no line can contain.
    """
    kept = file.header.extra.get(_KIND)
    kept = kept if isinstance(kept, dict) else {}
    lines = kept.get("lines")
    if not isinstance(lines, list):
        return {"": "\n".join(_new_text(file))}
    included = _included(file)
    ini = read_ini("\n".join(map(str, lines)), included.get)
    hal = kept.get("hal")
    edited = _Edited(file, ini, frozenset(map(str, hal)) if isinstance(hal, list) else frozenset())
    return {name: "\n".join(rows) for name, rows in edited.rows().items()}


def contents_of(file: ParameterFile, before: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the bytes of a configuration under "", and of each file beside it by its name.

    ``before`` are those from which the lines of the file were read; one of which no value was changed is
    returned as it is. Raises FormatError.
    """
    made = dict(before)
    for name, text in texts_of(file).items():
        plain, encoding, newline = _plain(before[name].decode("latin-1"))
        # Bytes that were not changed stay as they are: mixed line ends and marks of the file survive.
        if text != plain:
            made[name] = _encoded(text, encoding).replace(b"\n", newline.encode())
    return made


def _encoded(text: str, encoding: str) -> bytes:
    try:
        return text.encode(encoding)
    except UnicodeEncodeError as error:
        raise FormatError(
            f"'{error.object[error.start]}' is no character of latin-1, in which this text is"
        ) from None


def _included(file: ParameterFile) -> dict[str, str]:
    kept = file.header.extra.get(_KIND)
    included = kept.get("included") if isinstance(kept, dict) else None
    if not isinstance(included, dict):
        return {}
    return {str(name): "\n".join(map(str, rows)) for name, rows in included.items() if isinstance(rows, list)}


class _Edited:
    """The lines of a configuration with the values that a file has now."""

    def __init__(self, file: ParameterFile, ini: IniText, hal: frozenset[str]) -> None:
        self.file, self.ini = file, ini
        self.lines: dict[str, list[str | None]] = {name: list(rows) for name, rows in ini.lines.items()}
        self.written: set[Address] = set()
        for row in _rows(ini, file.schema, file.machine, hal):
            if row.address is not None and row.value is not None:
                self._value(row, row.address, row.value)
            elif row.unknown and row.unknown not in file.unknown:
                self._drop(row.entry)

    def rows(self) -> dict[str, list[str]]:
        """Return the lines of each file, with new values at the ends of their sections."""
        new = self._new_lines()
        # From the last section up: lines put in below do not move the places above.
        for section in sorted(new.keys() & self.ini.last.keys(), key=self.ini.last.__getitem__, reverse=True):
            at = self.ini.last[section] + 1
            self.lines[""][at:at] = new.pop(section)
        rows = {name: [row for row in lines if row is not None] for name, lines in self.lines.items()}
        for section, lines in new.items():
            main = rows[""]
            # A file that ends with a new line ends with one again.
            ends = bool(main) and main[-1] == ""
            main[len(main) - ends :] = ["", f"[{section}]", *lines, *[""] * ends]
        return rows

    def _new_lines(self) -> dict[str, list[str]]:
        """Return section -> the lines of values that have none yet."""
        new: dict[str, list[str]] = {}
        for address in self.file.addresses():
            value = self.file.get(address) if address not in self.written else None
            if value is not None and (line := _new_line(self.file, address, value)):
                new.setdefault(line[0], []).append(line[1])
        return new

    def _value(self, row: _Row, address: Address, before: Value) -> None:
        """Change, keep or take out the entry of a value."""
        value, unit = self.file.get(address), unit_in(self.file, address)
        self.written.add(address)
        if value is None:
            self._drop(row.entry)
        elif not same_value(value, before) or unit != row.unit:
            parameter = self.file.schema.parameters[address[0]]
            text = write_figure(parameter, value, unit)
            if not parameter.choices and parameter.type != "text":
                # What a person wrote behind the number stays.
                text += row.entry.text[len(number_in(parameter, row.entry.text)) :]
            lines = self.lines[row.entry.file]
            lines[row.entry.line] = with_value(str(lines[row.entry.line]), row.entry, text)
            if row.entry.lines > 1:
                lines[row.entry.line] = str(lines[row.entry.line]).removesuffix("\\")
            for at in range(row.entry.line + 1, row.entry.line + row.entry.lines):
                # Marked, not taken out: the entries below know their lines by number.
                lines[at] = None

    def _drop(self, entry: IniEntry) -> None:
        for at in range(entry.line, entry.line + entry.lines):
            self.lines[entry.file][at] = None


def unit_in(file: ParameterFile, address: Address) -> str:
    """Return the unit of a bare figure in the configuration of a file."""
    units = file.get((UNITS, ""))
    system = str(units.value) if units is not None and units.value in file.schema.family.units else "metric"
    return file.evaluation.unit(address, system)


def _new_line(file: ParameterFile, address: Address, value: Value) -> tuple[str, str] | None:
    """Return the section and the line of a value that has none yet."""
    name = re.fullmatch(r"\[([^\]]+)\](.+)", file.machine_schema.number(address) or "")
    if name is None:
        return None
    text = write_figure(file.schema.parameters[address[0]], value, unit_in(file, address))
    return (name[1], f"{name[2]} = {text}") if text else None


def _new_text(file: ParameterFile) -> Iterator[str]:
    """Yield the lines of a configuration that was never a text."""
    sections: dict[str, list[str]] = {}
    for address in file.addresses():
        value = file.get(address)
        if value is not None and (line := _new_line(file, address, value)):
            sections.setdefault(line[0], []).append(line[1])
    if not sections:
        raise FormatError("no parameter has a value: the file gives an empty configuration")
    yield f"{_HEAD} of {' '.join(file.header.name.split()) or 'a machine'}"
    for section, lines in sections.items():
        yield from ("", f"[{section}]", *lines)
    yield ""


def _write(file: ParameterFile) -> str:
    """Return the text of the INI file; raises FormatError for a change in one that it includes."""
    texts = texts_of(file)
    included = _included(file)
    if changed := [name for name, text in texts.items() if name and text != included[name]]:
        raise FormatError(
            f"a value of the included file {changed[0]} was changed: change it there, or send the file to the"
            " folder (folder:NAME.ini)"
        )
    kept = file.header.extra.get(_KIND)
    encoding = str(kept.get("encoding", "utf-8")) if isinstance(kept, dict) else "utf-8"
    return _encoded(texts[""], "latin-1" if encoding == "latin-1" else "utf-8").decode("latin-1")


def _newline(file: ParameterFile) -> str:
    kept = file.header.extra.get(_KIND)
    return "\r\n" if isinstance(kept, dict) and kept.get("newline") == "crlf" else "\n"


FORMAT = TextFormat(
    "ini",
    "LinuxCNC configuration",
    ".ini",
    _recognises,
    _read,
    _write,
    encoding="latin-1",
    around=(BOM_UTF8, b"\x1a"),
    newline_of=_newline,
    included=_included,
)
