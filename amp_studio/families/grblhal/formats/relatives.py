"""Settings of firmware that is related to Grbl, by what it has in common with it.

    M203 X500.00 Y500.00 Z5.00 E25.00        Marlin, its answer to M503: mm/s
    M203 X18000 Y18000 Z900 E3600            RepRapFirmware, its config.g: mm/min
    axes: {x: {steps_per_mm: 80.0, …}}       FluidNC, its configuration
    $/axes/x/steps_per_mm=80.000             FluidNC, an entry of it as the control shows it
    /axes/x: {steps_per_mm: 80.000, …}       FluidNC, its answer to $/axes/x: a section of it
    $X/StepsPerMm=80.000                     Grbl_ESP32 and FluidNC, settings by name ($S)

What they have in common becomes a setting by its number; everything else is kept as text.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from itertools import islice

from amp_studio.formats import FormatError

AXES = "XYZABC"
_MARLIN = re.compile(r"^[^;\n]{0,40}?\bM(?:92|201|203)[ \t]+[XYZ][-+0-9.]", re.MULTILINE)
_CODE = re.compile(r"(?:^|[\s:>])([MG][0-9]{1,3})((?:[ \t]+[A-Z][-+]?[0-9.]*)*)[ \t]*(?:;.*)?$")
_OTHER_CODE = re.compile(r"[^;\n]{0,40}?\b([MG][0-9]{1,3}(?:\.[0-9])?)[ \t]+([^;\n]+)")
"""A code with words that are no numbers."""
_WORD = re.compile(r"([A-Z])([-+]?[0-9]*\.?[0-9]+)?")
_RATES = "M203"
_OF_MARLIN = {"M92": 100, _RATES: 110, "M201": 120}
"""Code -> number of the first axis."""
_PER_SECOND = re.compile(r"(?:units|mm)/s(?:ec)?\b(?!\^?2)|^[^;\n]{0,40}\becho:", re.MULTILINE)
_PER_MINUTE = re.compile(r"(?:units|mm)/min\b|^[ \t]*M(?:566|584)\b", re.MULTILINE)
"""What shows the unit of M203: the remarks, ``echo:`` of Marlin, or codes that RepRapFirmware alone has."""
_FASTEST = 2000
"""mm/s of M203 that no machine has: without a remark it is mm/min, or another firmware."""
_FLUIDNC = re.compile(
    r"^[ \t]+steps_per_mm[ \t]*:"
    r"|^stepping[ \t]*:[^\n]*\n(?:[ \t][^\n]*\n){0,8}?[ \t]+(?:idle_ms|pulse_us)[ \t]*:",
    re.MULTILINE,
)
_ENTRY = re.compile(r"([ \t]*)([A-Za-z0-9_]+)[ \t]*:(?:[ \t]+(.*))?")
_SECTION = re.compile(r"/([a-z]\w*(?:/\w+)*):")
"""The head of a section (``RuntimeSetting::enterSection``), as an answer to its path."""
_BY_NAME = re.compile(r"^[^$\n]{0,40}\$/?([A-Za-z][\w/]{2,80})=([^\r\n]*)$", re.MULTILINE)
_OF_AXIS = {
    "steps_per_mm": 100,
    "max_rate_mm_per_min": 110,
    "acceleration_mm_per_sec2": 120,
    "max_travel_mm": 130,
    "stepspermm": 100,
    "maxrate": 110,
    "acceleration": 120,
    "maxtravel": 130,
    "current/run": 140,
    "current/hold": 150,
    "microsteps": 160,
    "stallguard": 170,
}
_OF_CONTROL = {
    "stepping/pulse_us": 0,
    "stepping/idle_ms": 1,
    "junction_deviation_mm": 11,
    "arc_tolerance_mm": 12,
    "report_inches": 13,
    "stepper/pulse": 0,
    "stepper/idletime": 1,
    "stepper/stepinvert": 2,
    "stepper/dirinvert": 3,
    "stepper/enableinvert": 4,
    "limits/invert": 5,
    "probe/invert": 6,
    "report/status": 10,
    "gcode/junctiondeviation": 11,
    "gcode/arctolerance": 12,
    "report/inches": 13,
    "limits/soft": 20,
    "limits/hard": 21,
    "homing/enable": 22,
    "homing/dirinvert": 23,
    "homing/feed": 24,
    "homing/seek": 25,
    "homing/debounce": 26,
    "homing/pulloff": 27,
    "gcode/maxs": 30,
    "gcode/mins": 31,
    "gcode/lasermode": 32,
    "spindle/pwm/frequency": 33,
    "spindle/pwm/off": 34,
    "spindle/pwm/min": 35,
    "spindle/pwm/max": 36,
}
"""Names of FluidNC and Grbl_ESP32 (SettingsDefinitions.cpp), without capitals -> number."""
_DIRECTION = "homing/positive_direction"
_JOINED = {
    "soft_limits": 20,
    "motor/hard_limits": 21,
    _DIRECTION: 23,
    "homing/feed_mm_per_min": 24,
    "homing/seek_mm_per_min": 25,
    "homing/settle_ms": 26,
    "motor/pulloff_mm": 27,
}
"""Entry of an axis of FluidNC -> the setting of Grbl for all axes.

