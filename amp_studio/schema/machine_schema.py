"""A schema on one machine type: which instances its parameters have there,
and by which numbers they are addressed.
"""

from __future__ import annotations

import re
import string
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from .address import Address, written
from .model import Family, Layout, Numbers, Parameter, Scope

_LETTERS = string.ascii_lowercase + "$"
"""What may come before a number: Pr61, R3, $130."""


@dataclass(frozen=True, eq=False, repr=False)
class MachineSchema:
    """The parameters of a family on one machine type. Built by ``Schema.on``, once each; never changed."""

    family: Family
    parameters: Mapping[str, Parameter]
    machine: str

    def __repr__(self) -> str:
        return f"MachineSchema({self.family.family!r}, {self.machine!r})"

    # -- instances -------------------------------------------------------------

    def layout(self, parameter: Parameter) -> Layout | None:
        """Return scope, instances and numbers of a parameter; None where it does not exist here."""
        return self._layouts[parameter.id]

    @cached_property
    def _layouts(self) -> dict[str, Layout | None]:
        return {p.id: _layout(p, self.machine) for p in self.parameters.values()}

    @cached_property
    def scopes(self) -> dict[str, Scope | None]:
        """Parameter id -> what its instances are; None where it does not exist here."""
        return {name: layout.scope if layout else None for name, layout in self._layouts.items()}

    def instances(self, parameter: Parameter) -> tuple[str, ...]:
        """Return the instances of a parameter; none where it does not exist here."""
        layout = self.layout(parameter)
        if layout is None:
            return ()
        return layout.instances or self.family.scopes[layout.scope].instances

    @cached_property
    def addresses(self) -> tuple[Address, ...]:
        """Every addressable value, in the manual's order."""
        return tuple((p.id, i) for p in self.parameters.values() for i in self.instances(p))

    @cached_property
    def places(self) -> Mapping[Address, int]:
        """Address -> its place in the manual's order."""
        return {address: n for n, address in enumerate(self.addresses)}

    def kin(self, scope: str | None, other: str | None) -> bool:
        """Return whether instances of two scopes belong together: the same scope,
        or one has the parts of the other.
        """
        return scope == other or bool(
            scope and other and (self._wholes.get(scope) == other or self._wholes.get(other) == scope)
        )

    @cached_property
    def _wholes(self) -> dict[str, str | None]:
        return {scope: info.of for scope, info in self.family.scopes.items()}

    # -- numbers ---------------------------------------------------------------

    def number(self, address: Address) -> str | None:
        """Return the number the manual gives an instance; None for a field that has none."""
        return self._numbers.get(address)

    def numbers(self, parameter: Parameter) -> dict[str, str]:
        """Return instance -> number, empty where there are no numbers."""
        layout = self.layout(parameter)
        if layout is None or layout.numbers is None:
            return {}
        return {
            i: number_of(layout.numbers, k, i)
            for k, i in enumerate(self.instances(parameter))
            if layout.numbers.listed is None or i in layout.numbers.listed
        }

    def plain_number(self, address: Address) -> str:
        """Return the number of an instance without what its format writes around it: ``110`` of ``$110``."""
        parameter, instance = self.parameters[address[0]], address[1]
        layout = self.layout(parameter)
        if layout is None or layout.numbers is None or self.number(address) is None:
            return ""
        return _plain_number(layout.numbers, self.instances(parameter).index(instance), instance)

    @cached_property
    def _numbers(self) -> dict[Address, str]:
        return {(p.id, i): n for p in self.parameters.values() for i, n in self.numbers(p).items()}

    @cached_property
    def every_number(self) -> tuple[str, ...]:
        """Every number, as the manual writes it."""
        return tuple(self._numbers.values())

    def addressed_by(self, number: str) -> list[Address]:
        """Return every instance that claims a number: the undisputed claims where there are any."""
        claims = self.claims(number)
        clear = [a for a in claims if not self.is_disputed(a[0])]
        return clear or claims

    def claims(self, number: str) -> list[Address]:
        """Return every instance that the manual prints a number for, with or without the letters before
        it.
        """
        text = number.strip().casefold()
        # The number as it is printed comes before one that was typed without its letters.
        return self._claims.get(text) or self._claims.get(self._bare_numbers.get(text, ""), [])

    def words(self, number: str) -> list[Address]:
        """Return the words of a number of which each has a separate one: those of ``P21`` are ``P21N0``,
        ``P21N1``, ….
        """
        return self._words.get(number.strip().casefold(), [])

    @cached_property
    def _claims(self) -> dict[str, list[Address]]:
        claims: dict[str, list[Address]] = {}
        for address, number in self._numbers.items():
            claims.setdefault(number.casefold(), []).append(address)
        return claims

    @cached_property
    def _bare_numbers(self) -> dict[str, str]:
        """A number without the letters before it -> the number: ``61`` -> ``pr61``."""
        split = ((number.lstrip(_LETTERS), number) for number in self._claims)
        return {bare: number for bare, number in split if bare not in ("", number)}

    @cached_property
    def _words(self) -> dict[str, list[Address]]:
        words: dict[str, list[Address]] = {}
        for address, number in self._numbers.items():
            if match := re.fullmatch(r"([a-z]*)([0-9]+)[a-z]+[0-9]+", number.casefold()):
                # With and without its letters: a set, as it may have none.
                for head in {match[1] + match[2], match[2]}:
                    words.setdefault(head, []).append(address)
        return words

    def is_disputed(self, parameter_id: str) -> bool:
        """Return whether the manual's number of a parameter really belongs to another one."""
        layout = self._layouts[parameter_id]
        return bool(layout and layout.numbers and layout.numbers.disputed)

    # -- words -----------------------------------------------------------------

    def label(self, address: Address) -> str:
        """Return ``1300 Home Calibration`` or, without a number, the name and the instance."""
        parameter, number = self.parameters[address[0]], self.number(address)
        if number and not self.is_disputed(address[0]):
            return f"{number} {parameter.name}"
        return f"{parameter.name} {self.instance_label(address)}".rstrip()

    def short(self, address: Address) -> str:
        """Return what addresses an instance: its own number, else ``id@instance``."""
        number = self.number(address)
        return number if number and self.addressed_by(number) == [address] else written(address)

    def named(self, address: Address) -> str:
        """Return the label and, where that has no number by which the instance is addressed, its address
        too.
        """
        label, short = self.label(address), self.short(address)
        return label if label.startswith(f"{short} ") else f"{label} ({short})"

    def instance_label(self, address: Address) -> str:
        """Return ``Axis 3``, ``Spindle 1, Gear 3``; empty for the only instance of a global parameter."""
        parameter = self.parameters[address[0]]
        layout = self.layout(parameter)
        if layout is None or address[1] == "":
            return ""
        return labelled(parameter.each or self.family.scopes[layout.scope].label, address[1])


