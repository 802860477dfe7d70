"""Listings of a Grbl before 0.9g, whose numbers mean other settings: ``$0`` is the steps of X, not the pulse.

    $0=250.000 (x, step/mm)      Grbl 0.8 names each setting in a remark: the remark decides
    $0=250.000                   without remarks the numbers of the release decide whose figures have a point

What means the same today becomes a setting by its number of today. Kept as text is the rest: the default feed
and seek, the acceleration of the path (each axis has its own today), segments of arcs, and the masks, whose
bits are those of a port of the processor and not of the axes.

Sources: ``report_grbl_settings`` of grbl/report.c (settings.c before 0.8) in grbl/grbl, of the branches v0_7
and v0_8 and of the commits 2055e92 (0.9b), 3c3382f (0.9c) and 532c359 (0.9e).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.formats import FormatError

from .log import LoggedListing, figure

OLDER = "grbl-0.9"
"""The machine type that such a listing is read for."""
_TODAY = {
    "x": 100,
    "y": 101,
    "z": 102,
    "rate.x": 110,
    "rate.y": 111,
    "rate.z": 112,
    "accel.x": 120,
    "accel.y": 121,
    "accel.z": 122,
    "travel.x": 130,
    "travel.y": 131,
    "travel.z": 132,
    "pulse": 0,
    "idle": 1,
    "enable": 4,
    "limits": 5,
    "junction": 11,
    "tolerance": 12,
    "inches": 13,
    "soft": 20,
    "hard": 21,
    "homing": 22,
    "locate": 24,
    "search": 25,
    "debounce": 26,
    "pulloff": 27,
}
"""Name in the tables below -> its number since Grbl 0.9g; the other names have none."""
_WHOLE = {
    "pulse",
    "idle",
    "enable",
    "limits",
    "inches",
    "soft",
    "hard",
    "homing",
    "debounce",
    "mask",
    "dirs",
    "homing_dirs",
    "corrections",
    "decimals",
    "auto",
}
"""Names whose figures are printed without a point."""
_STEPS_RATES = "x y z rate.x rate.y rate.z accel.x accel.y accel.z travel.x travel.y travel.z pulse"
_HOMING = "homing homing_dirs locate search debounce pulloff"
_LAYOUTS = {
    "0.7": ["x", "y", "z", "pulse", "feed", "seek", "segment", "mask", "accel", "junction"],
    "0.8": (
        "x y z pulse feed seek mask idle accel junction segment corrections decimals inches auto enable hard"
        f" {_HOMING}"
    ).split(),
    "0.9b": (
        f"{_STEPS_RATES} feed mask idle junction tolerance decimals inches auto enable soft hard {_HOMING}"
    ).split(),
    "0.9c": (
        f"{_STEPS_RATES} feed mask dirs idle junction tolerance decimals inches auto enable limits soft hard"
        f" {_HOMING}"
    ).split(),
    "0.9e": (
        f"{_STEPS_RATES} mask dirs idle junction tolerance decimals inches auto enable limits soft hard"
        f" {_HOMING}"
    ).split(),
}
"""Release -> the names of its settings, from ``$0`` on."""
_NAMED = {r"0\.7": "0.7", r"0\.8": "0.8", r"0\.9[ab]$": "0.9b", r"0\.9[cd]$": "0.9c", r"0\.9[ef]$": "0.9e"}
"""What a control names itself -> the release that has the same numbers."""
_REMARKS = {
    r"[xyz], step/mm": "",
    r"steps/mm [xyz]": "",
    r"[xyz] (?:max rate|v_max)": "rate",
    r"[xyz] accel": "accel",
    r"[xyz] max travel": "travel",
    r"step pulse|microseconds step pulse": "pulse",
    r"step idle delay": "idle",
    r"invert step enable|step enable invert": "enable",
    r"invert limit pins|limit pins invert": "limits",
    r"(?:cornering )?junction deviation": "junction",
    r"arc tolerance": "tolerance",
    r"report inches": "inches",
    r"soft limits": "soft",
    r"hard limits": "hard",
    r"homing cycle": "homing",
    r"homing feed": "locate",
    r"homing seek": "search",
    r"homing debounce": "debounce",
    r"homing pull-off": "pulloff",
    r"default (?:feed|seek)|mm/min default|acceleration(?:,| in)|arc, mm|mm/arc": "older",
    r"n-arc|n-decimals|auto start": "older",
}
"""What a remark begins with -> the name; of an axis behind which its letter comes. ``older`` are settings
that Grbl has no more.
"""
_BYTES = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, *range(14, 24), 26}
"""Numbers below 29 whose figures have no point since 0.9g, in grblHAL too."""
_MIN_ALIAS_NAMES, _MIN_SETTINGS = 3, 8
"""Remarks that name another setting than the number does today before all are believed; settings before a
listing without remarks is taken for an older one."""


@dataclass
class OlderListing:
    """A listing of an older Grbl by the numbers of today."""

    name: str
    """``Grbl 0.8``."""
    numbers: dict[int, int]
    """Number of then -> number of today, of what was read."""
    kept: dict[str, str] = field(default_factory=dict)
    """``Grbl 0.8 $4`` -> what it was: that has no setting of today."""

    def __str__(self) -> str:
        """Return the account of it."""
        read = ", ".join(f"${then} as ${today}" for then, today in sorted(self.numbers.items()))
        kept = f"; kept as text: {', '.join(self.kept)}" if self.kept else ""
        return (
            f"a listing of {self.name}, where the numbers mean other settings. What means the same today was"
            f" read by its number of today, {read}{kept}. The result is for a Grbl 0.9 or newer, not for that"
            " control"
        )


def read_older(listing: LoggedListing, greeting: str) -> tuple[LoggedListing, OlderListing] | None:
    """Return a listing by the numbers of today, and the account of it; None where it is of today.

    ``greeting`` is what the control wrote as it started.
    """
    release = match[1] if (match := re.search(r"\bgrbl v?(0\.[0-9]\w?)", greeting, re.IGNORECASE)) else ""
    if max(listing.settings) >= max(map(len, _LAYOUTS.values())):
        return None  # whatever is written beside it: a memory in disorder has remarks of other settings
    names = _by_remarks(listing) or _by_layout(listing, release)
    if not names:
        return None
    then = OlderListing(
        f"Grbl {release or _release_of(listing, names)}",
        {n: _TODAY[m] for n, m in names.items() if m in _TODAY},
    )
    today = LoggedListing(heading=listing.heading)
    for n, text in listing.settings.items():
        if n in then.numbers:
            # Without its remark, which belongs to the number of then.
            today.put(then.numbers[n], figure(text), listing.lines[n], "", "")
        else:
            then.kept[f"{then.name} ${n}"] = " ".join(filter(None, (text, _in_brackets(listing.remarks[n]))))
    return today, then


def _in_brackets(remark: str) -> str:
    return f"({remark})" if remark else ""


def _by_remarks(listing: LoggedListing) -> dict[int, str]:
    """Return number -> name as the remarks have it; empty where few of them name another setting than the
    number does today.
    """
    names = {n: name for n, remark in listing.remarks.items() if (name := _name_of(remark))}
    if sum(_TODAY.get(name) != n for n, name in names.items()) < _MIN_ALIAS_NAMES:
        return {}
    # A person who types a listing leaves remarks out: the one release that the others show has the names.
    layout = dict(enumerate(_LAYOUTS.get(_release_of(listing, names), ())))
    return {n: layout[n] for n in listing.settings.keys() & layout.keys() if not listing.remarks[n]} | names


def _name_of(remark: str) -> str:
    for begins, name in _REMARKS.items():
        if re.match(begins, remark, re.IGNORECASE):
            axis = re.search(r"\b[xyz]\b", remark.casefold()) if "[xyz]" in begins else None
            return ".".join(filter(None, (name, axis[0]))) if axis else name
    return ""


def _by_layout(listing: LoggedListing, release: str) -> dict[int, str]:
    """Return number -> name by the numbers of the release that the control names, or of the one whose figures
    have a point where these have one; empty where they could be of today. Raises FormatError where several
    releases could have listed them.
    """
    texts = {n: figure(text) for n, text in listing.settings.items()}
    named = next((key for letters, key in _NAMED.items() if re.match(letters, release)), "")
    if not named and not _is_odd(listing, texts):
        return {}
    layouts = [dict(enumerate(_LAYOUTS[key])) for key in ([named] if named else _LAYOUTS)]
    fits = [names for names in layouts if _fits(texts, names)]
    # All numbers present is the stronger sign; where figures have their points decides between the rest.
    for is_likelier in (
        lambda names: names.keys() == texts.keys(),
        lambda names: all(("." in texts[n]) != (names[n] in _WHOLE) for n in texts),
    ):
        fits = [*filter(is_likelier, fits)] or fits
    if len(fits) > 1:
        raise FormatError(
            "this is a listing of a Grbl before 0.9g, whose numbers mean other settings ($0 is the steps of"
            " X, not the pulse), and it does not show of which release: it is not read. Add the line with"
            " which the control starts, Grbl 0.8c for example",
            listing.first_line,
            1,
        )
    return fits[0] if fits else {}


def _is_odd(listing: LoggedListing, texts: Mapping[int, str]) -> bool:
    """Return whether remarks name other settings than the numbers do today, or what are whole bytes today
    has a point.
    """
    names = {n: _name_of(remark) for n, remark in listing.remarks.items()}
    if any(name and _TODAY.get(name) != n for n, name in names.items()):
        return True
    odd = sum("." in texts[n] for n in _BYTES & texts.keys())
    # One such point may be a slip of a person; a short listing may be a part of anything.
    return odd > 1 and len(texts) >= _MIN_SETTINGS and texts.keys() >= {0, 1, 2}


def _fits(texts: Mapping[int, str], names: Mapping[int, str]) -> bool:
    """Return whether a release has all these numbers, and none of its whole figures has a point here."""
    return texts.keys() <= names.keys() and not any("." in texts[n] and names[n] in _WHOLE for n in texts)


def _release_of(listing: LoggedListing, names: dict[int, str]) -> str:
    """Return the one release that has these names at these numbers; one before 0.9g where several could."""
    known = {n: name for n, name in names.items() if name in _TODAY}
    fits = [
        release
        for release, layout in _LAYOUTS.items()
        if max(listing.settings) < len(layout) and all(layout[n] == name for n, name in known.items())
    ]
    return fits[0] if len(fits) == 1 else "before 0.9g"
