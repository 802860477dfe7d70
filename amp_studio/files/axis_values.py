"""The values of one axis, wherever a family keeps them: to copy, swap, move and compare them.

They are the instances of parameters of the axis, those of its parts (the points of its cam table), and its
bit in each word that has a bit for every axis.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

from amp_studio.schema import Address, Parameter, Schema, Value, same_value, whole_of, written

from .axes import AxisError, are_alike, axis_kind, known_axis
from .parameter_file import Change, ParameterFile

_MIN_LABELS = 3
"""A word of which so many bits are named after axes, and none otherwise, has a bit for each axis."""


@dataclass(frozen=True)
class AxisDifference:
    """One parameter of which two axes have different values."""

    first: Address
    second: Address
    bits: tuple[int, int] | None = None
    """The bit of each axis, where both are in one word."""


def axis_addresses(file: ParameterFile, axis: str) -> Iterator[Address]:
    """Yield the addresses of an axis and of its parts, in the manual's order."""
    scopes, kin = file.machine_schema.scopes, file.machine_schema.kin
    for address in file.addresses():
        if whole_of(address[1]) == axis and kin(scopes[address[0]], "axis"):
            yield address


def bits_of_axes(file: ParameterFile, wanted: Mapping[str, bool]) -> dict[Address, Value]:
    """Return every word with a bit for each axis, with those of some axes as wanted;
    a word that is not set is 0 before.
    """
    found = {}
    for parameter_id, bits in words_of_axes(file.schema).items():
        value = file.get((parameter_id, ""))
        word = int(value.value) if value and not isinstance(value.value, str) else 0
        for axis, is_set in wanted.items():
            if axis in bits:
                word = word | 1 << bits[axis] if is_set else word & ~(1 << bits[axis])
        found[parameter_id, ""] = Value(word)
    return found


@lru_cache(maxsize=16)
def words_of_axes(schema: Schema) -> dict[str, dict[str, int]]:
    """Return the words of the control with a bit for each axis: axis -> bit."""
    info = schema.family.scopes.get("axis")
    if info is None:
        return {}
    names = {name: a for a in info.instances for name in (a, info.label.format(i=a, j=""))}
    fewest = min(_MIN_LABELS, len(info.instances))
    found = {}
    for p in schema.parameters.values():
        bits = _bits_by_label(p)
        if p.scope == "global" and len(bits) >= fewest and bits.keys() <= names.keys():
            found[p.id] = {names[label]: bit for label, bit in bits.items()}
    return found


def _bits_by_label(parameter: Parameter) -> dict[str, int]:
    """Return the single bits of a word by what they are called."""
    return {b.label: b.bit for b in parameter.bits or () if b.width == 1}


# -- copy


def copy_axis(file: ParameterFile, source: str, target: str) -> list[Change]:
    """Copy every value of one axis to another of the same type, except its name and what it is fitted by.

    Raises AxisError when the types differ or an axis does not exist.
    """
    for axis in (source, target):
        known_axis(file, axis)
    if source == target:
        raise AxisError(f"axis {source} cannot be copied to itself")
    if not are_alike(file, source, target):
        raise AxisError(
            f"axis {source} is {axis_kind(file, source)} and axis {target} is {axis_kind(file, target)}: "
            "only axes of the same type can be copied"
        )
    return [change for a, v in copied_values(file, source, target).items() if (change := file.set(a, v))]


def copied_values(file: ParameterFile, source: str, target: str) -> dict[Address, Value | None]:
    """Return what an axis has after it was copied from another: values and bits,
    without name and what it is fitted by.
    """
    own, wanted = _own(file), dict[Address, Value | None]()
    for parameter_id, instance in axis_addresses(file, target):
        if parameter_id not in own:
            wanted[parameter_id, instance] = file.get((parameter_id, source + instance[len(target) :]))
    for parameter_id, bits in words_of_axes(file.schema).items():
        value = file.get((parameter_id, ""))
        if parameter_id in own or value is None or source not in bits or target not in bits:
            continue
        word = int(float(value.value))
        is_set = bool(word >> bits[source] & 1)
        wanted[parameter_id, ""] = Value(word | 1 << bits[target] if is_set else word & ~(1 << bits[target]))
    return wanted


def _own(file: ParameterFile) -> set[str]:
    """Return the parameters that say what an axis is called and whether it is there: they are never
    copied.
    """
    profile, declared = file.schema.family.axes, file.schema.family.declared_axes
    if profile:
        return {profile.name, *filter(None, (profile.fitted_by,))}
    if declared is None:
        return set()
    fields = {field.param for field in (declared.name, declared.group) if field}
    return fields | set(declared.flags)


# -- swap and move


