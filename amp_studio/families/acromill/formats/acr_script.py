"""The script of commands that sets an ACR controller,
as the terminal of AcroMill sends them (pages 91 and 113 to 135).

A setting is written in the form that its parameter names: ``PPU X4096``, ``EXC AXIS0 4``, ``NOTCH X(500,
50)``. One setting is in a line; several axes behind one command are read too, as ``PPU X4096 Y4096`` is
printed (page 114). Written are scales, signs and limits before the gains they make safe (see ``ORDER``).
``REM`` begins a remark (page 128).

A start-up program is such a script among other commands. Lines that set nothing are kept in their place, and
a setting is written back with every sign that it had; only a figure whose value has changed is another one.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from amp_studio.files import ParameterFile
from amp_studio.formats import (
    FormatError,
    PassthroughLine,
    ReadOptions,
    TextFormat,
    TextRead,
    default_system,
    escaped,
    file_of,
    keep_lines,
    lines_kept,
    neighbours,
    placeholder,
    placeholder_in,
    read_figure,
    system_of,
    unescaped,
    write_figure,
)
from amp_studio.schema import Address, InvalidValueError, Schema, Value, load_schema, same_value, written

from .acr_command import Command, CommandArgument, CommandSetting, commands_of, program_commands_of
from .acr_lines import CODE_PAGE, ScriptLine, arguments_of, first_word, script_lines, word_of

FAMILY = "acromill"
_KIND = "acr"
_HEAD = "REM ACR command script"
_UNITS = re.compile(r"\s*REM\s+units\s+(\S+)\s*", re.IGNORECASE)
_NEWLINE = "\r\n"
_SET = "set|"
"""Begins the mark of a kept line that sets something: the line as it was."""
_ATTACH = re.compile(
    r"\s*ATTACH\s+SLAVE[0-9]+\s+AXIS(?P<axis>[0-9]{1,2})\s+\"(?P<letter>[A-Z])\"", re.IGNORECASE
)
"""The letter that a program gives an axis."""
ORDER = (
    "PPU",
    "MULT",
    "DAC",
    "EXC",
    "TLM",
    "LOPASS",
    "NOTCH",
    "DWIDTH",
    "DGAIN",
    "FBVEL",
    "PGAIN",
    "IDELAY",
    "ILIMIT",
    "IGAIN",
    "FFVEL",
    "FFACC",
)
"""The order in which settings are written, by the word of their command;
the others follow in the manual's order.

A controller obeys line by line, so a gain that came before its scale, sign or limit would move an axis with
the old one. The guide sets pulses, counting, polarity and error band first (page 114), then the torque limit
and the damping before P Gain, the integral and the feedforwards (page 115). Filters and the delay and limit
of the integral come before the gains they limit; that much is ours.
"""


# -- reading


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return the values of a script; what sets nothing that is known is kept, or raises FormatError."""
    machine = schema.family.default_machine
    commands, of_programs = commands_of(schema, machine), program_commands_of(schema, machine)
    words = {command.word or first_word(command) for command in commands}
    lines = list(script_lines(text, [*commands, *of_programs], words))
    found = TextRead()
    system = _read_system(lines, schema, found)
    _check_letters(lines, schema.family.scopes["axis"].instances if "axis" in schema.family.scopes else ())
    # Before repeats are looked for: the forms of programs set one value in several lines by design.
    _keep_unequal(lines, of_programs, schema, system)
    if options.keep_unknown:
        _set_aside_repeated(lines)
    _take_values(found, lines, schema, system, options)
    found.kept = [line.text for line in lines if line.is_kept]
    found.notes += _note_of_kept(found.kept)
    keep_lines(found, _KIND, [_layout(line) for line in lines], always=not _is_ours(text, found, schema))
    script = found.extra.get(f"{_KIND}_script")
    if isinstance(script, dict) and "\r" not in text:
        # Only kept where it is not the controller's own line end, which a new script gets.
        script["newline"] = "lf"
    return found


