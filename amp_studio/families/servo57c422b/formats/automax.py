"""AutoMax texts of the 57C422B: a table of registers, and the assignments of a BASIC task.

A line of the table is the number of a register and its content, in decimals or, as the tasks of the manual
write it, in hexadecimals (``01414H``, page 5-5). A double word is two registers. The task sets variables:
``%`` is one register, ``!`` a double word (page 4-48).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from amp_studio.files import ParameterFile
from amp_studio.formats import (
    FormatError,
    PassthroughLine,
    ReadOptions,
    TextFormat,
    TextRead,
    escaped,
    keep_lines,
    lines_kept,
    neighbours,
    placeholder,
    placeholder_in,
    unescaped,
)
from amp_studio.schema import Address, InvalidValueError, Schema, is_low_first, show_value

from .basic_text import BasicLine, BasicStatement, read_lines
from .registers import NumberInRegisters, Registers, RegisterValues, Written, contents_of, registers_of
from .word_text import read_word, write_hexadecimal

_CODE_PAGE = "cp437"
"""What DOS files are written in; every byte of theirs is a character of it."""


def _remark(file: ParameterFile, registers: Registers, address: Address) -> str:
    """Return ``Command Velocity (X axis), 160000 counts/s`` in characters that a DOS file has."""
    message = f"{registers.label(address)}, {show_value(registers.parameter(address), file.get(address))}"
    return _in_code_page(message)


def _in_code_page(text: str) -> str:
    return " ".join(text.encode(_CODE_PAGE, "replace").decode(_CODE_PAGE).split())


def _number(registers: Registers, of: NumberInRegisters) -> str:
    """Write the number of a register: the bits of a word, and what no signed number can express,
    in hexadecimals.
    """
    storage = registers.parameter(of.address).storage
    bits = 16 * len(of.words)
    # An unsigned number beyond the signed range has no decimal form that a task would take.
    if (storage and storage.notation == "hex" and of.number) or of.number >= 1 << (bits - 1):
        return write_hexadecimal(of.number & ((1 << bits) - 1))
    return str(of.number)


# -- the table

_TABLE_HEAD = "! Register table"
_ROW = re.compile(r"(\s*R?)([0-9]{1,9})(\s*[,;=]\s*|\s+)([^\s!]+)", re.IGNORECASE)


_DECIMAL = re.compile(r"[+-]?[0-9]+\.[0-9]+")
_WORD = re.compile(r"[+-]?[0-9][0-9A-F]*H?", re.IGNORECASE)
_SECTION = re.compile(r"^[ \t]*\[\w+\][ \t\r]*$", re.MULTILINE)


def _is_table(text: str) -> bool:
    """Return whether most lines are rows; a table with a line that is none gets a message about that line.
    Numbers below the head of a section ([grbl]) are of an INI.
    """
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("!")]
    texts = [row[4] if (row := _ROW.match(line)) else "" for line in lines]
    # Registers are whole numbers.
    is_other = sum(bool(_DECIMAL.fullmatch(text)) for text in texts) > 2 or _SECTION.search(text) is not None
    is_table = not is_other and 2 * sum(bool(_WORD.fullmatch(text)) for text in texts) > len(lines)
    return text.startswith(_TABLE_HEAD) or is_table


def _write_table(file: ParameterFile) -> str:
    """Return a file as a table of registers."""
    registers = registers_of(file.schema, file.machine)
    rows: dict[int, str] = {}
    for key, text in file.unknown.items():
        if re.fullmatch(r"R[0-9]{1,9}", key):
            rows[int(key[1:])] = f"{key[1:]}\t{_kept_word(key, text)}"
    for one in contents_of(file, registers):
        remark = _remark(file, registers, one.address)
        if len(one.words) == 1:
            rows[one.register] = f"{one.register}\t{_number(registers, one)}\t{remark}"
            continue
        for n, word in enumerate(one.words):
            # In bits: half of a number has no sign, and is no number that a person would read.
            rows[one.register + n] = f"{one.register + n}\t{write_hexadecimal(word)}\t" + (
                remark if n == 0 else "the rest of it"
            )
    head = f"{_TABLE_HEAD} of {file.header.name or 'a module'}, {file.schema.family.name}"
    return "\n".join(
        [_in_code_page(head), "! register\tvalue\tparameter", *(rows[n] for n in sorted(rows)), ""]
    )


def _read_table(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what a table of registers contains."""
    machine = schema.family.default_machine
    meaning = RegisterValues(registers_of(schema, machine), options.keep_unknown)
    for n, line in enumerate(_lines(text), 1):
        if not line.strip() or line.lstrip().startswith("!"):
            continue
        row = _ROW.match(line)
        if row is None:
            raise FormatError("a line is the number of a register and its value", n)
        try:
            number, is_pattern = read_word(row[4])
        except InvalidValueError as error:
            raise FormatError(str(error), n, row.start(4) + 1) from None
        meaning.take(Written(int(row[2]), number, is_pattern, 1, n, row.start(2) + 1, row.start(4) + 1))
    meaning.settle()
    unknown = {f"R{one.register}": _message(one) for one in meaning.leftover}
    lines = {f"R{one.register}": one.line for one in meaning.leftover}
    return TextRead(meaning.values, unknown, lines, meaning.lines, machine=machine)


