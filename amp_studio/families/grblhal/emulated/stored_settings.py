"""The settings of an emulated control: what is delivered, how a text is stored, how it is shown,
what moves what.

From settings.c of the grblHAL core. It shares no code with the driver,
which has to find out how this behaves.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.files import new_file
from amp_studio.schema import Parameter, code_of

FAMILY, CLASSIC = "grblhal", "grbl-1.1"
BAD_NUMBER, NEGATIVE, SOFT_LIMITS_NEED_HOMING, OUT_OF_RANGE, NOT_THERE = 2, 4, 10, 52, 53
_TYPES = {"boolean": 0, "bits": 1, "choice": 3, "integer": 5, "real": 6, "text": 7}
_AXES, _DECIMAL, _TEXT = 4, 6, 7
_GROUP_BASE = 43
_AXIS_RATES = range(180, 200)
"""There only while bit 9 of $22 is set."""
_ZERO_OR = (392, 393, 394, 539, 673)
"""Delays of 0, or of half a second and more (S2446)."""


class RefusedError(Exception):
    """A text that the firmware refuses; ``code`` is its answer."""

    def __init__(self, code: int) -> None:
        super().__init__(f"error:{code}")
        self.code = code


@dataclass
class StoredSetting:
    """One setting. ``bits`` is how much room a whole number has;
    ``shown_decimals`` those of a decimal number.
    """

    number: int
    name: str
    unit: str
    kind: int
    labels: tuple[str, ...]
    least: float | None
    most: float | None
    bits: int
    shown_decimals: int
    needs_restart: bool
    group: int
    help: str
    value: float | str

    def show(self) -> str:
        """Return the value as ``$$`` shows it."""
        if isinstance(self.value, str):
            return self.value
        return f"{self.value:.{self.shown_decimals}f}" if self.kind == _DECIMAL else str(int(self.value))

    def read(self, text: str) -> float | str:
        """Return what is stored of a text; raises RefusedError."""
        text = text.lstrip(" ")
        if self.kind == _TEXT:
            return text
        match = re.match(r"[+-]?(\d*)(\.\d*)?" if self.kind == _DECIMAL else r"\+?(\d+)", text)
        if match is None or not re.search(r"\d", match[0]):
            raise RefusedError(BAD_NUMBER)
        if self.kind == _DECIMAL:
            return self._decimal(match[0])
        number = int(match[1])
        least, most = self._range()
        if not least <= number <= most:
            raise RefusedError(OUT_OF_RANGE)
        return float(number % (1 << self.bits))

    def _range(self) -> tuple[float, float]:
        """Return the least and the greatest whole number; infinite where there is none."""
        if self.kind in (0, 1, 3, _AXES):
            most = {0: 1, 3: len(self.labels) - 1}.get(self.kind, (1 << len(self.labels)) - 1)
            return -math.inf, most

        least = -math.inf if self.least is None else self.least
        return least, math.inf if self.most is None else self.most

    def _decimal(self, text: str) -> float:
        """Return a number as the board stores it; raises RefusedError."""
        # The firmware keeps a float of 32 bits: what is shown is what is left of the figure.
        number = struct.unpack("<f", struct.pack("<f", float(text)))[0]
        if number == 0 and self.number in _ZERO_OR:
            return 0.0
        if self.least is None and number < 0:
            raise RefusedError(NEGATIVE)
        if (self.least is not None and number < self.least) or (self.most is not None and number > self.most):
            raise RefusedError(OUT_OF_RANGE)
        return float(number)

    def describe(self, axes: int) -> str:
        """Return its line of ``$ES``."""
        form = ",".join(self.labels) if self.kind in (1, 3) else "####0" if self.kind == 5 else ""
        if self.kind == _DECIMAL:
            form = "#####0" + ("." + "0" * self.shown_decimals if self.shown_decimals else "")
        if self.kind == _AXES:
            assert len(self.labels) == axes
        bounds = ("" if b is None else f"{b:g}" for b in (self.least or None, self.most))
        what = (self.number, self.group, self.name, self.unit, self.kind, form, *bounds)
        return (
            f"[SETTING:{'|'.join(map(str, (*what, int(self.needs_restart), int(self.number in _ZERO_OR))))}]"
        )


class StoredSettings:
    """All settings of one control, those that an option hides too."""

    def __init__(self, machine: str | None, axes: str = "XYZ") -> None:
        self.is_classic = machine == CLASSIC
        self.axes = axes
        self.all = {s.number: s for s in _delivered(CLASSIC if self.is_classic else FAMILY, axes)}
        self._move(24)
        self._move(25)
        self.defaults = self.values()

    def values(self) -> dict[int, float | str]:
        """Return number -> value of all that is stored."""
        return {number: setting.value for number, setting in self.all.items()}

    def load(self, values: dict[int, float | str]) -> None:
        """Take what was stored."""
        for number, value in values.items():
            if number in self.all:
                self.all[number].value = value

    def available(self) -> Iterator[StoredSetting]:
        """Yield the settings there are now, by number."""
        has_rates = bool(self._whole(22) & 1 << 9)
        for number, setting in sorted(self.all.items()):
            hidden = (24, 25) if has_rates and not self.is_classic else _AXIS_RATES
            if number not in hidden:
                yield setting

    def named(self, number: int) -> StoredSetting | None:
        """Return a setting that is asked for alone: $24 and $25 are shown then,
        though no list has them (recorded).
        """
        listed = (s for s in self.available() if s.number == number)
        return self.all[number] if number in (24, 25) else next(listed, None)

    def store(self, number: int, text: str) -> None:
        """Do ``$number=text``; raises RefusedError."""
        setting = next((s for s in self.available() if s.number == number), None)
        if setting is None:
            raise RefusedError(3 if self.is_classic else NOT_THERE)
        value = setting.read(text)
        if number in (20, 40) and value and not self._whole(22) & 1:
            raise RefusedError(SOFT_LIMITS_NEED_HOMING)
        setting.value = value
        self._move(number)

    def _move(self, number: int) -> None:
        """Change what a setting moves (``set_homing_enable``, ``set_reset_actions``,
        ``set_homing_feedrates``).
        """
        if number == 22:
            if not self._whole(22) & 1:
                for needs_homing in (22, 20, 40):
                    self._set(needs_homing, 0)
            if not self.is_classic:
                self._set(676, self._whole(676) & ~1 | (0 if self._whole(22) & 1 << 7 else 1))
        if number == 676:
            self._set(22, self._whole(22) & ~(1 << 7) | (0 if self._whole(676) & 1 else 1 << 7))
        self._move_rates(number)

    def _move_rates(self, number: int) -> None:
        """Change the rates of homing of single axes with the common ones, and those with the first axis."""
        is_common = number == 22 and not self._whole(22) & 1 << 9
        for common, first in ((24, 180), (25, 190)):
            if number == first and first in self.all:
                self.all[common].value = self.all[first].value
            elif first in self.all and (number == common or is_common):
                for axis in range(len(self.axes)):
                    self.all[first + axis].value = self.all[common].value

    def _whole(self, number: int) -> int:
        return int(self.all[number].value) if number in self.all else 0

    def _set(self, number: int, value: int) -> None:
        if number in self.all:
            self.all[number].value = float(value)


def _delivered(machine: str, axes: str) -> Iterator[StoredSetting]:
    """Yield the settings of a machine type as they are delivered, from the family's facts."""
    file = new_file(FAMILY, machine, () if machine == CLASSIC else tuple(axes))
    schema, here = file.schema, file.machine_schema
    groups = {p.id: n for n, group in enumerate(schema.groups, 1) for p in group.parameters}
    for address in here.addresses:
        number = here.plain_number(address)
        if not number or (address[1] and address[1] not in axes):
            continue
        parameter, value = schema.parameters[address[0]], file.values.get(address)
        if value is None and int(number) not in _AXIS_RATES:
            continue  # of another build
        setting = _setting(parameter, int(number), address[1], axes, groups[parameter.id])
        if value is not None:
            setting.value = float(code_of(parameter, value)) if parameter.choices else value.value
        yield setting


