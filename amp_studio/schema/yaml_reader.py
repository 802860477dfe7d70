"""The one reader of YAML: facts, rules, projects and parameter files all pass here.

It reads the parser's events and makes dict, list and scalars of them by itself, because a general loader does
more than any of these files needs: it follows references (a short file that fills the memory), makes objects
of tags and dates of texts, and raises whatever the part that it stumbles over raises. Here there are none of
these, depth and size are bounded, keys are unique, a file is one document,
and every failure is one ``YamlError`` with its line.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate
from typing import Any, NamedTuple

from amp_studio.errors import AmpStudioError

from .quoting import quoted

_DEEPEST = 50
"""Collections in each other."""
LARGEST = 16_000_000
"""Characters of a document; the largest machine of the examples has 36,000."""

KeyPath = tuple[str | int, ...]
"""The way to a value: keys of mappings, positions in lists."""


class YamlError(AmpStudioError, ValueError):
    """A text that cannot be used: what is wrong, and in which line (from 1)."""

    def __init__(self, what: str, line: int | None = None, *, is_syntax: bool = False) -> None:
        self.line, self.what, self.is_syntax = line, what, is_syntax
        super().__init__(what)


class Span(NamedTuple):
    """Position of an entry of a mapping or list in the text, in characters from 0."""

    start: int
    """Of the key, or of the item of a list."""
    value: int
    end: int
    """Behind the last character of the value."""
    is_flow: bool
    """Whether it is written in ``{}`` or ``[]``."""


@dataclass
class YamlDocument:
    """The content of a text."""

    text: str
    data: Any = None
    is_closed: bool = False
    """It ends with the end mark ``...``."""
    spans: dict[KeyPath, Span] | None = None

    def line(self, path: KeyPath) -> int:
        """Return the line of an entry, or of what it would be in; needs the spans."""
        spans = self.spans or {}
        while path and path not in spans:
            path = path[:-1]
        return bisect_right(self._starts, spans[path].start) if path else 1

    @property
    def _starts(self) -> list[int]:
        """Where each line begins."""
        found: list[int] | None = self.__dict__.get("_found")
        if found is None:
            lines = self.text.split("\n")
            found = [0, *accumulate(len(line) + 1 for line in lines[:-1])]
            self.__dict__["_found"] = found
        return found


# U+0085, U+2028 and U+2029 end a line for some readers of YAML and for no editor: they are written as
# escapes.
_UNREADABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufeff\ufffe\uffff]")
_BREAK = "\n\r"
_BLANK = re.compile(rf"(?:[ \t]*(?:#[^{_BREAK}]*)?(?:[{_BREAK}]|$))*")


def read_yaml(
    text: str, scalar: Callable[[str], Any] | None = None, *, spans: bool = False, references: bool = False
) -> YamlDocument:
    """Read the one document of a text; an empty one is None.

    ``scalar`` returns what a plain scalar means, ``typed_scalar`` does where none is given. With ``spans``
    every entry has its place. ``references`` are for facts of our own, which give a list once.
    Raises YamlError.
    """
    # The byte order mark that editors of Windows write.
    text = text.removeprefix("\ufeff")
    if len(text) > LARGEST:
        raise YamlError(f"is too large: {len(text):,} characters, and {LARGEST:,} are the most")
    if odd := _UNREADABLE.search(text):
        raise YamlError(
            f"is not readable: the character U+{ord(odd[0]):04X} has no place in it",
            _line_at(text, odd.start()),
        )
    start = _BLANK.match(text)
    # It could change what tags mean, and which version of YAML the rest is.
    if start and text.startswith("%", start.end()):
        raise YamlError("is not readable: it begins with a YAML directive", _line_at(text, start.end()))
    if not spans and not references and (document := _plain_lines(text, scalar or typed_scalar)) is not None:
        return document
    return _YamlParser(text, scalar or typed_scalar, spans, references).read()


_WORD = r"[A-Za-z0-9_.+/%()°²³µ·^*@,;<>=$&~-]"
_PLAIN = rf"(?:[A-Za-z0-9_.+$]|-[0-9.]){_WORD}*(?: {_WORD}+)*"
_LINE = re.compile(
    rf"(  )?([A-Za-z0-9_][A-Za-z0-9_.@-]{{0,1000}}):(?: +(?:'([^']*)'|({_PLAIN})))?(?: +#.*)? *"
)
"""A line that can mean but one thing in YAML: indent, key, quoted value, plain value. A key of more than
1024 characters is refused by YAML: read here alone, its file could not be amended, and lost every remark."""
_REMEMBERED = 200
"""Characters of the longest line whose parts are remembered."""


def _plain_lines(text: str, scalar: Callable[[str], Any]) -> YamlDocument | None:
    """Return the document of a text as this program writes it, a key and a value a line and one level of
    sections: most of the time to open a file is that of a general parser. None for anything else, and for
    anything wrong: the parser decides about it and names it.
    """
    data: dict[Any, Any] = {}
    section: dict[Any, Any] | None = None
    lines = iter(text.split("\n"))
    is_closed = False
    for line in lines:
        found = _remembered_entry(line) if len(line) <= _REMEMBERED else _entry(line)
        if found is None:
            if is_closed := line == "...":
                break
            if not _is_remark(line):
                return None
            continue
        indent, key, quoted_text, plain = found
        target = data if indent is None else section
        # An indented line without a section, or a key that occurs twice: the parser has the words for it.
        if target is None or key in target:
            return None
        if plain is not None:
            target[key] = scalar(plain)
        elif quoted_text is not None or indent is not None:
            target[key] = scalar("") if quoted_text is None else quoted_text
        if indent is None:
            section = None
            if key not in data:
                section = data[key] = {}
    if not data or not all(map(_is_remark, lines)):
        return None
    empty = {key: scalar("") for key, value in data.items() if value == {}}
    return YamlDocument(text, {**data, **empty}, is_closed)


def _entry(line: str) -> tuple[str | None, str, str | None, str | None] | None:
    """Return indent, key, quoted value and plain value of a line."""
    match = _LINE.fullmatch(line)
    return None if match is None else (match[1], match[2], match[3], match[4])


_remembered_entry = lru_cache(maxsize=32_768)(_entry)
"""The same: the files of a shop have most lines in common."""


def _is_remark(line: str) -> bool:
    text = line.strip(" ")
    return not text or text[0] == "#"


def _line_at(text: str, at: int) -> int:
    return text.count("\n", 0, at) + 1


class _YamlParser:
    def __init__(self, text: str, scalar: Callable[[str], Any], spans: bool, references: bool) -> None:
        self.scalar, self.depth = scalar, 0
        self.anchors: dict[str, Any] | None = {} if references else None
        self.document = YamlDocument(text, spans={} if spans else None)

    def read(self) -> YamlDocument:
        from ruamel.yaml import YAML
        from ruamel.yaml.error import MarkedYAMLError, YAMLError

        events = YAML(typ="safe").parse(self.document.text)
        try:
            self._read(events)
        except MarkedYAMLError as error:
            mark = error.problem_mark
            line = _line_at(self.document.text, mark.index) if mark else None
            raise YamlError(f"is not readable: {error.problem}", line, is_syntax=True) from None
        except YAMLError as error:
            raise YamlError(f"is not readable: {str(error).splitlines()[0]}") from None
        return self.document

    def _read(self, events: Iterator[Any]) -> None:
        """Read the one document of the events into ``document``."""
        document = self.document
        for event in events:
            kind = type(event).__name__
            if kind == "DocumentStartEvent":
                document.data, _ = self._node(next(events), events, ())
            elif kind == "DocumentEndEvent":
                document.is_closed = bool(event.explicit)
                self._check_end(event)
                return  # what the parser would do with the rest is not asked: it has been checked

    def _check_end(self, event: Any) -> None:
        """See that nothing but remarks comes after the document; the parser would read on there."""
        text, at = self.document.text, event.end_mark.index
        if rest := _BLANK.match(text, at):
            at = rest.end()
        if at < len(text):
            raise YamlError("is not readable: something comes after its end", _line_at(text, at))

    def _node(self, event: Any, events: Iterator[Any], path: KeyPath) -> tuple[Any, int]:
        """Return a value, and where its text ends."""
        anchor, kind = event.anchor, type(event).__name__
        if _is_plain_scalar(event):  # nearly all are
            text = event.value
            # ``implicit`` is false for a quoted one, which is a text whatever is in it.
            return (self.scalar(text) if event.implicit[0] else text), event.end_mark.index
        is_alias = kind == "AliasEvent"
        if anchor is not None and (self.anchors is None or (is_alias and anchor not in self.anchors)):
            raise self._error("is not readable: it uses a YAML reference", event)
        if is_alias and self.anchors is not None:
            return self.anchors[anchor], event.end_mark.index
        if event.tag is not None:
            raise self._error("is not readable: it uses a YAML tag", event)
        data, end = self._content(event, events, path)
        if anchor is not None and self.anchors is not None:
            self.anchors[anchor] = data
        return data, end

    def _content(self, event: Any, events: Iterator[Any], path: KeyPath) -> tuple[Any, int]:
        """Return a scalar, mapping or list without anchor, and where its text ends."""
        kind = type(event).__name__
        if kind == "ScalarEvent":
            text = event.value
            return self.scalar(text) if event.implicit[0] else text, event.end_mark.index
        self.depth += 1
        if self.depth > _DEEPEST:
            raise self._error(
                f"is not readable: more than {_DEEPEST} lists and mappings in each other", event
            )
        data: Any
        data, end = (
            self._mapping(event, events, path)
            if kind == "MappingStartEvent"
            else self._sequence(event, events, path)
        )
        self.depth -= 1
        return data, end

    def _mapping(self, start: Any, events: Iterator[Any], path: KeyPath) -> tuple[dict[Any, Any], int]:
        """Return a mapping whose keys are texts or whole numbers, each once, and where its text ends."""
        found: dict[Any, Any] = {}
        spans, end = self.document.spans, start.end_mark.index
        while type(event := next(events)).__name__ != "MappingEndEvent":
            if self.anchors is None and _is_plain_scalar(event):
                key = event.value  # a key is a name, also where it looks like a number
            else:
                key, _ = self._node(event, events, path)
            if not isinstance(key, (str, int)):
                raise self._error("is not readable: a key is no text", event)
            if key in found:
                raise self._error(f"{quoted(str(key))} occurs twice", event)
            at = (*path, key)
            value = next(events)
            found[key], end = self._node(value, events, at)
            if spans is not None:
                spans[at] = Span(event.start_mark.index, value.start_mark.index, end, bool(start.flow_style))
        # Only in facts: a merged mapping is completed by the keys that are written here.
        if self.anchors is not None and isinstance(found.get("<<"), dict):
            found = {**found.pop("<<"), **found}
        # A block ends with its last value; the parser's own end lies behind the blank lines and remarks
        # that follow.
        return found, event.end_mark.index if start.flow_style else end

    def _sequence(self, start: Any, events: Iterator[Any], path: KeyPath) -> tuple[list[Any], int]:
        """Return a list, and where its text ends."""
        found: list[Any] = []
        spans, end = self.document.spans, start.end_mark.index
        while type(event := next(events)).__name__ != "SequenceEndEvent":
            at = (*path, len(found))
            item, end = self._node(event, events, at)
            found.append(item)
            if spans is not None:
                spans[at] = Span(event.start_mark.index, event.start_mark.index, end, bool(start.flow_style))
        return found, event.end_mark.index if start.flow_style else end

    def _error(self, what: str, event: Any) -> YamlError:
        return YamlError(what, _line_at(self.document.text, event.start_mark.index))


# -- what plain scalars mean

_NULLS = frozenset(("", "~", "null", "Null", "NULL"))
_TRUTHS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
_WHOLE = re.compile(r"[-+]?[0-9]+")
_BASED = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_REAL = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_LONGEST_NUMBER = 40


def _is_plain_scalar(event: Any) -> bool:
    """Return whether a value is a scalar without anchor and tag."""
    return type(event).__name__ == "ScalarEvent" and event.anchor is None and event.tag is None


def text_scalar(text: str) -> str | None:
    """Return the text itself, None for null: what kind a value is, is decided elsewhere."""
    return None if text in _NULLS else text


def typed_scalar(text: str) -> Any:
    """Return None, a truth value, a number or a text, as the core schema of YAML 1.2 has it.

    A number that is not finite or has more than 40 characters stays the text it is.
    """
    if text in _NULLS:
        return None
    # YAML 1.1 would take ``no`` and ``on`` too, which are keys of choices here, and 1:30 for 90.
    if text in _TRUTHS:
        return _TRUTHS[text]
    # int() of a very long text is slow, and no number of a machine has so many digits.
    if len(text) > _LONGEST_NUMBER or text[0] not in "-+.0123456789":
        return text
    if _WHOLE.fullmatch(text):
        return int(text)
    if _BASED.fullmatch(text):
        return int(text, 0)
    if _REAL.fullmatch(text):
        number = float(text)
        return number if math.isfinite(number) else text
    return text


class _SpelledInt(int):
    """A whole number that is written otherwise than Python writes it: 007, 0x1F."""

    spelling = ""


class _SpelledFloat(float):
    """A number that is written otherwise than Python writes it: a version 1.10."""

    spelling = ""


def spelled_scalar(text: str) -> Any:
    """Return what ``typed_scalar`` does, with a number that remembers how it is spelled."""
    found = typed_scalar(text)
    if isinstance(found, (str, bool)) or found is None or repr(found) == text:
        return found
    number = _SpelledInt(found) if isinstance(found, int) else _SpelledFloat(found)
    number.spelling = text
    return number
