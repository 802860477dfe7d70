"""Reads YAML of which every value is a text, straight from the parser's events.

A parameter file says by itself what kind each value is, so nothing has to be
guessed from its looks (``1e5``, ``0x10``, ``no``), and reading takes a fifth of
the time that YAML's own types take.
"""

from __future__ import annotations

from typing import Any


class TextFault(ValueError):
    """A document that is YAML but no plain list of texts: what is wrong, and in which line."""

    def __init__(self, what: str, event: Any) -> None:
        self.line: int = event.start_mark.line + 1
        super().__init__(what)


def read_texts(text: str) -> Any:
    """Return the one document of a text as dict, list and str; None for an empty one.

    Raises TextFault for a key that stands twice, a tag, a reference and a second document; ruamel's YAMLError.
    """
    from ruamel.yaml import YAML

    events = YAML(typ="safe").parse(text)
    found: Any = None
    documents = 0
    for event in events:
        kind = type(event).__name__
        if kind == "DocumentStartEvent":
            documents += 1
            if documents > 1:
                raise TextFault("is not readable: it holds a second document", event)
            found = _node(next(events), events)
    return found


def _node(event: Any, events: Any) -> Any:
    kind = type(event).__name__
    if getattr(event, "tag", None) not in (None, "!"):
        raise TextFault("is not readable: it uses a YAML tag, which a parameter file has not", event)
    if kind == "ScalarEvent":
        plain = event.implicit[0] and event.value in ("", "~", "null", "Null", "NULL")
        return None if plain else event.value
    if kind == "MappingStartEvent":
        return _mapping(events)
    if kind == "SequenceStartEvent":
        items = []
        while type(event := next(events)).__name__ != "SequenceEndEvent":
            items.append(_node(event, events))
        return items
    raise TextFault("is not readable: it uses a YAML reference, which a parameter file has not", event)


def _mapping(events: Any) -> dict[str, Any]:
    found: dict[str, Any] = {}
    while type(event := next(events)).__name__ != "MappingEndEvent":
        key = _node(event, events)
        if not isinstance(key, str):
            raise TextFault("is not readable: a key is no text", event)
        if key in found:
            raise TextFault(f"'{key}' stands twice", event)
        found[key] = _node(next(events), events)
    return found
