"""A block of a part program as words: a letter and what follows it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.errors import AmpStudioError
from amp_studio.schema import quoted

DEEPEST = 20
"""Parentheses and functions inside one another."""
LONGEST = 1000
"""Characters of a block that are read; a longer one is refused."""
_EXPRESSION = r"\([^()]*\)"
for _ in range(DEEPEST - 1):  # parentheses inside one another; a character fits one branch alone: no search
    _EXPRESSION = rf"\((?:[^()]|{_EXPRESSION})*\)"
_PART = re.compile(
    r"\s+|(?P<skip>/[1-9]?)|(?P<remark>;.*|\([^)]*\))|%"
    r"|(?P<letter>,[A-Z]|\$?[A-Z])[ \t]*(?P<number>[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))?"
)
_WITH_EXPRESSION = re.compile(
    r"(?P<letter>[A-Z])[ \t]*(?P<number>[+-]?" + _EXPRESSION + r"|(?<=T)[P#][0-9]+|(?<=T )[P#][0-9]+)"
)
"""A T-word may name a program parameter for its number."""


class ProgramBlockError(AmpStudioError, ValueError):
    """A block that cannot be read at all, or that no control could use; ``key`` names what is wrong
    where a control has a code for it.
    """

    def __init__(self, message: str, key: str = "") -> None:
        super().__init__(message)
        self.key = key


@dataclass(frozen=True)
class TypedWord:
    """A word as it is typed."""

    letter: str
    number: str
    """As typed; "" without one."""
    text: str

    @property
    def is_expression(self) -> bool:
        """Whether its number has to be worked out."""
        return "(" in self.number or self.number[:1] in ("P", "#")

    @property
    def code(self) -> str:
        """Its code without zeros in front and behind: G1 for G01, G31.4 for G31.40."""
        whole, _, decimals = self.number.lstrip("+").partition(".")
        rest = decimals.rstrip("0")
        return f"{self.letter}{whole.lstrip('0') or '0'}{'.' + rest if rest else ''}"


def sentence(assumed: str) -> str:
    """Return what is assumed, as ``that it is so``, as a sentence."""
    return f"That {assumed.removeprefix('that ')}."


def words_of(block: str, expressions: bool = False) -> Iterator[TypedWord]:
    """Yield the words of one block; remarks and block delete characters are left out.

    With ``expressions`` a word may have an expression in parentheses for its number.
    Raises ProgramBlockError.
    """
    if len(block) > LONGEST:
        raise ProgramBlockError(f"A block has at most {LONGEST} characters, not {len(block)}")
    text, place = block.upper(), 0
    while place < len(text):
        found = (_WITH_EXPRESSION.match(text, place) if expressions else None) or _PART.match(text, place)
        if found is None:
            raise ProgramBlockError(f"{quoted(block[place : place + 12])} is no word: a letter and a number")
        if found.groupdict().get("letter"):
            yield TypedWord(found["letter"], found["number"] or "", block[place : found.end()].strip())
        place = found.end()
