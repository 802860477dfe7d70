"""The registers of a control: which parameter each belongs to, and the values that written registers mean.

Where a register means several parameters (a gear ratio as one number or as two, page 4-15; the points of a
cam table, page 4-57) the one that exists for the machine counts, as its other registers decide.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from amp_studio.files import Header, ParameterFile
from amp_studio.formats import FormatError
from amp_studio.schema import (
    WORD,
    Address,
    Parameter,
    Schema,
    StorageError,
    Value,
    is_low_first,
    register_number,
    value_of_register,
    value_of_words,
    words_of,
    words_taken,
    written,
)


@dataclass(frozen=True)
class Written:
    """A number that a text writes to a register, or to two of them."""

    register: int
    number: int
    is_pattern: bool
    """The number is the bits as they are (hexadecimal), and has no sign."""
    words: int
    line: int
    column: int
    value_column: int


@dataclass(frozen=True)
class NumberInRegisters:
    """The number in the registers of a value."""

    address: Address
    register: int
    number: int
    words: tuple[int, ...]
    """The content of each of its registers, 0 to 65535."""


class Registers:
    """The registers of a family's machine type."""

    def __init__(self, schema: Schema, machine: str) -> None:
        self.schema, self.machine = schema, machine
        self.first: dict[Address, int] = {}
        self.claims: dict[int, list[Address]] = {}
        for address in schema.on(machine).addresses:
            match = re.fullmatch(r"[^0-9]*([0-9]+)", schema.on(machine).number(address) or "")
            if match:
                self.first[address] = int(match[1])
                for register in self.of(address):
                    self.claims.setdefault(register, []).append(address)

    def of(self, address: Address) -> range:
        """Return the registers of a value."""
        first = self.first[address]
        return range(first, first + words_taken(self.parameter(address)))

    def parameter(self, address: Address) -> Parameter:
        return self.schema.parameters[address[0]]

    def unit(self, address: Address) -> str:
        return self.schema.units_of(self.parameter(address))[0]

    def label(self, address: Address) -> str:
        """Return ``Proportional Gain (Y axis)``."""
        instance = self.schema.on(self.machine).instance_label(address)
        return f"{self.parameter(address).name} ({instance})" if instance else self.parameter(address).name


@lru_cache(maxsize=8)
def registers_of(schema: Schema, machine: str) -> Registers:
    """Return the registers of a family on one machine type: thousands of them,
    worked out once for all its files.
    """
    return Registers(schema, machine)


# -- values to registers


def contents_of(file: ParameterFile, registers: Registers) -> list[NumberInRegisters]:
    """Return the content of the registers for a file, by rising number:
    the values that exist and can be written.

    Raises FormatError for a value that does not fit, and where two values share a register.
    """
    contents: list[NumberInRegisters] = []
    owner: dict[int, Address] = {}
    for address in file.addresses():
        value = file.get(address)
        if value is None or address not in registers.first or not is_writable(file, address):
            continue
        parameter, unit = registers.parameter(address), registers.unit(address)
        for register in registers.of(address):
            other = owner.setdefault(register, address)
            if other != address:
                message = f"{written(other)} and {written(address)} are both set, and both are stored in it"
                raise FormatError(f"register {register} contains one of two values: {message}")
        try:
            number, words = register_number(parameter, value, unit), words_of(parameter, value, unit)
        except StorageError as error:
            raise FormatError(f"register {registers.first[address]}, {written(address)}: {error}") from None
        contents.append(NumberInRegisters(address, registers.first[address], number, words))
    return sorted(contents, key=lambda content: content.register)


def is_writable(file: ParameterFile, address: Address) -> bool:
    """Return whether a value exists for this machine, and the control lets it be written."""
    return (
        file.schema.parameters[address[0]].access != "read"
        and file.evaluation.state(address).state != "hidden"
    )


# -- registers to values


@dataclass(frozen=True)
class _RegisterContent:
    """The content of one register."""

    word: int
    source: Written


