"""One axis in the place of another: to compare two axes, and machines whose axes have other numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.schema import Address
from amp_studio.schema.address import whole_of

from .axes import AxisError, axis_instances, fitted_axes
from .parameter_file import ParameterFile


@dataclass(frozen=True)
class MatchedAxes:
    """A file whose axes have the numbers that their letters have in another file.

    ``moved``: (letter, number before, number now) of each axis that got another one.
    ``left_out``: letters of axes for which the other file has no free number; their values are not in ``file``.
    """

    file: ParameterFile
    moved: tuple[tuple[str, str, str], ...]
    left_out: tuple[str, ...]


def axis_letters(file: ParameterFile) -> dict[str, str]:
    """Return fitted axis -> its letter, as the machine is programmed; the instance itself where no parameter names it."""
    profile = file.schema.family.axes
    if profile is None:
        scope = file.schema.family.scopes.get("axis")
        return {i: i for i in (fitted_axes(file) or (scope.instances if scope else ()))}
    labels = {c.key: c.label for c in file.schema.parameters[profile.name].choices or ()}
    letters = {}
    for axis in fitted_axes(file):
        name = file.get((profile.name, axis))
        letters[axis] = labels.get(str(name.value), str(name.value)) if name else axis
    return letters


def matched_by_letter(file: ParameterFile, like: ParameterFile) -> MatchedAxes:
    """Return a file with each axis at the number that its letter has in ``like``; both are of one schema.

    An axis whose letter ``like`` does not have gets a number that is free there, its own if possible. Where a letter occurs
    twice in one of the files nobody knows which axis is meant, and all stay where they are.
    """
    mine, wanted = axis_letters(file), {letter: axis for axis, letter in axis_letters(like).items()}
    is_plain = len(set(mine.values())) == len(mine) and len(wanted) == len(axis_letters(like))
    if not is_plain or file.schema.family.axes is None:
        return MatchedAxes(file, (), ())
    places = {axis: wanted[letter] for axis, letter in mine.items() if letter in wanted}
    free = [axis for axis in axis_instances(like) if axis not in wanted.values()]
    left_out = []
    for axis, letter in mine.items():
        if axis in places:
            continue
        if not free:
            left_out.append(letter)
            continue
        places[axis] = axis if axis in free else free[0]
        free.remove(places[axis])
    moved = tuple((mine[axis], axis, places[axis]) for axis in mine if places.get(axis, axis) != axis)
    if not moved and not left_out:
        return MatchedAxes(file, (), ())
    rest = [axis for axis in axis_instances(file) if axis not in mine]  # unfitted ones go where there is room
    room = [axis for axis in axis_instances(file) if axis not in places.values()]
    places |= dict(zip(rest, room, strict=False))
    return MatchedAxes(_moved(file, places), moved, tuple(left_out))


def _moved(file: ParameterFile, places: Mapping[str, str]) -> ParameterFile:
    """Return a file with its axes at other numbers; what belongs to an axis without a place is left out."""
    twin = file.copy()
    twin.values.clear()
    twin.forced.clear()
    for address, value in file.values.items():
        place = _place(file, address, places)
        if place is not None:
            twin.values[place] = value
            if address in file.forced:
                twin.forced[place] = file.forced[address]
    twin.evaluation.forget()
    return twin


def _place(file: ParameterFile, address: Address, places: Mapping[str, str]) -> Address | None:
    """Return where a value goes; None where its axis has no place, or the parameter does not exist there."""
    here = file.machine_schema
    scope = here.scopes.get(address[0])
    if scope is None or not here.kin(scope, "axis"):
        return address
    axis = places.get(whole_of(address[1]))
    if axis is None:
        return None
    place = (address[0], axis + address[1][len(whole_of(address[1])) :])
    return place if place in here.places else None


def as_axis(file: ParameterFile, source: str, target: str) -> ParameterFile:
    """Return a file in which axis ``target`` has the values of axis ``source``, except its name and what it is fitted by.

    Raises AxisError for an axis that does not exist and for one with itself.
    """
    scope = file.schema.family.scopes.get("axis")
    instances = axis_instances(file) or (scope.instances if scope else ())
    for axis in (source, target):
        if axis not in instances:
            raise AxisError(f"there is no axis {axis}")
    if source == target:
        raise AxisError(f"axis {source} cannot be compared with itself")
    profile, here, twin = file.schema.family.axes, file.machine_schema, file.copy()
    kept = (profile.name, profile.fitted_by) if profile else ()
    for address in here.places:
        scope_of = here.scopes[address[0]]
        if whole_of(address[1]) != target or address[0] in kept or not here.kin(scope_of, "axis"):
            continue
        other = (address[0], source + address[1][len(target) :])
        if other in here.places:
            twin.set(address, file.get(other))
            if other in file.forced and other in file.values:
                twin.forced[address] = file.forced[other]
    return twin