def _note_of_kept(kept: list[str]) -> Iterator[str]:
    """Yield how many lines of a program are kept, and what they begin with."""
    if kept:
        first = sorted({word_of(text) for text in kept})
        count = f"{len(kept)} lines" if len(kept) > 1 else "1 line"
        yield f"{count} of the program set nothing here, kept in their place: {', '.join(first)}"


def _take_values(
    found: TextRead, lines: list[ScriptLine], schema: Schema, system: str, options: ReadOptions
) -> None:
    """Take what the lines set; raises FormatError for a line that is not understood,
    and for what two of them set.
    """
    place: dict[CommandSetting, int] = {}
    for line in lines:
        if line.fault is not None and not options.keep_unknown:
            raise line.fault
        for argument in line.arguments:
            before = place.setdefault(argument.setting, line.number)
            new = _values(schema, argument, line.number, system)
            is_other = any(found.values.get(address, value) != value for address, value in new.items())
            if before != line.number or is_other:
                message = f"{argument.setting.name} occurs twice, in line {before} already"
                raise FormatError(message, line.number, argument.column)
            found.values.update(new)
            found.value_lines.update(dict.fromkeys(new, line.number))


def _is_ours(text: str, result: TextRead, schema: Schema) -> bool:
    """Return whether a text would be written so in any case."""
    head, _, rest = text.partition("\n")
    if result.kept or not head.startswith(_HEAD):
        return False
    try:
        return _write(file_of(schema, TextRead(result.values), "")).partition("\n")[2] == rest
    except FormatError:
        return False


def _check_letters(lines: list[ScriptLine], letters: Sequence[str]) -> None:
    """Refuse settings by a letter that the program gives to another axis than it is here."""
    attached = ((_ATTACH.match(line.text), line.number) for line in lines)
    given = {found["letter"].upper(): (int(found["axis"]), at) for found, at in attached if found}
    other = {x: at for x, at in given.items() if x in letters and letters.index(x) != at[0]}
    for line in lines:
        # By the number of its axis a setting means the same axis, whatever letter the program gives it.
        by_letter = [each for each in line.arguments if "{i}" in each.setting.template]
        for argument in by_letter:
            letter = argument.setting.instance
            if letter in other:
                axis, at = other[letter]
                text = f"{letter} is AXIS{axis} of this program (line {at}), and here it is"
                here = letters.index(letter)
                line.fault = FormatError(f"{text} AXIS{here}", line.number, argument.column)
        if line.fault is not None:
            line.arguments = []


def _keep_unequal(lines: list[ScriptLine], commands: list[Command], schema: Schema, system: str) -> None:
    """Take settings in the forms of programs for text where not all of them are there with one value."""
    forms = _forms(commands)
    seen: dict[Address, list[tuple[ScriptLine, str, set[Value]]]] = {}
    for line in lines:
        for each in line.arguments:
            address = each.setting.addresses[0]
            if each.setting.template in forms.get(address, ()):
                parameter = schema.parameters[address[0]]
                values = {read_figure(schema, parameter, text, system) for text, _ in each.figures}
                seen.setdefault(address, []).append((line, each.setting.template, values))
    for address, some in seen.items():
        own, templates, figures = zip(*some, strict=True)
        # Forms with one word are written in place of each other, ACC and DEC beside each other.
        words = {template.partition(" ")[0] for template in forms[address]}
        if len(set().union(*figures)) > 1 or {each.partition(" ")[0] for each in templates} != words:
            for line in own:
                line.arguments, line.is_kept = [], True


def _forms(commands: list[Command]) -> dict[Address, set[str]]:
    """Return the forms in which programs set a value."""
    forms: dict[Address, set[str]] = {}
    for setting in chain.from_iterable(command.settings for command in commands):
        forms.setdefault(setting.addresses[0], set()).add(setting.template)
    return forms


