"""A packed word given by what its bits are called: ``Enable, Override locks``.

A bit is set by its label, a field of several bits by ``label: choice`` or ``label: number``; whatever is not named is
0, and ``none`` is no bit at all.
"""

from __future__ import annotations

import re
from difflib import get_close_matches

from .model import Bit, Parameter
from .quoting import quoted
from .values import InvalidValueError, field_at, plain, with_field

_LONGEST = 4096
_MOST = 256
"""Labels in one text; a word has at most 64 bits."""
_SHOWN = 6


def word_of_labels(parameter: Parameter, text: str) -> int | None:
    """Return the word that labels mean; None where nothing in the text is one.

    Raises InvalidValueError for a label that stands beside good ones and is unknown, or that several bits share.
    """
    if plain(text) == "none":
        return 0
    pieces = text.split(",", _MOST) if len(text) <= _LONGEST else []
    word, at, unknown = 0, 0, []
    while at < len(pieces):
        for end in range(len(pieces), at, -1):  # a label may hold commas itself
            entry = ",".join(pieces[at:end]).strip()
            try:
                found = _with_entry(parameter, word, entry)
            except InvalidValueError:
                if end == at + 1:
                    raise
                continue  # "Name: X, Group: 1": the value of the first ends at the comma
            if found is not None:
                word, at = found, end
                break
        else:
            unknown.append(pieces[at].strip())
            at += 1
    if not pieces or len(unknown) == len(pieces):
        return None
    if unknown:
        raise InvalidValueError(no_label(parameter, unknown[0]))
    return word


def no_label(parameter: Parameter, text: str) -> str:
    """Return what is said of a text that is no bit of a word, with the labels that come near."""
    labels = {plain(b.label): b.label for b in parameter.bits or ()}
    near = [labels[n] for n in get_close_matches(plain(text[:80]), labels, 3, 0.5)]
    if near:
        return f"{quoted(text)} is no bit of {parameter.name}. Did you mean: {', '.join(near)}"
    told = list(labels.values())
    more = f" and {len(told) - _SHOWN} more" if len(told) > _SHOWN else ""
    return f"{quoted(text)} is no bit of {parameter.name}, whose bits are {', '.join(told[:_SHOWN])}{more}"


def _with_entry(parameter: Parameter, word: int, entry: str) -> int | None:
    """Return the word with what one entry names set in it; None where the entry names nothing."""
    numbered = re.fullmatch("bit ([0-9]{1,2})", plain(entry))
    if numbered:
        return with_field(field_at(parameter, int(numbered[1])), word, "1")
    fields = _called(parameter, entry)
    if fields:
        field = _only(parameter, entry, fields)
        if field.width > 1:
            raise InvalidValueError(
                f"{field.label} of {parameter.name} has {field.width} bits: write '{field.label}: …'"
            )
        return word | 1 << field.bit
    for sign in re.finditer("[:=]", entry):
        fields = _called(parameter, entry[: sign.start()])
        if fields:
            return with_field(_only(parameter, entry, fields), word, entry[sign.end() :])
    return None


def _called(parameter: Parameter, label: str) -> list[Bit]:
    return [b for b in parameter.bits or () if plain(b.label) == plain(label)]


def _only(parameter: Parameter, entry: str, fields: list[Bit]) -> Bit:
    if len(fields) > 1:
        bits = " and ".join(str(b.bit) for b in fields)
        raise InvalidValueError(
            f"{quoted(entry)} is what the bits {bits} of {parameter.name} are called: set one bit at a time"
        )
    return fields[0]
