"""Axes of a grid put together from axes that have one varied figure each.

Binding reads the file and takes a millisecond; a grid of n by m variations needs it some (n + m) times only,
where no number of the axis depends on two of the varied figures at once. A number of the axis comes from the
one figure whose own change moves it; where two do, the axis is bound from the file. A law may have cases (no
integral gain, no backlash): so each value is tried at both ends of all other figures as well, and a value
with which the axis is another there than put together is always bound from the file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

from amp_studio.sim.engine.machine import Machine
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw

BindPoint = Callable[[Sequence[float]], AxisLaw | None]
"""bind(point) -> the axis as the file makes it; None where it cannot be."""
_VECTORS = ("parameters", "linear_parameters", "push")
_NUMBERS = (
    "position_sample",
    "velocity_sample",
    "state_size",
    "servo_period",
    "velocity_period",
    "position_rate",
    "feedrate",
    "inposition_band",
    "rest_band",
    "ramps",
)
"""What a run depends on beside the vectors and the machine."""
_SETTLED = frozenset({("", "position_rate"), ("", "rest_band")})
"""Places that two figures may change: `AxisLaw.settled` makes them of the vectors and the machine."""
_MACHINE = tuple(field.name for field in fields(Machine))
_Parts = dict[tuple[str, object], Any]


def _parts(axis: AxisLaw) -> _Parts:
    """Return all figures of an axis that a run depends on, each under its place."""
    found: _Parts = {("", name): getattr(axis, name) for name in _NUMBERS}
    found["", "ramps"] = dict(axis.ramps)
    for name in _VECTORS:
        vector = getattr(axis, name)
        found |= {(name, n): each for n, each in enumerate(() if vector is None else vector)}
        found["shape", name] = None if vector is None else len(vector)
    found |= {("machine", name): getattr(axis.machine, name) for name in _MACHINE}
    found["shape", "after"], found["shape", "monitors"] = axis.after is None, len(axis.monitors)
    return found


def agrees(one: AxisLaw | None, other: AxisLaw | None) -> bool:
    """Return whether both are the same to a run, or both cannot be."""
    if one is None or other is None:
        return one is other
    return _parts(one) == _parts(other)


class ComposedAxes:
    """The axes of one grid; those with one figure changed are bound when they are first asked for."""

    def __init__(self, bind: BindPoint, grids: Sequence[Sequence[float]]) -> None:
        self._bind = bind
        self._at = tuple(grid[len(grid) // 2] for grid in grids)
        self._ends = tuple(grid[0] for grid in grids), tuple(grid[-1] for grid in grids)
        self._base = bind(self._at)
        self._whole = {} if self._base is None else _parts(self._base)
        self._changes: dict[tuple[int, float], _Parts | None] = {}
        self._sure: dict[tuple[int, float], bool] = {}
        self._machines: dict[tuple[tuple[str, float], ...], Machine] = {}

    def axis(self, point: Sequence[float]) -> AxisLaw | None:
        """Return the axis of a point, bound from the file where its figures cannot be put together."""
        if all(self._is_sure(n, number) for n, number in enumerate(point)):
            return self._together(point)
        return self._bind(point)

    def _is_sure(self, index: int, number: float) -> bool:
        """Return whether a value makes the same axis bound and put together, at both ends of the others."""
        key = index, number
        if key not in self._sure:
            tried = ([*end[:index], number, *end[index + 1 :]] for end in self._ends)
            self._sure[key] = all(agrees(self._together(point), self._bind(point)) for point in tried)
        return self._sure[key]

    def _together(self, point: Sequence[float]) -> AxisLaw | None:
        """Return the axis of a point, composed of what each figure alone changes, or bound where that
        fails.
        """
        if self._base is None:
            return self._bind(point)
        together: _Parts = {}
        shared = _SETTLED if self._base.settled else frozenset()
        for n, number in enumerate(point):
            changed = self._changed(n, number)
            # Two figures move the same number: only the file knows what both together make of it.
            if changed is None or not changed.keys() & together.keys() <= shared:
                return self._bind(point)
            together |= changed
        try:
            return self._with(self._base, together)
        except SimulationError:  # a machine that cannot be: the file gives the reason
            return self._bind(point)

    def _changed(self, index: int, number: float) -> _Parts | None:
        """Return which figures one varied figure changes; None for no axis, or one of another shape."""
        key = index, number
        if key not in self._changes:
            point = [*self._at[:index], number, *self._at[index + 1 :]]
            axis = None if self._base is None else self._bind(point)
            found = None if axis is None else _parts(axis)
            if found is not None:
                found = {place: each for place, each in found.items() if each != self._whole.get(place)}
                found = None if any(place == "shape" for place, _ in found) else found
            self._changes[key] = found
        return self._changes[key]

    def _with(self, base: AxisLaw, changed: Mapping[tuple[str, object], Any]) -> AxisLaw:
        """Return an axis with changed parts: of itself, of its vectors or of its machine."""
        new: dict[str, Any] = {}
        machine: dict[str, float] = {}
        for (place, name), each in changed.items():
            if place == "machine":
                machine[str(name)] = each
            elif place == "":
                new[str(name)] = each
            else:
                new.setdefault(place, list(getattr(base, place)))[name] = each
        if machine:
            new["machine"] = self._machine(base.machine, machine)
        axis = replace(base, **new) if new else base
        return axis if axis.settled is None else axis.settled(axis)

    def _machine(self, base: Machine, changed: Mapping[str, float]) -> Machine:
        """Return one machine for the same figures, checked once."""
        key = tuple(sorted(changed.items()))
        if key not in self._machines:
            self._machines[key] = replace(base, **changed)  # type: ignore[arg-type]  # as they were read
        return self._machines[key]
