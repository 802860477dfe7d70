"""What a family can do with its axes, and the reason where it cannot: for menus and dialogs,
before anything is tried.
"""

from __future__ import annotations

from amp_studio.schema import Choice, Schema

from .axes import axis_instances, fitted_axes, other_use
from .parameter_file import ParameterFile


def why_axes_are_fixed(schema: Schema) -> str:
    """Return why a file of a family cannot choose its axes; "" where it can."""
    family = schema.family
    if family.fits_axes:
        return ""
    axes = family.scopes["axis"].instances if "axis" in family.scopes else ()
    if not axes:
        return f"{family.name} has no axes to configure"
    page = f" (page {family.declared_axes.page})" if family.declared_axes else ""
    return f"{family.name} always has the axes {' and '.join((', '.join(axes[:-1]), axes[-1]))}{page}"


def why_letters_are_fixed(schema: Schema) -> str:
    """Return why an axis of a family cannot have another letter; "" where it can."""
    declared = schema.family.declared_axes
    if schema.family.axes or (declared and declared.name):
        return ""
    return f"{schema.family.name} has fixed names for its axes"


def why_types_are_fixed(schema: Schema) -> str:
    """Return why an axis of a family cannot have another type; "" where it can."""
    if schema.family.axes:
        return ""
    return f"{schema.family.name} has no parameter for the type of an axis"


def parameters_of_axes(schema: Schema) -> tuple[str, ...]:
    """Return the parameters that a choice of axes is written to."""
    profile, declared = schema.family.axes, schema.family.declared_axes
    if profile:
        return tuple(filter(None, (profile.name, profile.type, profile.fitted_by)))
    if declared is None:
        return ()
    named = (
        declared.name.param if declared.name else None,
        declared.group_count,
        declared.count,
        declared.letters,
    )
    return tuple(filter(None, (*named, *declared.flags)))


def letters_offered(schema: Schema) -> tuple[str, ...]:
    """Return the letters an axis can be given; none where they are fixed, or any text is one."""
    return tuple(choice.label for choice in _letter_choices(schema) or () if choice.key != "none")


def _letter_choices(schema: Schema) -> tuple[Choice, ...] | None:
    """Return the choices of what names an axis: a parameter, or a field of a packed word."""
    profile, declared = schema.family.axes, schema.family.declared_axes
    field = declared.name if declared else None
    named = profile.name if profile else field.param if field else None
    if named is None:
        return None
    parameter = schema.parameters[named]
    if field is None or field.bit is None:
        return parameter.choices
    return next((bit.choices for bit in parameter.bits or () if bit.bit == field.bit), None)


def places_offered(file: ParameterFile) -> tuple[str, ...]:
    """Return the places at which an axis can be added, the usual one first; none where no axis can be."""
    schema, fitted = file.schema, fitted_axes(file)
    free = [a for a in axis_instances(file) if a not in fitted and not other_use(file, a)]
    if why_axes_are_fixed(schema) or not free:
        return ()
    declared = schema.family.declared_axes
    if declared is None:
        return (free[0], *(a for a in axis_instances(file) if a != free[0]))
    return tuple(free) if declared.flags else (free[0],)
