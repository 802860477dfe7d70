"""The axis operations of the editor: name, configure, copy, delete.

They act on the parameters that the family's axis profile names, and return the
changes they made, so that each is one step to undo.
"""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.schema import Address, AxisProfile, InvalidValueError, Value
from amp_studio.schema.model import AxisList

from .parameter_file import Change, ParameterFile


class AxisError(ValueError):
    """An axis operation that cannot be done; the text is one clear sentence."""


def axis_instances(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes a file can have; empty for a family without an axis profile or a list of axes."""
    family = file.schema.family
    if family.axis_list:
        return family.scopes["axis"].instances
    return file.machine_schema.instances(file.schema.parameters[family.axes.type]) if family.axes else ()


def axis_type(file: ParameterFile, axis: str) -> str:
    """Return the type key of an axis; when it is not set the unfitted one, or the usual one where there is none."""
    profile = _profile(file)
    value = file.get((profile.type, axis))
    return str(value.value) if value else profile.unfitted or profile.usual_type


def alike_axes(file: ParameterFile, axis: str) -> tuple[str, ...]:
    """Return the fitted axes of the same type as an axis; where there are no types, those that move as it does."""
    if file.schema.family.axes:
        return tuple(a for a in fitted_axes(file) if axis_type(file, a) == axis_type(file, axis))
    named = file.schema.family.angular_when
    turning = {a: bool(named) and file.evaluation.is_true(str(named), a, "axis") for a in fitted_axes(file)}
    return tuple(a for a, turns in turning.items() if turns == turning.get(axis))


def axis_title(file: ParameterFile, axis: str) -> str:
    """Return ``1 X linear`` for a column head."""
    profile = _profile(file)
    name = file.get((profile.name, axis))
    parameter = file.schema.parameters[profile.name]
    labels = {c.key: c.label for c in parameter.choices or ()}
    own = str(name.value) if name else "–"
    return f"{axis} {labels.get(own, '?') if name and labels else own} {axis_type(file, axis)}"


def fitted_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that are not unfitted."""
    family, profile = file.schema.family, file.schema.family.axes
    if family.axis_list:
        listed = file.get((family.axis_list.param, ""))
        return tuple(a for a in axis_instances(file) if listed is None or a in str(listed.value))
    if profile is None:
        return ()
    if profile.fitted_by:
        switches = {a: file.get((profile.fitted_by, a)) for a in axis_instances(file)}
        return tuple(a for a, switch in switches.items() if switch is None or switch.value != 0)
    return tuple(a for a in axis_instances(file) if axis_type(file, a) != profile.unfitted)


def name_axes(file: ParameterFile, names: Sequence[str]) -> list[Change]:
    """Name the axes in order and fit as many; the others become unfitted.

    A spindle's name makes a spindle; A, B and C are fitted as rotary, every
    other as linear, as is usual; raises AxisError for a name that is not
    offered and for too many axes. A control with a list of axes has the first ones, in their order.
    """
    instances = axis_instances(file)
    if instances and len(names) > len(instances):
        raise AxisError(f"{len(names)} axes are too many: {file.schema.family.name} has {len(instances)}")
    if file.schema.family.axis_list:
        return _list_axes(file, file.schema.family.axis_list, [name.upper() for name in names])
    profile = _profile(file)
    wanted: dict[Address, Value | None] = {}
    for axis, name in zip(instances, names, strict=False):
        try:
            wanted[(profile.name, axis)] = file.read((profile.name, axis), name)
        except InvalidValueError as error:
            raise AxisError(str(error)) from None
        wanted[(profile.type, axis)] = Value(profile.types.get(name.upper(), profile.usual_type))
    for axis in instances[len(names) :]:
        wanted.update(_unfitted(profile, axis))
    return file.set_many(wanted)


def _list_axes(file: ParameterFile, listed: AxisList, names: Sequence[str]) -> list[Change]:
    instances = axis_instances(file)
    if tuple(names) != instances[: len(names)] or len(names) < listed.least:
        order = ", ".join(instances)
        raise AxisError(
            f"{file.schema.family.name} has the first {listed.least} or more of the axes {order}, in this order"
        )
    return file.set_many({(listed.param, ""): Value("".join(names))})


def retype_axis(file: ParameterFile, axis: str, type_key: str) -> list[Change]:
    """Change the type of an axis; its lengths become angles, or its angles lengths, with the same figures.

    The control knows only the figure: its values are in millimetres or degrees as the axis moves.
    """
    profile = _profile(file)
    if axis not in axis_instances(file):
        raise AxisError(f"there is no axis {axis}")
    types = [c.key for c in file.schema.parameters[profile.type].choices or ()]
    if type_key not in types:
        raise AxisError(f"there is no axis type '{type_key}': {', '.join(types)}")
    change = file.set((profile.type, axis), Value(type_key))
    return ([change] if change else []) + file.refit_units(axis)


def copy_axis(file: ParameterFile, source: str, target: str) -> list[Change]:
    """Copy every per-axis value of one axis to another of the same type, except its name and what it is fitted by.

    Raises AxisError when the types differ or an axis does not exist.
    """
    profile = _profile(file)
    for axis in (source, target):
        if axis not in axis_instances(file):
            raise AxisError(f"there is no axis {axis}")
    if source == target:
        raise AxisError(f"axis {source} cannot be copied to itself")
    if axis_type(file, source) != axis_type(file, target):
        raise AxisError(
            f"axis {source} is {axis_type(file, source)} and axis {target} is {axis_type(file, target)}: "
            "only axes of the same type can be copied"
        )
    changes = []
    for parameter_id, instance in file.addresses():
        own = parameter_id in (profile.name, profile.fitted_by)
        if instance == target and not own and _is_axis(file, parameter_id):
            change = file.set((parameter_id, target), file.get((parameter_id, source)))
            if change:
                changes.append(change)
    return changes


def delete_axis(file: ParameterFile, axis: str) -> list[Change]:
    """Make an axis unfitted and put its values back to their printed defaults; a value without one is not set."""
    profile = _profile(file)
    if axis not in axis_instances(file):
        raise AxisError(f"there is no axis {axis}")
    changes = []
    unfitted = _unfitted(profile, axis)
    changes += [change for a, value in unfitted.items() if (change := file.set(a, value))]
    for address in file.addresses():
        if (
            address[1] == axis
            and address not in unfitted
            and address[0] != profile.name
            and _is_axis(file, address[0])
        ):
            change = file.set(address, file.default(address))
            if change:
                changes.append(change)
    return changes


def _unfitted(profile: AxisProfile, axis: str) -> dict[Address, Value]:
    """Return the value that marks an axis that is not there."""
    if profile.fitted_by:
        return {(profile.fitted_by, axis): Value(0)}
    return {(profile.type, axis): Value(profile.unfitted or "")}


def _is_axis(file: ParameterFile, parameter_id: str) -> bool:
    return file.machine_schema.scopes[parameter_id] == "axis"


def _profile(file: ParameterFile) -> AxisProfile:
    if file.schema.family.axes is None:
        raise AxisError(f"{file.schema.family.name} has no axes to configure")
    return file.schema.family.axes
