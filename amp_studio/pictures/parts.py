"""The parts of a file that have a picture: axes, pairs of axes, spindles."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import ParameterId

from .figures import ValueReader


def axes_with(file: ParameterFile, parameters: Iterable[ParameterId]) -> tuple[str, ...]:
    """Return the axes on which one of the parameters is set and active; the fitted ones where there is
    none.
    """
    own = [p for p in parameters if file.machine_schema.scopes[p] == "axis"]
    axes = every_axis(file)
    found = tuple(axis for axis in axes if any(_is_drawn(file, p, axis) for p in own))
    # A file that does not say which axes are fitted would offer every axis of the family, all of them
    # empty.
    return found or (axes if file.schema.family.fits_axes else axes[:1])


def every_axis(file: ParameterFile) -> tuple[str, ...]:
    """Return the fitted axes; every axis of a family whose files do not say which are."""
    return fitted_axes(file) if file.schema.family.fits_axes else file.schema.family.scopes["axis"].instances


def _is_drawn(file: ParameterFile, parameter: ParameterId, axis: str) -> bool:
    address = parameter, axis
    return file.get(address) is not None and file.evaluation.state(address).is_active


def pairs(file: ParameterFile, parameters: Iterable[ParameterId]) -> tuple[tuple[str, ...], ...]:
    """Return the pairs of axes to draw against each other; the only axis alone."""
    axes = axes_with(file, parameters)
    return tuple(combinations(axes, 2)) or tuple((axis,) for axis in axes[:1])


def part_name(figures: ValueReader, axes: tuple[str, ...]) -> str:
    """Return ``X Y``."""
    return " ".join(figures.axis(axis) for axis in axes)
