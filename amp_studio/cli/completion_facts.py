"""What completion offers out of the schema and the file that the line names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from amp_studio.files import ParameterFile, axis_letter, fitted_axes, new_file, open_file
from amp_studio.guide import steps_of
from amp_studio.schema import Parameter, family_ids, label_of
from amp_studio.validate import calculators


def facts(kind: str, named: str, current: str) -> Iterable[str]:
    """Return what may come in a place for the family or the file ``named``; nothing where it cannot be opened."""
    try:
        file = new_file(named) if named in family_ids() else open_file(Path(named)).file
    except (ValueError, OSError):
        return ()
    schema = file.schema
    if kind == "group":
        return [group.name for group in schema.groups]
    if kind == "table":
        return schema.tables
    if kind == "formula":
        return calculators(schema.family.family)
    if kind == "machine":
        return [machine.key for machine in schema.family.machines]
    if kind in ("step", "at", "done", "not_done", "keep_defaults"):
        return [step.id for step in steps_of(schema)]
    if kind == "rule":
        return [rule.id for rule in schema.rules]
    if kind == "axis":
        return _axes(file)
    if kind == "assignments":
        return _assignments(file, current)
    return _parameters(file, current)


def _axes(file: ParameterFile) -> Iterator[str]:
    return (axis_letter(file, axis) or axis for axis in fitted_axes(file))


def _parameters(file: ParameterFile, current: str) -> Iterator[str]:
    """Yield numbers and ids, those of active parameters; an instance only once its ``@`` is typed."""
    for address in file.addresses():
        if file.evaluation.state(address).state == "hidden":
            continue
        number = file.machine_schema.number(address)
        if number and number.casefold().startswith(current.casefold()):
            yield number
        if "@" in current or not address[1]:
            yield "@".join(filter(None, address))
        else:
            yield address[0]


def _assignments(file: ParameterFile, current: str) -> Iterator[str]:
    name, sign, _ = current.partition("=")
    if not sign:
        yield from (f"{param}=" for param in _parameters(file, current))
        return
    address, bit = file.evaluation.find_bit(name)
    if bit is None:
        yield from (f"{name}={word}" for word in _words(file.schema.parameters[address[0]]))


def _words(parameter: Parameter) -> Iterator[str]:
    """Yield the values of a choice that can be typed without quotes."""
    for choice in parameter.choices or ():
        label = label_of(parameter, choice.key)
        yield label if " " not in label else choice.code or choice.key
