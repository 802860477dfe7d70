"""How the lines of a NUM parameter table are laid out, and what of a table is no value.

A table is written as the control sends it (page 13-14) unless the parameter file remembers otherwise. What it
remembers is in its header, in words that a person can read and change; ``docs/formats/num.md`` lists them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from amp_studio.formats import FormatError
from amp_studio.schema import InvalidValueError

from .words import Spelling, Word, name_of

XOFF = "\x13"
MAX_VALUES = 10
"""Values of one data line (page 13-14)."""
WordTexts = dict[Word, str]
"""Every word of a table, as the control would spell it."""
Heads = Mapping[int, tuple[int, int]]
"""Parameter -> type and number of its words."""
_NAMES = {"CR": "\r", "LF": "\n", "XOFF": XOFF, "SUB": "\x1a", "NUL": "\0"}
_CHARACTERS = {character: name for name, character in _NAMES.items()}
_HEAD = re.compile(r"t([0-24-9])n([1-9][0-9]{0,3})")
_BLOCK = re.compile(r"P([0-9]{1,4})N([0-9]{1,4})(:?)(?: ([0-9]{1,2})|#([ -~]*))")


@dataclass(frozen=True, slots=True)
class Placed:
    """Words that are together in a data line."""

    first: Word
    count: int
    typed: bool = True
    """Whether the header gives type and number of words."""
    data: str | None = None
    """How the line spells its words, if that is not the control's way."""

    @property
    def words(self) -> Iterable[Word]:
        """The words of the line."""
        parameter, first = self.first
        return ((parameter, n) for n in range(first, first + self.count))

    def as_header(self) -> str:
        """Return the block as the header of a parameter file has it: ``P9N0: 10``, ``P9N0#00 01``."""
        head = name_of(self.first) + (":" if self.typed else "")
        return f"{head} {self.count}" if self.data is None else f"{head}#{self.data}"


def _job_reference(number: object) -> str:
    """Return the eight digits of a job reference; raises FormatError."""
    reference = f"{number:08d}" if isinstance(number, int) else str(number)
    if not re.fullmatch("[0-9]{8}", reference):
        raise FormatError(f"the job reference '{reference}' is not of eight digits")
    return reference


@dataclass
class TableLayout:
    """What a table contains besides its words; the defaults are those of a table that the control sends."""

    job_reference: str = "00000000"
    comment: str = ""
    """What comes after the job reference, with its blank."""
    line_end: str = "\n"
    end: str = ""
    """From behind the length of the last line; empty for a line end and Xoff."""
    old_headers: bool = False
    """Headers without type and number of words: software before index K."""
    heads: dict[int, tuple[int, int]] = field(default_factory=dict)
    """Parameter -> type and number of words where the schema has others: software of another index."""
    blocks: list[Placed] = field(default_factory=list)
    """The order and the division of the lines; empty for the control's own."""

    def as_header(self) -> dict[str, object]:
        """Return it for the header of a parameter file, without what goes without saying."""
        header: dict[str, object] = {}
        if self.job_reference != TableLayout.job_reference:
            header["job_reference"] = self.job_reference
        if self.comment:
            header["comment"] = self.comment
        if self.line_end != TableLayout.line_end:
            header["line_end"] = _named(self.line_end)
        if self.end not in ("", self.line_end + XOFF):
            header["end"] = _named(self.end)
        if self.old_headers:
            header["headers"] = "old"
        if self.heads:
            header["words"] = {f"P{a}": f"t{code}n{count}" for a, (code, count) in self.heads.items()}
        if self.blocks:
            header["lines"] = [block.as_header() for block in self.blocks]
        return header

    @classmethod
    def from_header(cls, header: object) -> TableLayout:
        """Read the header of a parameter file; raises FormatError where a person wrote what cannot be."""
        entries = header if isinstance(header, Mapping) else {}
        reference = _job_reference(entries.get("job_reference", cls.job_reference))
        comment = str(entries.get("comment", ""))
        if not re.fullmatch(r"(?![0-9])[ -~]*", comment):
            raise FormatError(
                "the comment behind the job reference contains more than ASCII or begins with a digit"
            )
        layout = cls(
            reference,
            comment,
            _characters(entries.get("line_end", "LF")),
            _characters(entries.get("end", "")),
        )
        layout.old_headers = entries.get("headers") == "old"
        words, lines = entries.get("words"), entries.get("lines")
        for key, head in (words if isinstance(words, Mapping) else {}).items():
            match = _HEAD.fullmatch(str(head))
            if match is None or not re.fullmatch("P[0-9]{1,4}", str(key)):
                raise FormatError(f"'{key}: {head}' is not type and number of words, as in P4: t0n4")
            layout.heads[int(str(key)[1:])] = int(match[1]), int(match[2])
        for line in lines if isinstance(lines, list) else []:
            layout.blocks.append(_block(str(line)))
        return layout


