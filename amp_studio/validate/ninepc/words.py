"""Program words and their formats: chapters 15, 16 and 23."""

from __future__ import annotations

import re

_FORMAT = re.compile(r"([0-9])\.([0-9])(?:-([0-9])\.([0-9]))?")


def largest_word(form: str, inch: bool) -> float:
    """Largest number that a word of a format can write in inch or in metric programs (page 15-1).

    "3.4-4.3", for 3.4 inch and 4.3 metric, ends at 999.9999 in and 9999.999 mm; "3.4" is the same in both.
    """
    found = _FORMAT.fullmatch(form)
    if not found:
        raise ValueError(f"A word format is digits before and behind the point, as 3.4-4.3, not {form!r}.")
    whole, decimals = found.groups()[:2] if inch or not found[3] else found.groups()[2:]
    return round(10.0 ** int(whole) - 10.0 ** -int(decimals), int(decimals))
