"""Records as JSON that is kept and read back without a check: facts were checked when they were compiled."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from amp_studio.schema.compiled_cache import read_cached, report_unusable, write_cached

from .record import Model

R = TypeVar("R", bound=Model)

_KIND = "is"
"""The key under which an object names its kind of record; no field of a record is called so."""


def cached_record(path: Path, kind: type[R], name: str, make: Callable[[], R]) -> R:
    """Return the record that is kept at a path; where there is none, ``make`` one and keep it there.

    ``name`` is that of the family, or of its texts in a language: older ones of the same name are removed.
    """
    kept = read_cached(path)
    if kept is not None:
        try:
            found = text_record(kept)
        except ValueError:
            found = None
        if isinstance(found, kind):
            return found
        # Its digest was right, so it was written by something else, or for another kind of record.
        report_unusable(path, "it contains no facts")
    made = make()
    write_cached(path, record_text(made).encode(), name)
    return made


def record_text(record: Model) -> str:
    """Return a record, and the records in it, as JSON; fields that have their default are left out."""
    return json.dumps(record, default=_plain, ensure_ascii=False, separators=(",", ":"))


def _plain(record: Any) -> dict[str, Any]:
    return {_KIND: type(record).__name__} | {
        name: value for name, value in record.items() if value != record.fields[name]
    }


def text_record(text: str | bytes) -> Any:
    """Return the record of such a text; raises ValueError for what is none."""
    kinds = _kinds(Model)

    def record_of(entry: dict[str, Any]) -> Any:
        for name, value in entry.items():
            # JSON has no tuples, and records have no lists: they are hashed.
            if value.__class__ is list:
                entry[name] = _tuple(value)
        kind = entry.pop(_KIND, None)
        if kind is None:
            return entry
        # Past the constructor: what was checked when it was compiled needs no second check.
        record = object.__new__(kinds[kind])
        record.__dict__.update(entry)
        return record

    try:
        return json.loads(text, object_hook=record_of)
    except (LookupError, TypeError, RecursionError) as error:
        raise ValueError(f"these are no records: {error}") from None


def _tuple(values: list[Any]) -> tuple[Any, ...]:
    return tuple([_tuple(value) if value.__class__ is list else value for value in values])


def _kinds(kind: type[Model]) -> dict[str, type[Model]]:
    return {
        name: record
        for below in kind.__subclasses__()
        for name, record in {below.__name__: below, **_kinds(below)}.items()
    }
