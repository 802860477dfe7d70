"""What the registers of a module contain: those that an application sets, under a line that names the kind.

Command, mode and interrupt registers (64 to 67, 104, 105, 4095) start motions or answer them: they are read
live and never part of a content, of a copy, or of a download.
"""

from __future__ import annotations

import re
from functools import cache

from amp_studio.families.servo57c422b.formats.registers import (
    Registers,
    RegisterValues,
    Written,
    contents_of,
    registers_of,
)
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, TextRead, file_of
from amp_studio.schema import load_schema
from amp_studio.transfer import ImageError, TakesAllOrRefuses

KIND = "57C422B registers 1"
FAMILY = "57c422b"
AXIS_Y = 2048
"""What is added to a register of the X axis for the same of the Y axis (page 4-1)."""
LIVE = frozenset((64, 65, 66, 67, 104, 105, AXIS_Y - 1))
_LINE = re.compile(r"R([0-9]{1,4}) ([0-9]{1,5})")
_NAMED = 5


@cache
def _known_registers() -> Registers:
    """Return the registers of the family."""
    schema = load_schema(FAMILY)
    return registers_of(schema, schema.family.default_machine)


@cache
def settings() -> tuple[int, ...]:
    """Return the registers that a content has, by rising number."""
    known = _known_registers()
    return tuple(
        register
        for register in sorted(known.claims)
        if register % AXIS_Y not in LIVE
        and any(known.parameter(a).access != "read" for a in known.claims[register])
    )


def written_content(words: dict[int, int]) -> bytes:
    """Return the content of registers."""
    return "".join([f"{KIND}\n", *(f"R{register} {words[register]}\n" for register in settings())]).encode(
        "ascii"
    )


def words_of_content(content: bytes) -> dict[int, int]:
    """Return register -> what it contains; raises ImageError for what is no content."""
    head, *lines = content.decode("latin-1").split("\n")
    if head != KIND or not lines or lines[-1]:
        raise ImageError("the content of the registers is cut off or another kind")
    words: dict[int, int] = {}
    for number, line in enumerate(lines[:-1], 2):
        found = _LINE.fullmatch(line)
        if found is None or int(found[2]) > 0xFFFF or int(found[1]) in words:
            raise ImageError(f"line {number} of the registers is not a register and a number from 0 to 65535")
        words[int(found[1])] = int(found[2])
    if words.keys() != set(settings()):
        raise ImageError("the content does not have the registers that a module has")
    # Another order or a leading zero would have another checksum for the same registers.
    if written_content(words) != content:
        raise ImageError("the registers would be written otherwise")
    return words


class RegisterContent(TakesAllOrRefuses):
    """Between a parameter file and the registers of one module."""

    has_header = False

    def decode(self, content: bytes) -> ParameterFile:
        """Return what the registers mean; raises ImageError."""
        values = RegisterValues(_known_registers(), keep_unknown=True)
        try:
            for register, word in words_of_content(content).items():
                if any(
                    _known_registers().parameter(a).access != "read"
                    for a in _known_registers().claims[register]
                ):
                    values.take(Written(register, word, True, 1, 0, 0, 0))
            values.settle()
        except FormatError as error:
            raise ImageError(f"the registers of the module: {error.what}") from None
        return file_of(load_schema(FAMILY), TextRead(values.values), "module")

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return the registers with the values of a file in them; raises ImageError."""
        words = words_of_content(current)
        try:
            contents = contents_of(file, _known_registers())
        except FormatError as error:
            raise ImageError(error.what) from None
        for each in contents:
            for register, word in zip(
                range(each.register, each.register + len(each.words)), each.words, strict=True
            ):
                if register in words:
                    words[register] = word
        return written_content(words)

    def refit(self, content: bytes, current: bytes) -> bytes:  # noqa: ARG002  # every module has the same registers
        """Return registers that were kept; raises ImageError."""
        return written_content(words_of_content(content))

    def difference(self, content: bytes, found: bytes) -> str:
        """Return the registers that differ, in a few words."""
        if content == found:
            return ""
        try:
            wanted, present = words_of_content(content), words_of_content(found)
        except ImageError:
            return "so much that it cannot be read"
        different = [f"R{register}" for register in wanted if wanted[register] != present[register]]
        more = len(different) - _NAMED
        return f"in {', '.join(different[:_NAMED])}" + (f" and {more} more" if more > 0 else "")