def _kept_word(key: str, text: str) -> str:
    """Return a word that was kept without knowing its register;
    raises FormatError where a person made it none.
    """
    try:
        read_word(text)
    except InvalidValueError as error:
        raise FormatError(f"{key}: {error}") from None
    return text


def _message(one: Written) -> str:
    return write_hexadecimal(one.number) if one.is_pattern else str(one.number)


def _lines(text: str) -> list[str]:
    """Return the lines of a DOS file, without the character that ends it."""
    return [line.removesuffix("\r") for line in text.rstrip("\x1a").split("\n")]


# -- the task

_KIND = "basic"
_SET = re.compile(r"(?:LET\s+)?([A-Z][A-Z0-9_]*[%!]?)\s*=\s*(.*)", re.IGNORECASE | re.DOTALL)
_FIRST_LINE, _LAST_LINE, _STEP = 2000, 29999, 10


class Variables:
    """The names of registers in a task: those of the manual's own tasks, else ``REG_`` and the number.

    The configuration of a rack gives the names (page 4-2). Which variable is which register the family's
    table ``basic-variables`` lists; ``REG_64%`` is printed for register 64 (page 4-48) and does for every
    other one.
    """

    def __init__(self, schema: Schema) -> None:
        table = schema.tables.get("basic-variables")
        rows = (
            zip(table.column("Variable") or (), table.column("Register") or (), strict=True) if table else ()
        )
        self._registers = {str(name).upper(): int(register) for name, register in rows}
        self._names = {(n, _words(name)): name for name, n in self._registers.items()}

    def register(self, name: str) -> int | None:
        """Return the first register of a variable; None for one that is none."""
        numbered = re.fullmatch(r"REG_([0-9]{1,9})[%!]", name.upper())
        return int(numbered[1]) if numbered else self._registers.get(name.upper())

    def name(self, register: int, words: int) -> str:
        return self._names.get((register, words)) or f"REG_{register}{'!' if words == 2 else '%'}"


def _words(name: str) -> int:
    return 2 if name.endswith("!") else 1


def _is_task(text: str) -> bool:
    return bool(
        re.search(
            r"^[ \t]*[0-9]+[ \t]+(?:LET\s+)?[A-Z][A-Z0-9_]*\s?[%!]\s*=", text, re.IGNORECASE | re.MULTILINE
        )
    )


def _write_task(file: ParameterFile) -> str:
    """Return a file as assignments of a BASIC task, in the lines that it was read from if there are any."""
    registers, variables = registers_of(file.schema, file.machine), Variables(file.schema)
    # A variable is one register or two: longer values have none.
    settings = [one for one in contents_of(file, registers) if len(one.words) <= 2]
    statements = {one.register: _assignment(registers, variables, one) for one in settings}
    layout = lines_kept(file, _KIND)
    if layout is not None:
        return _filled(layout, [(one.register, len(one.words)) for one in settings], statements)
    # Stable: all else keeps the order of the manual, and what starts to act finds its setups there.
    settings.sort(key=lambda one: _acts_at_once(file, one.address))
    # Gaps of ten, as people number BASIC; without them where the lines would run out.
    step = _STEP if _FIRST_LINE + _STEP * len(settings) <= _LAST_LINE else 1
    if _FIRST_LINE + step * len(settings) > _LAST_LINE:
        raise FormatError(f"{len(settings)} assignments are more than a task has lines for")
    lines = [_in_code_page(f"1000 ! {file.header.name or 'A module'}, {file.schema.family.name}")]
    for n, one in enumerate(settings):
        remark = _remark(file, registers, one.address)
        lines.append(f"{_FIRST_LINE + n * step} {statements[one.register]} \\!{remark}")
    return "\n".join([*lines, ""])


def _assignment(registers: Registers, variables: Variables, of: NumberInRegisters) -> str:
    """Return the assignment of a register; two of them where a ``!``,
    whose first register is the upper half, will not do.
    """
    if is_low_first(registers.parameter(of.address)):
        return " \\ ".join(
            f"{variables.name(of.register + n, 1)}={write_hexadecimal(word)}"
            for n, word in enumerate(of.words)
        )
    return f"{variables.name(of.register, len(of.words))}={_number(registers, of)}"


def _acts_at_once(file: ParameterFile, address: Address) -> bool:
    """Return whether the module acts on a register as soon as it is written: such ones come last in a
    task.
    """
    return (file.schema.parameters[address[0]].effect or file.schema.family.effect).level == "at-once"


