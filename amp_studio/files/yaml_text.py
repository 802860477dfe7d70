"""Writes YAML, and changes entries of a YAML text without touching another byte of it.

What did not change stays as a person wrote it: remarks, order, spelling, line ends. A new entry comes after
the one before it in the given order; a remark below an entry that goes belongs to what follows, and stays.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from amp_studio.schema import KeyPath, Span, YamlDocument, typed_scalar

_BREAK = re.compile("\r\n|\n|\r")
_LONGEST_KEY = 1000
"""A key may have 1024 characters unless it is marked by ``?``."""

# -- one value

_PRINTABLE = re.compile("[^\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufeff\ufffe\uffff]+")
_PLAIN = re.compile(r"(?:[^\s\-?:,\[\]{}#&*!|>'\"%@`=<~]|-(?=[^\s\-]))(?:.*[^\s:])?")
"""It begins with no character that means something, and ends with none."""
_LOOKS_OTHERWISE = re.compile(
    r"\.\.\.|[-+]?[0-9_.,:]*[0-9][0-9_.,:]*(?:[eE][-+]?[0-9]+)?|[0-9]{4}-[0-9]{1,2}-.*"
)
"""Numbers and dates of other readers of YAML."""
_ESCAPES = {"\n": "\\n", "\t": "\\t", "\r": "\\r", '"': '\\"', "\\": "\\\\"}


def scalar_text(value: Any) -> str:
    """Return a scalar so that it is read back as what it is."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return getattr(value, "spelling", "") or repr(value)
    text = str(value)
    if _is_plain(text):
        return text
    if _PRINTABLE.fullmatch(text):
        return "'" + text.replace("'", "''") + "'"
    return _double_quoted(text) if text else "''"


def _is_plain(text: str) -> bool:
    """Return whether a text needs no quotes: no character of it means something, and it is read as a text."""
    if not _PRINTABLE.fullmatch(text) or not _PLAIN.fullmatch(text) or ": " in text or " #" in text:
        return False
    return isinstance(typed_scalar(text), str) and not _LOOKS_OTHERWISE.fullmatch(text)


def _double_quoted(text: str) -> str:
    return (
        '"' + "".join(_ESCAPES.get(c) or (c if _PRINTABLE.fullmatch(c) else _escape(c)) for c in text) + '"'
    )


def _escape(character: str) -> str:
    code = ord(character)
    return f"\\x{code:02X}" if code < 0x100 else f"\\u{code:04X}" if code < 0x10000 else f"\\U{code:08X}"


def _flow_text(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_flow_text(k)}: {_flow_text(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_flow_text, value)) + "]"
    # In brackets a text without quotes would end at a comma.
    return _double_quoted(value) if isinstance(value, str) else scalar_text(value)


# -- entries


def _entry_lines(key: Any, value: Any, indent: str = "") -> Iterator[str]:
    """Yield the lines of one entry of a mapping: lists and mappings in it as blocks,
    what is in these in one line each.
    """
    name = scalar_text(key)
    if len(name) > _LONGEST_KEY:
        yield f"{indent}? {name}"
        name = ""
    if isinstance(value, Mapping) and value:
        yield f"{indent}{name}:"
        for inner, inside in value.items():
            yield from _entry_lines(inner, inside, indent + "  ")
    elif isinstance(value, (list, tuple)) and value:
        yield f"{indent}{name}:"
        yield from (f"{indent}- {_line_text(item)}" for item in value)
    else:
        yield f"{indent}{name}: {_line_text(value)}"


def _line_text(value: Any) -> str:
    """Return how a value is written in one line: a list or a mapping in brackets."""
    return _flow_text(value) if isinstance(value, (Mapping, list, tuple)) else scalar_text(value)


def new_text(entries: Mapping[str, Any], end: str = "") -> str:
    """Return a document of these entries, with an end mark."""
    lines = [line for key, value in entries.items() for line in _entry_lines(key, value)]
    return "".join(f"{line}\n" for line in [*lines, *filter(None, [end])])


def amended(
    document: YamlDocument, known: Mapping[str, Any], wanted: Mapping[str, Any], sections: Sequence[str] = ()
) -> str | None:
    """Return the text of a document with other entries; None where it is a mapping in braces,
    which has no lines.

    ``known`` is what each entry means now, in the terms of ``wanted``: what is equal in both is not touched.
    The entries of ``sections`` are compared one by one.
    """
    editor = _Editor(document, sections)
    if not isinstance(document.data, dict) or any(editor.is_flow((key,)) for key in document.data):
        return None
    editor.amend((), known, wanted)
    return editor.text()


def with_item(document: YamlDocument, key: str, item: Mapping[str, Any]) -> str | None:
    """Return the text of a document with one more mapping at the end of a list; None as ``amended``.

    A list that is not there is made; one in brackets or without entries is written again.
    """
    data = {} if document.data is None else document.data
    editor = _Editor(document, ())
    if not isinstance(data, dict) or any(editor.is_flow((name,)) for name in data):
        return None
    if key not in data:
        editor.add_item(f"{key}:", None, item)
        return editor.text()
    listed = data[key] or ()
    last = editor.spans[(key, len(listed) - 1)] if listed else None
    if last is None or last.is_flow:
        return amended(document, data, data | {key: [*listed, item]})
    editor.add_item("", last, item)
    return editor.text()


