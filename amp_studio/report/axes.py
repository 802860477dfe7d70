"""Axes as a report names them, and the scope of a value."""

from __future__ import annotations

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import Address, label_of


def printed_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes a report prints: the fitted ones, or all if the family has no unfitted axes."""
    family = file.schema.family
    if family.fits_axes:
        return fitted_axes(file)
    scope = family.scopes.get("axis")
    return scope.instances if scope else ()


def scope_of(file: ParameterFile, address: Address) -> str:
    """Return the scope of a value on the machine type of the file."""
    layout = file.machine_schema.layout(file.schema.parameters[address[0]])
    return layout.scope if layout else "global"


def axis_name(file: ParameterFile, axis: str) -> str:
    """Return the letter or name of an axis; empty if it has none."""
    profile = file.schema.family.axes
    value = file.get((profile.name, axis)) if profile else None
    return label_of(file.schema.parameters[profile.name], str(value.value)) if profile and value else ""


def axis_label(file: ParameterFile, axis: str) -> str:
    """Return ``Axis 1 X``."""
    return f"{file.schema.family.scopes['axis'].label.format(i=axis)} {axis_name(file, axis)}".rstrip()