def _filled(layout: list[str], settings: list[tuple[int, int]], statements: dict[int, str]) -> str:
    """Return a task as it was kept, with the values of now; a new one comes beside the register before it."""
    lines = list(read_lines("\n".join(layout)))
    marked = _registers_in(lines)
    there = [first for first, _ in settings if first in marked]
    beside = neighbours([first for first, _ in settings], there)
    front = [statements[n] for n in beside.get(None, [])]
    text = []
    for line in lines:
        for statement in line.statements:
            mine = _marked_registers(statement)
            if not mine:
                line.replace(statement, [unescaped(statement.text)])
            else:
                line.replace(statement, front + _statements_at(mine, beside, statements))
                front = []
        text.append(line.text)
    if front:
        # No kept register comes before these: they go to the front of the first line.
        text[0] = lines[0].with_first(front)
    return "\n".join([*text, ""])


def _registers_in(lines: Sequence[BasicLine]) -> set[int]:
    """Return the registers that have a mark in a task."""
    return {register for line in lines for s in line.statements for register in _marked_registers(s)}


def _statements_at(
    mark: tuple[int, ...], beside: Mapping[int | None, Sequence[int]], statements: Mapping[int, str]
) -> list[str]:
    """Return the statements of the registers of a mark that are set, each with the new ones beside it."""
    present = [first for first in mark if first in statements]
    return [statements[r] for first in present for r in (first, *beside.get(first, []))]


def _marked_registers(statement: BasicStatement) -> tuple[int, ...]:
    """Return the registers whose mark a statement is; none for any other."""
    what = placeholder_in(statement.text) or ""
    return tuple(map(int, what.split("+"))) if re.fullmatch(r"[0-9]{1,9}(\+[0-9]{1,9})*", what) else ()


def _read_task(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what the assignments of a BASIC task set."""
    variables, machine = Variables(schema), schema.family.default_machine
    lines = list(read_lines("\n".join(_lines(text))))
    settings = _settings(lines, variables, keep_unknown=options.keep_unknown)
    if options.keep_unknown:  # which of several values counts, the run of the task decides
        counts = Counter(one.register for one in settings.values())
        settings = {key: one for key, one in settings.items() if counts[one.register] == 1}
    meaning = RegisterValues(registers_of(schema, machine), options.keep_unknown)
    for one in settings.values():
        meaning.take(one)
    meaning.settle()
    settings = {key: one for key, one in settings.items() if one not in meaning.leftover}
    found = TextRead(meaning.values, value_lines=meaning.lines, machine=machine)
    keep_lines(found, _KIND, [_row(line, settings) for line in lines])
    return found


def _settings(lines: Sequence[BasicLine], variables: Variables, *, keep_unknown: bool) -> dict[int, Written]:
    """Return the ``id`` of each statement that sets something -> what it writes; raises FormatError for any
    other one, unless it is kept.
    """
    settings: dict[int, Written] = {}
    for line in lines:
        for statement in line.statements:
            try:
                settings[id(statement)] = _setting(statement, variables)
            except FormatError:
                if not keep_unknown:
                    raise
            if re.match(r"IF\b", statement.text, re.IGNORECASE):
                break  # what follows in the line hangs on the condition (page 4-48)
    return settings


def _row(line: BasicLine, settings: dict[int, Written]) -> PassthroughLine:
    """Return a line with a mark where each setting was."""
    is_known = all(id(statement) in settings for statement in line.statements)
    for statement in line.statements:
        if id(statement) in settings:
            one = settings[id(statement)]
            line.replace(statement, [placeholder("+".join(str(one.register + n) for n in range(one.words)))])
        else:
            line.replace(statement, [escaped(statement.text)])
    return PassthroughLine(line.text, "" if is_known else line.number)


def _setting(statement: BasicStatement, variables: Variables) -> Written:
    """Return what an assignment writes; raises FormatError for a statement that is none, or of nothing
    known.
    """
    match = _SET.fullmatch(statement.text)
    if match is None:
        raise statement.fault(f"'{statement.short}' assigns no value to a register")
    register = variables.register(match[1])
    if register is None:
        raise statement.fault(f"{match[1]} is the variable of no register: REG_3% is that of register 3")
    column = statement.column + match.start(2)
    try:
        number, is_pattern = read_word(match[2])
    except InvalidValueError as error:
        raise FormatError(f"{match[1]}: {error}", statement.line, column) from None
    return Written(register, number, is_pattern, _words(match[1]), statement.line, statement.column, column)


TABLE = TextFormat(
    "registers", "AutoMax register table", ".reg", _is_table, _read_table, _write_table, _CODE_PAGE, "\r\n"
)
TASK = TextFormat(
    "basic", "AutoMax BASIC task", ".bas", _is_task, _read_task, _write_task, _CODE_PAGE, "\r\n"
)
