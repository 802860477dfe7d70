"""What has to be checked for a machine type, worked out once for every file of a family.

A plan resolves each rule's names to addresses and turns them round: from an
address to the checks that read it, so that an edit runs only those again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from amp_studio.schema import Address, Reading, Rule, Schema, Situation, UnknownParameter, program

CheckKey = tuple[str, str]
"""Rule id and instance; a range check is ``("", id@instance)``."""


@dataclass(frozen=True, slots=True)
class RuleCheck:
    """One rule for one instance, its names resolved."""

    rule: Rule
    instance: str
    readings: Mapping[str, Reading]
    when: Any
    check: Any
    values: tuple[tuple[str, Any], ...]

    @property
    def key(self) -> CheckKey:
        """What the findings of this check are filed under."""
        return self.rule.id, self.instance


@dataclass(frozen=True)
class Plan:
    """All checks for one schema, machine type and set of rules."""

    addresses: tuple[Address, ...]
    checks: tuple[RuleCheck, ...]
    range_readers: Mapping[Address, frozenset[Address]] = field(repr=False)
    """Address -> addresses whose range check must run again when it changes."""
    rule_readers: Mapping[Address, tuple[RuleCheck, ...]] = field(repr=False)


class RuleFault(ValueError):
    """A rule that cannot be used: its id and what is wrong with it."""

    def __init__(self, rule: str, what: str) -> None:
        self.rule = rule
        super().__init__(f"rule {rule}: {what}")


def make_plan(schema: Schema, machine: str, extra: tuple[Rule, ...] = ()) -> Plan:
    """Return the plan for a machine type with the family's rules and further ones; raises RuleFault."""
    return _make(schema, machine, extra) if extra else _family_plan(schema, machine)


@lru_cache(maxsize=32)
def _family_plan(schema: Schema, machine: str) -> Plan:
    return _make(schema, machine, ())


def _make(schema: Schema, machine: str, extra: tuple[Rule, ...]) -> Plan:
    situation = Situation(schema, lambda _: None, lambda: machine)
    addresses = schema.addresses(machine)
    states = {address: frozenset(situation.state_reads(address)) for address in addresses}
    range_readers: dict[Address, set[Address]] = {}
    for address in addresses:
        for read in {address, *states[address], *_bounds(situation, address)}:
            range_readers.setdefault(read, set()).add(address)
    checks = [check for rule in schema.rules + extra for check in _checks(situation, rule)]
    rule_readers: dict[Address, list[RuleCheck]] = {}
    for check in checks:
        read_by_check: set[Address] = set()
        for reading in check.readings.values():
            for address in reading.addresses:
                read_by_check |= {address} | states[address]
        for address in read_by_check:
            rule_readers.setdefault(address, []).append(check)
    return Plan(
        addresses,
        tuple(checks),
        {a: frozenset(r) for a, r in range_readers.items()},
        {a: tuple(c) for a, c in rule_readers.items()},
    )


def _bounds(situation: Situation, address: Address) -> set[Address]:
    parameter = situation.schema.parameters[address[0]]
    ranges = [*(parameter.ranges or {}).values()]
    for variant in parameter.range_variants:
        ranges += variant.ranges.values()
    found: set[Address] = set()
    for pair in ranges:
        for bound in pair:
            if bound is not None and not isinstance(bound, float):
                source = situation.reading(bound.param, address[1]).addresses[0]
                found |= {source} | situation.state_reads(source)
    return found


def _checks(situation: Situation, rule: Rule) -> list[RuleCheck]:
    try:
        when, check = program(rule.when), program(rule.check)
        values = tuple((name, program(text)) for name, text in rule.values.items())
        for fix in rule.fix:
            program(fix.value)
    except ValueError as error:
        raise RuleFault(rule.id, str(error).splitlines()[0]) from None
    checks = []
    for instance in _instances(situation, rule):
        try:
            readings = {name: situation.reading(text, instance) for name, text in rule.reads.items()}
        except UnknownParameter:
            continue
        checks.append(RuleCheck(rule, instance, readings, when, check, values))
    return checks


def _instances(situation: Situation, rule: Rule) -> tuple[str, ...]:
    """Return the instances a rule runs for: those of the scoped parameters it reads by themselves."""
    found: list[str] = []
    for text in rule.reads.values():
        parameter_id, _, which = text.partition("@")
        parameter = situation.schema.parameters.get(parameter_id)
        if parameter is None:
            raise RuleFault(rule.id, f"reads '{parameter_id}', which the family does not have")
        own = situation.schema.instances(parameter, situation.machine)
        if which in ("", "<", ">"):
            found += [i for i in own if i and i not in found]
    return tuple(found) or ("",)