class _Editor:
    """Collects changes of a text."""

    def __init__(self, document: YamlDocument, sections: Sequence[str]) -> None:
        self.document, self.sections = document, sections
        self.spans = document.spans or {}
        match = _BREAK.search(document.text)
        self.line_end = match[0] if match else "\n"
        self.edits: list[tuple[int, int, str]] = []

    def is_flow(self, path: KeyPath) -> bool:
        return self.spans[path].is_flow

    def text(self) -> str:
        """Return the text with the changes."""
        source, parts, at = self.document.text, [], 0
        # Stable, so that new entries of one place stay in their order.
        for start, end, new in sorted(self.edits, key=lambda edit: edit[:2]):
            parts += [source[at:start], new]
            # What lies inside of a part that is removed ends before it.
            at = max(at, end)
        return "".join([*parts, source[at:]])

    def amend(self, path: KeyPath, known: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
        """Bring the entries of a block mapping, which is not empty, to what is wanted."""
        first = self.spans[(*path, next(iter(known)))].start
        indent = " " * (first - self._line_start(first)) if path else ""
        for key in known:
            if key not in wanted:
                self._delete((*path, key))
        behind = self._line_behind(self.spans[path].start + 1) if path else self._line_start(first)
        for key, value in wanted.items():
            if key not in known:
                self._insert(behind, key, value, indent)
                continue
            behind = self._line_behind(self.spans[*path, key].end)
            # By their text, as 1, 1.0 and True are equal to Python.
            if repr(known[key]) != repr(value) and not self._amended_in_place(
                (*path, key), known[key], value
            ):
                self._delete((*path, key))
                self._insert(behind, key, value, indent)

    def _amended_in_place(self, path: KeyPath, known: Any, value: Any) -> bool:
        """Bring a section entry by entry, or a scalar, to another value; return whether it is one of both."""
        if len(path) == 1 and path[0] in self.sections and self._is_block(path, known) and value:
            self.amend(path, known, value)
            return True
        return self._replace_scalar(path, value)

    def add_item(self, title: str, last: Span | None, item: Mapping[str, Any]) -> None:
        """Write a mapping as the next item of a list in lines; as the first, under its title,
        where there is no last.
        """
        text, indent = self.document.text, ""
        at = max((self._line_behind(span.end) for span in self.spans.values()), default=len(text))
        if last is not None:
            dash, at = text.rfind("-", 0, last.start), self._line_behind(last.end)
            indent = " " * (dash - self._line_start(dash))
        lines = [line for key, value in item.items() for line in _entry_lines(key, value, indent + "  ")]
        first = f"{indent}- {lines[0].lstrip()}"
        self._insert_lines(at, [*filter(None, [title]), first, *lines[1:]])

    def _is_block(self, path: KeyPath, known: Any) -> bool:
        return isinstance(known, Mapping) and bool(known) and not self.is_flow((*path, next(iter(known))))

    def _replace_scalar(self, path: KeyPath, value: Any) -> bool:
        """Write a scalar in the place of another; False where one of them is none."""
        span, source = self.spans[path], self.document.text
        old = source[span.value : span.end]
        before = source[span.start : span.value].rstrip()
        kinds = (Mapping, list, tuple)
        if isinstance(value, kinds) or isinstance(self._data(path), kinds) or not before.endswith(":"):
            return False
        new = scalar_text(value)
        ending = _BREAK.search(old[-2:]) if old.endswith(("\n", "\r")) else None
        blank = " " if source[span.value - 1] == ":" else ""
        self.edits.append((span.value, span.end, f"{blank}{new}{ending[0] if ending else ''}"))
        return True

    def _delete(self, path: KeyPath) -> None:
        """Remove an entry with the remark in its own line; remarks in lines of their own stay."""
        span, data = self.spans[path], self._data(path)
        if isinstance(data, dict) and self._is_block(path, data):
            self.edits.append((self._line_start(span.start), self._line_behind(span.start + 1), ""))
            for key in data:
                self._delete((*path, key))
        else:
            self.edits.append((self._line_start(span.start), self._line_behind(span.end), ""))

    def _data(self, path: KeyPath) -> Any:
        data = self.document.data
        for step in path:
            data = data[step]
        return data

    def _insert(self, at: int, key: str, value: Any, indent: str) -> None:
        self._insert_lines(at, _entry_lines(key, value, indent))

    def _insert_lines(self, at: int, new: Iterable[str]) -> None:
        lines = "".join(line + self.line_end for line in new)
        is_open = (
            at and self.document.text[at - 1] not in "\r\n"
        )  # the last line of a text without a line end
        self.edits.append((at, at, self.line_end + lines if is_open else lines))

    def _line_start(self, at: int) -> int:
        text = self.document.text
        return max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1

    def _line_behind(self, at: int) -> int:
        """Return where the line behind a place begins; a block of text ends with its line."""
        text = self.document.text
        if at and text[at - 1] in "\r\n":
            return at
        match = _BREAK.search(text, at)
        return match.end() if match else len(text)


def without_stray_tabs(content: bytes) -> bytes:
    """Return a content whose blank lines are empty:
    YAML takes a tab in one behind some entries and not behind others.
    """
    return re.sub(rb"(?m)^ *\t[ \t]*$", b"", content)
