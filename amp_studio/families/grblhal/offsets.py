"""Offsets and start-up lines: what is lost with the memory too,
and what of it can be put back without moving anything.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from .content import GrblContent
from .numbers import decimals_of, written_number

PUT_BACK = (*(f"G{n}" for n in range(54, 60)), "G59.1", "G59.2", "G59.3")
"""Set by ``G10 L2 P1`` to ``P9`` whatever the position is. G28, G30 and G92 are set by where the machine
is."""
_REPORTS_INCHES = 13
_INCH = 25.4
_NEAR = 0.0026  # mm; a ten thousandth of an inch is shown
_COORDINATE = re.compile(r"-?\d{1,9}(\.\d{1,6})?")
_HARMLESS = re.compile(
    r"(G(1[789]|2[01]|40|49|5[4-9](\.[1-3])?|61|64|80|9[013457](\.1)?)|M0?[59](?!\d)|F\d+(\.\d*)?)*",
    re.IGNORECASE,
)


def reports_inches(content: GrblContent) -> bool:
    """Return whether the control shows offsets in inches."""
    return content.settings.get(_REPORTS_INCHES, "0") == "1"


def offset_differences(a: GrblContent, b: GrblContent) -> list[str]:
    """Return the names of the offsets that differ by more than is shown."""
    return [n for n in a.offsets if not is_same_offset(a, b, n)]


def is_same_offset(a: GrblContent, b: GrblContent, name: str) -> bool:
    """Return whether both controls have the same offset, as far as each shows it."""
    one, other = a.offsets.get(name), b.offsets.get(name)
    # What two controls show in one unit has the same digits, and compares as texts.
    if one is None or other is None or _is_shown_alike(a, b, one, other):
        return one == other
    first, second = _millimeters(a, one), _millimeters(b, other)
    return len(first) == len(second) and all(abs(x - y) <= _NEAR for x, y in zip(first, second, strict=True))


def _is_shown_alike(a: GrblContent, b: GrblContent, one: str, other: str) -> bool:
    """Return whether two offsets are in one unit, and neither was converted (``offsets_in``)."""
    return reports_inches(a) == reports_inches(b) and [decimals_of(part) for part in one.split(",")] == [
        decimals_of(part) for part in other.split(",")
    ]


def offsets_in(content: GrblContent, settings: Mapping[int, str]) -> dict[str, str]:
    """Return the offsets of a control as they are in the unit of other settings of it:
    converted, with more digits than it shows, where $13 is another one.
    """
    in_inches = settings.get(_REPORTS_INCHES, "0") == "1"
    if in_inches == reports_inches(content):
        return dict(content.offsets)
    factor = 1 / _INCH if in_inches else _INCH
    return {
        name: ",".join(f"{float(x) * factor:.6f}" if _COORDINATE.fullmatch(x) else x for x in text.split(","))
        for name, text in content.offsets.items()
    }


def _millimeters(content: GrblContent, text: str) -> list[float]:
    factor = _INCH if reports_inches(content) else 1.0
    return [float(part) * factor for part in text.split(",") if _COORDINATE.fullmatch(part)]


def at_axes(copy: GrblContent, present: GrblContent, name: str) -> str:
    """Return the coordinates of a copy on the axes of another control,
    which keeps its own where the copy has none; in the unit of the copy.
    """
    own_text = offsets_in(present, copy.settings)[name]
    theirs, own = copy.offsets.get(name, "").split(","), own_text.split(",")
    if copy.axes == present.axes or len(theirs) != len(copy.axes) or len(own) != len(present.axes):
        return copy.offsets.get(name, own_text)
    by_axis = dict(zip(copy.axes, theirs, strict=True))
    return ",".join(by_axis.get(axis, at) for axis, at in zip(present.axes, own, strict=True))


def offsets_to_put_back(wanted: GrblContent, present: GrblContent) -> Iterable[str]:
    """Yield the names of the offsets that are to be put back."""
    for name in offset_differences(wanted, present):
        parts = wanted.offsets[name].split(",")
        if name in PUT_BACK and len(parts) == len(wanted.axes) and all(map(_COORDINATE.fullmatch, parts)):
            yield name


def offset_command(wanted: GrblContent, name: str, *, in_inches: bool) -> str:
    """Return the command that sets an offset, in the unit that is active at the control:
    another one would stay active for the next program where the download breaks off.
    """
    factor = 1.0
    if in_inches != reports_inches(wanted):
        factor = 1 / _INCH if in_inches else _INCH
    words = "".join(
        f"{axis}{written_number(float(part) * factor)}"
        for axis, part in zip(wanted.axes, wanted.offsets[name].split(","), strict=True)
    )
    return f"{'G20' if in_inches else 'G21'}G10L2P{PUT_BACK.index(name) + 1}{words}"


def startup_commands(wanted: GrblContent, present: GrblContent) -> Iterable[tuple[str, str]]:
    """Yield name and command of each start-up line that is to be put back and moves nothing.

    The control executes a line that it stores (system.c ``set_startup_line``).
    """
    for number, line in wanted.startup.items():
        if line != present.startup.get(number) and _is_harmless(line):
            yield f"$N{number}", f"$N{number}={line}"


def _is_harmless(line: str) -> bool:
    """Return whether a start-up line sets modes only: no motion, spindle, coolant, tool or output."""
    return _HARMLESS.fullmatch(re.sub(r"[\s|]", "", line)) is not None


def left_notes(wanted: GrblContent, present: GrblContent) -> list[str]:
    """Return sentences about what is not put back,
    because it would move the machine or depends on where it is.
    """
    notes = [
        f"{name} was {wanted.offsets[name]} and is {present.offsets.get(name, 'not there')}: it is not put"
        " back, because it is set by moving there."
        for name in offset_differences(wanted, present)
        if name not in PUT_BACK
    ]
    for number, line in wanted.startup.items():
        if line != present.startup.get(number) and not _is_harmless(line):
            notes.append(
                f"The start-up line $N{number}={line} is not put back: the control would execute it now."
            )
    return notes