class RegisterValues:
    """The values that written registers mean; ``leftover`` are those that mean none, where they are
    wanted.
    """

    def __init__(self, registers: Registers, keep_unknown: bool) -> None:
        self.registers, self.keep_unknown = registers, keep_unknown
        self.values: dict[Address, Value] = {}
        self.lines: dict[Address, int] = {}
        """The line in which each of these begins."""
        self.leftover: dict[Written, None] = {}
        self._cells: dict[int, _RegisterContent] = {}
        self._done: set[int] = set()

    def take(self, source: Written) -> None:
        """Take one written number; raises FormatError where a register is written twice
        or the number is too long.
        """
        bits = WORD * source.words
        # Decimal numbers may be signed or not: both forms of a word are in use.
        low = 0 if source.is_pattern else -(1 << (bits - 1))
        if not low <= source.number < 1 << bits:
            what = "two registers" if source.words > 1 else "a register"
            raise FormatError(
                f"{source.number} does not fit the {bits} bits of {what}", source.line, source.value_column
            )
        for register, word in _split(source):
            before = self._cells.setdefault(register, _RegisterContent(word, source))
            if before.source is not source:
                message = f"register {register} is written twice, in line {before.source.line} already"
                raise FormatError(message, source.line, source.column)

    def settle(self) -> None:
        """Find what the registers mean; raises FormatError at the first that means nothing."""
        several = []
        for register in sorted(self._cells):
            claims = self.registers.claims.get(register, [])
            if len(claims) > 1:
                several.append(register)
            else:
                self._decide(register, claims, "is of no parameter")
        # Shared registers last: which of their parameters exists depends on the others.
        file = ParameterFile(self.registers.schema, Header(machine=self.registers.machine))
        file.take(self.values)
        for register in several:
            claims = self.registers.claims[register]
            existing = [a for a in claims if file.evaluation.state(a).state != "hidden"]
            why = dict.fromkeys(file.evaluation.state(a).why for a in claims)
            self._decide(register, existing, f"means nothing here: {'; '.join(w for w in why if w)}")

    def _decide(self, register: int, claims: list[Address], text: str) -> None:
        """Give a register to the one value that claims it; raises FormatError where several do."""
        if register in self._done:
            return
        cell = self._cells[register]
        if len(claims) > 1:
            names = " or ".join(written(a) for a in claims)
            raise self._fault(cell, f"register {register} means {names} here")
        if not claims:
            self._keep_unknown(register, f"register {register} {text}")
            return
        mine = self.registers.of(claims[0])
        missing = [str(r) for r in mine if r not in self._cells]
        if missing:
            name, numbers = self.registers.label(claims[0]), ", ".join(map(str, mine))
            self._keep_unknown(
                register,
                f"register {register} is half of {name}, registers {numbers}, and {', '.join(missing)} is"
                " missing",
            )
            return
        if self.registers.parameter(claims[0]).access == "read":
            raise self._fault(
                cell, f"register {register}, {self.registers.label(claims[0])}, can only be read"
            )
        self.values[claims[0]] = self._value(claims[0], [self._cells[r] for r in mine])
        self.lines[claims[0]] = self._cells[mine[0]].source.line
        self._done.update(mine)

    def _value(self, address: Address, cells: list[_RegisterContent]) -> Value:
        """Return the value that the words of some registers mean; raises FormatError."""
        parameter, unit = self.registers.parameter(address), self.registers.unit(address)
        source = cells[0].source
        is_whole = source.words == len(cells) and all(cell.source is source for cell in cells)
        try:
            # A signed number is taken as it was written; words in bits are put together first.
            if is_whole and not source.is_pattern and not is_low_first(parameter):
                return value_of_register(parameter, source.number, unit)
            return value_of_words(parameter, tuple(cell.word for cell in cells), unit)
        except StorageError as error:
            raise FormatError(str(error), source.line, source.value_column) from None

    def _keep_unknown(self, register: int, text: str) -> None:
        cell = self._cells[register]
        if not self.keep_unknown:
            raise self._fault(cell, text)
        self.leftover[cell.source] = None
        self._done.add(register)

    @staticmethod
    def _fault(cell: _RegisterContent, text: str) -> FormatError:
        return FormatError(text, cell.source.line, cell.source.column)


def _split(source: Written) -> Iterator[tuple[int, int]]:
    """Yield register and word of a written number;
    of a double word the first register is the upper half (page 4-48).
    """
    for n in range(source.words):
        yield source.register + n, source.number >> WORD * (source.words - 1 - n) & 0xFFFF
