"""Program words and their formats: chapters 15, 16 and 23."""

from __future__ import annotations

import re
from typing import Literal

from amp_studio.programs import NumberFormat, digits_of, number_of

_FORMAT = re.compile(r"([0-9])(?:\.([0-9]))?(?:-([0-9])\.([0-9]))?")
_WORD = re.compile(r"([+-]?)([0-9]+)")


def largest_word(form: str, inch: bool) -> float:
    """Largest number that a word of a format can write in inch or in metric programs (page 15-1).

    "3.4-4.3", for 3.4 inch and 4.3 metric, ends at 999.9999 in and 9999.999 mm; "3.4" and "6", which is six
    digits without decimals, are the same in both.
    """
    before, behind = _digits(form, inch)
    return round(10.0**before - 10.0**-behind, behind)


def word_value(word: str, form: str, inch: bool, suppressed: Literal["leading", "trailing"]) -> float:
    """Number of a word written without a point where zeros of one end are left out (page 15-3).

    In format 4.3 with leading zeros suppressed 01 is 0.001 and 2790 is 2.790; with trailing zeros
    suppressed 01 is 100.000 and 279 is 2790.000. ``word`` is what comes after the letter.
    """
    before, behind = _digits(form, inch)
    match = _WORD.fullmatch(word)
    if not match or len(match[2]) > before + behind:
        raise ValueError(f"A word of the format {form} has up to {before + behind} digits, not {word!r}.")
    if suppressed not in ("leading", "trailing"):
        raise ValueError(f"The zeros left out are the leading or the trailing ones, not {suppressed!r}.")
    value = number_of(
        word, NumberFormat((before, behind), "right" if suppressed == "leading" else "left")
    ).value
    assert value is not None  # as many digits as the format has
    return value


def _digits(form: str, inch: bool) -> tuple[int, int]:
    """Digits before and behind the point."""
    match = _FORMAT.fullmatch(form)
    if not match or (match[3] and not match[2]):
        raise ValueError(f"A word format is digits before and behind the point, as 3.4-4.3, not {form!r}.")
    return digits_of(form, inch)
