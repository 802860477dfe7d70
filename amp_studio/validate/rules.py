"""One rule for one instance: whether it is broken, and what is said of it then."""

from __future__ import annotations

import math
from collections.abc import Iterator
from operator import is_
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Value,
    canonical_unit,
    canonical_value,
    convert,
    fault,
    part_of,
    show_value,
    shown,
    write_number,
)
from amp_studio.schema.cel_engine import Context, Program
from amp_studio.schema.situation import Canonical
from amp_studio.schema.units import angular

from .finding import Finding, Setting
from .formulas import rule_functions
from .plan import RuleCheck

EVALUATION_FAULTS = (TypeError, ValueError, RuntimeError, ArithmeticError, LookupError)
"""What CEL raises for a value of a kind that an expression does not speak of."""


class _Given:
    """The context of one check, with the values it was given and what came of them.

    Giving values to CEL costs ten times as much as an expression, so a context is kept, and is given only values
    that are no longer the same object: to be equal is not enough, for Python takes 1 and True for equal.
    """

    __slots__ = ("broken", "context", "values")

    def __init__(self, context: Context) -> None:
        self.context = context
        self.values: list[Any] | None = None
        self.broken = False

    def take(self, names: tuple[str, ...], values: list[Any]) -> bool:
        """Take the present values; tells whether any of them is new."""
        before = self.values
        if before is None:
            self.context.update(dict(zip(names, values, strict=True)))
        elif all(map(is_, values, before)):
            return False
        else:
            every = zip(names, values, before, strict=True)
            self.context.update({name: value for name, value, old in every if value is not old})
        self.values = values
        return True


