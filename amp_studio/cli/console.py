"""What every verb prints and how: one line for what cannot be used, notes, JSON, progress."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import UsageError
from .screen import print_notice, print_over

if TYPE_CHECKING:
    from amp_studio.schema import Schema


def print_remark(text: str) -> None:
    """Print a line that is no result."""
    print_notice(" ".join(text.split()))


def ask(question: str) -> str:
    """Return a person's answer; the question goes through the stream that keeps texts
    from steering the terminal.
    """
    print_notice(question, end="")
    return input()


def print_json(data: Any) -> None:
    """Print one JSON document; a terminal without UTF-8 gets it in ASCII."""
    import json

    is_ascii = (sys.stdout.encoding or "").lower() != "utf-8"
    # As it comes: the rows of a long program would not fit into memory.
    for part in json.JSONEncoder(ensure_ascii=is_ascii, indent=2).iterencode(data):
        sys.stdout.write(part)
    print()


def family(name: str) -> Schema:
    """Return a family's schema; raises UsageError."""
    from amp_studio import load_schema
    from amp_studio.schema import UnknownFamilyError

    try:
        return load_schema(name)
    except UnknownFamilyError as error:
        raise UsageError(str(error)) from None


def is_family(text: str) -> bool:
    """Return whether a text names a family, and not a file; raises UsageError where there is neither."""
    from amp_studio import family_ids

    if text in family_ids():
        return True
    path = Path(text)
    if not path.suffix and len(path.parts) == 1 and not path.exists():
        family(text)
    return False


def progress(of: str = "") -> Callable[[str, int, int], None]:
    """Return a progress callback: one line on standard error that counts the per cent.

    A terminal sees it change; elsewhere, and where it is that ``of`` one control among several, the end of
    each stage is a line, and what is waited for.
    """
    last: dict[str, int] = {}
    # Of several controls at once each would write over the line of the others.
    changes = sys.stderr.isatty() and not of
    before = f"{of}: " if of else ""

    def show(stage: str, done: int, total: int) -> None:
        if stage == "silent":
            silence(done)
            return
        if total < 0:  # what the person is to do at the control, as a sentence
            print_notice(before + stage)
            return
        if stage == "cut":
            print_notice(f"{before}the line is cut, trying again …")
            last["silent"] = 0
            return
        # Of nothing all is done. Rounded down, so that 100 is the end and nothing before it.
        percent = 100 if total == 0 else done * 100 // total
        if last.get(stage) == percent:
            return
        if changes:
            print_over(f"{_WAITING.get(stage, stage)} {percent:3d} %", last=percent == 100)
        elif percent == 100:
            print_notice(f"{before}{stage} 100 %")
        elif stage in _WAITING and stage not in last:
            print_notice(before + _WAITING[stage])
        last[stage] = percent

    def silence(seconds: int) -> None:
        text = f"no answer for {seconds} s, trying again …" if seconds else "the control answers again"
        if changes:
            print_over(text, last=not seconds)
            last.clear()
        elif not seconds or "silent" not in last:
            print_notice(before + text)
        last["silent"] = seconds
        if not seconds:
            del last["silent"]

    return show


_WAITING = {"restart": "waiting for the control to restart"}
"""What the person reads while a stage waits for another program."""


def assignments(texts: Sequence[str], form: str = "PARAM=VALUE") -> list[tuple[str, str]]:
    """Part texts of this form; raises UsageError that names all that are none."""
    from amp_studio.schema import quoted

    pairs, slips = [], []
    for text in texts:
        param, sign, value = text.partition("=")
        if sign and param.strip():
            pairs.append((param.strip(), value.strip()))
        else:
            slips.append(f"{quoted(text)} is not {form}")
    if slips:
        raise UsageError("; ".join(slips))
    return pairs
