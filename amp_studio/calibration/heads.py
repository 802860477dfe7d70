"""What the head of a column of measured points means: position, angle of a circle, error, direction, run,
and the unit beside it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

HeadKind = Literal["position", "angle", "measured", "error", "correction", "mean", "run", "direction", ""]

_BRACKETED = re.compile(r"[\[(/_]\s*(mm|um|µm|μm|microns?|in|inch|inches|deg|degrees?|°|arcsec)\s*[\])]?\s*$")
_SPACED = re.compile(r"\s(mm|um|µm|μm|microns?|inch|inches|deg|degrees?|°|arcsec)\s*$")
_UNITS = {
    "mm": "mm",
    "um": "um",
    "µm": "um",
    "μm": "um",
    "micron": "um",
    "microns": "um",
    "in": "in",
    "inch": "in",
    "inches": "in",
    "deg": "deg",
    "degree": "deg",
    "degrees": "deg",
    "°": "deg",
    "arcsec": "arcsec",
}
_KINDS: tuple[tuple[HeadKind, str], ...] = (
    ("", r".*\b(std|stdev|standard|sigma|repeatability|range|max\.?|min\.?|maximum|minimum|limit)\b.*"),
    ("mean", r".*\b(mean|average|avg\.?|mittelwert|mittel)\b.*"),
    ("direction", r"direction|dir|approach|richtung"),
    ("run", r"(run|pass|cycle|series|lauf|messung)( ?(no\.?|number|nr\.?))?"),
    ("angle", r"angle|theta|phi|polar angle|winkel"),
    ("position", r"((target|nominal|command(ed)?|set|control|absolute)\s*)?(position|pos\.?|point|reading)"),
    ("position", r"soll|sollposition|sollwert|zielposition"),
    ("position", r"target|nominal|commanded|command|absolute|[xyzabcuvw]|[xyzabcuvw] (position|axis)"),
    ("correction", r".*\b(correction|compensation|comp\.?|korrektur)\b.*"),
    ("measured", r".*\b(measured|measurement|measure|actual|laser|ist|istposition|istwert|gemessen)\b.*"),
    ("error", r".*\b(error|err\.?|deviation|dev\.?|difference|diff\.?|abweichung|fehler)\b.*"),
)
_RISING = re.compile(r"(?<![a-z])(up|fwd|forwards?|pos|positive|rising|f)(?![a-z])|[↑→]|^\+|\+\)?$")
_FALLING = re.compile(
    r"(?<![a-z])(down|rev|reverse|back|backwards?|neg|negative|falling|r|b)(?![a-z])|[↓←]|^-|[-\u2212]\)?$"
)
_WORDS = {"+": True, "1": True, "+1": True, "-": False, "-1": False, "\u2212": False, "0": False}


@dataclass(frozen=True)
class Head:
    """One column; ``rising`` is None where its head names no direction."""

    kind: HeadKind
    unit: str
    rising: bool | None


def read_head(text: str, column: int) -> Head:
    """Return what a head means; a value column without a word of its kind, as ``Run 1 +``, contains
    errors.
    """
    words = " ".join(text.strip().strip("\"'").casefold().replace("_", " _").split())
    found = _BRACKETED.search(words) or _SPACED.search(words)
    unit = _UNITS[found[1]] if found else ""
    plain = words[: found.start()].strip() if found else words
    plain = plain.removesuffix(" in").replace(" _", " ").strip()
    # The first that fits: columns of spreads come first, since "standard deviation" has a word of errors.
    kind: HeadKind = next((kind for kind, pattern in _KINDS if re.fullmatch(pattern, plain)), "")
    rising = _direction_in(plain)
    if kind in ("", "run") and column and (rising is not None or re.search(r"\d", plain)):
        kind = "error"  # Run 1, 2-, F1
    return Head(kind, unit, rising)


def unit_of(cell: str) -> str | None:
    """Return the unit that a cell of a line of units names, "" for an empty cell; None for what is none."""
    word = cell.strip().strip("[]()").casefold()
    return _UNITS.get(word) if word else ""


def _direction_in(text: str) -> bool | None:
    """Return whether a text names the rising direction (True), the falling one (False), or none of them."""
    rising, falling = _RISING.search(text), _FALLING.search(text)
    # Words of both directions, as "pos. reverse", name none for certain.
    return None if bool(rising) == bool(falling) else bool(rising)


def direction_of(cell: str) -> bool | None:
    """Return the direction that a cell of a direction column means; None for what means none."""
    word = cell.strip().casefold()
    return _WORDS[word] if word in _WORDS else _direction_in(word)