$23 has the bit of each axis that homes in its negative direction. Which axes home, and in which cycle, Grbl
has in its build: that is kept as text.
"""
_MAX_LINES = 5000
_MIN_NAMED = 3
"""Settings by name before a text is taken for a listing of them."""


@dataclass
class Relative:
    """The settings of such a firmware."""

    name: str
    settings: dict[int, str] = field(default_factory=dict)
    kept: dict[str, str] = field(default_factory=dict)
    """What has no number in common: name -> text."""
    counts: Counter[str] = field(default_factory=Counter)
    """How often each code came with words that are kept."""


def is_relative(text: str) -> bool:
    """Return whether a text is one of these."""
    if _MARLIN.search(text) or _FLUIDNC.search(text):
        return True
    # TinyG has names behind its $ too, but none with a slash.
    return sum("/" in name for name, _ in _BY_NAME.findall(text)) >= _MIN_NAMED


def read_relative(text: str) -> Relative:
    """Return what a text has in common with Grbl, and the rest; raises FormatError."""
    if _MARLIN.search(text):
        return _marlin(text)
    if _FLUIDNC.search(text):
        return _by_name("FluidNC", _entries_of_fluidnc(text))
    name = "FluidNC" if "$/" in text else "Grbl_ESP32"
    return _by_name(name, ((key, value.strip()) for key, value in _BY_NAME.findall(text)))


def _marlin(text: str) -> Relative:
    """Return the settings of a text of Marlin (M503) or RepRapFirmware (config.g) as Grbl numbers them."""
    name, rate_factor, is_known = _dialect(text)
    found = Relative(name)
    for n, line in enumerate(text.splitlines(), 1):
        code = _CODE.search(line)
        if code is None:
            if other := _OTHER_CODE.match(line):
                _keep(found, other[1], other[2].strip())
            continue
        if code[1] == "G20":
            raise FormatError("the listing is in inches: send G21 before M503", n)
        words = dict(_WORD.findall(code[2]))
        factor = rate_factor if code[1] == _RATES else 1
        # A rate that may be 60 times too large is kept as text rather than set.
        if code[1] != _RATES or is_known or not _is_fast(words):
            _take_words(found, code[1], words, factor)
        _keep_words(found, code[1], words)
    return found


def _dialect(text: str) -> tuple[str, int, bool]:
    """Return the firmware, the factor of its rates to mm/min, and whether the text names their unit."""
    # ``echo:`` is Marlin alone, whose remarks may name mm/min of another code.
    if _PER_MINUTE.search(text) and not re.search(r"\becho:", text):
        return "RepRapFirmware (config.g)", 1, True
    return "Marlin (M503)", 60, bool(_PER_SECOND.search(text))


def _is_fast(words: dict[str, str]) -> bool:
    """Return whether a figure is too large for mm/s."""
    return any(float(figure or 0) > _FASTEST for figure in words.values())


def _keep_words(found: Relative, code: str, words: dict[str, str]) -> None:
    """Keep the words of a code that are no settings of Grbl."""
    if words and code != "G21":
        _keep(found, code, " ".join(f"{letter}{figure}" for letter, figure in words.items()))


def _take_words(found: Relative, code: str, words: dict[str, str], factor: int) -> None:
    """Take the words of a code that are settings of Grbl."""
    if code in _OF_MARLIN:
        for k, axis in enumerate("XYZ"):
            if words.get(axis):
                found.settings[_OF_MARLIN[code] + k] = _plain(Decimal(words.pop(axis)) * factor)
    elif code == "M205" and words.get("J"):
        found.settings[11] = words.pop("J")
    elif code == "M211" and words.get("S") in ("0", "1"):
        found.settings[20] = words.pop("S")


def _keep(found: Relative, code: str, text: str) -> None:
    """Keep the words of a code; those of one that comes again under its name and a number."""
    found.counts[code] += 1
    count = found.counts[code]
    found.kept[code if count == 1 else f"{code} ({count})"] = text


def _plain(number: Decimal) -> str:
    return format(number.normalize(), "f")


def _by_name(name: str, entries: Iterator[tuple[str, str]]) -> Relative:
    """Return the settings among entries; one that comes again has the later value, as the firmware takes it,
    and the earlier one is kept as text.
    """
    found = Relative(name)
    came: dict[str, str] = {}
    of_axes = _OfAxes()
    for path, value in entries:
        if of_axes.take(path.casefold(), value):
            continue
        number = _number_of(path.casefold())
        if path in came:
            found.kept[f"{path} (earlier)"] = came[path]
        elif number in found.settings:
            found.kept[path] = value
            continue
        came[path] = value
        if number is None:
            found.kept[path] = value
        else:
            found.settings[number] = {"true": "1", "false": "0", "on": "1", "off": "0"}.get(
                value.casefold(), value
            )
    of_axes.join(found)
    return found


class _OfAxes:
    """What FluidNC has for each axis and Grbl for all: one setting where all axes agree, else kept as text.

    An axis without an entry has its default (Machine/Axis.h, Homing.h, Motor.h): no soft and no hard limits.
    """

    def __init__(self) -> None:
        self._entries: dict[str, list[tuple[str, str, str]]] = {}
        """Entry without its axis and motor -> axis, whole path, value."""
        self._axes: set[str] = set()

    def take(self, path: str, value: str) -> bool:
        """Take an entry; returns whether it is one of these and not yet there."""
        axis = re.fullmatch(r"/?axes/([xyzabc])/(?:(motor)[01]/)?(.+)", path.casefold())
        if axis is None:
            return False
        self._axes.add(axis[1])
        name = f"motor/{axis[3]}" if axis[2] else axis[3]
        entries = self._entries.setdefault(name, [])
        if name not in _JOINED or any(path == other for _, other, _ in entries):
            return False
        entries.append((axis[1], path, value))
        return True

    def join(self, found: Relative) -> None:
        """Put what all axes agree in among the settings, and the rest into what is kept."""
        for name, entries in self._entries.items():
            if not entries:
                continue
            text = self._joined(name, entries)
            if text is None or _JOINED[name] in found.settings:
                found.kept.update({path: value for _, path, value in entries})
            else:
                found.settings[_JOINED[name]] = text

    def _joined(self, name: str, entries: list[tuple[str, str, str]]) -> str | None:
        """Return the one setting that entries of several axes make; None where they make none."""
        texts = {text.casefold() for _, _, text in entries}
        if name == _DIRECTION:
            return _directions(entries) if texts <= {"true", "false"} else None
        # One axis without it, whose default is off, and Grbl's setting for all would be wrong.
        if texts == {"true"}:
            return "1" if {axis for axis, _, _ in entries} == self._axes else None
        if texts == {"false"}:
            return "0"
        is_number = len(texts) == 1 and re.fullmatch(r"[0-9]+\.?[0-9]*", next(iter(texts)))
        return entries[0][2] if is_number else None


def _directions(entries: list[tuple[str, str, str]]) -> str:
    """Return the word with the bit of each axis that homes in its negative direction."""
    negative = {axis for axis, _, text in entries if text.casefold() == "false"}
    return str(sum(1 << AXES.index(axis.upper()) for axis in negative))


def _number_of(path: str) -> int | None:
    axis = re.fullmatch(r"(?:axes/)?([xyzabc])/(.+)", path)
    if axis and axis[2] in _OF_AXIS:
        return _OF_AXIS[axis[2]] + AXES.index(axis[1].upper())
    return _OF_CONTROL.get(path)


def _entries_of_fluidnc(text: str) -> Iterator[tuple[str, str]]:
    """Yield path and value of each entry, as FluidNC reads its configuration, line by line
    (Configuration/Tokenizer.cpp): other lines, as a forum has them around it, and what comes twice do not
    matter.
    """
    open_keys: list[tuple[int, str]] = []
    lines = (line.expandtabs().rstrip() for line in text.splitlines())
    entries = (_ENTRY.fullmatch(line) or _SECTION.fullmatch(line) for line in lines)
    for entry in islice(filter(None, entries), _MAX_LINES):
        if entry.re is _SECTION:
            open_keys = [(0, entry[1])]
            continue
        indent, key, value = len(entry[1]), entry[2], _unquoted(entry[3] or "")
        while open_keys and open_keys[-1][0] >= indent:
            open_keys.pop()
        if value:
            yield "/".join([*(name for _, name in open_keys), key]), value
        else:
            open_keys.append((indent, key))


def _unquoted(value: str) -> str:
    if quoted := re.match(r"([\"'])(.*?)\1", value):
        return quoted[2]
    return re.split(r"(?:^|\s)#", value, maxsplit=1)[0].strip()