def _set_aside_repeated(lines: list[ScriptLine]) -> None:
    """Take what is set more than once for not understood: which value counts, the run of the script
    decides.
    """
    counts = Counter(a.setting for line in lines for a in line.arguments)
    twice = {setting for setting, count in counts.items() if count > 1}
    for line in lines:
        if any(a.setting in twice for a in line.arguments):
            line.arguments, line.fault = [], FormatError("it is set more than once", line.number)


def _read_system(lines: list[ScriptLine], schema: Schema, result: TextRead) -> str:
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
            result.values[chooser, ""] = Value(system)
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


def _layout(line: ScriptLine) -> PassthroughLine:
    """Return what is kept of a line."""
    if line.arguments:
        return PassthroughLine(placeholder(_SET + line.text))
    return PassthroughLine(escaped(line.text), str(line.number) if line.fault else "")


def _recognises(text: str) -> bool:
    """Return whether a text has our heading or a command that sets a parameter."""
    if text.startswith(_HEAD):
        return True
    try:
        schema = load_schema(FAMILY)
    except KeyError:
        return False
    machine = schema.family.default_machine
    commands = [*commands_of(schema, machine), *program_commands_of(schema, machine)]
    # The beginning shows what it is; a file of another kind may be long.
    lines = script_lines(text[:20_000], commands, set())
    return any(line.arguments for line in lines)


# -- writing


def _write(file: ParameterFile) -> str:
    """Return a file as a script, in the lines that it was read from where there are any."""
    system = system_of(file)
    rows = {s.addresses[0]: row for s in _settings(file) if (row := _row(file, s, system))}
    units = [f"REM units {system}"] if file.schema.family.unit_parameter else []
    layout = lines_kept(file, _KIND)
    if layout is None:
        name = " ".join(
            f"{_HEAD} of {file.header.name or 'a machine'}".encode(CODE_PAGE, "replace")
            .decode(CODE_PAGE)
            .split()
        )
        return "\n".join([name, *units, *rows.values(), ""])
    is_clear = system == default_system(file.schema) or any(
        _UNITS.fullmatch(unescaped(row)) for row in layout
    )
    return "\n".join([*([] if is_clear else units), *_filled(file, layout, rows)])


def _settings(file: ParameterFile) -> list[CommandSetting]:
    """Return every setting that the family's commands can make, in ``ORDER``."""
    place = file.machine_schema.places
    rank = {word: n for n, word in enumerate(ORDER)}

    def order(setting: CommandSetting) -> tuple[int, int]:
        word = re.match("[A-Z]*", setting.template)
        return rank.get(word[0] if word else "", len(rank)), place[setting.addresses[0]]

    settings = [s for command in commands_of(file.schema, file.machine) for s in command.settings]
    return sorted(settings, key=order)


def _row(file: ParameterFile, setting: CommandSetting, system: str) -> str:
    """Return the line of a setting; empty where it is not set, or does not exist for this machine."""
    not_set = [a for a in setting.addresses if file.get(a) is None]
    hidden = any(file.evaluation.state(a).state == "hidden" for a in setting.addresses)
    if hidden or len(not_set) == len(setting.addresses):
        return ""
    if not_set:
        needed = ", ".join(written(a) for a in not_set)
        raise FormatError(f"{setting.name} has several values, and {needed} is not set")
    figures = []
    for address in setting.addresses:
        parameter, value = file.schema.parameters[address[0]], file.values[address]
        try:
            figures.append(write_figure(file.schema, parameter, value, system))
        except InvalidValueError as error:
            raise FormatError(f"{written(address)}: {error}") from None
    return setting.write(figures)


def _filled(file: ParameterFile, layout: list[str], rows: dict[Address, str]) -> Iterator[str]:
    """Yield the lines of a kept script with the values of now;
    a new setting comes after all that go before it.
    """
    machine = file.machine
    commands = [*commands_of(file.schema, machine), *program_commands_of(file.schema, machine)]
    kept_lines = _kept_lines(layout, commands)
    there = _line_of_each(layout, kept_lines, rows)
    new = {place: [rows[a] for a in those] for place, those in neighbours(rows, there, there).items()}
    named = {written(a): (a, row) for a, row in rows.items()}
    system = system_of(file)
    for n, row in enumerate(layout):
        text, what = unescaped(row), placeholder_in(row)
        if what is not None or (n == len(layout) - 1 and not text):
            yield from new.pop(None, [])
        if what is None:
            yield _unit_remark(file, text, system)
            continue
        here, lines = _set_here(file, kept_lines.get(n), named.get(what), system)
        yield from lines
        for address in here:
            yield from new.pop(address, [])
    yield from new.pop(None, [])


