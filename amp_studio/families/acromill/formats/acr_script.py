"""The script of commands that sets an ACR controller, as the terminal of AcroMill sends them (pages 91 and 113 to 135).

A setting is written in the form that its parameter names: ``PPU X4096``, ``EXC AXIS0 4``, ``NOTCH X(500, 50)``. One
setting is in a line; several axes behind one command are read too, as ``PPU X4096 Y4096`` is printed (page 114).
Written are scales, signs and limits before the gains they make safe (see ``ORDER``).
``REM`` begins a remark (page 128).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from amp_studio.files import ParameterFile
from amp_studio.formats.bare_figures import default_system, read_figure, system_of, write_figure
from amp_studio.formats.passthrough_lines import (
    PassthroughLine,
    keep,
    kept,
    mark,
    marked,
    neighbours,
    plain,
    shown,
)
from amp_studio.formats.text_format import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import Address, InvalidValueError, Schema, Value, load_schema, written

from .acr_command import Command, CommandArgument, CommandSetting, commands_of

FAMILY = "acromill"
_KIND = "acr"
_HEAD = "REM ACR command script"
_SIGNS = "cp437"
"""Commands are plain ASCII; of other signs, which a remark may contain, every byte comes back as it was."""
_MARK = "\ufeff".encode().decode(_SIGNS)
_MARK_SEEN_AS_LATIN = "\ufeff".encode().decode("latin-1")
_UNITS = re.compile(r"\s*REM\s+units\s+(\S+)\s*", re.IGNORECASE)
_REMARK = re.compile(r"\s*(REM\b.*)?", re.IGNORECASE | re.DOTALL)
_BEHIND = re.compile(r"\s*+(?:\(.*\)\s*+)?")
"""The guide's own remarks: ``MULT X-4     (Times 4 multiplication in opposite direction)`` (page 114)."""

_LONGEST_LINE = 1000

ORDER = ("PPU", "MULT", "DAC", "EXC", "TLM", "LOPASS", "NOTCH", "DWIDTH", "DGAIN", "FBVEL", "PGAIN", "IDELAY", "ILIMIT",
         "IGAIN", "FFVEL", "FFACC")  # fmt: skip
"""The order in which settings are written, by the word of their command; the others follow in the manual's order.

A controller obeys line by line, so a gain that came before its scale, sign or limit would move an axis with the old one.
The guide sets pulses, counting, polarity and error band first (page 114), then the torque limit and the damping before
P Gain, the integral and the feedforwards (page 115). Filters and the delay and limit of the integral come before the
gains they limit; that much is ours.
"""


# -- reading -------------------------------------------------------------------------------------------------------


@dataclass
class _ScriptLine:
    """A line of a script: its settings, or why it has none."""

    number: int
    text: str
    arguments: list[CommandArgument] = field(default_factory=list)
    fault: FormatError | None = None
    """Why the line is not understood."""


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    lines = list(_lines(text, commands_of(schema, schema.family.default_machine)))
    if options.keep_unknown:
        _set_aside_repeated(lines)
    found = TextRead()
    system = _read_system(lines, schema, found)
    place: dict[CommandSetting, int] = {}
    for line in lines:
        if line.fault is not None and not options.keep_unknown:
            raise line.fault
        for argument in line.arguments:
            before = place.setdefault(argument.setting, line.number)
            if before != line.number or argument.setting.addresses[0] in found.values:
                message = f"{argument.setting.name} occurs twice, in line {before} already"
                raise FormatError(message, line.number, argument.column)
            found.values.update(_values(schema, argument, line.number, system))
    keep(found, _KIND, [row for line in lines for row in _layout(line)])
    return found


def _lines(text: str, commands: list[Command]) -> Iterator[_ScriptLine]:
    for n, row in enumerate(text.removeprefix(_MARK).removeprefix(_MARK_SEEN_AS_LATIN).split("\n"), 1):
        line = _ScriptLine(n, row.rstrip("\r"))
        if len(line.text) > _LONGEST_LINE:
            line.fault = FormatError(f"the line is longer than {_LONGEST_LINE} signs", n)
        elif not _REMARK.fullmatch(line.text):
            try:
                line.arguments = list(_arguments(line, commands))
            except FormatError as fault:
                line.fault = fault
        yield line


def _arguments(line: _ScriptLine, commands: list[Command]) -> Iterator[CommandArgument]:
    """Yield the settings of a line; raises FormatError."""
    word = re.match(r"\s*([A-Z]+)(?:\s+|$)", line.text, re.IGNORECASE)
    known = [c for c in commands if word and c.word == word[1].upper()]
    at = word.end() if word and known else len(line.text) - len(line.text.lstrip())
    known = known or [c for c in commands if not c.word]
    is_first = True
    while is_first or not _BEHIND.fullmatch(line.text, at):
        argument = next((a for c in known if (a := c.read(line.text, at))), None)
        if argument is None or (not is_first and not known[0].word):
            raise _not_read(line, at, known)
        yield argument
        at, is_first = argument.end, False


def _not_read(line: _ScriptLine, at: int, known: list[Command]) -> FormatError:
    rest = line.text[at:].strip()
    text = rest if len(rest) <= 40 else rest[:39] + "…"
    if not known or not known[0].word:
        return FormatError(f"'{text}' is no command that sets a parameter here", line.number, at + 1)
    form = " or ".join(f"'{c.example}'" for c in known)
    what = f"'{text}' sets nothing: {known[0].word}" if rest else f"{known[0].word} alone sets nothing: it"
    return FormatError(
        f"{what} is written as {form}, for {', '.join(known[0].instances)}", line.number, at + 1
    )


