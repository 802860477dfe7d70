"""The unit of length that a simulation is shown in and its settings are given in: that of the file,
or one that is asked for.

Inside everything is in mm or deg; a family whose file is in inches sees inches in figures, columns, limits,
recommendations and sentences.
"""

from __future__ import annotations

import re
from dataclasses import replace

from amp_studio.files import ParameterFile
from amp_studio.schema import UNITS, canonical

from .errors import SimulationError
from .rounding import rounded, value_text
from .trace import Figure, HomingCourse, PlaneArea, Recommendation, Trace

MM_PER_INCH = 25.4
_LENGTHS = ("mm", "in")
_IN_TEXT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?) (mm(?:/[a-z0-9]+)*)(?![\w/])")
"""A number and its metric unit in a sentence."""
_DIGITS = 6
"""Digits of a converted number in a sentence or a recommendation."""


def length_unit(file: ParameterFile, system: str | None = None) -> str:
    """Return "mm" or "in": of a unit system of the family, None for that of the file.

    Raises SimulationError for a system that the family has not.
    """
    systems = file.schema.family.units
    if system is not None and system not in systems:
        raise SimulationError(f"Unknown unit system '{system}'. Known: {', '.join(systems)}")
    found = systems.get(system or file.header.units, {}).get("length", "mm")
    return found if found in _LENGTHS else "mm"


def path_error_unit(length: str) -> tuple[str, float]:
    """Return the unit in which the error of a path is shown, µm or in, and how many of it a mm has."""
    return ("in", 1.0 / MM_PER_INCH) if length == "in" else ("µm", 1000.0)


def path_error_text(error: float, length: str) -> str:
    """Return the error of a path, in mm, as a person reads it."""
    unit, times = path_error_unit(length)
    # Below a picometre it is the rounding of sums.
    return value_text(times * error if error > 1e-9 else 0.0, unit, 3)


def axis_unit(file: ParameterFile, axis: str, length: str) -> str:
    """Return the unit that an axis moves in: ``length``, or deg where it turns."""
    family = file.schema.family
    known = family.axes is not None and axis in file.machine_schema.instances(
        file.schema.parameters[family.axes.type]
    )
    turns = known and family.axes is not None and file.evaluation.turns((family.axes.type, axis))
    return "deg" if turns else length


def own_unit(metric: str, length: str) -> str:
    """Return a unit with the unit of length in the place of mm; others as they are."""
    head, slash, rest = metric.partition("/")
    return f"{length}{slash}{rest}" if head == "mm" else metric


def in_text(text: str, length: str) -> str:
    """Return a sentence with its lengths in another unit."""
    if length == "mm":
        return text
    return _IN_TEXT.sub(
        lambda found: value_text(float(found[1]) / MM_PER_INCH, own_unit(found[2], length), _DIGITS), text
    )


def described(text: str, length: str) -> str:
    """Return what a setting is, with its unit in brackets and its lengths in another unit."""
    brackets = re.sub(r"\((mm\S*)(?= or |\))", lambda found: f"({own_unit(found[1], length)}", text)
    return in_text(brackets, length)


def in_unit(trace: Trace, length: str) -> Trace:
    """Return a trace whose lengths are in another unit."""
    if length == "mm":
        return trace
    factors = {name: _factor(unit, length) for name, unit in trace.units.items()}
    return replace(
        trace,
        columns={name: column / factors.get(name, 1.0) for name, column in trace.columns.items()},
        units={name: own_unit(unit, length) for name, unit in trace.units.items()},
        result={name: _figure(figure, length) for name, figure in trace.result.items()},
        limits={name: _figure(figure, length) for name, figure in trace.limits.items()},
        alarms=tuple(replace(alarm, message=in_text(alarm.message, length)) for alarm in trace.alarms),
        recommendations=tuple(_recommendation(each, length) for each in trace.recommendations),
        assumptions=tuple(in_text(text, length) for text in trace.assumptions),
        model=in_text(trace.model, length),
        areas=tuple(_area(each) for each in trace.areas),
        course=trace.course and _course(trace.course, length),
    )


def _area(area: PlaneArea) -> PlaneArea:
    (left, right), (low, high) = area.x, area.y
    return replace(
        area, x=(left / MM_PER_INCH, right / MM_PER_INCH), y=(low / MM_PER_INCH, high / MM_PER_INCH)
    )


def _course(course: HomingCourse, length: str) -> HomingCourse:
    """Return the course of a homing in another unit of length."""
    factor = _factor(course.unit, length)
    switch, marker, home = course.switch, course.marker, course.home
    return replace(
        course,
        stages=tuple(each._replace(speed=each.speed / factor) for each in course.stages),
        switch=None if switch is None else (switch[0] / factor, switch[1] / factor),
        marker=None if marker is None else marker / factor,
        turn=course.turn / factor,
        home=None if home is None else home / factor,
        coordinate=course.coordinate / factor,
        unit=own_unit(course.unit, length),
    )


def _factor(unit: str, length: str) -> float:
    """Return how much of a unit the same unit with another length is."""
    # One factor for mm, mm/min and mm/s2: the time in a unit does not change.
    return MM_PER_INCH if own_unit(unit, length) != unit else 1.0


def _figure(figure: Figure, length: str) -> Figure:
    value, unit = figure
    return None if value is None else value / _factor(unit, length), own_unit(unit, length)


def _recommendation(each: Recommendation, length: str) -> Recommendation:
    """Return a recommendation in another unit of length, its sentences too."""
    unit = own_unit(each.unit, length)
    value = each.value
    if unit != each.unit:
        # In a unit of the program, so that ``set`` takes it.
        unit = unit if unit in UNITS else each.unit
        value = rounded(canonical(value, each.unit) / canonical(1.0, unit), _DIGITS)
    return replace(
        each, value=value, unit=unit, why=in_text(each.why, length), price=in_text(each.price, length)
    )
