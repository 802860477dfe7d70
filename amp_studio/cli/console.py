"""What every verb says and how: one line for what cannot be used, notes, JSON, progress."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Sequence
from typing import Any

from amp_studio.schema import Schema, family_ids, load_schema


class UsageFault(Exception):
    """Input that cannot be used; the text is the one line the user sees."""


def note(text: str) -> None:
    """Print a line that is no result."""
    print(text, file=sys.stderr)


def print_json(data: Any) -> None:
    """Print one JSON document; a terminal without UTF-8 gets it in ASCII."""
    print(json.dumps(data, ensure_ascii=(sys.stdout.encoding or "").lower() != "utf-8", indent=2))


def family(name: str) -> Schema:
    """Return a family's schema; raises UsageFault."""
    try:
        return load_schema(name)
    except KeyError:
        raise UsageFault(f"'{name}' is no control family: {', '.join(family_ids())}") from None


def progress() -> Callable[[str, int, int], None]:
    """Return a progress callback: one line on standard error that counts the per cent."""
    last: dict[str, int] = {}

    def show(stage: str, done: int, total: int) -> None:
        percent = 100 if total == 0 else done * 100 // total
        if last.get(stage) != percent:
            last[stage] = percent
            if sys.stderr.isatty():
                print(
                    f"\r{stage} {percent:3d} %",
                    end="\n" if percent == 100 else "",
                    file=sys.stderr,
                    flush=True,
                )
            elif percent == 100:
                print(f"{stage} 100 %", file=sys.stderr, flush=True)

    return show


def assignments(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Part ``PARAM=VALUE`` texts; raises UsageFault."""
    pairs = []
    for text in texts:
        param, sign, value = text.partition("=")
        if not sign or not param.strip():
            raise UsageFault(f"'{text}' is not PARAM=VALUE")
        pairs.append((param.strip(), value.strip()))
    return pairs
