"""A message of the control in the light of a file: its parameters with their values,
and which of its rules are broken.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, ControlMessage, MachineSchema, Parameter, Rule, Schema, show_value
from amp_studio.validate import Finding

from .places import place_of


class LinkedValue(NamedTuple):
    """A value of such a parameter: where, and as a person reads it."""

    address: Address
    place: str
    """The letter of its axis, or what else the instance is called; empty for the only one."""
    text: str


@dataclass(frozen=True, slots=True)
class LinkedParameter:
    """A parameter that a message points to."""

    id: str
    name: str
    number: str
    """Of its first instance; empty where it has none."""
    values: tuple[LinkedValue, ...]
    """Active values of the file; empty without a file."""


@dataclass(frozen=True, slots=True)
class LinkedRule:
    """A rule that finds what brings a message about."""

    rule: Rule
    findings: tuple[Finding, ...]
    """Its findings in the file now."""


@dataclass(frozen=True, slots=True)
class MessagePage:
    """What there is to know about a message."""

    message: ControlMessage
    parameters: tuple[LinkedParameter, ...]
    rules: tuple[LinkedRule, ...]

    @property
    def broken(self) -> tuple[LinkedRule, ...]:
        """The rules that are broken in the file now."""
        return tuple(linked for linked in self.rules if linked.findings)


def _values(file: ParameterFile, parameter: Parameter, instances: Iterable[str]) -> Iterator[LinkedValue]:
    """Yield the active values of a parameter."""
    for instance in instances:
        address = (parameter.id, instance)
        if file.evaluation.state(address).state == "in-force":
            yield LinkedValue(address, place_of(file, address), show_value(parameter, file.get(address)))


def message_page(
    schema: Schema,
    machine: str,
    message: ControlMessage,
    file: ParameterFile | None = None,
    findings: Iterable[Finding] = (),
) -> MessagePage:
    """Return the page of a message; what a described control
    or another machine type does not have is left out.
    """
    here = schema.on(machine)
    present = [schema.parameters[name] for name in message.params if name in schema.parameters]
    linked = (_linked(here, parameter, file) for parameter in present if here.instances(parameter))
    by_rule: dict[str, list[Finding]] = {}
    for finding in findings:
        by_rule.setdefault(finding.rule, []).append(finding)
    rules = {rule.id: rule for rule in schema.rules}
    found = (LinkedRule(rules[name], tuple(by_rule.get(name, ()))) for name in message.rules if name in rules)
    return MessagePage(message, tuple(linked), tuple(found))


def _linked(here: MachineSchema, parameter: Parameter, file: ParameterFile | None) -> LinkedParameter:
    """Return a parameter of a message with its number and, for one that can be set, its values in a file."""
    instances = here.instances(parameter)
    values = () if file is None or parameter.access == "read" else _values(file, parameter, instances)
    number = here.number((parameter.id, instances[0])) or ""
    return LinkedParameter(parameter.id, parameter.name, number, tuple(values))
