"""A family's parameters, ready to be asked: instances, numbers, groups, signature."""

from __future__ import annotations

import hashlib
import json
import re
import string
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

from .load import Compiled, load_compiled
from .model import (
    Choice,
    Erratum,
    Family,
    Group,
    Guide,
    Layout,
    Numbers,
    Parameter,
    Rule,
    Scope,
    Table,
)
from .units import angular

Address = tuple[str, str]
"""Parameter id and instance; the instance of a global parameter is ``""``."""


class UnknownParameterError(KeyError):
    """A number or an id that the family does not have; the text is one clear sentence.

    ``nearest`` is asked for the names that come near only when the text is read: many are met and never told.
    """

    def __init__(self, said: str, nearest: Callable[[], Sequence[str]] = tuple) -> None:
        super().__init__(said)
        self._nearest = nearest

    def __str__(self) -> str:
        near = ", ".join(self._nearest())
        return f"{self.args[0]}. Did you mean: {near}" if near else str(self.args[0])


@dataclass(frozen=True, eq=False, repr=False)
class Schema:
    """One family. Built by ``load_schema``, once; never changed."""

    family: Family
    groups: tuple[Group, ...]
    rules: tuple[Rule, ...]
    errata: dict[str, Erratum]
    tables: dict[str, Table]
    guides: tuple[Guide, ...]
    parameters: dict[str, Parameter]
    group_of: dict[str, Group]

    def __repr__(self) -> str:
        return f"Schema({self.family.family!r})"

    # -- instances and numbers -------------------------------------------------

    def layout(self, parameter: Parameter, machine: str) -> Layout | None:
        """Return scope, instances and numbers on this machine type; None where it does not exist there."""
        key = (parameter.id, machine)
        if key not in self._layouts:
            self._layouts[key] = self._layout(parameter, machine)
        return self._layouts[key]

    @staticmethod
    def _layout(parameter: Parameter, machine: str) -> Layout | None:
        if parameter.layouts is None:
            return Layout(scope=parameter.scope, numbers=parameter.numbers, instances=parameter.instances)
        for layout in parameter.layouts:
            if layout.machines is None or machine in layout.machines:
                return layout
        return None

    def scopes(self, machine: str) -> dict[str, Scope | None]:
        """Return parameter id -> what its instances are on this machine type; None where it does not exist there."""
        if machine not in self._scopes:
            layouts = ((p.id, self.layout(p, machine)) for p in self.parameters.values())
            self._scopes[machine] = {
                parameter_id: layout.scope if layout else None for parameter_id, layout in layouts
            }
        return self._scopes[machine]

    def instances(self, parameter: Parameter, machine: str) -> tuple[str, ...]:
        """Return the instances a parameter has on this machine type."""
        layout = self.layout(parameter, machine)
        if layout is None:
            return ()
        return layout.instances or self.family.scopes[layout.scope].instances

    def addresses(self, machine: str) -> tuple[Address, ...]:
        """Return every addressable value, in the manual's order."""
        if machine not in self._addresses:
            self._addresses[machine] = tuple(
                (p.id, i) for p in self.parameters.values() for i in self.instances(p, machine)
            )
        return self._addresses[machine]

    def number(self, address: Address, machine: str) -> str | None:
        """Return the number the manual gives an instance; None for a field that has none."""
        return self._numbers(machine).get(address)

    def numbers(self, parameter: Parameter, machine: str) -> dict[str, str]:
        """Return instance -> number, empty where there are no numbers."""
        layout = self.layout(parameter, machine)
        if layout is None or layout.numbers is None:
            return {}
        return {
            i: number_of(layout.numbers, k, i)
            for k, i in enumerate(self.instances(parameter, machine))
            if layout.numbers.listed is None or i in layout.numbers.listed
        }

    def addressed_by(self, number: str, machine: str) -> list[Address]:
        """Return every instance that claims a number: the undisputed claims where there are any."""
        claims = self.claims(number, machine)
        clear = [a for a in claims if not self.is_disputed(a[0], machine)]
        return clear or claims

    def claims(self, number: str, machine: str) -> list[Address]:
        """Return every instance that the manual prints a number for, with or without the letters before it."""
        text, table = number.strip().casefold(), self._claims(machine)
        return table.get(text) or table.get(self._bare_numbers(machine).get(text, ""), [])

    def words(self, number: str, machine: str) -> list[Address]:
        """Return the words of a number of which each has one of its own: those of ``P21`` are ``P21N0``, ``P21N1``, …."""
        return self._word_table(machine).get(number.strip().casefold(), [])

    def every_number(self, machine: str) -> Iterable[str]:
        """Return every number, as the manual writes it."""
        return self._numbers(machine).values()

    def is_disputed(self, parameter_id: str, machine: str) -> bool:
        """Tell whether the manual's number of a parameter really belongs to another one."""
        layout = self.layout(self.parameters[parameter_id], machine)
        return bool(layout and layout.numbers and layout.numbers.disputed)

    def _claims(self, machine: str) -> dict[str, list[Address]]:
        if machine not in self._claim_tables:
            table: dict[str, list[Address]] = {}
            for address, number in self._numbers(machine).items():
                table.setdefault(number.casefold(), []).append(address)
            self._claim_tables[machine] = table
        return self._claim_tables[machine]

    def _bare_numbers(self, machine: str) -> dict[str, str]:
        """Return a number without the letters before it -> the number: ``61`` -> ``pr61``."""
        if machine not in self._bare_tables:
            split = ((number.lstrip(_LETTERS), number) for number in self._claims(machine))
            self._bare_tables[machine] = {bare: number for bare, number in split if bare not in ("", number)}
        return self._bare_tables[machine]

    def _word_table(self, machine: str) -> dict[str, list[Address]]:
        if machine not in self._word_tables:
            table: dict[str, list[Address]] = {}
            for address, number in self._numbers(machine).items():
                if found := re.fullmatch(r"([a-z]*)([0-9]+)[a-z]+[0-9]+", number.casefold()):
                    for head in {found[1] + found[2], found[2]}:
                        table.setdefault(head, []).append(address)
            self._word_tables[machine] = table
        return self._word_tables[machine]

    def _numbers(self, machine: str) -> dict[Address, str]:
        if machine not in self._number_tables:
            self._number_tables[machine] = {
                (p.id, i): n for p in self.parameters.values() for i, n in self.numbers(p, machine).items()
            }
        return self._number_tables[machine]

    def kin(self, scope: str | None, other: str | None) -> bool:
        """Tell whether instances of two scopes belong together: the same scope, or one has the parts of the other."""
        return scope == other or bool(
            scope and other and (self._wholes.get(scope) == other or self._wholes.get(other) == scope)
        )

    @cached_property
    def _wholes(self) -> dict[str, str | None]:
        return {scope: info.of for scope, info in self.family.scopes.items()}

    @cached_property
    def machines(self) -> frozenset[str]:
        """The keys of the machine types."""
        return frozenset(m.key for m in self.family.machines)

    @cached_property
    def _scopes(self) -> dict[str, dict[str, Scope | None]]:
        return {}

    @cached_property
    def _layouts(self) -> dict[tuple[str, str], Layout | None]:
        return {}

    @cached_property
    def _addresses(self) -> dict[str, tuple[Address, ...]]:
        return {}

    @cached_property
    def _number_tables(self) -> dict[str, dict[Address, str]]:
        return {}

    @cached_property
    def _claim_tables(self) -> dict[str, dict[str, list[Address]]]:
        return {}

    @cached_property
    def _bare_tables(self) -> dict[str, dict[str, str]]:
        return {}

    @cached_property
    def _word_tables(self) -> dict[str, dict[str, list[Address]]]:
        return {}

    # -- words -----------------------------------------------------------------

    def parameter(self, parameter_id: str) -> Parameter:
        """Return a parameter by id; raises UnknownParameterError."""
        try:
            return self.parameters[parameter_id]
        except KeyError:
            raise UnknownParameterError(f"Unknown parameter '{parameter_id}' of {self.family.name}") from None

    def label(self, address: Address, machine: str) -> str:
        """Return ``1300 Home Calibration`` or, without a number, the name and the instance."""
        parameter = self.parameters[address[0]]
        number = self.number(address, machine)
        if number and not self.is_disputed(address[0], machine):
            return f"{number} {parameter.name}"
        return f"{parameter.name} {self.instance_label(address, machine)}".rstrip()

    def short(self, address: Address, machine: str) -> str:
        """Return what addresses an instance: its own number, else ``id@instance``."""
        claims = self.addressed_by(self.number(address, machine) or "", machine)
        return str(self.number(address, machine)) if claims == [address] else written(address)

    def named(self, address: Address, machine: str) -> str:
        """Return the label and, where that has no number by which the instance is addressed, its address too."""
        label, short = self.label(address, machine), self.short(address, machine)
        return label if label.startswith(f"{short} ") else f"{label} ({short})"

    def instance_label(self, address: Address, machine: str) -> str:
        """Return ``Axis 3``, ``Spindle 1, Gear 3``; empty for the only instance of a global parameter."""
        parameter = self.parameters[address[0]]
        layout = self.layout(parameter, machine)
        if layout is None or address[1] == "":
            return ""
        return labelled(parameter.each or self.family.scopes[layout.scope].label, address[1])

    def page(self, address: Address) -> str:
        """Return the page on which the manual describes an instance."""
        parameter = self.parameters[address[0]]
        return parameter.pages.get(address[1]) or parameter.pages.get(whole_of(address[1])) or parameter.page

    def unit(self, parameter: Parameter, system: str, turns: bool) -> str:
        """Return the unit of entry in a unit system (``metric``, ``inch``); degrees where the axis turns."""
        if parameter.unit is not None:
            return parameter.unit
        unit = self.family.units.get(system, {}).get(parameter.quantity) or _PLAIN_UNITS.get(
            parameter.quantity, ""
        )
        return angular(unit) if turns else unit

    def units_of(self, parameter: Parameter) -> tuple[str, ...]:
        """Return every unit a parameter can be entered in, in any unit system, straight or turning."""
        if parameter.id not in self._unit_table:
            systems = tuple(self.family.units) or ("",)
            units = [self.unit(parameter, system, turns) for turns in (False, True) for system in systems]
            self._unit_table[parameter.id] = tuple(dict.fromkeys(units))
        return self._unit_table[parameter.id]

    @cached_property
    def _unit_table(self) -> dict[str, tuple[str, ...]]:
        return {}

    @cached_property
    def signature(self) -> str:
        """Checksum over instances, numbers, names, types, units, storage, choices and bits; travels with every file."""
        lines = []
        for parameter in self.parameters.values():
            instances = {m.key: self.instances(parameter, m.key) for m in self.family.machines}
            numbers = {m.key: self.numbers(parameter, m.key) for m in self.family.machines}
            choices = _codes(parameter.choices)
            bits = [(b.bit, b.width, b.label, _codes(b.choices)) for b in parameter.bits or ()]
            storage = parameter.storage.model_dump() if parameter.storage else None
            for word in ("code", "command"):
                if storage and storage[word] is None:
                    del storage[word]  # files of a family without codes or commands keep their checksum
            lines.append([parameter.id, parameter.name, parameter.type, parameter.quantity, parameter.unit,
                          instances, numbers, choices, bits, storage])  # fmt: skip
        text = json.dumps([self.family.family, lines], sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()


_LETTERS = string.ascii_lowercase + "$"
"""What may stand before a number: Pr61, R3, $130."""


def _codes(choices: tuple[Choice, ...] | None) -> list[tuple[str, str, int | None]]:
    return [(c.key, c.label, c.raw) for c in choices or ()]


_PLAIN_UNITS = {
    "angle": "deg", "time": "ms", "percent": "%", "voltage": "V", "current": "A", "frequency": "Hz",
    "rotation": "rpm", "counts": "counts", "power": "W",
}  # fmt: skip


def number_of(numbers: Numbers, index: int, instance: str) -> str:
    """Return the number of the instance at ``index``."""
    if numbers.listed is not None:
        return numbers.listed[instance]
    if numbers.starts is not None:
        whole, _, part = instance.partition(".")
        return numbers.format.format(n=numbers.starts[whole] + int(part) * numbers.step, i=instance)
    plain = "" if numbers.start is None else numbers.start + index * numbers.step
    return numbers.format.format(n=plain, i=instance)


def labelled(label: str, instance: str) -> str:
    """Return what an instance is called: ``Spindle {i}, Gear {j}`` and ``1.3`` give ``Spindle 1, Gear 3``."""
    whole, _, part = instance.partition(".")
    return label.format(i=whole, j=part)


@cache
def whole_of(instance: str) -> str:
    """Return the instance that another one is a part of: ``1`` for ``1.3``, itself for a whole one."""
    return instance.partition(".")[0]


def part_of(instance: str) -> float | None:
    """Return which part of its whole an instance is: 3.0 for ``1.3``; None for a whole one."""
    part = instance.partition(".")[2]
    return float(part) if part.isdecimal() else None


def written(address: Address) -> str:
    """Write an address the way files do: ``home.calibration@1``, a global one without the ``@``."""
    return f"{address[0]}@{address[1]}" if address[1] else address[0]


def read_address(text: str) -> Address:
    """Read ``id@instance``."""
    parameter_id, _, instance = text.partition("@")
    return parameter_id, instance


@cache
def load_schema(family_id: str) -> Schema:
    """Return a family's schema; raises KeyError for an unknown family, DatabaseError for a bad fact."""
    return schema_of(load_compiled(family_id))


def schema_of(compiled: Compiled) -> Schema:
    """Return the schema of compiled facts."""
    return Schema(
        family=compiled.family,
        groups=compiled.groups,
        rules=compiled.rules,
        errata={e.id: e for e in compiled.errata},
        tables={t.id: t for t in compiled.tables},
        guides=compiled.guides,
        parameters={p.id: p for group in compiled.groups for p in group.parameters},
        group_of={p.id: group for group in compiled.groups for p in group.parameters},
    )
