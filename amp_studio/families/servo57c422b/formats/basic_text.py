r"""The lines of a BASIC task, taken apart into statements: ``2030 PGAIN%=18700 \!Position Gain`` (page 5-5).

A line begins with its number; ``\`` is between statements, ``!`` or ``REM`` before a remark, and ``&`` at the
end of what goes on in the next line (page 4-48). A ``!`` that follows a name at once belongs to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from amp_studio.formats import FormatError

_TOKEN = re.compile(
    r"""
      (?P<remark> (?:!|REM\b) [^\n]* )                    # to the end of the line
    | (?P<separator> \\ )
    | (?P<text> "[^"\n]*"? | [A-Z][A-Z0-9_]*[%!@$]? | [0-9][0-9A-Z.]* | \{[^}]*\} | . )
    """,
    re.IGNORECASE | re.VERBOSE | re.DOTALL,
)


_LONGEST_LINE = 5000
"""Characters of a line with all that it goes on in."""


@dataclass(eq=False)
class BasicStatement:
    """One statement of a line, without the blanks around it."""

    text: str
    line: int
    column: int

    @property
    def short(self) -> str:
        """Its name in messages."""
        text = " ".join(self.text.split())
        return text if len(text) <= 40 else text[:39] + "…"

    def fault(self, what: str) -> FormatError:
        return FormatError(what, self.line, self.column)


@dataclass
class BasicLine:
    """One numbered line: its pieces in order, which together are its text."""

    head: str
    """The number, with the blanks around it."""
    pieces: list[str] = field(default_factory=list)
    statements: list[BasicStatement] = field(default_factory=list)
    _places: dict[int, int] = field(default_factory=dict)
    """id of a statement -> its piece."""

    @property
    def number(self) -> str:
        """The number, without zeros in front."""
        return str(int(self.head))

    @property
    def text(self) -> str:
        return self.head + "".join(self.pieces)

    def add(self, piece: str, statement: BasicStatement | None = None) -> None:
        if statement is not None:
            self._places[id(statement)] = len(self.pieces)
            self.statements.append(statement)
        self.pieces.append(piece)

    def replace(self, statement: BasicStatement, texts: list[str]) -> None:
        r"""Put other statements in the place of one; without any it goes, and its ``\`` with it."""
        at = self._places[id(statement)]
        piece = self.pieces[at]
        if texts:
            # In its blanks: the columns of the task stay as a person has set them.
            self.pieces[at] = piece.replace(statement.text, " \\ ".join(texts), 1)
            return
        self.pieces[at] = piece[: len(piece) - len(piece.lstrip())]
        # The separator behind it goes first, the one before it where it was the last statement.
        for beside in (at + 1, at - 1):
            if 0 <= beside < len(self.pieces) and self.pieces[beside] == "\\":
                self.pieces[beside] = ""
                return
        if not "".join(self.pieces).strip():
            self.pieces[at] += "!"  # the number stays: something may jump to it

    def with_first(self, texts: list[str]) -> str:
        """Return the line with statements before all others."""
        rest = "".join(self.pieces).lstrip()
        return self.head + " \\ ".join(texts) + (f" \\ {rest}" if rest else "")


def read_lines(text: str) -> Iterator[BasicLine]:
    """Yield the lines of a task; raises FormatError for one without a number, or with that of another."""
    begun: list[str] = []
    first = 0
    seen: dict[str, int] = {}
    for n, line in enumerate(text.split("\n"), 1):
        if not begun:
            first = n
        begun.append(line)
        if sum(map(len, begun)) > _LONGEST_LINE:
            raise FormatError(f"the line is longer than {_LONGEST_LINE} characters", first)
        # In a remark an & is text.
        if line.rstrip().endswith("&") and not _ends_in_remark(line):
            continue
        if "".join(begun).strip():
            found = _line("\n".join(begun), first)
            # BASIC keeps one line of a number: which of two would count cannot be seen in the text.
            before = seen.setdefault(found.number, first)
            if before != first:
                raise FormatError(f"number {found.number} occurs twice, in line {before} already", first, 1)
            yield found
        begun = []
    if begun:
        raise FormatError("the last line ends with '&' and goes on nowhere", first)


def _ends_in_remark(line: str) -> bool:
    return any(found.lastgroup == "remark" for found in _TOKEN.finditer(line))


def _line(text: str, number: int) -> BasicLine:
    """Return a line of a task with its statements, each with its place."""
    head = re.match(r"\s*[0-9]{1,9}(?![0-9])[ \t]*", text)
    if head is None:
        raise FormatError("a line of a task begins with its number", number, 1)
    line = BasicLine(head[0])
    at = head.end()
    for piece, is_statement in _pieces(text[at:]):
        statement = None
        if is_statement:
            start = at + len(piece) - len(piece.lstrip())
            row, column = text.count("\n", 0, start), start - (text.rfind("\n", 0, start) + 1)
            statement = BasicStatement(piece.strip(), number + row, column + 1)
        line.add(piece, statement)
        at += len(piece)
    return line


def _pieces(text: str) -> Iterator[tuple[str, bool]]:
    """Yield the pieces of a line, and whether each is a statement."""
    piece = ""
    for found in _TOKEN.finditer(text):
        if found.lastgroup == "text":
            piece += found[0]
            continue
        if piece:
            yield piece, bool(piece.strip())
        piece = ""
        yield found[0], False
    if piece:
        yield piece, bool(piece.strip())