def _layout(parameter: Parameter, machine: str) -> Layout | None:
    """Return the layout of a parameter on a machine type; None where it does not exist there."""
    if parameter.layouts is None:
        return Layout.model_construct(  # its parts have been checked
            scope=parameter.scope, numbers=parameter.numbers, instances=parameter.instances
        )
    for layout in parameter.layouts:
        if layout.machines is None or machine in layout.machines:
            return layout
    return None


def number_of(numbers: Numbers, index: int, instance: str) -> str:
    """Return the number of the instance at ``index``."""
    return numbers.format.format(n=_plain_number(numbers, index, instance), i=instance)


def _plain_number(numbers: Numbers, index: int, instance: str) -> str:
    """Return the value of ``{n}``: the number without what its format writes around it."""
    if numbers.listed is not None:
        return numbers.listed[instance]
    if numbers.starts is not None:
        whole, _, part = instance.partition(".")
        return str(numbers.starts[whole] + int(part) * numbers.step)
    return "" if numbers.start is None else str(numbers.start + index * numbers.step)


def labelled(label: str, instance: str) -> str:
    """Return what an instance is called: ``Spindle {i}, Gear {j}`` and ``1.3`` give ``Spindle 1, Gear 3``."""
    whole, _, part = instance.partition(".")
    return label.format(i=whole, j=part)