def _set_aside_repeated(lines: list[_ScriptLine]) -> None:
    """Take what is set more than once for not understood: which value counts, the run of the script decides."""
    counts = Counter(a.setting for line in lines for a in line.arguments)
    twice = {setting for setting, count in counts.items() if count > 1}
    for line in lines:
        if any(a.setting in twice for a in line.arguments):
            line.arguments, line.fault = [], FormatError("it is set more than once", line.number)


def _read_system(lines: list[_ScriptLine], schema: Schema, found: TextRead) -> str:
    """Return the unit system of the figures, and set it where the script names it."""
    chooser = schema.family.unit_parameter
    for line in lines:
        named = _UNITS.fullmatch(line.text)
        if named and chooser:
            system = named[1].casefold()
            if system not in schema.family.units:
                offered = ", ".join(schema.family.units)
                raise FormatError(
                    f"'{named[1]}' is no unit system here: {offered}", line.number, named.start(1) + 1
                )
            found.values[chooser, ""] = Value(system)
            return system
    return default_system(schema) or next(iter(schema.family.units), "")


def _values(schema: Schema, argument: CommandArgument, line: int, system: str) -> dict[Address, Value]:
    values = {}
    for address, (text, column) in zip(argument.setting.addresses, argument.figures, strict=True):
        try:
            values[address] = read_figure(schema, schema.parameters[address[0]], text, system)
        except InvalidValueError as error:
            raise FormatError(str(error), line, column) from None
    return values


def _layout(line: _ScriptLine) -> list[PassthroughLine]:
    """Return what is kept of a line: a mark for each setting, or its text."""
    if line.arguments:
        return [PassthroughLine(mark(written(a.setting.addresses[0]))) for a in line.arguments]
    return [PassthroughLine(plain(line.text), str(line.number) if line.fault else "")]


def _recognises(text: str) -> bool:
    if text.startswith(_HEAD):
        return True
    try:
        schema = load_schema(FAMILY)
    except KeyError:
        return False
    lines = _lines(text[:20_000], commands_of(schema, schema.family.default_machine))
    return any(line.arguments for line in lines)


# -- writing -------------------------------------------------------------------------------------------------------


def _write(file: ParameterFile) -> str:
    system = system_of(file)
    rows = {s.addresses[0]: row for s in _settings(file) if (row := _row(file, s, system))}
    units = [f"REM units {system}"] if file.schema.family.unit_parameter else []
    layout = kept(file, _KIND)
    if layout is None:
        name = " ".join(
            f"{_HEAD} of {file.header.name or 'a machine'}".encode(_SIGNS, "replace").decode(_SIGNS).split()
        )
        return "\n".join([name, *units, *rows.values(), ""])
    return "\n".join(_filled(file, layout, rows, units if system != default_system(file.schema) else []))


def _settings(file: ParameterFile) -> list[CommandSetting]:
    """Return every setting that the family's commands can make, in ``ORDER``."""
    place = file.machine_schema.places
    rank = {word: n for n, word in enumerate(ORDER)}

    def order(setting: CommandSetting) -> tuple[int, int]:
        word = re.match("[A-Z]*", setting.template)
        return rank.get(word[0] if word else "", len(rank)), place[setting.addresses[0]]

    found = [s for command in commands_of(file.schema, file.machine) for s in command.settings]
    return sorted(found, key=order)


def _row(file: ParameterFile, setting: CommandSetting, system: str) -> str:
    """Return the line of a setting; empty where it is not set, or does not exist for this machine."""
    unset = [a for a in setting.addresses if file.get(a) is None]
    hidden = any(file.evaluation.state(a).state == "hidden" for a in setting.addresses)
    if hidden or len(unset) == len(setting.addresses):
        return ""
    if unset:
        needed = ", ".join(written(a) for a in unset)
        raise FormatError(f"{setting.name} has several values, and {needed} is not set")
    figures = []
    for address in setting.addresses:
        parameter, value = file.schema.parameters[address[0]], file.values[address]
        try:
            figures.append(write_figure(file.schema, parameter, value, system))
        except InvalidValueError as error:
            raise FormatError(f"{written(address)}: {error}") from None
    return setting.write(figures)


def _filled(
    file: ParameterFile, layout: list[str], rows: dict[Address, str], units: list[str]
) -> Iterator[str]:
    """Yield the lines of a kept script with the values of now; a new setting comes after all that go before it."""
    at = {what: n for n, row in enumerate(layout) if (what := marked(row))}
    there = {a: at[written(a)] for a in rows if written(a) in at}
    beside = neighbours(rows, there, there)
    front = [rows[a] for a in beside.get(None, [])]
    names = {written(a): a for a in rows}
    if units and not any(_UNITS.fullmatch(shown(row)) for row in layout):
        yield units[0]
    last = len(layout) - 1
    for n, row in enumerate(layout):
        what = marked(row)
        if what is None:
            if n == last and not shown(row) and front:
                yield from front
                front = []
            text = shown(row)
            yield (
                f"REM units {system_of(file)}"
                if file.schema.family.unit_parameter and _UNITS.fullmatch(text)
                else text
            )
            continue
        yield from front
        front = []
        if address := names.get(what):
            yield rows[address]
            yield from (rows[a] for a in beside.get(address, []))
    yield from front


FORMAT = TextFormat("acr", "ACR command script", ".acr", _recognises, _read, _write, _SIGNS, "\r\n")