def swap_axes(file: ParameterFile, first: str, second: str) -> list[Change]:
    """Let two axes change places with all their values, also name, type and what fits them.

    In a family whose axes have fixed names their values change places. What names an axis by its number
    follows. Raises AxisError.
    """
    for axis in (first, second):
        known_axis(file, axis)
    if first == second:
        raise AxisError(f"axis {first} cannot be swapped with itself")
    if not _own(file) and not are_alike(file, first, second):
        raise AxisError(
            f"axis {first} is {axis_kind(file, first)} and axis {second} is {axis_kind(file, second)}: "
            "only axes that move alike can be swapped"
        )
    with file.step() as changes:
        moved(file, {first: second, second: first})
    return changes


def moved(file: ParameterFile, order: Mapping[str, str]) -> None:
    """Move axes, each to the place of another (``order``: from -> to), with all their values,
    bits and references.
    """
    wanted: dict[Address, Value | None] = {}
    # All is read before anything is set: axes may change places in a circle.
    notes, left = dict(file.header.value_notes), file.header.value_notes
    for source, target in order.items():
        for parameter_id, instance in axis_addresses(file, source):
            place = parameter_id, target + instance[len(source) :]
            wanted[place] = file.get((parameter_id, instance))
            notes.pop(written(place), None)
            if note := left.get(written((parameter_id, instance))):
                notes[written(place)] = note
    for parameter_id, bits in words_of_axes(file.schema).items():
        if value := file.get((parameter_id, "")):
            wanted[parameter_id, ""] = Value(_with_bits_moved(int(float(value.value)), bits, order))
    for address, key in _references(file, wanted, order):
        wanted[address] = Value(key)
    for address, found in wanted.items():
        file.set(address, found)
    file.header.value_notes = notes


def _with_bits_moved(word: int, bits: Mapping[str, int], order: Mapping[str, str]) -> int:
    """Return a word with the bit of each axis at that of the axis whose place it takes."""
    after = word
    for source, target in order.items():
        if source in bits and target in bits:
            after = after & ~(1 << bits[target]) | (word >> bits[source] & 1) << bits[target]
    return after


def _references(
    file: ParameterFile, wanted: Mapping[Address, Value | None], order: Mapping[str, str]
) -> list[tuple[Address, str]]:
    """Return the choices that name an axis which moves, with the choice that names it afterwards."""
    references = []
    for parameter_id, keys in _choices_of_axes(file.schema).items():
        axes = {key: axis for axis, key in keys.items()}
        for instance in file.machine_schema.instances(file.schema.parameters[parameter_id]):
            address = (parameter_id, instance)
            value = wanted.get(address, file.get(address))
            axis = axes.get(str(value.value)) if value else None
            if axis is not None and axis in order and order[axis] in keys:
                references.append((address, keys[order[axis]]))
    return references


@lru_cache(maxsize=16)
def _choices_of_axes(schema: Schema) -> dict[str, dict[str, str]]:
    """Return the parameters whose choices are axes by number (``Axis 3``): axis -> key."""
    info = schema.family.scopes.get("axis")
    names = {info.label.format(i=a, j=""): a for a in info.instances if not a.isalpha()} if info else {}

    def of(parameter: Parameter) -> dict[str, str]:
        return {names[c.label]: c.key for c in parameter.choices or () if c.label in names}

    return {p.id: keys for p in schema.parameters.values() if (keys := of(p))}


# -- compare


def compare_axes(file: ParameterFile, first: str, second: str) -> list[AxisDifference]:
    """Return where two axes differ, in the manual's order; what names and fits them is left out.
    Raises AxisError.
    """
    for axis in (first, second):
        known_axis(file, axis)
    own = _own(file)
    found = [
        AxisDifference((p, i), other)
        for p, i in axis_addresses(file, first)
        if p not in own
        and not same_value(file.get((p, i)), file.get(other := (p, second + i[len(first) :])))
        and _exists(file, (p, i), other)
    ]
    found += (d for d in _different_bits(file, first, second) if d.first[0] not in own)
    places = file.machine_schema.places
    return sorted(found, key=lambda d: places[d.first])


def _different_bits(file: ParameterFile, first: str, second: str) -> Iterator[AxisDifference]:
    """Yield the words with a bit for each axis in which those of two axes differ."""
    for parameter_id, bits in words_of_axes(file.schema).items():
        address = (parameter_id, "")
        value = file.get(address)
        if value is None or not {first, second} <= bits.keys():
            continue
        word = int(float(value.value))
        if (word >> bits[first] ^ word >> bits[second]) & 1:
            yield AxisDifference(address, address, (bits[first], bits[second]))


def _exists(file: ParameterFile, *addresses: Address) -> bool:
    return any(file.evaluation.state(a).state != "hidden" for a in addresses)