class RuleChecks:
    """The rules of one plan over the values of one file."""

    def __init__(self, file: ParameterFile, machine: str) -> None:
        self._file, self._machine = file, machine
        self._functions = rule_functions(file.schema.family.family)
        self._given: dict[int, _Given] = {}
        """Place of a check -> what it was given."""
        self._seen: dict[Address, Canonical] = {}
        self._lists: dict[tuple[Address, ...], list[Canonical]] = {}
        self._lists_before: dict[tuple[Address, ...], list[Canonical]] = {}

    def look_again(self) -> None:
        """Forget the values, which may have changed; called before the checks of a round."""
        self._seen.clear()
        self._lists_before.update(self._lists)
        self._lists.clear()

    def finding(self, check: RuleCheck) -> Finding | None:
        """Return what is wrong if the rule is broken; None too where what it needs is unset or out of force."""
        values = self._values(check)
        if values is None:
            return None
        given = self._given.get(check.place)
        if given is None:
            given = self._given[check.place] = _Given(self._new_context(check))
        if given.take(check.names, values):
            try:
                given.broken = check.expressions.broken.execute(given.context) is True
            except EVALUATION_FAULTS:
                given.broken = (
                    False  # a value of a kind the rule does not speak of; its own check says what is wrong
                )
        return self._finding(check, given) if given.broken else None

    def context_of(self, check: RuleCheck) -> Context:
        """Return what the expressions of a check see now."""
        given = _Given(self._new_context(check))
        given.take(check.names, self._values(check) or [None] * len(check.names))
        return given.context

    # -- values ----------------------------------------------------------------

    def _values(self, check: RuleCheck) -> list[Canonical | list[Canonical]] | None:
        """Return the values of a check's names; None when one it needs is not there."""
        values: list[Canonical | list[Canonical]] = []
        seen, lists = self._seen, self._lists
        for single in check.singles:
            address = single.address
            found = seen[address] if address in seen else self._see(address)
            if found is None and single.any_state:
                found = self._out_of_force(address)
            if found is None and not single.optional:
                return None
            values.append(found)
        for _, addresses in check.lists:
            values.append(lists[addresses] if addresses in lists else self._list(addresses))
        return values

    def _new_context(self, check: RuleCheck) -> Context:
        context = Context()
        for name in check.expressions.functions:
            context.add_function(name, self._functions[name])
        always: dict[str, Canonical] = {
            "machine": self._machine,
            "application": self._file.header.application,
        }
        always |= {"instance": check.instance, "part": part_of(check.instance)}
        context.update({name: always[name] for name in check.expressions.always})
        return context

    def _see(self, address: Address) -> Canonical:
        situation = self._file.situation
        counts = situation.state(address).state == "in-force"
        found = self._seen[address] = situation.canonical(address) if counts else None
        return found

    def _out_of_force(self, address: Address) -> Canonical:
        situation = self._file.situation
        return situation.canonical(address) if situation.state(address).state != "hidden" else None

    def _list(self, addresses: tuple[Address, ...]) -> list[Canonical]:
        """Return the values of several instances: the same list as before while they are the same."""
        found = [self._seen[a] if a in self._seen else self._see(a) for a in addresses]
        before = self._lists_before.get(addresses)
        if before is not None and all(map(is_, found, before)):
            found = before
        self._lists[addresses] = found
        return found

    # -- what is said ----------------------------------------------------------

    def _finding(self, check: RuleCheck, given: _Given) -> Finding:
        rule, situation = check.rule, self._file.situation
        texts = {"instance": check.instance, "machine": self._machine}
        texts["application"] = self._file.header.application
        texts["part"] = check.instance.partition(".")[2]
        for single in check.singles:
            texts[single.name] = self._shown(single.address)
        for name, addresses in check.lists:
            texts[name] = ", ".join(map(self._shown, addresses))
        own = tuple(single.address for single in check.singles)
        turns = any(situation.turns(address) for address in own)
        for name, expression in check.expressions.values:
            texts[name] = self._text(expression, given.context, rule.units.get(name, ""), turns)
        about = own or tuple(
            a for _, addresses in check.lists for a in addresses if situation.state(a).state == "in-force"
        )
        repairs = self._repairs(check, given)
        safe = bool(repairs) and all(fix.safe for fix in rule.fix)
        return Finding(
            rule.id,
            rule.severity,
            about,
            rule.message.format_map(texts),
            repairs,
            rule.page,
            safe,
            tuple(self._set(check, given, check.expressions.effective)),
        )

    def _shown(self, address: Address) -> str:
        return show_value(self._file.schema.parameters[address[0]], self._file.values.get(address))

    def _text(self, expression: Program, context: Context, unit: str, turns: bool) -> str:
        try:
            found = expression.execute(context)
        except EVALUATION_FAULTS:
            return "?"
        if isinstance(found, (bool, str)) or not isinstance(found, (int, float)):
            return str(found)
        if unit:
            unit = angular(unit) if turns else unit
            inch = unit.replace("mm", "in", 1)
            if self._file.header.units == "inch" and inch != unit:
                found, unit = convert(float(found), unit, inch), inch
        return f"{write_number(float(f'{found:.7g}'))} {shown(unit)}".rstrip()

    def _repairs(self, check: RuleCheck, given: _Given) -> tuple[Setting, ...]:
        """Return what the rule would change; nothing if a part of it is not allowed, or if it would not help."""
        repairs = tuple(self._set(check, given, check.expressions.fixes))
        if any(fault(self._file.situation, repair.address, repair.value) for repair in repairs):
            return ()
        return repairs if repairs and self._mends(check, given, repairs) else ()

    def _set(
        self, check: RuleCheck, given: _Given, assignments: tuple[tuple[str, Program], ...]
    ) -> Iterator[Setting]:
        """Yield what the rule sets, where that is another value than the present one."""
        for name, expression in assignments:
            address = check.address_of(name)
            value = self._worked_out(address, expression, given.context)
            if value is not None and value != self._file.values.get(address):
                yield Setting(address, value)

    def _mends(self, check: RuleCheck, given: _Given, repairs: tuple[Setting, ...]) -> bool:
        """Tell whether the rule holds with its own repairs, which were rounded as the parameter wants it."""
        mended = {repair.address: canonical_value(repair.value) for repair in repairs}
        before = dict(zip(check.names, given.values or (), strict=True))
        after: dict[str, Any] = {s.name: mended[s.address] for s in check.singles if s.address in mended}
        for name, addresses in check.lists:
            if not mended.keys().isdisjoint(addresses):
                after[name] = [mended.get(a, value) for a, value in zip(addresses, before[name], strict=True)]
        given.context.update(after)
        try:
            return check.expressions.broken.execute(given.context) is not True
        except EVALUATION_FAULTS:
            return False
        finally:
            given.context.update({name: before[name] for name in after})

    def _worked_out(self, address: Address, expression: Program, context: Context) -> Value | None:
        """Return a value as the parameter holds it, in the unit of the present one; None where there is none."""
        parameter = self._file.schema.parameters[address[0]]
        try:
            found = expression.execute(context)
        except EVALUATION_FAULTS:
            return None
        if isinstance(found, (bool, str)):
            return Value(found)
        if not isinstance(found, (int, float)) or not math.isfinite(found):
            return None
        old = self._file.values.get(address)
        unit = old.unit if old else self._file.situation.unit(address, self._file.header.units)
        number = float(f"{convert(float(found), canonical_unit(unit), unit):.12g}")
        if parameter.decimals is not None and (not parameter.ranges or unit in parameter.ranges):
            number = round(number, parameter.decimals)
        return Value(int(number) if parameter.type in ("integer", "bits") else number, unit)
