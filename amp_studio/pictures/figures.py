"""Values of a file as figures of a picture, and back: units, resolution, range, and why one cannot be
drawn.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal, TypeGuard

from amp_studio.drawing import MAX_DRAWN, MIN_DRAWN, Drag, Handle, PictureNote, Point, multiple, round_step
from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Direction,
    ParameterId,
    UnknownParameterError,
    Value,
    axis_name,
    convert,
    dimension,
    exact,
    fault,
    limits,
    real_value,
    show_value,
    size_of,
    write_figure,
)

STEPS = 1000
"""Steps of a key over the length of a picture, at most."""


@dataclass(frozen=True)
class DrawnValue:
    """One value as a picture needs it."""

    address: Address
    label: str
    number: float | None
    """In the unit of the picture; None where it cannot be drawn."""
    unit: str
    text: str
    problem: str = ""
    """Why there is no number, or why it is not allowed."""
    wrong: bool = False
    """Out of range, whether drawn or not."""
    inactive: bool = False


def number_of(figure: DrawnValue | None) -> float | None:
    """Return the number of a figure; None where there is none to draw."""
    return figure.number if figure else None


class ValueReader:
    """Reads one file for one picture and remembers what it read."""

    def __init__(self, file: ParameterFile) -> None:
        self.file, self.evaluation = file, file.evaluation
        # A dict as a set with an order: the picture lists what it is drawn from as it was read.
        self.read: dict[Address, None] = {}
        self.notes: dict[str, PictureNote] = {}

    def address(self, parameter: ParameterId, instance: str, scope: str = "axis") -> Address | None:
        """Return the instance that belongs to an axis (a spindle …), or the one of the control;
        None where there is none.
        """
        instances = self.file.machine_schema.instances(self.file.schema.parameters[parameter])
        # An instance of the parameter itself, as a gear is, needs no reference by an axis.
        if instance in instances:
            return parameter, instance
        try:
            found = self.evaluation.reference(parameter, instance, scope)
        except UnknownParameterError:
            return None
        return None if found.is_list else found.addresses[0]

    def unit(self, address: Address) -> str:
        """Return the unit in which a value is drawn: that of the file,
        or mm and deg where another parameter sets its size.
        """
        entry = self.evaluation.unit(address, self.file.header.units)
        size = size_of(self.evaluation, address, entry)
        return size.unit if size else entry

    def figure(
        self, parameter: ParameterId | None, instance: str, unit: str = "", *, quiet: bool = False
    ) -> DrawnValue | None:
        """Return a value in a unit, its own by default; None where the machine does not have the parameter,
        or the family none for it.

        What cannot be drawn, and what is out of range, becomes a note, unless it is ``quiet``.
        """
        address = self.address(parameter, instance) if parameter else None
        if address is None or self.evaluation.state(address).state == "hidden":
            return None
        self.read[address] = None
        found = self._figure(address, unit)
        if found.problem and not quiet:
            self.add_note(f"{found.label}: {found.problem}", address, wrong=found.wrong)
        return found

    def _figure(self, address: Address, unit: str) -> DrawnValue:
        """Return a value as a picture draws it: its number where it is active and has one."""
        definition, value = self.file.schema.parameters[address[0]], self.file.get(address)
        unit, label = unit or self.unit(address), self.label(address)
        value_text = self._value_text(address, value)
        if value is None:
            return DrawnValue(address, label, None, unit, value_text, "not set")
        state = self.evaluation.state(address)
        if not state.is_active:
            return DrawnValue(address, label, None, unit, value_text, f"inactive, {state.why}", inactive=True)
        number = self._number(address, value, unit)
        if number is None:
            return DrawnValue(
                address,
                label,
                None,
                unit,
                value_text,
                f"{value_text} cannot be drawn in {unit or 'numbers'}",
                wrong=True,
            )
        wrong = fault(self.evaluation, address, value) or ""
        return DrawnValue(
            address, label, number, unit, value_text, wrong.removeprefix(f"{definition.name} "), bool(wrong)
        )

    def _number(self, address: Address, value: Value, unit: str) -> float | None:
        """Return the number of a value in a unit, of what it really is where its unit has a size; None where
        a picture has no scale for it.
        """
        if isinstance(value.value, (str, bool)):
            return None
        real = real_value(self.evaluation, address, value) or value
        if dimension(real.unit) != dimension(unit) or isinstance(real.value, (str, bool)):
            return None
        number = convert(float(real.value), real.unit, unit)
        # Beyond these a picture has no scale.
        return number if number == 0.0 or MIN_DRAWN <= abs(number) <= MAX_DRAWN else None

    def _in_file(self, address: Address, value: Value | None) -> Value | None:
        """Return a value in the unit system of the file, as the table shows it."""
        if value is None or isinstance(value.value, (str, bool)):
            return value
        unit = self.evaluation.unit(address, self.file.header.units)
        if dimension(unit) != dimension(value.unit) or unit == value.unit:
            return value
        return Value(float(write_figure(convert(float(value.value), value.unit, unit))), unit)

    def _value_text(self, address: Address, value: Value | None) -> str:
        """Return a value as a person reads it, with what it is in mm or degrees where its unit has a size."""
        definition = self.file.schema.parameters[address[0]]
        text = show_value(definition, self._in_file(address, value))
        real = real_value(self.evaluation, address, value)
        return f"{text} ({show_value(definition, real)})" if real is not None else text

    def label(self, address: Address) -> str:
        """Return ``1007 Limit 3 Max Value, X``."""
        machine = self.file.machine_schema
        if self.evaluation.scope(address) != "axis":
            return machine.label(address)
        text, name = machine.label(address), self.file.schema.parameters[address[0]].name
        if text.endswith(machine.instance_label(address)):
            text = name  # without a number the label ends with the axis
        return f"{text}, {self.axis(address[1])}"

    def axis(self, instance: str) -> str:
        """Return the letter of an axis, or what it is called without one."""
        return axis_name(self.evaluation, instance) or instance

    def add_note(
        self, text: str, address: Address | None = None, *, wrong: bool = False, is_remark: bool = False
    ) -> None:
        """Say something about the picture, once."""
        # Several shapes of one picture read the same value.
        self.notes.setdefault(text, PictureNote(text, address, wrong, is_remark))

    def figures(self, parameters: Iterable[ParameterId], instance: str) -> list[DrawnValue]:
        """Return the values that the machine has, as `figure` does."""
        return [each for parameter in parameters if (each := self.figure(parameter, instance))]

    def is_on_decades(self, each: DrawnValue | None) -> TypeGuard[DrawnValue]:
        """Return whether a figure has a place on a scale of powers of ten; 0 and less are noted."""
        if each is None or each.number is None:
            return False
        if each.number <= 0.0:
            self.add_note(
                f"{each.label}: {each.text} has no place on this scale", each.address, wrong=each.wrong
            )
            return False
        return True

    def direction(self, role: Direction | None, instance: str, axes: tuple[str, ...]) -> float:
        """Return 1 or -1, 0 where the direction is not known."""
        address = self.address(role.param, instance) if role else None
        if role is None or address is None:
            return 0.0
        self.read[address] = None
        value = self.file.get(address)
        if value is None:
            self.add_note(f"{self.label(address)}: not set, so the direction is not drawn", address)
            return 0.0
        if role.bits and instance in axes and not isinstance(value.value, str):
            is_set = int(value.value) >> axes.index(instance) & 1
            return 1.0 if bool(is_set) == (role.bits == "plus") else -1.0
        # A choice in neither list, as of an axis that is not homed, has no direction.
        return float((value.value in role.plus) - (value.value in role.minus))

    # -- back to values ----------------------------------------------------------

    def value(self, address: Address, number: float, unit: str, grain: float) -> Value | None:
        """Return a number of a picture as a value in the file's unit,
        rounded to the step that a person would enter.
        """
        entry = self.evaluation.unit(address, self.file.header.units)
        in_entry = self._to_entry(address, number, unit, entry)
        if in_entry is None or not math.isfinite(in_entry):
            return None
        definition = self.file.schema.parameters[address[0]]
        # The coarser of both: a hand drags no finer than a thousandth of the picture, and nothing below a
        # decimal is stored.
        rounded = multiple(in_entry, max(self.resolution(address), grain))
        return Value(int(rounded) if definition.type == "integer" else rounded, entry)

    def _to_entry(self, address: Address, number: float, unit: str, entry: str) -> float | None:
        size = size_of(self.evaluation, address, entry)
        if size and dimension(size.unit) == dimension(unit):
            # Exactly: a size as 1/3 µm would else give another count back than the one that was drawn.
            return float(exact(convert(number, unit, size.unit)) / size.number)
        return convert(number, unit, entry) if dimension(unit) == dimension(entry) else None

    def resolution(self, address: Address) -> float:
        """Return the smallest change of a value in the unit of entry: a whole one,
        or the last decimal that is stored.
        """
        definition = self.file.schema.parameters[address[0]]
        if definition.type == "integer":
            return 1.0
        decimals = definition.decimals
        if decimals is None and definition.storage:
            decimals = definition.storage.decimals
        return 10.0**-decimals if decimals is not None else 0.0

    def drag(
        self,
        figure: DrawnValue,
        along: Literal["x", "y"],
        span: float,
        inverse: Callable[[float], float | None] = lambda at: at,
        *,
        rises: bool = True,
    ) -> Drag:
        """Return how a figure follows a coordinate: ``inverse`` is coordinate -> figure,
        ``span`` the figures the picture shows.
        """
        address, unit = figure.address, figure.unit
        entry = self.evaluation.unit(address, self.file.header.units)
        across = abs(self._to_entry(address, span, unit, entry) or 0.0)
        step = max(self.resolution(address), round_step(across / STEPS) if across > 0.0 else 0.0) or 1e-6
        allowed = limits(self.evaluation, address, entry)

        def value_at(at: float) -> Value | None:
            number = inverse(at)
            return None if number is None else self.value(address, number, unit, step)

        low, high = (allowed.low, allowed.high) if allowed else (None, None)
        return Drag(address, along, value_at, step, rises, low, high, entry)

    def handle(self, figure: DrawnValue, at: Point, *drags: Drag, second: bool = False) -> Handle:
        """Return the handle of a figure."""
        return Handle(at, drags, figure.label, figure.text, second)
