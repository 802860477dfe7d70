"""Axes as a report names them, and the scope of a value."""

from __future__ import annotations

from amp_studio.files import ParameterFile, axis_instances, axis_letter, shown_axes
from amp_studio.schema import Address


def printed_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes a report prints: the fitted ones with inputs that something else uses, or all if the file does not say."""
    return shown_axes(file) if file.schema.family.fits_axes else axis_instances(file)


def scope_of(file: ParameterFile, address: Address) -> str:
    """Return the scope of a value on the machine type of the file."""
    layout = file.machine_schema.layout(file.schema.parameters[address[0]])
    return layout.scope if layout else "global"


def axis_label(file: ParameterFile, axis: str) -> str:
    """Return ``Axis 1 X``."""
    return f"{file.schema.family.scopes['axis'].label.format(i=axis)} {_other_letter(file, axis)}".rstrip()


def axis_column(file: ParameterFile, axis: str) -> str:
    """Return ``1 X``, or ``X`` where axes are known by their letters."""
    return f"{axis} {_other_letter(file, axis)}".rstrip()


def _other_letter(file: ParameterFile, axis: str) -> str:
    letter = axis_letter(file, axis)
    return letter if letter != axis else ""
