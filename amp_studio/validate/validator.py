"""Findings of one file, kept up to date edit by edit."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Rule,
    UnitError,
    Value,
    canonical_unit,
    clip,
    convert,
    fault,
    show_value,
    shown,
    write_number,
)
from amp_studio.schema.cel_engine import Context
from amp_studio.schema.units import angular

from .finding import SEVERITIES, Finding, Repair
from .formulas import rule_functions
from .plan import Plan, RuleCheck, make_plan

EVALUATION_FAULTS = (TypeError, ValueError, RuntimeError, ArithmeticError, LookupError)
"""What CEL raises for a value of a kind that an expression does not speak of."""


class Validator:
    """Checks ranges, choices, states and rules of one file.

    ``run`` checks everything, ``update`` only what read the changed addresses;
    both leave the same findings. Any value whatever may stand in the file.
    """

    def __init__(self, file: ParameterFile, extra_rules: Iterable[Rule] = ()) -> None:
        self.file = file
        self.extra = tuple(extra_rules)
        self._context = Context()
        for name, function in rule_functions(file.schema.family.family).items():
            self._context.add_function(name, function)
        self._machine = ""
        self._ranges: dict[Address, Finding] = {}
        self._unset: set[Address] = set()
        self._rules: dict[tuple[str, str], Finding] = {}
        self._plan: Plan = make_plan(file.schema, file.machine, self.extra)

    def run(self) -> tuple[Finding, ...]:
        """Check everything; returns the findings, errors first, in the manual's order."""
        self._machine = self.file.machine
        self._plan = make_plan(self.file.schema, self._machine, self.extra)
        self._ranges.clear()
        self._unset.clear()
        self._rules.clear()
        for address in self._plan.addresses:
            self._check_address(address)
        for check in self._plan.checks:
            self._check_rule(check)
        return self.findings()

    def update(self, changed: Iterable[Address]) -> tuple[Finding, ...]:
        """Check again what reads the changed addresses; returns all findings."""
        if self.file.machine != self._machine:
            return self.run()
        addresses: set[Address] = set()
        checks: dict[tuple[str, str], RuleCheck] = {}
        for address in changed:
            addresses |= self._plan.range_readers.get(address, frozenset())
            for check in self._plan.rule_readers.get(address, ()):
                checks[check.key] = check
        for address in addresses:
            self._check_address(address)
        for check in checks.values():
            self._check_rule(check)
        return self.findings()

    def findings(self) -> tuple[Finding, ...]:
        """Return the present findings, errors first, in the manual's order."""
        found = [*self._ranges.values(), *self._rules.values(), *self._general()]
        order = {address: n for n, address in enumerate(self._plan.addresses)}
        last = len(order)
        found.sort(
            key=lambda f: (SEVERITIES.index(f.severity), min((order.get(a, last) for a in f.addresses), default=-1), f.rule)
        )
        return tuple(found)

    def rules_of(self, address: Address) -> tuple[Rule, ...]:
        """Return the rules that read an address itself."""
        readers = self._plan.rule_readers.get(address, ())
        direct = [c.rule for c in readers if any(address in r.addresses for r in c.readings.values())]
        return tuple({rule.id: rule for rule in direct}.values())

    # -- one address -----------------------------------------------------------

    def _check_address(self, address: Address) -> None:
        self._ranges.pop(address, None)
        self._unset.discard(address)
        state = self.file.situation.state(address).state
        value = self.file.values.get(address)
        if value is None:
            if state == "in-force":
                self._unset.add(address)
            return
        if state in ("hidden", "ignored") and address not in self.file.forced:
            return
        said = fault(self.file.situation, address, value)
        if said is None:
            said = self._wrong_unit(address, value)
        if said is not None:
            self._ranges[address] = self._range_finding(address, value, said)

    def _range_finding(self, address: Address, value: Value, said: str) -> Finding:
        parameter = self.file.schema.parameters[address[0]]
        mended = clip(self.file.situation, address, value)
        repairs = (Repair(address, mended),) if mended != value else ()
        if parameter.choices and (default := self.file.default(address)) is not None:
            repairs = (Repair(address, default),)
        forced = f" It was forced {self.file.forced[address]}." if address in self.file.forced else ""
        kind = "schema.choice" if parameter.choices else "schema.range"
        return Finding(kind, "error", (address,), said + "." + forced, repairs, parameter.page)

    def _wrong_unit(self, address: Address, value: Value) -> str | None:
        """Say so when a value is in degrees on an axis that moves straight, or the other way round."""
        if isinstance(value.value, (str, bool)) or not value.unit:
            return None
        unit = self.file.situation.unit(address, self.file.header.units)
        try:
            convert(1.0, value.unit, unit)
        except UnitError:
            name = self.file.schema.parameters[address[0]].name
            return f"{name} {show_value(self.file.schema.parameters[address[0]], value)} should be in {shown(unit)} here"
        return None

    def _general(self) -> list[Finding]:
        found = []
        if self._unset:
            unset = tuple(a for a in self._plan.addresses if a in self._unset)
            names = ", ".join(self.file.schema.label(a, self._machine) for a in unset[:4])
            more = f" and {len(unset) - 4} more" if len(unset) > 4 else ""
            found.append(Finding("schema.unset", "advice", unset,
                                 f"{len(unset)} parameters in force have no value here, so the control keeps its own: "
                                 f"{names}{more}."))  # fmt: skip
        for key in self.file.unknown:
            found.append(Finding("schema.unknown", "warning", (), f"{key} is no parameter of this schema; it is kept as it is."))
        return found

    # -- one rule --------------------------------------------------------------

    def _check_rule(self, check: RuleCheck) -> None:
        self._rules.pop(check.key, None)
        names = self._names(check)
        if names is None:
            return
        context = self._context
        context.update(names)
        try:
            if check.when.execute(context) is not True or check.check.execute(context) is not False:
                return
        except EVALUATION_FAULTS:
            return  # a value of a kind the rule does not speak of; its own range check says what is wrong
        self._rules[check.key] = self._rule_finding(check)

    def _names(self, check: RuleCheck) -> dict[str, Any] | None:
        """Return the rule's names with their values; None when one it needs is unset or out of force."""
        situation = self.file.situation
        names: dict[str, Any] = {"machine": self._machine, "instance": check.instance}
        for name, reading in check.readings.items():
            if reading.is_list:
                names[name] = [situation.canonical(a) if situation.state(a).state == "in-force" else None
                               for a in reading.addresses]  # fmt: skip
                continue
            address = reading.addresses[0]
            state = situation.state(address).state
            counts = state == "in-force" or (state != "hidden" and name in check.rule.any_state)
            found = situation.canonical(address) if counts else None
            if found is None and name not in check.rule.optional:
                return None
            names[name] = found
        return names

    def _rule_finding(self, check: RuleCheck) -> Finding:
        rule = check.rule
        single = {n: r.addresses[0] for n, r in check.readings.items() if not r.is_list}
        schema = self.file.schema
        texts = {"instance": check.instance, "machine": self._machine}
        for name, address in single.items():
            texts[name] = show_value(schema.parameters[address[0]], self.file.values.get(address))
        for name, reading in check.readings.items():
            if reading.is_list:
                texts[name] = ", ".join(
                    show_value(schema.parameters[a[0]], self.file.values.get(a)) for a in reading.addresses
                )
        turns = any(self.file.situation.turns(a) for a in single.values())
        for name, expression in check.values:
            texts[name] = self._text(expression, rule.units.get(name, ""), turns)
        addresses = tuple(single.values()) or tuple(
            a for r in check.readings.values() for a in r.addresses if self.file.situation.state(a).state == "in-force"
        )
        repairs = tuple(r for fix in rule.fix if (r := self._repair(single[fix.set], fix.value)) is not None)
        safe = bool(repairs) and all(fix.safe for fix in rule.fix)
        return Finding(rule.id, rule.severity, addresses, _fill(rule.message, texts), repairs, rule.page, safe)

    def _text(self, expression: Any, unit: str, turns: bool) -> str:
        try:
            found = expression.execute(self._context)
        except EVALUATION_FAULTS:
            return "?"
        if isinstance(found, (bool, str)) or not isinstance(found, (int, float)):
            return str(found)
        if unit:
            unit = angular(unit) if turns else unit
            inch = unit.replace("mm", "in", 1)
            if self.file.header.units == "inch" and inch != unit:
                found, unit = convert(float(found), unit, inch), inch
        return f"{write_number(float(f'{found:.7g}'))} {shown(unit)}".rstrip()

    def _repair(self, address: Address, expression: str) -> Repair | None:
        from amp_studio.schema import program

        parameter = self.file.schema.parameters[address[0]]
        try:
            found = program(expression).execute(self._context)
        except EVALUATION_FAULTS:
            return None
        if isinstance(found, (bool, str)):
            value = Value(found)
        else:
            old = self.file.values.get(address)
            unit = old.unit if old else self.file.situation.unit(address, self.file.header.units)
            number = float(f"{convert(float(found), canonical_unit(unit), unit):.12g}")
            if parameter.decimals is not None and (not parameter.ranges or unit in parameter.ranges):
                number = round(number, parameter.decimals)
            value = Value(int(number) if parameter.type == "integer" else number, unit)
        if value == self.file.values.get(address) or fault(self.file.situation, address, value):
            return None
        return Repair(address, value)


class _Texts(dict[str, str]):
    def __missing__(self, key: str) -> str:
        return "{" + key + "}"


def _fill(message: str, texts: dict[str, str]) -> str:
    return message.format_map(_Texts(texts))
