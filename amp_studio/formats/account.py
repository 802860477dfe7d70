"""What becomes of every value of a file in a text, and of every entry of a text in a file:
found by reading the text back.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, same_value, show_value, write_value

from .text_format import TextRead

_WORD = re.compile(r"[^\s,;:]+")


class NotWritten(NamedTuple):
    """A value that is not in the text, and why."""

    address: Address
    value: Value
    why: str


class Rounded(NamedTuple):
    """A value that the text gives back as another one."""

    address: Address
    before: Value
    after: Value


class UnknownEntry(NamedTuple):
    """An entry that names no parameter; ``line`` of the text, 0 where the entry was in a file."""

    name: str
    line: int


@dataclass(frozen=True)
class Account:
    """Every value is in exactly one of ``written`` (or their number), ``not_representable`` and
    ``rounded``.
    """

    written: int
    """Values that come back as they are."""
    kept: tuple[str, ...] = ()
    """Entries that name no parameter and are kept as text."""
    not_representable: tuple[NotWritten, ...] = ()
    rounded: tuple[Rounded, ...] = ()
    unknown: tuple[UnknownEntry, ...] = ()
    """Entries that name no parameter, those that are kept among them."""
    format: str = ""
    """Title of the format of an export."""


def account_of_export(
    file: ParameterFile, back: ParameterFile, title: str, left_out: frozenset[Address]
) -> Account:
    """Return what became of a file in a text of the format ``title``, which was read back as ``back``.

    ``left_out`` are the secrets that were not to be written.
    """
    missing: list[NotWritten] = []
    rounded: list[Rounded] = []
    for address, value in file.values.items():
        after = back.get(address)
        if after is None:
            missing.append(NotWritten(address, value, _why_missing(file, address, title, left_out)))
        # In another unit it may be the same value; only what a reader would notice is rounding.
        elif not same_value(value, after):
            rounded.append(Rounded(address, value, after))
    return Account(
        len(file.values) - len(missing) - len(rounded),
        tuple(text for name, text in file.unknown.items() if back.unknown.get(name) == text),
        tuple(missing),
        tuple(rounded),
        tuple(UnknownEntry(name, 0) for name in file.unknown),
        title,
    )


def account_of_import(file: ParameterFile, read: TextRead) -> Account:
    """Return what became of a text that was read; ``file`` is what was made of it."""
    return Account(
        len(file.values),
        (*read.kept, *read.unknown.values()),
        unknown=tuple(UnknownEntry(name, read.unknown_lines.get(name, 0)) for name in read.unknown),
    )


def _why_missing(file: ParameterFile, address: Address, title: str, left_out: frozenset[Address]) -> str:
    """Return why a value of a file is not in a text."""
    if address in left_out:
        return "secret values are left out unless secrets are to be shown"
    state = file.evaluation.state(address)
    if state.state == "hidden":
        return "it does not exist for this configuration"
    if file.schema.parameters[address[0]].access == "read":
        return "the control writes it itself"
    return f"there is no place for it in this format ({title})"


def account_json(file: ParameterFile, account: Account) -> dict[str, Any]:
    """Return an account in the form of ``import --json`` and ``export --json``; a secret has no value."""
    here = file.machine_schema

    def text(address: Address, value: Value) -> str | None:
        parameter = file.schema.parameters[address[0]]
        return None if parameter.secret else write_value(parameter, value)

    return {
        "written": account.written,
        "kept": list(account.kept),
        "not_representable": [
            {"param": here.short(one.address), "value": text(one.address, one.value), "why": one.why}
            for one in account.not_representable
        ],
        "rounded": [
            {
                "param": here.short(one.address),
                "from": text(one.address, one.before),
                "to": text(one.address, one.after),
            }
            for one in account.rounded
        ],
        "unknown": [{"name": one.name, "line": one.line or None} for one in account.unknown],
    }


def account_lines(file: ParameterFile, account: Account, named: str = "") -> Iterator[str]:
    """Yield what did not go across as it is, in words; nothing where all of it did.

    ``named`` are the notes of the reader: unknown entries that they name are not named again.
    """
    here = file.machine_schema
    why: dict[str, list[str]] = {}
    for missing in account.not_representable:
        why.setdefault(missing.why, []).append(here.short(missing.address))
    for reason, names in why.items():
        yield f"{_values(len(names))} not written, {reason}: {', '.join(names)}"
    if account.rounded:
        changes = []
        for one in account.rounded:
            parameter = file.schema.parameters[one.address[0]]
            values = (show_value(parameter, value) for value in (one.before, one.after))
            changes.append(f"{here.short(one.address)} {' -> '.join(values)}")
        yield f"{_values(len(changes))} changed by rounding: {', '.join(changes)}"
    yield from _unknown_line(account, named)


def _unknown_line(account: Account, named: str) -> Iterator[str]:
    """Yield one line about the entries that name no parameter; nothing where the reader's notes name all of
    them.
    """
    # $10 is not named where $100 is; and a log may have a hundred thousand, each of which is looked for.
    words = set(_WORD.findall(named))
    unknown = [
        one for one in account.unknown if one.name not in (words if _WORD.fullmatch(one.name) else named)
    ]
    if unknown:
        entries = "entry" if len(unknown) == 1 else "entries"
        names = [f"{one.name} (line {one.line})" if one.line else one.name for one in unknown]
        kept = "kept as text" if account.kept else "not kept"
        yield f"{len(names)} unknown {entries}, {kept}: {', '.join(names)}"


def _values(number: int) -> str:
    return f"{number} value{'' if number == 1 else 's'}"
