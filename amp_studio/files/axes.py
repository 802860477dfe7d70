"""The axes of a file: which there are, their letters, how they move. An idea of every family.

A family declares where a file has this: in types of axes (``AxisProfile``),
or otherwise (``AxisDeclaration``).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from amp_studio.errors import AmpStudioError
from amp_studio.schema import Address, AxisProfile, axis_group, axis_name, is_fitted, labelled

from .parameter_file import ParameterFile


class AxisError(AmpStudioError, ValueError):
    """An axis operation that cannot be done; the text is one clear sentence."""


def axis_instances(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes a file can have; empty for a family without axes."""
    family = file.schema.family
    if family.axes:
        return file.machine_schema.instances(file.schema.parameters[family.axes.type])
    instances = family.scopes["axis"].instances if "axis" in family.scopes else ()
    most = family.declared_axes.most.get(file.machine) if family.declared_axes else None
    return instances[:most]


def fitted_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that are there, as far as the file states it."""
    return tuple(a for a in axis_instances(file) if is_fitted(file.evaluation, a))


def shown_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that have a column and are printed: the fitted ones,
    and inputs that something else uses.
    """
    return tuple(a for a in axis_instances(file) if is_fitted(file.evaluation, a) or other_use(file, a))


def other_use(file: ParameterFile, axis: str) -> str:
    """Return what else uses the input of an axis (``spindle``); "" where nothing does."""
    declared = file.schema.family.declared_axes
    uses = declared.other_uses if declared else {}
    return next((use for when, use in uses.items() if file.evaluation.is_true(when, axis, "axis")), "")


def axis_type(file: ParameterFile, axis: str) -> str:
    """Return the type key of an axis; when it is not set the unfitted one,
    or the usual one where there is none.
    """
    profile = axis_profile(file)
    value = file.get((profile.type, axis))
    return str(value.value) if value else profile.unfitted or profile.usual_type


def axis_turns(file: ParameterFile, axis: str) -> bool:
    """Return whether an axis is entered in degrees; false in a family without the difference."""
    condition = file.schema.family.angular_when
    return condition is not None and file.evaluation.is_true(condition, axis, "axis")


_KINDS = frozenset({"linear", "rotary", "spindle"})


def axis_kind(file: ParameterFile, axis: str) -> str:
    """Return how an axis moves, as its head shows it: its type, ``linear`` or ``rotary``;
    "" where the family has no such fact.
    """
    if file.schema.family.axes:
        kind = axis_type(file, axis)
        return kind if kind in _KINDS or not axis_turns(file, axis) else "rotary"
    if use := other_use(file, axis):
        return use
    if file.schema.family.angular_when is None or not is_fitted(file.evaluation, axis):
        return ""
    return "rotary" if axis_turns(file, axis) else "linear"


def alike_axes(file: ParameterFile, axis: str) -> tuple[str, ...]:
    """Return the fitted axes of the same type as an axis; where there are no types,
    those that move as it does.
    """
    return tuple(a for a in fitted_axes(file) if are_alike(file, a, axis))


def are_alike(file: ParameterFile, axis: str, other: str) -> bool:
    """Return whether two axes have the same type; where there are no types, whether they move alike."""
    if file.schema.family.axes:
        return axis_type(file, axis) == axis_type(file, other)
    return axis_turns(file, axis) == axis_turns(file, other)


def axis_letter(file: ParameterFile, axis: str) -> str:
    """Return the letter of an axis: the one the file gives it, or its own; "" where it has none."""
    declared = file.schema.family.declared_axes
    own = axis if declared is not None and declared.name is None else ""
    return axis_name(file.evaluation, axis) or own


def axis_title(file: ParameterFile, axis: str) -> str:
    """Return the head of an axis: ``1 X linear``, ``0 X linear, Group 2`` where there are several groups,
    ``X axis``.
    """
    family = file.schema.family
    letter, kind = axis_letter(file, axis), axis_kind(file, axis)
    if use := other_use(file, axis):
        return f"{axis} {use}"
    if family.axes is None and letter in ("", axis):
        title = labelled(family.scopes["axis"].label, axis)
    else:
        # raw: is a stored code for which the manual prints no letter.
        title = f"{axis} {'?' if letter.startswith('raw:') else letter or '–'}"
    return f"{title} {kind}".rstrip() + (_of_group(file, axis) if letter else "")


def axis_head(file: ParameterFile, axis: str) -> tuple[str, str]:
    """Return the head of an axis in two parts, the letter and the rest: ``("X", "1 linear")``, ``("Z",
    "linear")``.

    The letter is the one that the file gives it; an axis without one has a rest only, ``Axis 3``.
    """
    letter = axis_letter(file, axis)
    if letter.startswith("raw:") or letter.casefold() == "none":
        letter = ""
    kind = axis_kind(file, axis)
    if not letter:
        return "", f"{labelled(file.schema.family.scopes['axis'].label, axis)} {kind}".rstrip()
    return letter, " ".join(filter(None, ("" if letter == axis else axis, kind))) + _of_group(file, axis)


def _of_group(file: ParameterFile, axis: str) -> str:
    """Return ``, Group 2`` where the axes of a file are in several groups."""
    own = axis_group(file.evaluation, axis)
    several = own and len({axis_group(file.evaluation, a) for a in fitted_axes(file)}) > 1
    return f", {own}" if several else ""


def unlike_axes(file: ParameterFile, addresses: Iterable[Address]) -> set[Address]:
    """Return which values of one parameter are unlike those of most axes that are given in the same unit.

    Where each axis has its own value none is unlike the others, and of two axes it is the second.
    """
    profile = file.schema.family.axes
    of_each_axis = (profile.name, profile.type, profile.fitted_by) if profile else ()
    by_unit: dict[str, list[Address]] = {}
    for address in addresses:
        if address[0] not in of_each_axis:
            by_unit.setdefault(file.evaluation.unit(address, file.header.units), []).append(address)
    return {a for alike in by_unit.values() for a in _unlike(file, alike)}


def _unlike(file: ParameterFile, addresses: Sequence[Address]) -> Iterator[Address]:
    """Yield the addresses whose value is not the usual one of all; none where no two are the same."""
    keys = [file.evaluation.keys[a] for a in addresses]
    usual, count = Counter(keys).most_common(1)[0]
    # Of two axes neither is the usual one; the second is marked, so that a difference is seen at all.
    if count > 1 or len(addresses) == 2:
        yield from (a for a, key in zip(addresses, keys, strict=True) if key != usual)


def axis_profile(file: ParameterFile) -> AxisProfile:
    """Return the axis profile of a file's family; raises AxisError where axes have no types."""
    if file.schema.family.axes is None:
        raise AxisError(f"{file.schema.family.name} has no types of axes")
    return file.schema.family.axes


def known_axis(file: ParameterFile, axis: str) -> str:
    """Return the axis; raises AxisError for one that the family does not have."""
    if axis not in axis_instances(file):
        raise AxisError(f"there is no axis {axis}")
    return axis
