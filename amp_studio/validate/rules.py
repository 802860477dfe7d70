"""One rule for one instance: whether it is broken, and the finding it gives then."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from operator import is_
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    MASKED,
    Address,
    BuilderRule,
    Value,
    canonical_unit,
    canonical_value,
    convert,
    show_value,
    shown,
    write_number,
)
from amp_studio.schema.cel_engine import Context, Program
from amp_studio.schema.expression import (
    ALWAYS_THERE,
    EVALUATION_ERRORS,
    Canonical,
    Circumstances,
    context_of,
    same_values,
)
from amp_studio.schema.units import angular

from .blame import about
from .expression_worth import LONGEST_TEXT
from .finding import OWN_FAULT, Finding, Setting
from .formulas import rule_functions
from .plan import Listed, RuleCheck

_SHOWN = 4
"""Values that a message about a rule shows."""


@dataclass(frozen=True, slots=True)
class _Given:
    """What the expressions of a check see: the context, and the values in it."""

    context: Context
    values: list[Any]


class RuleChecks:
    """The rules of one plan over the values of one file."""

    def __init__(self, file: ParameterFile, machine: str, places: Mapping[str, str]) -> None:
        self._file, self._machine, self._places = file, machine, places
        self._functions = rule_functions(file.schema.family.family)
        self._given: dict[int, tuple[list[Any], bool | None]] = {}
        """Place of a check -> the values it was given, and whether it was broken by them."""
        self._by_instance: dict[str, Circumstances] = {}
        self._seen: dict[Address, Canonical] = {}
        self._lists: dict[Listed, list[Canonical]] = {}
        self._lists_before: dict[Listed, list[Canonical]] = {}
        self._list_keys: dict[Listed, Hashable] = {}
        """What is in the place of the lists in a key."""

    def look_again(self) -> None:
        """Forget the values, which may have changed; called before the checks of a round."""
        self._seen.clear()
        self._lists_before.update(self._lists)
        self._lists.clear()
        self._list_keys.clear()

    def finding(self, check: RuleCheck) -> Finding | None:
        """Return what is wrong if the rule is broken; None too where what it needs is not set or inactive."""
        values = self._values(check)
        if values is None:
            return None
        given = self._given.get(check.place)
        if given is not None and all(map(is_, values, given[0])):
            broken = given[1]
        else:
            broken = self._broken_by(check, values)
            self._given[check.place] = (values, broken)
        if broken is None:
            return self._unusable(check)
        return self._finding(check, values) if broken else None

    def is_broken(self, check: RuleCheck) -> bool:
        """Return whether there is a ``finding``, without its words."""
        values = self._values(check)
        return values is not None and self._broken_by(check, values) is not False

    def _broken_by(self, check: RuleCheck, values: list[Any]) -> bool | None:
        """Return whether a rule is broken by values; what it came to for equal ones before is remembered.

        None where a builder's rule makes no sense of values that are all there. Our own are tried with all that there are.
        """
        is_own = isinstance(check.rule, BuilderRule)
        if is_own and _too_long(values):
            return False
        key = same_values(values[: len(check.singles)])
        if check.lists:
            key = key, *[self._list_key(listed) for _, listed in check.lists]
        found = check.expressions.broken.verdict(key, check.names, values, self._circumstances(check))
        return None if found is None and is_own and not _is_any_missing(values) else found is True

    def context_of(self, check: RuleCheck) -> Context:
        """Return what the expressions of a check see now."""
        return self._context(check, self._values(check) or [None] * len(check.names))

    def _context(self, check: RuleCheck, values: list[Any]) -> Context:
        """Return what every expression of a check sees."""
        functions = {name: self._functions[name] for name in check.expressions.finding.functions}
        return context_of(functions, ALWAYS_THERE, check.names, values, self._circumstances(check))

    def _circumstances(self, check: RuleCheck) -> Circumstances:
        found = self._by_instance.get(check.instance)
        if found is None:
            found = Circumstances(self._machine, self._file.header.application, check.instance)
            self._by_instance[check.instance] = found
        return found

    # -- values ----------------------------------------------------------------

    def _values(self, check: RuleCheck) -> list[Canonical | list[Canonical]] | None:
        """Return the values of a check's names; None when one it needs is not there."""
        seen, lists = self._seen, self._lists
        if check.plain:
            plain: list[Canonical | list[Canonical]] = [
                seen[a] if a in seen else self._see(a) for a in check.plain
            ]
            return None if None in plain else plain
        values: list[Canonical | list[Canonical]] = []
        for single in check.singles:
            address = single.address
            found = seen[address] if address in seen else self._see(address)
            if found is None and single.any_state:
                found = self._out_of_force(address)
            if found is None and not single.optional:
                return None
            values.append(found)
        for _, listed in check.lists:
            values.append(lists[listed] if listed in lists else self._list(listed))
        return values

    def _see(self, address: Address) -> Canonical:
        evaluation = self._file.evaluation
        counts = evaluation.state(address).state == "in-force"
        found = self._seen[address] = evaluation.canonical(address) if counts else None
        return found

    def _out_of_force(self, address: Address) -> Canonical:
        evaluation = self._file.evaluation
        return evaluation.canonical(address) if evaluation.state(address).state != "hidden" else None

    def _list_key(self, listed: Listed) -> Hashable:
        found = self._list_keys.get(listed)
        if found is None:
            found = self._list_keys[listed] = same_values(self._lists[listed])
        return found

    def _list(self, listed: Listed) -> list[Canonical]:
        """Return the values of several instances: the same list as before while they are the same."""
        found = [self._seen[a] if a in self._seen else self._see(a) for a in listed.addresses]
        before = self._lists_before.get(listed)
        if before is not None and all(map(is_, found, before)):
            found = before
        self._lists[listed] = found
        return found

    # -- the finding -----------------------------------------------------------

    def _unusable(self, check: RuleCheck) -> Finding:
        """Return the finding about a rule that ends in an error with the values of a file."""
        rule, is_secret = check.rule, self._reads_secret(check)
        given = [f"{s.name} = {MASKED if is_secret else self._shown(s.address)}" for s in check.singles]
        said = (
            f"{self._places.get(rule.id, 'A rule')}: {rule.id}: it cannot be worked out"
            f"{f' with {_listed(given)}' if given else ''}: a number is too large, divided by zero or no number."
        )
        return Finding(
            OWN_FAULT, "error", (), said, compared=check.addresses, instance=f"{rule.id} {check.instance}"
        )

    def _finding(self, check: RuleCheck, present: list[Any]) -> Finding:
        rule, evaluation = check.rule, self._file.evaluation
        given = _Given(self._context(check, present), present)
        texts = {"instance": check.instance, "machine": self._machine}
        texts["application"] = self._file.header.application
        texts["part"] = check.instance.partition(".")[2]
        for single in check.singles:
            texts[single.name] = self._shown(single.address)
        for name, listed in check.lists:
            if f"{{{name}}}" in rule.message:
                texts[name] = ", ".join(map(self._shown, listed.addresses))
        own = [single.address for single in check.singles]
        turns = any(evaluation.turns(address) for address in own)
        entered = {value.unit for value in map(self._file.values.get, own) if value is not None}
        is_secret = self._reads_secret(check)
        for name, expression in check.expressions.finding.values:
            unit = rule.units.get(name, "")
            unit = angular(unit) if turns else unit
            # What is worked out of a secret can give it away.
            texts[name] = MASKED if is_secret else self._text(expression, given.context, unit, entered)
        causes, compared = (
            tuple(a for a in addresses if evaluation.state(a).state != "hidden") or addresses
            for addresses in about(check, given.context, present)
        )
        fix = self._fix(check, given)
        safe = bool(fix) and all(entry.safe for entry in rule.fix)
        return Finding(
            rule.id,
            rule.severity,
            causes,
            rule.message.format_map(texts),
            fix,
            rule.page,
            safe,
            tuple(self._set(check, given, check.expressions.finding.effective)),
            compared,
            check.instance,
            isinstance(rule, BuilderRule),
        )

    def _reads_secret(self, check: RuleCheck) -> bool:
        parameters = self._file.schema.parameters
        return any(parameters[address[0]].secret for address in check.addresses)

    def _shown(self, address: Address) -> str:
        return show_value(self._file.schema.parameters[address[0]], self._file.values.get(address))

    def _text(self, expression: Program, context: Context, unit: str, entered: set[str]) -> str:
        """Return what was worked out: a figure in inches where the file, or a value it comes from, is; a list in commas."""
        try:
            found = expression.execute(context)
        except EVALUATION_ERRORS:
            return "?"
        if isinstance(found, list):
            return ", ".join(map(str, found))
        if isinstance(found, (bool, str)) or not isinstance(found, (int, float)):
            return str(found)
        if unit:
            inch = unit.replace("mm", "in", 1)
            if inch != unit and (self._file.header.units == "inch" or inch in entered):
                found, unit = convert(float(found), unit, inch), inch
        number, sign = write_number(float(f"{found:.7g}")), shown(unit)
        return f"{number}{sign}" if sign == "°" else f"{number} {sign}".rstrip()

    def _fix(self, check: RuleCheck, given: _Given) -> tuple[Setting, ...]:
        """Return what the rule would change; nothing if it would not help. Whether it does harm is for a trial."""
        fix = tuple(self._set(check, given, check.expressions.finding.fixes))
        return fix if fix and self._mends(check, given, fix) else ()

    def _set(
        self, check: RuleCheck, given: _Given, assignments: tuple[tuple[str, Program], ...]
    ) -> Iterator[Setting]:
        """Yield what the rule sets, if that is another value than the present one; no secret goes elsewhere."""
        is_secret = bool(assignments) and self._reads_secret(check)
        for name, expression in assignments:
            address = check.address_of(name)
            if is_secret and not self._file.schema.parameters[address[0]].secret:
                continue
            value = self._worked_out(address, expression, given.context)
            if value is not None and value != self._file.values.get(address):
                yield Setting(address, value)

    def _mends(self, check: RuleCheck, given: _Given, fix: tuple[Setting, ...]) -> bool:
        """Return whether the rule is satisfied with its own suggested fixes, which were rounded as the parameter needs it."""
        mended = {setting.address: canonical_value(setting.value) for setting in fix}
        before = dict(zip(check.names, given.values, strict=True))
        after: dict[str, Any] = {s.name: mended[s.address] for s in check.singles if s.address in mended}
        for name, listed in check.lists:
            if not mended.keys().isdisjoint(listed.addresses):
                after[name] = [mended.get(a, v) for a, v in zip(listed.addresses, before[name], strict=True)]
        given.context.update(after)
        try:
            return check.expressions.broken.program.execute(given.context) is not True
        except EVALUATION_ERRORS:
            return False
        finally:
            given.context.update({name: before[name] for name in after})

    def _worked_out(self, address: Address, expression: Program, context: Context) -> Value | None:
        """Return a value as the parameter stores it, in the unit of the present one; None where there is none."""
        parameter = self._file.schema.parameters[address[0]]
        try:
            found = expression.execute(context)
        except EVALUATION_ERRORS:
            return None
        if isinstance(found, (bool, str)):
            return Value(found)
        if not isinstance(found, (int, float)) or not math.isfinite(found):
            return None
        old = self._file.values.get(address)
        unit = old.unit if old else self._file.evaluation.unit(address, self._file.header.units)
        number = float(f"{convert(float(found), canonical_unit(unit), unit):.12g}")
        if parameter.decimals is not None and (not parameter.ranges or unit in parameter.ranges):
            number = round(number, parameter.decimals)
        return Value(int(number) if parameter.type in ("integer", "bits") else number, unit)


def _is_any_missing(values: Iterable[Any]) -> bool:
    """Return whether a value, or one of a list, is not set or inactive."""
    return any(value is None or (type(value) is list and None in value) for value in values)


def _listed(given: list[str]) -> str:
    """Return the values that an expression was given, the first of them where there are many."""
    more = f" and {len(given) - _SHOWN} more" if len(given) > _SHOWN else ""
    return ", ".join(given[:_SHOWN]) + more


def _too_long(values: Iterable[Any]) -> bool:
    """Return whether a text is longer than a builder's rule was found to bear; its own check reports that it is too long."""
    return any(
        len(value) > LONGEST_TEXT if type(value) is str else type(value) is list and _too_long(value)
        for value in values
    )