def _named(characters: str) -> str:
    return " ".join(_CHARACTERS[character] for character in characters)


def _characters(names: object) -> str:
    try:
        return "".join(_NAMES[name] for name in str(names).split())
    except KeyError as error:
        raise FormatError(f"{error.args[0]} is not one of the characters {', '.join(_NAMES)}") from None


def _block(line: str) -> Placed:
    match = _BLOCK.fullmatch(line)
    if match is None:
        raise FormatError(f"'{line}' is no line of a table, as in P9N0: 10")
    data = match[5]
    count = int(match[4]) if data is None else data.count(" ") + 1
    return Placed((int(match[1]), int(match[2])), count, match[3] == ":", data)


# -- from words to text ----------------------------------------------------------


def compose(texts: WordTexts, heads: Heads, forms: Mapping[int, Spelling], layout: TableLayout) -> str:
    """Return the text of a table; raises FormatError for a line that is too long."""
    lines = [f"%{layout.job_reference}{layout.comment}"]
    for block in _arranged(texts, layout):
        head = heads.get(block.first[0]) if block.typed else None
        lines.append(name_of(block.first) + (f":t{head[0]}n{head[1]}" if head else ""))
        lines.append(f"#{_data(block, texts, forms)}")
    for line in lines:
        if len(line) > 0xFF:
            raise FormatError(f"a line has 255 characters at most, and this one {len(line)}: {line[:40]}…")
    measured = layout.line_end.join(f"{line};{len(line):02X}" for line in lines)
    return measured + (layout.end or layout.line_end + XOFF)


def _arranged(texts: WordTexts, layout: TableLayout) -> list[Placed]:
    """Return the lines of a table: those remembered as far as their words are there, the rest in its
    place.
    """
    left = dict.fromkeys(sorted(texts), True)
    arranged: list[Placed] = []
    for block in layout.blocks:
        there = [word for word in block.words if left.pop(word, False)]
        # A line that lost a word is divided again by the rules of the control: a gap in a line would shift
        # its words.
        arranged += [block] if len(there) == block.count else runs(there, block.typed)
    added = list(runs(left, not layout.old_headers))
    if not arranged:
        return added
    for block in added:
        later = (n for n, other in enumerate(arranged) if other.first > block.first)
        # New words go before the first line with a greater number, as the control would have them.
        arranged.insert(next(later, len(arranged)), block)
    return arranged


def runs(words: Iterable[Word], typed: bool) -> Iterator[Placed]:
    """Divide words into the lines of the control: ten to a line from word 0,
    and a separate line after each gap.
    """
    first, count = (-1, -1), 0
    for parameter, n in words:
        # Lines of the control begin at words 0, 10, 20 …, also after a gap.
        if count and (parameter, n) == (first[0], first[1] + count) and n % MAX_VALUES:
            count += 1
            continue
        if count:
            yield Placed(first, count, typed)
        first, count = (parameter, n), 1
    if count:
        yield Placed(first, count, typed)


def _data(block: Placed, texts: WordTexts, forms: Mapping[int, Spelling]) -> str:
    """Return the data line of a block, as it was spelled where it means the same."""
    spelled = [texts[word] for word in block.words]
    form = forms.get(block.first[0])
    if block.data is not None and form is not None:
        own = [block.data] if block.count == 1 else block.data.split(" ")
        try:
            # The old spelling (leading zeros, a sign) is kept only while it means the same words.
            if [form.spell(form.read(text)) for text in own] == spelled:
                return block.data
        except InvalidValueError:
            pass  # a person changed it: the values count
    return " ".join(spelled)
