"""A new file: the family's printed defaults, on the axes that the machine has."""

from __future__ import annotations

from collections.abc import Iterable

from amp_studio.schema import Value, load_schema
from amp_studio.schema.nearest import unknown_name

from .axis_fitting import name_axes
from .parameter_file import Header, ParameterFile, fill_defaults, without_secrets


def new_file(
    family: str, machine: str | None = None, axes: Iterable[str] = (), name: str = ""
) -> ParameterFile:
    """Return a new file with the family's printed defaults.

    ``axes`` names the axes in order; the rest is unfitted. Without it the
    family's own default axes stay. Raises KeyError for an unknown family,
    ValueError for a machine type or an axis name the family does not have.
    """
    schema = load_schema(family)
    known = [m.key for m in schema.family.machines]
    if machine is not None and machine not in known:
        raise ValueError(unknown_name("machine type", machine, known))
    applications = schema.family.applications
    file = ParameterFile(
        schema,
        Header(
            name=name,
            application=applications[0] if applications else "",
            machine="" if schema.family.machine_parameter else machine or schema.family.default_machine,
            signature=schema.signature,
        ),
    )
    if schema.family.machine_parameter:
        file.set((schema.family.machine_parameter, ""), Value(machine or schema.family.default_machine))
    if file.schema.family.axes:
        profile = file.schema.family.axes
        for instance in schema.on(file.machine).instances(schema.parameters[profile.type]):
            default = file.default((profile.type, instance))
            if default is not None:
                file.set((profile.type, instance), default)
    axes = list(axes)
    if axes:
        name_axes(file, axes)
    declared = schema.family.declared_axes
    fill_defaults(file, existing_only=declared is not None and declared.letters is not None)
    return file


def new_like(source: ParameterFile, name: str) -> ParameterFile:
    """Return a new file with the values of another one; notes, software revision and passwords belong to that machine and stay there."""
    file = without_secrets(source).copy()
    file.header.name, file.header.notes, file.header.revision = name, "", ""
    return file
