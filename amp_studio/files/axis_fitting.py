"""Which axes a machine has: to choose them for a new file, to name, type, add and remove them.

Each operation writes the parameters that the family's facts name and returns the changes it made, so that it
is one step to undo. An error changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from amp_studio.schema import (
    Address,
    AxisDeclaration,
    AxisField,
    AxisProfile,
    InvalidValueError,
    Value,
    axis_group,
    field_at,
    is_fitted,
    quoted,
    with_field,
)

from .axes import AxisError, axis_instances, axis_letter, axis_profile, fitted_axes, known_axis, shown_axes
from .axis_abilities import letters_offered, parameters_of_axes, why_axes_are_fixed, why_letters_are_fixed
from .axis_values import axis_addresses, bits_of_axes, moved
from .parameter_file import Change, ParameterFile, fill_defaults

# -- all axes of a machine


def name_axes(file: ParameterFile, names: Sequence[str]) -> list[Change]:
    """Name the axes in order and fit as many; the others become unfitted.

    With types of axes a spindle's name makes a spindle; A, B and C are fitted as rotary, every other as
    linear, as is usual. Where axes are in groups a name may carry its group, ``X.2``. Raises AxisError for a
    name that is not offered, for too many axes, and where a family always has the same ones.
    """
    instances, declared = axis_instances(file), file.schema.family.declared_axes
    if instances and len(names) > len(instances):
        raise AxisError(f"{len(names)} axes are too many: {file.schema.family.name} has {len(instances)}")
    if declared is None:
        return file.set_checked(_typed(file, names))
    if declared.is_fixed and tuple(n.upper() for n in names) == instances:
        return []
    _may_choose(file)
    if declared.letters:
        return file.set_checked(_lettered(file, declared, [name.upper() for name in names]))
    _enough_axes(file, declared, len(names))
    with file.step() as changes:
        # Checked afterwards, inside of the step: an error takes back what was set.
        file.set_checked(_named_and_fitted(file, declared, instances, names))
        _each_name_once(file, instances[: len(names)])
        _declare_groups(file, declared)
    return changes


def _enough_axes(file: ParameterFile, declared: AxisDeclaration, count: int) -> None:
    """Raise AxisError for fewer axes than the family always has."""
    if count < declared.least:
        raise AxisError(f"{file.schema.family.name} has {declared.least} or more axes (page {declared.page})")


def _named_and_fitted(
    file: ParameterFile, declared: AxisDeclaration, instances: Sequence[str], names: Sequence[str]
) -> dict[Address, Value | None]:
    """Return the values by which the first axes have these names and are fitted, and the others are not."""
    values: dict[Address, Value | None] = {}
    for axis, name in zip(instances, names, strict=False):
        _put(file, values, _named(file, declared, axis, name))
    if declared.count:
        _put(file, values, {(declared.count, ""): Value(len(names))})
    else:
        for axis in instances[len(names) :]:
            _put(file, values, _without_letter(file, declared, axis))
    fitted = {axis: n < len(names) for n, axis in enumerate(instances)}
    _put(file, values, _flagged(file, declared, fitted))
    return values


def _put(file: ParameterFile, wanted: dict[Address, Value | None], more: dict[Address, Value | None]) -> None:
    wanted.update({a: v for a, v in more.items() if a in wanted or file.get(a) != v})


def _typed(file: ParameterFile, names: Sequence[str]) -> dict[Address, Value | None]:
    """Return what names and fits axes in a family with types of axes."""
    _may_choose(file)
    profile, instances = axis_profile(file), axis_instances(file)
    wanted: dict[Address, Value | None] = {}
    for axis, name in zip(instances, names, strict=False):
        wanted.update(_of_type(file, profile, axis, name))
    for axis in instances[len(names) :]:
        wanted.update(_unfitted(profile, axis))
    return wanted


def _of_type(file: ParameterFile, profile: AxisProfile, axis: str, name: str) -> dict[Address, Value | None]:
    """Return the name of an axis and the type that goes with it; raises AxisError."""
    try:
        own = file.read((profile.name, axis), name)
    except InvalidValueError as error:
        raise AxisError(str(error)) from None
    return {
        (profile.name, axis): own,
        (profile.type, axis): Value(profile.types.get(name.upper(), profile.usual_type)),
    }


def _lettered(
    file: ParameterFile, declared: AxisDeclaration, names: Sequence[str]
) -> dict[Address, Value | None]:
    """Return what declares the letters of the axes; raises AxisError for letters that a control cannot
    have.
    """
    instances = axis_instances(file)
    if declared.any_letters:
        if bad := [name for n, name in enumerate(names) if name not in instances or name in names[:n]]:
            raise AxisError(f"{quoted(bad[0])} is no name for one more axis: {', '.join(instances)}")
        return {(str(declared.letters), ""): Value(" ".join(names)), **_counted(file, declared, len(names))}
    if tuple(names) != instances[: len(names)] or len(names) < declared.least:
        order = ", ".join(instances)
        raise AxisError(
            f"{file.schema.family.name} has the first {declared.least} or more of the axes {order}, in this"
            " order"
        )
    return {(str(declared.letters), ""): Value("".join(names))}


def _counted(file: ParameterFile, declared: AxisDeclaration, axes: int) -> dict[Address, Value | None]:
    """Return the number of motors: as many more or less as there are axes now."""
    present = file.evaluation.canonical((str(declared.count), ""))
    # Motors without an axis of their letter, as the second of a gantry, stay.
    spare = int(present) - len(fitted_axes(file)) if isinstance(present, float) else 0
    return {(str(declared.count), ""): Value(axes + max(0, spare))}


def _may_choose(file: ParameterFile) -> None:
    if reason := why_axes_are_fixed(file.schema):
        raise AxisError(reason)


# -- one axis


def rename_axis(file: ParameterFile, axis: str, name: str) -> list[Change]:
    """Give an axis another letter; raises AxisError for one that is not offered,
    or that its group has already.
    """
    known_axis(file, axis)
    if reason := why_letters_are_fixed(file.schema):
        raise AxisError(reason)
    declared = file.schema.family.declared_axes
    with file.step() as changes:
        if declared is not None:
            file.set_checked(_named(file, declared, axis, name))
            _each_name_once(file, [axis])
        else:
            address = (axis_profile(file).name, axis)
            try:
                file.set_checked({address: file.read(address, name)})
            except InvalidValueError as error:
                raise AxisError(str(error)) from None
    return changes


def retype_axis(file: ParameterFile, axis: str, type_key: str) -> list[Change]:
    """Change the type of an axis; its lengths become angles, or its angles lengths, with the same figures.

    The control knows only the figure: its values are in millimetres or degrees as the axis moves.
    """
    profile = axis_profile(file)
    known_axis(file, axis)
    types = [c.key for c in file.schema.parameters[profile.type].choices or ()]
    if type_key not in types:
        raise AxisError(f"there is no axis type '{type_key}': {', '.join(types)}")
    change = file.set((profile.type, axis), Value(type_key))
    return ([change] if change else []) + file.refit_units(axis)


def add_axis(file: ParameterFile, name: str, at: str | None = None) -> list[Change]:
    """Fit one more axis under a name: the first that is free, or one given with ``at``.

    Where a family counts its axes from the first one, the axes from ``at`` on move up by one, with all their
    values; where an axis is what it is wired to, ``at`` must be free. Raises AxisError.
    """
    _may_choose(file)
    declared, instances, fitted = file.schema.family.declared_axes, axis_instances(file), fitted_axes(file)
    free = [a for a in instances if a not in fitted]
    if not free:
        raise AxisError(
            f"{file.schema.family.name} has no axis that is free: all {len(instances)} are fitted"
        )
    with file.step() as changes:
        if declared is None:
            place = free[0] if at is None else known_axis(file, at)
            _add_typed(file, name, place, free)
        elif declared.flags:
            place = _add_flagged(file, declared, name, at)
        else:
            place = _add_last(file, declared, name, at)
        fill_defaults(file, [place], existing_only=declared is not None and declared.letters is not None)
    return changes


def _add_typed(file: ParameterFile, name: str, place: str, free: list[str]) -> None:
    profile = axis_profile(file)
    if place not in free:
        _make_room(file, place, free)
    # What it is wired to is not known: not set, the axis is there and a finding asks for it.
    fit = dict.fromkeys([(profile.fitted_by, place)] if profile.fitted_by else [])
    file.set_checked({**_of_type(file, profile, place, name), **fit})


def _make_room(file: ParameterFile, place: str, free: list[str]) -> None:
    """Move the axes from one on up by one, as far as the next that is free; what was there moves to the
    gap.
    """
    instances = axis_instances(file)
    start = instances.index(place)
    end = next((n for n in range(start, len(instances)) if instances[n] in free), None)
    if end is None:
        raise AxisError(f"there is no free axis after axis {place}")
    order = {instances[n]: instances[n + 1] for n in range(start, end)} | {instances[end]: place}
    moved(file, order)
    _reset_axis(file, place)


def _add_flagged(file: ParameterFile, declared: AxisDeclaration, name: str, at: str | None) -> str:
    """Fit an axis at a free input, by default the first; returns which. Raises AxisError."""
    fitted, taken = fitted_axes(file), shown_axes(file)
    place = at if at is not None else next((a for a in axis_instances(file) if a not in taken), "")
    if known_axis(file, place) in fitted:
        raise AxisError(
            f"axis {place} is there already ({axis_letter(file, place) or 'without a name'}); an axis is"
            f" known by the {declared.place}: choose one that is free"
        )
    if place in taken:
        raise AxisError(f"the input {place} serves a spindle or a handwheel")
    file.set_checked({**_named(file, declared, place, name), **_flagged(file, declared, {place: True})})
    _each_name_once(file, [place])
    return place


def _add_last(file: ParameterFile, declared: AxisDeclaration, name: str, at: str | None) -> str:
    """Fit the axis behind the last one; returns which. Raises AxisError."""
    instances, fitted = axis_instances(file), fitted_axes(file)
    if declared.any_letters:
        file.set_checked(_lettered(file, declared, [*fitted, name.upper()]))
        return name.upper()
    place = instances[len(fitted)]
    if at not in (None, place):
        raise AxisError(f"{file.schema.family.name} has the first axes in order: the next one is {place}")
    if declared.letters:
        file.set_checked(_lettered(file, declared, [*fitted, name.upper()]))
        return place
    file.set_checked(
        {**_named(file, declared, place, name), (str(declared.count), ""): Value(len(fitted) + 1)}
    )
    _each_name_once(file, [place])
    return place


def delete_axis(file: ParameterFile, axis: str) -> list[Change]:
    """Make an axis unfitted and put its values back to their printed defaults;
    a value without one is not set.

    Raises AxisError for an axis that is not fitted or that the machine must have,
    and for one that is not the last where they are counted.
    """
    known_axis(file, axis)
    _may_choose(file)
    if axis not in fitted_axes(file):
        raise AxisError(f"axis {axis} is not fitted")
    declared = file.schema.family.declared_axes
    with file.step() as changes:
        if profile := file.schema.family.axes:
            file.set_checked(_unfitted(profile, axis))
            _reset_axis(file, axis)
        elif declared is not None:
            _remove(file, declared, axis)
            _reset_axis(file, axis)
    return changes


def _unfit(file: ParameterFile, declared: AxisDeclaration, axis: str) -> None:
    """Take letter and flag of an axis away, then its bit in each word that is set."""
    file.set_checked(_without_letter(file, declared, axis) | _flagged(file, declared, {axis: False}))
    bits = bits_of_axes(file, {axis: False})
    file.set_checked({a: value for a, value in bits.items() if file.get(a) is not None})


def _remove(file: ParameterFile, declared: AxisDeclaration, axis: str) -> None:
    """Take an axis of a family without types away; raises AxisError where the machine would not have the
    rest.
    """
    fitted = fitted_axes(file)
    if declared.flags:
        _unfit(file, declared, axis)
        return
    if declared.any_letters:
        file.set_checked(_lettered(file, declared, [name for name in fitted if name != axis]))
        return
    if axis != fitted[-1]:
        raise AxisError(
            f"only the last axis can be removed, {fitted[-1]}: they are counted from the first one"
        )
    left = fitted[:-1]
    _enough_axes(file, declared, len(left))
    counted_by = {declared.count: Value(len(left)), declared.letters: Value("".join(left))}
    file.set_checked({(parameter, ""): value for parameter, value in counted_by.items() if parameter})


def _reset_axis(file: ParameterFile, axis: str) -> None:
    """Put the values of an axis back to their printed defaults, except its letter and what fits it."""
    own = set(parameters_of_axes(file.schema))
    described = (declared := file.schema.family.declared_axes) is not None and declared.letters
    for address in axis_addresses(file, axis):
        if address[0] in own:
            continue
        # A control that lists its axes does not have the settings of the others: they have no default.
        gone = described and file.evaluation.state(address).state == "hidden"
        file.set(address, None if gone else file.default(address))


def _unfitted(profile: AxisProfile, axis: str) -> dict[Address, Value | None]:
    """Return the value that marks an axis that is not there."""
    if profile.fitted_by:
        return {(profile.fitted_by, axis): Value(0)}
    return {(profile.type, axis): Value(profile.unfitted or "")}


# -- where axes have no types


def _named(
    file: ParameterFile, declared: AxisDeclaration, axis: str, name: str
) -> dict[Address, Value | None]:
    """Return what gives an axis a letter and, for ``X.2``, a group;
    raises AxisError for one that is not offered.
    """
    letter, point, group = name.strip().partition(".")
    offered = letters_offered(file.schema)
    if declared.name is None or letter.upper() not in offered or bool(point) != bool(group):
        raise AxisError(f"{quoted(name)} is no name for an axis: {', '.join(offered)}")
    if group and declared.group is None:
        raise AxisError(f"{quoted(name)}: {file.schema.family.name} has no groups of axes")
    try:
        if declared.name.bit is None:
            return {(declared.name.param, axis): file.read((declared.name.param, axis), letter)}
        return _with_group(file, declared, axis, group, _with_field(file, declared.name, axis, letter))
    except InvalidValueError as error:
        # "none" is a choice of the parameter, and no name for an axis.
        raise AxisError(str(error).removesuffix(", none")) from None


def _with_group(
    file: ParameterFile, declared: AxisDeclaration, axis: str, group: str, values: dict[Address, Value | None]
) -> dict[Address, Value | None]:
    """Return values with the group of an axis in them: the given one, else the first for an axis without."""
    if declared.group is None:
        return values
    has_one = is_fitted(file.evaluation, axis) and not _has_none(file, declared.group, axis)
    if has_one and not group:
        return values
    return _with_field(file, declared.group, axis, f"Group {group or 1}", values)


def _has_none(file: ParameterFile, field: AxisField, axis: str) -> bool:
    return file.get((field.param, axis)) is None or not axis_group(file.evaluation, axis)


def _without_letter(file: ParameterFile, declared: AxisDeclaration, axis: str) -> dict[Address, Value | None]:
    """Return what leaves an axis without a name and a group."""
    wanted: dict[Address, Value | None] = {}
    for field in filter(None, (declared.name, declared.group)):
        # Name and group may be fields of one word: each is put into the result of the one before.
        wanted = _with_field(file, field, axis, "none", wanted)
    return wanted


def _with_field(
    file: ParameterFile,
    field: AxisField,
    axis: str,
    text: str,
    before: dict[Address, Value | None] | None = None,
) -> dict[Address, Value | None]:
    """Return the word of an axis with one field set to a text, over ``before`` where it has the word
    already.
    """
    address, parameter = (field.param, axis), file.schema.parameters[field.param]
    present = (before or {}).get(address) or file.get(address)
    word = int(present.value) if present and not isinstance(present.value, str) else 0
    return {address: Value(with_field(field_at(parameter, field.bit or 0), word, text))}


def _flagged(
    file: ParameterFile, declared: AxisDeclaration, fitted: dict[str, bool]
) -> dict[Address, Value | None]:
    """Return the words with a bit for each axis that is there."""
    return {a: v for a, v in bits_of_axes(file, fitted).items() if a[0] in declared.flags}


def _each_name_once(file: ParameterFile, named: Iterable[str]) -> None:
    """Raise AxisError where one of these axes has the letter of another axis of its group."""
    axes = {a: (axis_letter(file, a), axis_group(file.evaluation, a)) for a in fitted_axes(file)}
    for axis in named:
        letter, group = axes.get(axis, ("", ""))
        others = [a for a in axes if a != axis and letter and axes[a] == (letter, group)]
        if others:
            first, second = sorted((axis, others[0]), key=list(axes).index)
            of_group = f" of {group}" if group else ""
            raise AxisError(f"the axes {first} and {second}{of_group} would both be named {letter}")


def _declare_groups(file: ParameterFile, declared: AxisDeclaration) -> None:
    """Declare as many groups as the axes are in."""
    if declared.group_count is None or declared.group is None:
        return
    used = {axis_group(file.evaluation, a) for a in fitted_axes(file)} - {""}
    most = max((int(group.rpartition(" ")[2]) for group in used), default=0)
    present = file.evaluation.canonical((declared.group_count, ""))
    if most > (present if isinstance(present, float) else 0):
        file.set_checked({(declared.group_count, ""): Value(most)})
