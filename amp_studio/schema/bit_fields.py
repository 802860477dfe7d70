"""The fields of a packed word, one by one or given by what its bits are called: ``Enable, Override locks``.

A bit is set by its label, a field of several bits by ``label: choice`` or ``label: number``; whatever is not
named is 0, and ``none`` is no bit at all.
"""

from __future__ import annotations

import contextlib
import re
from collections import Counter

from .model import Bit, Parameter
from .nearest import close_matches
from .quoting import quoted
from .value import LONGEST_NUMBER, InvalidValueError, plain

_LONGEST = 4096
_MAX_LABELS = 256
"""Labels in one text; a word has at most 64 bits."""
_SHOWN = 6


def word_of_labels(parameter: Parameter, text: str) -> int | None:
    """Return the word that labels mean; None where nothing in the text is one.

    Raises InvalidValueError for an unknown label beside known ones, or that several bits share.
    """
    if plain(text) == "none":
        return 0
    # Bounded, as what follows takes the square of their number.
    pieces = text.split(",", _MAX_LABELS) if len(text) <= _LONGEST else []
    word, at, unknown = 0, 0, []
    while at < len(pieces):
        for end in range(len(pieces), at, -1):  # a label may contain commas itself
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
    if len(unknown) == len(pieces):
        return None
    if unknown:
        raise InvalidValueError(no_label(parameter, unknown[0]))
    return word


def labels_of_word(parameter: Parameter, word: int) -> str:
    """Return the labels of what is set in a word: ``Axis 1, Axis 5``; ``none`` where nothing is.

    It is read back by ``word_of_labels``; a bit without a label, or with that of another, is ``bit 7``.
    """
    fields = parameter.bits or ()
    counts = Counter(plain(field.label) for field in fields)
    parts, unnamed = [], word
    for field in fields:
        # What no field covers is written too: it would be lost when the text is read back.
        unnamed &= ~(((1 << field.width) - 1) << field.bit)
        number = field_value(field, word)
        if number:
            parts.append(_part(field, number, is_alone=counts[plain(field.label)] == 1))
    parts += [f"bit {n}" for n in range(unnamed.bit_length()) if unnamed >> n & 1]
    if not parts and any(choice.label == "none" for field in fields for choice in field.choices or ()):
        # Axis X in group 1 is 0: "none" is the name of another value.
        named = [field for field in fields if any(choice.raw == 0 for choice in field.choices or ())]
        parts = [_part(field, 0, is_alone=False) for field in named]
    return ", ".join(parts) or "none"


def _part(field: Bit, number: int, *, is_alone: bool) -> str:
    """Return what a field is in the text of a word; ``is_alone``: no other one has its label."""
    if field.width > 1 or field.choices:
        label = next((c.label for c in field.choices or () if c.raw == number), str(number))
        return f"{field.label}: {label}"
    # A label with a comma would be read back as two entries.
    return field.label if is_alone and "," not in field.label else f"bit {field.bit}"


def no_label(parameter: Parameter, text: str) -> str:
    """Return the message for a text that is not a bit of a word, with the nearest labels."""
    labels = {plain(b.label): b.label for b in parameter.bits or ()}
    near = [labels[n] for n in close_matches(plain(text[:80]), labels, 3, 0.5)]
    if near:
        return f"{quoted(text)} is no bit of {parameter.name}. Did you mean: {', '.join(near)}"
    names = list(labels.values())
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"{quoted(text)} is no bit of {parameter.name}, whose bits are {', '.join(names[:_SHOWN])}{more}"


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
    # Each of them: a label may contain a colon itself.
    for separator in re.finditer("[:=]", entry):
        fields = _called(parameter, entry[: separator.start()])
        if fields:
            return with_field(_only(parameter, entry, fields), word, entry[separator.end() :])
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


# -- one field ---------------------------------------------------------------------


def field_at(parameter: Parameter, bit: int) -> Bit:
    """Return the field that begins at a bit of a word;
    one that the database does not name is a bit by itself.

    Raises InvalidValueError for a parameter without bits, and beyond its last bit.
    """
    if parameter.type != "bits":
        raise InvalidValueError(f"{parameter.name} is no word of bits")
    width = parameter.word_width
    if width is not None and bit >= width:
        raise InvalidValueError(f"{parameter.name} has the bits 0 to {width - 1}, not {bit}")
    found = next((b for b in parameter.bits or () if b.bit == bit), None)
    return found if found is not None else Bit(bit=bit, label=f"bit {bit}", unknown=True)


def field_value(field: Bit, word: int) -> int:
    """Return the number in a field of a word."""
    number = (word >> field.bit) & ((1 << field.width) - 1)
    return number - (1 << field.width) if field.signed and number >> (field.width - 1) else number


def with_field(field: Bit, word: int, text: str) -> int:
    """Return a word with one field changed to what a person wrote; every other bit stays.
    Raises InvalidValueError.
    """
    mask = (1 << field.width) - 1
    number = _chosen(field, plain(text))
    if number is None:
        # A negative number becomes its two's complement in the width of the field.
        number = _typed_number(field, text) & mask
    return word & ~(mask << field.bit) | number << field.bit


def _chosen(field: Bit, typed: str) -> int | None:
    """Return the number of the choice of a field that a text names; None where it names none."""
    for choice in field.choices or ():
        names = [plain(name) for name in (choice.label, choice.code, choice.key) if name]
        if choice.raw is not None and typed in [*names, f"raw:{choice.raw}"]:
            return choice.raw
    return None


_SWITCH = {"yes": 1, "true": 1, "on": 1, "no": 0, "false": 0, "off": 0}


def _typed_number(field: Bit, text: str) -> int:
    """Return the number that is typed for a field, or yes or no for one bit; raises InvalidValueError."""
    typed = plain(text)
    if field.width == 1 and typed in _SWITCH:
        return _SWITCH[typed]
    mask = (1 << field.width) - 1
    lowest, highest = (-(mask + 1) // 2, mask // 2) if field.signed else (0, mask)
    with contextlib.suppress(ValueError):
        if (
            # First the length: int() of a very long text is slow.
            len(typed) <= LONGEST_NUMBER
            and lowest <= (number := int(typed.removeprefix("raw:"), 0)) <= highest
        ):
            return number
    if field.choices:
        offered = ", ".join(choice.label for choice in field.choices)
        raise InvalidValueError(f"{quoted(text.strip())} is not a choice of {field.label}: {offered}")
    raise InvalidValueError(f"{quoted(text)} does not fit {field.label}, which takes {lowest} to {highest}")
