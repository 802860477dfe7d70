"""The lines of a script of an ACR controller: what each sets, or why it sets nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from amp_studio.formats import FormatError

from .acr_command import Command, CommandArgument

CODE_PAGE = "cp437"
"""Commands are plain ASCII; of other characters, which a remark may contain, every byte comes back as it
was."""
_MARK = "\ufeff".encode().decode(CODE_PAGE)
_MARK_SEEN_AS_LATIN = "\ufeff".encode().decode("latin-1")
_REMARK = re.compile(r"\s*(REM\b.*)?", re.IGNORECASE | re.DOTALL)
_BEHIND = re.compile(r"\s*+(?:\(.*\)\s*+|REM\b.*)?", re.IGNORECASE)
"""A remark, or the guide's own: ``MULT X-4     (Times 4 multiplication in opposite direction)``
(page 114)."""

_PROFILE = re.compile(
    r"\s*:?(?:\s*(?:STP|VEL|JRK|IVEL|FVEL)\s*(?:[0-9.]+|\([^()]*\))(?![\w.]))*+\s*", re.IGNORECASE
)
"""What a program gives its moves beside ``ACC`` and ``DEC`` (page 91). That several commands may be in a
line, with a colon between them or none, is assumed: no page prints it."""
_MOVE = re.compile(r"(?:\s*[XYZABCUV]\s*/?\s*(?:[-+]?[0-9.]+|\([^()]*\))(?![\w.]))++\s*", re.IGNORECASE)
"""A move of axes behind the commands for it: it sets nothing (page 115)."""

_LONGEST_LINE = 1000
_WORDS = re.compile(
    "ABS|ACC|ADC|ALL|ALM|AS|ATTACH|AUT|AXIS|BASE|BKL|BLK|BLM|BRESET|BSC|CAM|CLEAR|CLOCK|CLOSE|CLR|COM1|COM2|"
    "CONFIG|CPU|DAC|DEC|DETACH|DGAIN|DIAG|DIM|DST|DWIDTH|DWL|ECHO|ELOAD|ENC|END|ERASE|ESAVE|EXC|F|FBVEL|"
    "FFACC|FFVEL|FIFO|FLASH|FLZ|FOV|FREQ|FVEL|FWD|GAIN|GEAR|GOSUB|GOTO|HALT|HDW|HELP|HSINT|IDELAY|IF|IGAIN|"
    "IHPOS|ILIMIT|IMAGE|INC|INH|INPUT|INT|INTCAP|IO|IPB|ITB|IVEL|JLM|JOG|JRK|LIMIT|LIST|LISTEN|LOAD|LOCK|"
    "LOPASS|LRUN|MASK|MASTER|MAX|MEM|MIN|MODE|MOV|MSEEK|MULT|NEG|NEW|NONE|NORM|NOTCH|OFF|OFFSET|ON|OPEN|"
    "PAUSE|PBOOT|PERIOD|PGAIN|PLC|PLS|PDIFF|PON|POS|PPU|PRINT|PROG|PROM|RATCH|RATIO|REBOOT|REM|REN|RES|"
    "RESUME|RETURN|REV|ROTARY|ROTATE|ROV|RUN|SAMP|SAVE|SCALE|SEG|SET|SHIFT|SINE|SLAVE|SRC|STEP|STEPPER|STP|"
    "SYS|THEN|TLM|TRG|TRJ|TROFF|TRON|UNLOCK|USING|VECDEF|VECTOR|VEL|VER|WIDTH|XID"
)
"""Commands of the controller (page 91)."""
_LATER = re.compile(
    "BIT|BREAK|DRIVE|ELSE|ENDIF|ENDP|FSTAT|HLBIT|HLDEC|HLIM|LOOK|MAXVEL|MBUF|SLDEC|SLIM|SLM|WEND|WHILE"
)
"""Words of published start-up programs for later controllers: the guide does not have them."""
_OF_A_PROGRAM = re.compile(
    r"\s*(?:[0-9]+\s+[A-Z]|(?P<assigned>P|BIT)[0-9]+\s*=|[FXYZABCUV]\s*[-+.0-9]|(?P<word>[A-Z]+)[0-9]*(?![A-Z]))",
    re.IGNORECASE,
)
"""A line with a number, as of a PLC program (page 114); an assignment (pages 45 and 128);
a feed or a move (page 115); a command."""


@dataclass
class ScriptLine:
    """A line of a script: its settings, or why it has none."""

    number: int
    text: str
    arguments: list[CommandArgument] = field(default_factory=list)
    fault: FormatError | None = None
    """Why the line is not understood."""
    is_kept: bool = False
    """It is of a program, and sets nothing."""


def first_word(command: Command) -> str:
    word = re.match("[A-Z]+", command.form)
    return word[0] if word else ""


def word_of(text: str) -> str:
    """Return what a line of a program begins with, in a word."""
    word = re.search(r"[A-Z]+", text, re.IGNORECASE)
    return word[0].upper() if word else text.strip()[:10]


def script_lines(text: str, commands: list[Command], words: set[str]) -> Iterator[ScriptLine]:
    # Editors put a byte order mark in front, which is three characters in either of these code pages.
    for n, row in enumerate(text.removeprefix(_MARK).removeprefix(_MARK_SEEN_AS_LATIN).split("\n"), 1):
        line = ScriptLine(n, row.rstrip("\r"))
        # Patterns with repeats take long on a long line: a script has none.
        if len(line.text) > _LONGEST_LINE:
            line.fault = FormatError(f"the line is longer than {_LONGEST_LINE} characters", n)
        elif not _REMARK.fullmatch(line.text):
            try:
                line.arguments = list(arguments_of(line, commands))
            except FormatError as fault:
                line.is_kept = _is_of_a_program(line.text, words)
                line.fault = None if line.is_kept else fault
        yield line


def _is_of_a_program(text: str, words: set[str]) -> bool:
    """Return whether a line that sets nothing here is another command;
    one with the word of a setting is a slip.
    """
    match = _OF_A_PROGRAM.match(text)
    if match is None:
        return False
    word = (match["word"] or "").upper()
    if not word:
        return True
    # DAC with another word is a setting of the card, not one here.
    if word == "DAC":
        return not re.match(r"\s*DAC[0-9]*\s+GAIN\b", text, re.IGNORECASE)
    return word not in words and (_LATER.fullmatch(word) or _WORDS.fullmatch(word)) is not None


def arguments_of(line: ScriptLine, commands: list[Command]) -> Iterator[CommandArgument]:
    """Yield the settings of a line; raises FormatError."""
    known, at = _known_at_begin(line.text, 0, commands)
    is_first = True
    while is_first or not _BEHIND.fullmatch(line.text, at):
        argument = next((a for c in known if (a := c.read(line.text, at))), None)
        if not is_first and (argument is None or not known[0].word):
            is_of_moves = all("{i}" not in c.form for c in known)
            next_known, begin = _known_at_begin(line.text, at, commands)
            if begin == len(line.text) or (is_of_moves and _MOVE.fullmatch(line.text, begin)):
                return  # what is behind the last setting sets nothing
            if not next_known[0].word:
                raise _not_read(line, at, known)
            known, at, is_first = next_known, begin, True
            continue
        if argument is None:
            raise _not_read(line, at, known)
        yield argument
        at, is_first = argument.end, False


def _known_at_begin(text: str, at: int, commands: list[Command]) -> tuple[list[Command], int]:
    """Return the commands of the word that a line goes on with, and where it goes on behind the word;
    without such a word those that have none.
    """
    begin = _PROFILE.match(text, at)
    at = begin.end() if begin else at
    word = re.compile(r"([A-Z]+)(?:\s+|$|(?=\())", re.IGNORECASE).match(text, at)
    if word and (known := [c for c in commands if c.word == word[1].upper()]):
        return known, word.end()
    return [c for c in commands if not c.word], at


def _not_read(line: ScriptLine, at: int, known: list[Command]) -> FormatError:
    """Return why what begins at a place of a line sets nothing."""
    rest = line.text[at:].strip()
    text = rest if len(rest) <= 40 else rest[:39] + "…"
    if not known or not known[0].word:
        return FormatError(f"'{text}' is no command that sets a parameter here", line.number, at + 1)
    form = " or ".join(f"'{c.example}'" for c in known)
    what = f"'{text}' sets nothing: {known[0].word}" if rest else f"{known[0].word} alone sets nothing: it"
    axes = ", ".join(filter(None, known[0].instances))
    return FormatError(f"{what} is written as {form}{f', for {axes}' if axes else ''}", line.number, at + 1)
