"""What a shell offers in a place of the command line: names of the facts,
and of the file that the line names.

Each function takes the first word behind the verb and the word that is typed;
the rooms are loaded when one is called.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile


def families(named: str = "", current: str = "") -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the families, as ``family_ids`` of the schema does, without loading it."""
    import sys

    from amp_studio.family_places import installed_places

    package = Path(__file__).resolve().parent.parent
    folders = (package / "parameter_db", package.parent / "parameter_db")
    own = {p.parent.name for folder in folders for p in folder.glob("*/family.yaml")}
    registration = sys.modules.get("amp_studio.schema.registration")  # who registers a family has loaded it
    added = registration.added_facts() if registration else ()
    return sorted(own | set(installed_places()) | set(added))


def family_first(named: str, current: str) -> Sequence[str]:
    """Return the families where nothing is named yet."""
    return () if named else families(named, current)


def example_names(named: str = "", current: str = "") -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the folders of the example machines, without reading them."""
    package = Path(__file__).resolve().parent.parent
    folders = (package / "examples", package.parent / "examples")
    return sorted({p.parent.name for folder in folders for p in folder.glob("*/*.amp")})


def scenarios(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return what can be simulated."""
    from amp_studio.scenarios import IDENTIFY, scenario_names

    return (*scenario_names(), IDENTIFY)


def groups(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the groups of parameters."""
    return [group.name for file in _files(named) for group in file.schema.groups]


def tables(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the printed tables."""
    return [table for file in _files(named) for table in file.schema.tables]


def formulas(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the published formulas."""
    from amp_studio.validate import calculators

    return [name for file in _files(named) for name in calculators(file.schema.family.family)]


def machines(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the machine types."""
    return [machine.key for file in _files(named) for machine in file.schema.family.machines]


def steps(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the steps of commissioning."""
    from amp_studio.guide import steps_of

    return [step.id for file in _files(named) for step in steps_of(file.schema)]


def ways(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the printed ways of tuning and fitting."""
    return [way.id for file in _files(named) for way in file.schema.guides]


def rules(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the rules."""
    return [rule.id for file in _files(named) for rule in file.schema.rules]


def targets(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the families that a machine can be migrated to."""
    from amp_studio.meaning import targets as migrated

    return migrated()


def machine_tests(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the names of the tests at the machine."""
    from amp_studio.sim import SimulationError, machine_tests

    try:
        return [test.name for file in _files(named) for test in machine_tests(file)]
    except SimulationError:  # a file without axes, a family without a law
        return ()


def axes(named: str, current: str) -> Sequence[str]:  # noqa: ARG001  # every completion takes both
    """Return the axes, by letter where they have one."""
    from amp_studio.files import axis_letter, fitted_axes

    return [axis_letter(file, axis) or axis for file in _files(named) for axis in fitted_axes(file)]


def parameters(named: str, current: str) -> Iterator[str]:
    """Yield numbers and ids, of a family all, of a file those of parameters that its machine has; an instance
    only once its ``@`` is typed.
    """
    from amp_studio.schema import family_ids

    if named in family_ids():
        yield from _of_family(named, current)
        return
    for file in _files(named):
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


def _of_family(family: str, current: str) -> Iterator[str]:
    """Yield what a person may call a parameter of a family, on any machine type."""
    from amp_studio.schema import load_schema

    schema = load_schema(family)
    everywhere = [schema.on(machine) for machine in schema.machines]
    for parameter in schema.parameters.values():
        numbers = dict.fromkeys(n for here in everywhere for n in here.numbers(parameter).values())
        yield from (number for number in numbers if number.casefold().startswith(current.casefold()))
        instances = dict.fromkeys(i for here in everywhere for i in here.instances(parameter) if i)
        yield from (f"{parameter.id}@{i}" for i in instances if "@" in current)
        yield parameter.id


def assignments(named: str, current: str) -> Iterator[str]:
    """Yield parameters with ``=``, and behind it the values of a choice that can be typed without quotes."""
    from amp_studio.schema import label_of

    name, equals, _ = current.partition("=")
    if not equals:
        yield from (f"{param}=" for param in parameters(named, current))
        return
    for file in _files(named):
        address, bit = file.evaluation.find_bit(name)
        parameter = file.schema.parameters[address[0]]
        for choice in (parameter.choices or ()) if bit is None else ():
            label = label_of(parameter, choice.key)
            # A label with blanks would have to be quoted, which shells do in different ways.
            yield f"{name}={label if ' ' not in label else choice.code or choice.key}"


def _files(named: str) -> list[ParameterFile]:
    """Return the file that is named, or a new one of the family; none where it cannot be opened."""
    from amp_studio.files import new_file, open_file
    from amp_studio.schema import family_ids

    try:
        return [new_file(named) if named in family_ids() else open_file(Path(named)).file] if named else []
    except (ValueError, OSError):
        return []
