"""A new file: the family's printed defaults, on the axes that the machine has."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass

from amp_studio.schema import Parameter, Schema, Value, load_schema, unknown_name, whole_of

from .axis_fitting import name_axes
from .axis_match import axis_letters, matched_by_letter
from .parameter_file import Header, ParameterFile, fill_defaults


def new_file(
    family: str, machine: str | None = None, axes: Iterable[str] = (), name: str = ""
) -> ParameterFile:
    """Return a new file with the family's printed defaults.

    ``axes`` names the axes in order; the rest is unfitted. Without it the
    family's own default axes stay. Raises KeyError for an unknown family,
    ValueError for a machine type or an axis name the family does not have.
    """
    schema = load_schema(family)
    file = _empty_file(schema, machine, name)
    if profile := schema.family.axes:
        # Types of axes first: on them depends which other parameters exist, and their units.
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


def _empty_file(schema: Schema, machine: str | None, name: str) -> ParameterFile:
    """Return a file with a header alone, and the machine type where a parameter has it; raises ValueError
    for a machine type that the family does not have.
    """
    family = schema.family
    known = [m.key for m in family.machines]
    if machine is not None and machine not in known:
        raise ValueError(unknown_name("machine type", machine, known))
    machine = machine or family.default_machine
    application = family.applications[0] if family.applications else ""
    header = Header(name=name, application=application, machine=machine, signature=schema.signature)
    file = ParameterFile(schema, header)
    if family.machine_parameter:
        # A parameter has it: two places could contradict each other.
        header.machine = ""
        file.set((family.machine_parameter, ""), Value(machine))
    return file


@dataclass(frozen=True)
class MadeLike:
    """A new file that was made like another one, and what was not taken over."""

    file: ParameterFile
    left: tuple[Parameter, ...]
    """Parameters of which the other file has values that are true of its machine alone, and passwords."""
    new_axes: tuple[str, ...] = ()
    """Letters of axes that the other file does not have: they are at the printed defaults."""
    missing_axes: tuple[str, ...] = ()
    """Letters of axes of the other file that the new one does not have."""


def of_one_machine(schema: Schema) -> tuple[Parameter, ...]:
    """Return the parameters whose values a new file never takes over from another: calibrations,
    lost motion, passwords.
    """
    named = schema.commissioning.of_one_machine if schema.commissioning else ()
    secret = (p.id for p in schema.parameters.values() if p.secret)
    return tuple(schema.parameters[name] for name in (*named, *secret) if name in schema.parameters)


def new_like(source: ParameterFile, name: str) -> ParameterFile:
    """Return a new file with the values of another one, except what is true of that machine alone."""
    return made_like(source, name).file


def made_like(source: ParameterFile, name: str, axes: Iterable[str] = ()) -> MadeLike:
    """Return a new file with the values of another one, and what was not taken over.

    What was measured on the other machine, passwords, notes, software revision, ticks and marks of values out
    of range stay with it; such a parameter has its printed default, or is not set; a password is not set.
    With ``axes`` the new file has these: one whose letter the other file has gets its values, the rest their
    defaults. Raises ValueError where a family cannot be made with other axes.
    """
    file, axes = source.copy(), list(axes)
    file.header.notes = file.header.revision = ""
    # One empty mapping for all: these are replaced and never changed in place (``Header``).
    file.header.done = file.header.value_notes = file.header.group_notes = {}
    file.header.name = name
    file.forced.clear()
    own = {p.id for p in of_one_machine(file.schema)}
    of_it = [address for address in source.values if address[0] in own]
    left = {address[0] for address in of_it if not source.is_default(address)}
    for address in of_it:
        file.set(address, None if file.schema.parameters[address[0]].secret else file.default(address))
    parameters = tuple(map(file.schema.parameters.__getitem__, sorted(left, key=_place_in(file))))
    letters = list(axis_letters(file).values())
    if not axes or axes == letters:
        return MadeLike(file, parameters)
    return _with_axes(file, axes, letters, parameters)


def _place_in(file: ParameterFile) -> Callable[[str], int]:
    places = {name: n for n, name in enumerate(file.schema.parameters)}
    return places.__getitem__


def _with_axes(
    source: ParameterFile, axes: list[str], letters: list[str], left: tuple[Parameter, ...]
) -> MadeLike:
    """Return a file with other axes, each of the other file's with its values."""
    schema = source.schema
    if schema.family.axes is None:
        raise ValueError(
            f"a file of {schema.family.name} is made like another one with the same axes"
            f" ({', '.join(letters)}): leave the axes out, and add or remove axes in the new file"
        )
    made = new_file(schema.family.family, source.machine, axes, source.header.name)
    made.header.units, made.header.application = source.header.units, source.header.application
    matched = matched_by_letter(source, made).file
    new = axis_letters(made)
    taken = {axis for axis, letter in new.items() if letter in letters}
    here = made.machine_schema
    for address in here.places:
        if not here.kin(here.scopes[address[0]], "axis") or whole_of(address[1]) in taken:
            made.set(address, matched.get(address))
    made.unknown.update(source.unknown)
    return MadeLike(made, left, _without(new.values(), letters), _without(letters, list(new.values())))


def _without(letters: Iterable[str], others: Collection[str]) -> tuple[str, ...]:
    """Return the letters that are not among the others."""
    return tuple(letter for letter in letters if letter not in others)
