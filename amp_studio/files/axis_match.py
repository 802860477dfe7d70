"""One axis in the place of another: to compare two axes, and machines whose axes have other numbers."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from amp_studio.schema import Address, read_address, whole_of, written

from .axes import AxisError, axis_instances, axis_letter, fitted_axes, known_axis
from .axis_values import axis_addresses, copied_values, moved
from .parameter_file import ParameterFile


@dataclass(frozen=True)
class MatchedAxes:
    """A file whose axes have the numbers that their letters have in another file.

    ``moved``: (letter, number before, number now) of each axis that got another one. ``left_out``: letters of
    axes for which the other file has no free number; their values are not in ``file``.
    """

    file: ParameterFile
    moved: tuple[tuple[str, str, str], ...]
    left_out: tuple[str, ...]


def axis_letters(file: ParameterFile) -> dict[str, str]:
    """Return fitted axis -> its letter, as the machine is programmed; the instance itself where it has
    none.
    """
    letters = {axis: axis_letter(file, axis) for axis in fitted_axes(file)}
    return {
        axis: axis if not letter or letter.startswith("raw:") else letter for axis, letter in letters.items()
    }


def matched_by_letter(file: ParameterFile, like: ParameterFile) -> MatchedAxes:
    """Return a file with each axis at the number that its letter has in ``like``; one of another family
    stays as it is.

    An axis whose letter ``like`` does not have gets a number that is free there, its own if possible. Where a
    letter occurs twice in one of the files it is not known which axis is meant, and all stay where they are.
    """
    if file.schema.family.family != like.schema.family.family:
        return MatchedAxes(file, (), ())
    mine, theirs = axis_letters(file), axis_letters(like)
    wanted = dict(zip(theirs.values(), theirs, strict=True))
    # A letter that is there twice has made the mapping the shorter one.
    if len(set(mine.values())) < len(mine) or len(wanted) < len(theirs):
        return MatchedAxes(file, (), ())
    places = {axis: wanted[letter] for axis, letter in mine.items() if letter in wanted}
    left_out = _placed_where_free(_without(mine, places), _without(axis_instances(like), theirs), places)
    others = tuple((mine[axis], axis, places[axis]) for axis in mine if places.get(axis, axis) != axis)
    if not others and not left_out:
        return MatchedAxes(file, (), ())
    rest = _without(axis_instances(file), mine)  # unfitted ones go where there is room
    room = _without(axis_instances(file), places.values())
    places |= dict(zip(rest, room, strict=False))
    return MatchedAxes(_moved(file, places), others, tuple(mine[axis] for axis in left_out))


def _without(axes: Iterable[str], taken: Collection[str]) -> list[str]:
    return [axis for axis in axes if axis not in taken]


def _placed_where_free(axes: Sequence[str], free: list[str], places: dict[str, str]) -> list[str]:
    """Give each axis a free number, its own if possible; returns those for which there is none left."""
    for n, axis in enumerate(axes):
        if not free:
            return list(axes[n:])
        places[axis] = axis if axis in free else free[0]
        free.remove(places[axis])
    return []


def _moved(file: ParameterFile, places: Mapping[str, str]) -> ParameterFile:
    """Return a file with its axes at other numbers; what belongs to an axis without a place is left out."""
    twin, here = file.copy(), file.machine_schema
    moved(twin, places)
    for axis in set(axis_instances(file)) - set(places.values()):
        for address in axis_addresses(file, axis):
            twin.set(address, None)

    def placed(address: Address) -> Address:
        axis = whole_of(address[1])
        if axis not in places or not here.kin(here.scopes.get(address[0]), "axis"):
            return address
        return address[0], places[axis] + address[1][len(axis) :]

    marks = {placed(address): why for address, why in file.forced.items()}
    twin.forced.update({address: why for address, why in marks.items() if address in twin.values})
    notes = file.header.value_notes.items()
    twin.header.value_notes = {written(placed(read_address(key))): text for key, text in notes}
    return twin


def as_axis(file: ParameterFile, source: str, target: str) -> ParameterFile:
    """Return a file in which axis ``target`` has the values of axis ``source``,
    except its name and what it is fitted by.

    They may be of different types. Raises AxisError for an axis that does not exist and for one with itself.
    """
    for axis in (source, target):
        known_axis(file, axis)
    if source == target:
        raise AxisError(f"axis {source} cannot be compared with itself")
    twin = file.copy()
    for address, value in copied_values(file, source, target).items():
        twin.set(address, value)
        # An instance may go on behind its axis.
        other = (address[0], source + address[1][len(target) :])
        if other in file.forced and address[1]:
            twin.forced[address] = file.forced[other]
    return twin
