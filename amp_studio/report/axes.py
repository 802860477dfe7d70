"""Axes as a report names them, and the scope of a value."""

from __future__ import annotations

from amp_studio.files import ParameterFile, axis_instances, axis_kind, axis_letter, other_use, shown_axes
from amp_studio.schema import Address


def printed_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes a report prints: the fitted ones with inputs that something else uses,
    or all if the file does not say.
    """
    return shown_axes(file) if file.schema.family.fits_axes else axis_instances(file)


def scope_of(file: ParameterFile, address: Address) -> str:
    """Return the scope of a value on the machine type of the file."""
    layout = file.machine_schema.layout(file.schema.parameters[address[0]])
    return layout.scope if layout else "global"


def axis_label(file: ParameterFile, axis: str) -> str:
    """Return ``X``; ``X (axis 1)`` where several printed axes have that letter, ``Axis 1`` without a
    letter.
    """
    letter, label = axis_letter(file, axis), file.schema.family.scopes["axis"].label.format(i=axis)
    if not letter:
        return label
    letters = [axis_letter(file, other) for other in printed_axes(file)]
    return letter if letters.count(letter) <= 1 else f"{letter} ({label.lower()})"


def axis_note(file: ParameterFile, axis: str) -> str:
    """Return what is beside the name of an axis: ``1 linear``; without its number if the name has it."""
    number = axis if axis_letter(file, axis) == axis_label(file, axis) != axis else ""
    return f"{number} {other_use(file, axis) or axis_kind(file, axis)}".strip()


def place_of(file: ParameterFile, address: Address) -> str:
    """Return which axis, spindle or process a value belongs to; empty for one of the whole control."""
    if scope_of(file, address) == "axis":
        return axis_label(file, address[1])
    return file.machine_schema.instance_label(address)
