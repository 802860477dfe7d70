"""The parameter table that NUM controls send and take (section 13.2.6).

``%`` and the job reference, then a header ``PaNb:tcnd`` and a data line ``#`` for each ten words, Xoff at the
end; every line closes with ``;`` and its length in hexadecimal. ``docs/formats/num.md`` lists what was
decided where the manual is silent.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import InvalidValueError, Schema, Value

from .layout import MAX_VALUES, Placed, TableLayout, WordTexts, compose, runs
from .lines import HEADER, Block, blocks_of, split_table
from .words import (
    WORD_TYPES,
    Content,
    KnownWords,
    Spelling,
    Word,
    WordMeaning,
    active_meaning,
    name_of,
    spelled_text,
    words_of,
)

KEY = "num_table"
"""Where a parameter file remembers, in its header, what is no value in the table it came from."""
_KEPT = re.compile(r"(?::t([0-24-9])n([1-9][0-9]{0,3}))?#([ -~]*)")
"""What comes after the number of the first word where words are kept that the schema does not have."""


def _recognises(text: str) -> bool:
    return re.search(r"\A%[0-9]{8}|^P[0-9]+N[0-9]+(?::t|;)", text, re.MULTILINE) is not None


# -- reading ---------------------------------------------------------------------


@dataclass
class _Reader:
    """Takes the blocks of one table."""

    schema: Schema
    keep_unknown: bool
    contents: dict[Word, Content] = field(default_factory=dict)
    """Words that the schema has."""
    found: TextRead = field(default_factory=TextRead)
    heads: dict[int, tuple[int, int]] = field(default_factory=dict)
    """Parameter -> type and number of words, where a header gives them."""
    places: dict[Word, tuple[int, int]] = field(default_factory=dict)
    """Every word of the table, known or not -> line and column."""

    def __post_init__(self) -> None:
        self.machine = self.schema.family.default_machine
        self.known = words_of(self.schema, self.machine)

    def take(self, block: Block) -> Placed:
        """Take one block and return how it is laid out; raises FormatError."""
        (parameter, n), count = block.first, self._count(block)
        form = self.known.form(parameter, self.heads)
        alone = form is not None and form.is_text and count == 1
        # A text alone in its parameter may contain blanks, which elsewhere part the values.
        texts, spelled = [block.data] if alone else block.data.split(" "), []
        kept: list[tuple[Word, str]] = []
        line, column = block.line + 1, 2
        for text in texts:
            word = (parameter, n)
            self._check_place(block, word, count, column)
            if not text and not alone:
                raise FormatError("a value is missing: values have one blank between them", line, column)
            content = text if form is None else _content(form, word, text, (line, column))
            if meanings := self.known.meanings.get(word):
                content = self.contents[word] = text if meanings[0].parameter.type == "text" else content
                spelled.append(text if form is None else form.spell(content))
            else:
                self._check_kept(block, word, column)
                kept.append((word, text))
                spelled.append(text)
            self.places[word] = line, column
            column += len(text) + 1
            n += 1
        self._keep(block, kept)
        return Placed(
            block.first, len(texts), block.count is not None, None if spelled == texts else block.data
        )

    def _count(self, block: Block) -> int | None:
        """Return how many words the parameter has; the header has to agree with the others
        and with the schema.
        """
        parameter, line = block.first[0], block.line
        if block.code is None or block.count is None:
            return self.heads[parameter][1] if parameter in self.heads else self.known.counts.get(parameter)
        column = block.header.index(":") + 3
        if block.code not in WORD_TYPES:
            raise FormatError(f"there is no type {block.code} of words", line, column)
        own = self.known.heads.get(parameter)
        if own is not None and own[0] != block.code:
            message = (
                f"P{parameter} of {self.schema.family.name} has words of type {own[0]}, not {block.code}"
            )
            raise FormatError(message, line, column)
        # A parameter of more than ten words has a header for each line: all of them must agree.
        before = self.heads.setdefault(parameter, (block.code, block.count))
        if before != (block.code, block.count):
            message = f"a header above gives t{before[0]}n{before[1]} of P{parameter}"
            raise FormatError(message, line, column - 1)
        return block.count

    def _check_place(self, block: Block, word: Word, count: int | None, column: int) -> None:
        """See that there is such a word, that the line has room for it and that it occurs once."""
        line = block.line + 1
        if word[1] - block.first[1] >= MAX_VALUES:
            raise FormatError(f"a data line contains {MAX_VALUES} values at most", line, column)
        if count is not None and word[1] >= count and (block.count is not None or not self.keep_unknown):
            message = (
                f"P{word[0]} has {count} {'word' if count == 1 else 'words'}: there is no {name_of(word)}"
            )
            if word == block.first:
                raise FormatError(message, block.line, block.header.index("N") + 1)
            raise FormatError(message, line, column)
        if word in self.places:
            raise FormatError(f"{name_of(word)} is in line {self.places[word][0]} already", line, column)

    def _check_kept(self, block: Block, word: Word, column: int) -> None:
        """Refuse a word that the schema does not have, unless such words are to be kept."""
        if self.keep_unknown:
            return
        message = f"{self.schema.family.name} has no {name_of(word)}"
        if word == block.first:
            raise FormatError(message, block.line, 1)
        raise FormatError(message, block.line + 1, column)

    def _keep(self, block: Block, kept: list[tuple[Word, str]]) -> None:
        """Keep words that the schema does not have: those that follow each other under the number of the
        first.
        """
        unknown, (_, colon, form) = self.found.unknown, block.header.partition(":")
        key, behind = "", (-1, -1)
        for word, text in kept:
            if word == behind:
                unknown[key] += f" {text}"
            else:
                key = name_of(word)
                unknown[key] = f"{colon}{form}#{text}"
                self.found.unknown_lines[key] = block.line
            behind = word[0], word[1] + 1

    def values(self) -> None:
        """Turn the words into values: those first whose meaning depends on no others."""
        file = ParameterFile(self.schema)
        file.header.machine = self.machine
        values, later = {}, []
        for word in self.contents:
            meanings = self.known.meanings[word]
            # What a word means may hang on the axes that other words describe: those come first.
            if len(meanings) > 1 or meanings[0].unit is None:
                later.append(word)
            else:
                values[meanings[0].address] = self._value(file, word, meanings[0])
        file.take(values)
        for word in later:
            meaning = active_meaning(file, self.known.meanings[word])
            file.set(meaning.address, self._value(file, word, meaning))
        self.found.values = file.values

    def _value(self, file: ParameterFile, word: Word, meaning: WordMeaning) -> Value:
        self.found.value_lines[meaning.address] = self.places[word][0]
        try:
            return meaning.value(file, self.contents[word])
        except InvalidValueError as error:
            raise FormatError(f"{name_of(word)}: {error}", *self.places[word]) from None

    def missing(self) -> Iterator[str]:
        """Yield what the table leaves open: parameters and words that it does not have,
        other numbers of words.
        """
        here: dict[int, set[int]] = {}
        for parameter, word in self.places:
            here.setdefault(parameter, set()).add(word)
        if missing := [a for a in sorted(self.known.counts) if a not in here]:
            yield f"the table does not contain {_runs_of('P', missing)}"
        yield from self._missing_words(here)

    def _missing_words(self, here: Mapping[int, set[int]]) -> Iterator[str]:
        """Yield which words of known parameters a table lacks, and which parameters have other numbers of
        them.
        """
        left, other = [], []
        for parameter, words in sorted(here.items()):
            known = self.known.counts.get(parameter)
            count = self.heads[parameter][1] if parameter in self.heads else known
            if count is not None and len(words) < count:
                left.append(_runs_of(f"P{parameter}N", sorted(set(range(count)) - words)))
            if known is not None and count != known:
                other.append(f"{count} of P{parameter} ({known})")
        if left:
            yield f"the table does not contain these words: {', '.join(left)}"
        if other:
            yield f"the table has other numbers of words than {self.schema.family.name}: {', '.join(other)}"


def _runs_of(letters: str, numbers: list[int]) -> str:
    """Write numbers in ascending order: ``P3, P5 to P9``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ", ".join(f"{letters}{a}" if a == b else f"{letters}{a} to {letters}{b}" for a, b in runs)


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what a parameter table contains, with what is needed to write it as it was."""
    lines, layout = split_table(text)
    reader = _Reader(schema, options.keep_unknown)
    known, blocks = reader.known, list(blocks_of(lines))
    placed = [reader.take(block) for block in blocks]
    reader.values()
    found = reader.found
    found.machine = reader.machine
    found.notes = list(reader.missing())
    layout.old_headers = bool(placed) and not any(block.typed for block in placed)
    layout.heads = {a: h for a, h in reader.heads.items() if a in known.counts and h != known.heads.get(a)}
    # The order of the blocks is remembered only where it is not the usual one.
    if placed != list(runs(sorted(reader.places), not layout.old_headers)):
        layout.blocks = placed
    if header := layout.as_header():
        found.extra[KEY] = header
    return found


# -- writing ---------------------------------------------------------------------


def _heads(known: KnownWords, layout: TableLayout, unknown: dict[str, str]) -> dict[int, tuple[int, int]]:
    """Return type and number of words for the headers: those of the schema, where the table had no others."""
    heads = dict(known.heads)
    for word, head, _ in _kept(unknown):
        if head is not None:
            heads[word[0]] = head
    return heads | layout.heads


def _kept(unknown: dict[str, str]) -> Iterator[tuple[Word, tuple[int, int] | None, str]]:
    """Yield first word, type with number of words, and data of the kept lines of a table."""
    for key, text in unknown.items():
        header = HEADER.fullmatch(key)
        if header is None or header[3] is not None:
            continue  # of another format
        kept = _KEPT.fullmatch(text)
        if kept is None:
            raise FormatError(f"'{text}' is not how words of {key} are kept, as in :t1n3#0 0 5")
        head = None if kept[1] is None else (int(kept[1]), int(kept[2]))
        yield (int(header[1]), int(header[2])), head, kept[3]


def _write(file: ParameterFile) -> str:
    """Return a file as a parameter table; raises FormatError for a word that it cannot contain."""
    known = words_of(file.schema, file.machine)
    layout = TableLayout.from_header(file.header.extra.get(KEY))
    heads = _heads(known, layout, file.unknown)
    alone = {a for a, (code, count) in heads.items() if count == 1 and WORD_TYPES[code].is_text}
    cells = {**_kept_cells(file.unknown, alone), **_known_cells(file, known, heads)}
    for word, text in cells.items():
        _check_cell(word, text, layout, is_alone=word[0] in alone)
    forms = {a: form for a in known.counts if (form := known.form(a, heads)) is not None}
    return compose(cells, heads, forms, layout)


def _kept_cells(unknown: dict[str, str], alone: Collection[int]) -> WordTexts:
    """Return the words of the kept lines; what is a word of text by itself may have blanks."""
    return {
        (parameter, first + place): text
        for (parameter, first), _, data in _kept(unknown)
        for place, text in enumerate([data] if parameter in alone else data.split(" "))
    }


def _known_cells(file: ParameterFile, known: KnownWords, heads: dict[int, tuple[int, int]]) -> WordTexts:
    """Return the words that are values of the file."""
    cells: WordTexts = {}
    for word, meanings in known.meanings.items():
        # A word with several meanings is written by the one that is active and set.
        there = tuple(meaning for meaning in meanings if meaning.address in file.values)
        if there:
            cells[word] = _spelled(file, active_meaning(file, there), known.form(word[0], heads))
    return cells


def _check_cell(word: Word, text: str, layout: TableLayout, *, is_alone: bool) -> None:
    # Software of another index has fewer words: this one has no place there.
    if word[0] in layout.heads and word[1] >= layout.heads[word[0]][1]:
        message = f"the control that the table came from has {layout.heads[word[0]][1]} words of P{word[0]}"
        raise FormatError(f"{name_of(word)}: {message}")
    # A blank parts the values of a line.
    if (not text or " " in text) and not is_alone:
        raise FormatError(f"{name_of(word)}: the text '{text}' would not be read as one value")


def _spelled(file: ParameterFile, meaning: WordMeaning, form: Spelling | None) -> str:
    try:
        content = meaning.content(file, file.values[meaning.address])
        return spelled_text(str(content)) if form is None else form.spell(content)
    except InvalidValueError as error:
        raise FormatError(f"{file.machine_schema.label(meaning.address)}: {error}") from None


FORMAT = TextFormat(
    "num",
    "NUM parameter table",
    ".par",
    _recognises,
    _read,
    _write,
    encoding="ascii",
    around=(b"\x1a",),
    other_endings=(".num", ".txt"),
)


def _content(form: Spelling, word: Word, text: str, at: tuple[int, int]) -> int | float | str:
    """Return what a text is in its form; raises FormatError with its line and column."""
    try:
        return form.read(text)
    except InvalidValueError as error:
        raise FormatError(f"{name_of(word)}: {error}", *at) from None
