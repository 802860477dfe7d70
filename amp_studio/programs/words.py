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
    r"[ \t]+|(?P<remark>;.*|\([^)]*\))"
    r"|(?P<letter>,[A-Z]|\$?[A-Z])[ \t]*(?P<number>[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))?",
    re.ASCII,
)
_BLOCK_DELETE = re.compile(r"\s*/[1-9]?", re.ASCII)
_REMARK_OR_BLANK = re.compile(r"\([^)]*\)|;.*|[ \t]+")
_REMARK_OR_END = re.compile(r"\([^)]*\)|;.*|\)")
_OPEN_REMARK = re.compile(r"^((?:[^(;]|\([^)]*\))*)\([^)]*$")
_DEMARCATION = re.compile(r"\s*%\s*[0-9.]*\s*(?:;.*|\([^)]*\)\s*)?", re.ASCII)
"""A line that begins or ends a program; some controls have its number behind the %."""
_FLOW = re.compile(r"\s*(?:N\s*[0-9]+\s*)?O\s*(?:[0-9]+\s*[A-Z]|<|\[)", re.ASCII)
"""An O-word that is more than the number of a program."""
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
    text = in_capitals(block)
    if _DEMARCATION.fullmatch(text):
        return
    if _FLOW.match(text):
        raise ProgramBlockError(
            f"{quoted(block[:12])}: subroutines and branches by O-words are not simulated"
        )
    deleted = _BLOCK_DELETE.match(text)
    place = deleted.end() if deleted else 0
    bare = False
    while place < len(text):
        # Expressions first: for the other pattern their parentheses would begin a remark.
        found = (_WITH_EXPRESSION.match(text, place) if expressions else None) or _PART.match(text, place)
        if found is None:
            raise _unreadable_word(block, place, bare=bare, expressions=expressions)
        bare = bool(found.groupdict().get("letter")) and not found["number"]
        if found.groupdict().get("letter"):
            yield TypedWord(found["letter"], found["number"] or "", block[place : found.end()].strip())
        place = found.end()


def _unreadable_word(block: str, place: int, *, bare: bool, expressions: bool) -> ProgramBlockError:
    """Return the error of what is at a place, behind a letter that is ``bare`` of its number."""
    # Some controls distinguish a letter whose number cannot be read from what is no letter.
    key = "no-digits" if bare else "no-letter" if block[place] > " " and block[place] != "$" else ""
    return ProgramBlockError(_unreadable(block[place : place + 12], expressions=expressions), key)


def without_blanks(block: str) -> str:
    """Return a block without the blanks outside of its remarks; one that is no words stays as it is."""
    return (
        block
        if _FLOW.match(block)
        else _REMARK_OR_BLANK.sub(lambda found: "" if found[0].isspace() else found[0], block)
    )


def without_open_remark(block: str) -> str:
    """Return a block without a remark that is not closed, which goes to the end of its line, and without the
    end of one that has not begun.
    """
    closed = _OPEN_REMARK.sub(r"\1", block)
    return _REMARK_OR_END.sub(lambda found: "" if found[0] == ")" else found[0], closed)


def in_capitals(block: str) -> str:
    """Return a block with the letters a to z in capitals: no other letter becomes one of a word."""
    return block.upper() if block.isascii() else "".join(c.upper() if c.isascii() else c for c in block)


def _unreadable(rest: str, *, expressions: bool) -> str:
    """Return what is wrong with the rest of a block."""
    if rest[0] == "(":
        return f"{quoted(rest)}: the remark is not closed"
    if rest[0] in "#[<" and not expressions:
        return f"{quoted(rest)} is no word: parameters and expressions of this control are not simulated"
    return f"{quoted(rest)} is no word: a letter and a number"