def _line_of_each(
    layout: list[str], kept_lines: dict[int, ScriptLine], rows: Iterable[Address]
) -> dict[Address, int]:
    """Return the line of the kept script that sets each address, of those that it sets."""
    at = {
        written(address): n
        for n, line in kept_lines.items()
        for argument in line.arguments
        for address in argument.setting.addresses
    }
    at |= {what: n for n, row in enumerate(layout) if (what := placeholder_in(row)) and n not in kept_lines}
    return {a: at[written(a)] for a in rows if written(a) in at}


def _set_here(
    file: ParameterFile, line: ScriptLine | None, new: tuple[Address, str] | None, system: str
) -> tuple[list[Address], list[str]]:
    """Return the addresses that a row of the layout sets, and its lines with the values of now: those of a
    kept line as it was written, else the row as it is written ``new``.
    """
    if line is not None:
        addresses = [a for argument in line.arguments for a in argument.setting.addresses[:1]]
        return addresses, [text for text in [_with_values(file, line, system)] if text]
    return ([new[0]], [new[1]]) if new else ([], [])


def _kept_lines(layout: list[str], commands: list[Command]) -> dict[int, ScriptLine]:
    """Return the kept lines that set something; raises FormatError for one that sets nothing any more."""
    lines: dict[int, ScriptLine] = {}
    for n, row in enumerate(layout):
        if (what := placeholder_in(row) or "").startswith(_SET):
            lines[n] = ScriptLine(n + 1, what.removeprefix(_SET))
            lines[n].arguments = list(arguments_of(lines[n], commands))
    return lines


def _unit_remark(file: ParameterFile, text: str, system: str) -> str:
    """Return a line that sets nothing; the remark that names the unit of the figures has that of now."""
    named = _UNITS.fullmatch(text)
    if named is None or not file.schema.family.unit_parameter or named[1].casefold() == system:
        return text
    return f"REM units {system}"


def _with_values(file: ParameterFile, line: ScriptLine, system: str) -> str:
    """Return a line of a script with the values of now, every other character as it was;
    empty where none of them is set.
    """
    text, is_any = line.text, False
    # From the end, so that the columns before it stay where they were read.
    for argument in reversed(line.arguments):
        if not _row(file, argument.setting, system):
            text = text[: argument.column - 1] + text[argument.end :]
            continue
        is_any = True
        for address, (figure, column) in reversed(
            list(zip(argument.setting.addresses, argument.figures, strict=True))
        ):
            parameter, value = file.schema.parameters[address[0]], file.values[address]
            # An equal value keeps its spelling: 4096.0 stays 4096.0.
            if not same_value(value, read_figure(file.schema, parameter, figure, system)):
                new, begin = write_figure(file.schema, parameter, value, system), column - 1
                if new.startswith("-") and text[begin - 1 : begin] == "-":  # the other side of a band
                    new, begin = new[1:], begin - 1
                text = text[:begin] + new + text[column - 1 + len(figure) :]
    return text.rstrip() if is_any and text != line.text else text if is_any else ""


def _newline_of(file: ParameterFile) -> str:
    kept_script = file.header.extra.get(f"{_KIND}_script")
    is_lf = isinstance(kept_script, dict) and kept_script.get("newline") == "lf"
    return "\n" if is_lf else _NEWLINE


FORMAT = TextFormat(
    "acr",
    "ACR command script",
    ".acr",
    _recognises,
    _read,
    _write,
    CODE_PAGE,
    _NEWLINE,
    newline_of=_newline_of,
)
