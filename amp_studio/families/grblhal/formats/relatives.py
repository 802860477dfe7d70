"""Settings of firmware that is related to Grbl, by what it has in common with it.

    M203 X500.00 Y500.00 Z5.00 E25.00        Marlin, its answer to M503: mm/s
    axes: {x: {steps_per_mm: 80.0, …}}       FluidNC, its configuration
    $/axes/x/steps_per_mm=80.000             FluidNC, an entry of it as the control shows it
    $X/StepsPerMm=80.000                     Grbl_ESP32 and FluidNC, settings by name ($S)

What they have in common becomes a setting by its number; everything else is kept as text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from typing import Any

from amp_studio.formats import FormatError
from amp_studio.schema import YamlError, read_yaml

AXES = "XYZABC"
_MARLIN = re.compile(r"^[^;\n]{0,40}?\bM(?:92|201|203)[ \t]+[XYZ][-+0-9.]", re.MULTILINE)
_CODE = re.compile(r"(?:^|[\s:>])([MG][0-9]{1,3})((?:[ \t]+[A-Z][-+]?[0-9.]*)*)[ \t]*(?:;.*)?$")
_WORD = re.compile(r"([A-Z])([-+]?[0-9]*\.?[0-9]+)")
_OF_MARLIN = {"M92": (100, 1), "M203": (110, 60), "M201": (120, 1)}
"""Code -> number of the first axis, and what its figure is times."""
_FLUIDNC = re.compile(r"^[ \t]+steps_per_mm[ \t]*:", re.MULTILINE)
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
_MOST = 5000


@dataclass
class Relative:
    """The settings of such a firmware."""

    name: str
    settings: dict[int, str] = field(default_factory=dict)
    kept: dict[str, str] = field(default_factory=dict)
    """What has no number in common: name -> text."""


def is_relative(text: str) -> bool:
    """Return whether a text is one of these."""
    return bool(_MARLIN.search(text) or _FLUIDNC.search(text) or len(_BY_NAME.findall(text)) >= 3)


def read_relative(text: str) -> Relative:
    """Return what a text has in common with Grbl, and the rest; raises FormatError."""
    if _MARLIN.search(text):
        return _marlin(text)
    if _FLUIDNC.search(text):
        return _by_name("FluidNC", _entries_of_yaml(text))
    name = "FluidNC" if "$/" in text else "Grbl_ESP32"
    return _by_name(name, ((key, value.strip()) for key, value in _BY_NAME.findall(text)))


def _marlin(text: str) -> Relative:
    found = Relative("Marlin (M503)")
    for n, line in enumerate(text.splitlines(), 1):
        code = _CODE.search(line)
        if code is None:
            continue
        if code[1] == "G20":
            raise FormatError("the listing is in inches: send G21 before M503", n)
        words = dict(_WORD.findall(code[2]))
        if code[1] in _OF_MARLIN:
            first, factor = _OF_MARLIN[code[1]]
            for k, axis in enumerate("XYZ"):
                if axis in words:
                    found.settings[first + k] = _plain(Decimal(words.pop(axis)) * factor)
        elif code[1] == "M205" and "J" in words:
            found.settings[11] = words.pop("J")
        elif code[1] == "M211" and words.get("S") in ("0", "1"):
            found.settings[20] = words.pop("S")
        if words and code[1] != "G21":
            found.kept[code[1]] = " ".join(f"{letter}{figure}" for letter, figure in words.items())
    return found


def _plain(number: Decimal) -> str:
    return format(number.normalize(), "f")


def _by_name(name: str, entries: Iterator[tuple[str, str]]) -> Relative:
    found = Relative(name)
    for path, value in entries:
        number = _number_of(path.casefold())
        if number is None or number in found.settings:
            found.kept[path] = value
        else:
            found.settings[number] = {"true": "1", "false": "0", "on": "1", "off": "0"}.get(
                value.casefold(), value
            )
    return found


def _number_of(path: str) -> int | None:
    axis = re.fullmatch(r"(?:axes/)?([xyzabc])/(.+)", path)
    if axis and axis[2] in _OF_AXIS:
        return _OF_AXIS[axis[2]] + AXES.index(axis[1].upper())
    return _OF_CONTROL.get(path)


def _entries_of_yaml(text: str) -> Iterator[tuple[str, str]]:
    try:
        data = read_yaml(text).data
    except YamlError as error:
        raise FormatError(error.what, error.line) from None
    yield from list(_flat("", data))[:_MOST]


def _flat(path: str, data: Any) -> Iterator[tuple[str, str]]:
    if isinstance(data, dict):
        for key, value in data.items():
            yield from _flat(f"{path}/{key}" if path else str(key), value)
    elif data is not None:
        yield path, str(data)