def _setting(parameter: Parameter, number: int, axis: str, axes: str, group: int) -> StoredSetting:
    """Return a parameter of the facts as the emulated control stores and describes it."""
    storage = parameter.storage
    kind, labels = _kind(parameter, axes)
    low, high = _bounds(parameter)
    return StoredSetting(
        number,
        f"{axis}-axis {parameter.name.lower()}" if axis else parameter.name,
        _unit(parameter),
        kind,
        labels,
        0.5 if number in _ZERO_OR else low or None,
        high,
        (storage.bits if storage else None) or 32,
        (storage.decimals if storage else None) or 0,
        parameter.effect is not None and parameter.effect.level == "restart",
        _GROUP_BASE + axes.index(axis) if axis else group,
        parameter.help.what,
        0.0,
    )


def _kind(parameter: Parameter, axes: str) -> tuple[int, tuple[str, ...]]:
    """Return how a setting is entered, and the labels of its choices, bits or axes."""
    if parameter.bits and parameter.first_axis == 0:
        return _AXES, tuple(axes)
    kind = _TYPES.get(parameter.type, _TEXT)
    if parameter.bits:
        named = {b.bit: b.label for b in parameter.bits if not b.needs}
        return kind, tuple(named.get(n, "N/A") for n in range(max(named) + 1))
    return kind, tuple(c.label for c in parameter.choices or ())


def _bounds(parameter: Parameter) -> tuple[float | None, float | None]:
    """Return the bounds that are numbers."""
    low, high = next(iter((parameter.ranges or {}).values()), (None, None))
    return low if isinstance(low, (int, float)) else None, high if isinstance(high, (int, float)) else None


def _unit(parameter: Parameter) -> str:
    unit = (parameter.storage.unit if parameter.storage else None) or ""
    return {"steps/mm": "step/mm", "mm/s2": "mm/sec^2", "rpm": "RPM", "us": "microseconds"}.get(unit, unit)
