"""One rule for one instance: whether it is broken, and the finding it gives then."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    ACTIVE,
    ALWAYS_THERE,
    MASKED,
    NO_RESULT,
    Address,
    Circumstances,
    Context,
    Evaluation,
    Expression,
    InvalidValueError,
    Value,
    ValueKey,
    angular,
    canonical_unit,
    checked,
    context_of,
    convert,
    dimension,
    key_of,
    show_value,
    unit_text,
    value_of,
    write_figure,
)

from .blame import about
from .builder_rules import LONGEST_TEXT
from .finding import OWN_FAULT, AddressedValue, Finding
from .functions import rule_functions
from .plan import CheckGroup, Listed, RuleCheck

_SHOWN = 4
"""Values that a message about a rule shows."""


class _KeyedContext:
    """What the expressions of a check see: the values with their keys, and the context of the engine."""

    def __init__(self, keys: tuple[ValueKey, ...], make_context: Callable[[list[Any]], Context]) -> None:
        self.keys, self._make_context = keys, make_context

    @cached_property
    def values(self) -> list[Any]:
        """The values."""
        return list(map(value_of, self.keys))

    @cached_property
    def context(self) -> Context:
        """What the engine is given; made only for what is not remembered."""
        return self._make_context(self.values)


class _Active(dict[Address, ValueKey]):
    """The keys of the values that are active, and None for the others;
    each looked up when it is first asked for.
    """

    def __init__(self, evaluation: Evaluation) -> None:
        self._evaluation, self._keys, self._states = evaluation, evaluation.keys, evaluation.known_states()

    def clear(self) -> None:
        super().clear()
        self._states = self._evaluation.known_states()

    def __missing__(self, address: Address) -> ValueKey:
        key = self._keys[address]
        if key is not None:
            state = self._states.get(address) or self._evaluation.state(address)
            if state is not ACTIVE:
                key = None
        self[address] = key
        return key


class RuleChecks:
    """The rules of one plan over the values of one file."""

    def __init__(self, file: ParameterFile, machine: str, places: Mapping[str, str] | None = None) -> None:
        self._file, self._machine, self._places = file, machine, places or {}
        self._functions = rule_functions(file.schema.family.family)
        self._by_instance: dict[str, Circumstances] = {}
        self._seen = _Active(file.evaluation)
        self._lists: dict[Listed, tuple[ValueKey, ...]] = {}

    def forget_values(self, changed: Iterable[Address] | None = None) -> None:
        """Forget the values, which may have changed; called before the checks of a round.

        Where nothing that decides on states has changed, the ``changed`` ones alone are forgotten: a cam has
        thousands of others.
        """
        edited = None if changed is None else list(changed)
        if edited is None or any(map(self._file.evaluation.decides_states, edited)):
            self._seen.clear()
            self._lists.clear()
            return
        for address in edited:
            self._seen.pop(address, None)
            for listed in [listed for listed in self._lists if address in listed.places]:
                keys, at = self._lists[listed], listed.places[address]
                self._lists[listed] = (*keys[:at], self._seen[address], *keys[at + 1 :])

    def add_keys(self, read: Mapping[Address, None], seen: Iterable[tuple[Address, ValueKey]]) -> None:
        """Take the keys of values that are active, and None for the others:
        quicker than to look at one by one.

        Of what is ``read``, that which is not among the values is not set.
        """
        self._seen.update(read)
        self._seen.update(seen)

    def is_active(self, address: Address) -> bool:
        """Return whether a value is there and counts."""
        return self._seen[address] is not None

    def is_complete(self, check: RuleCheck) -> bool:
        """Return whether all values that a check needs are there."""
        return self._keys(check) is not None

    def findings(self, checks: Iterable[RuleCheck]) -> Iterator[tuple[RuleCheck, Finding]]:
        """Yield the checks of rules that are broken, and what is wrong."""
        for check in checks:
            keys = self._keys(check)
            if keys is None:
                continue
            # Most rules depend on their values alone; those that name the machine or the instance are
            # found by _broken_by.
            broken = check.expressions.remembered.get(keys)
            if broken is None:
                broken = self._broken_by(check, keys)
            if broken is None:
                yield check, self._unusable(check)
            elif broken:
                yield check, self._finding(check, keys)

    def findings_of(self, group: CheckGroup) -> Iterator[tuple[RuleCheck, Finding]]:
        """Yield the same of a group; one look at its values is enough where they were found sound before."""
        keys: tuple[ValueKey, ...] = tuple(map(self._seen.__getitem__, group.reads))
        if group.first is None and None in keys:  # some may count though they are inactive, others do not
            own = zip(keys, group.reads, strict=True)
            keys += tuple([self._inactive(address) for key, address in own if key is None])
        # With the model, which conditions may name; the machine type is that of the plan.
        values = (self._file.header.application, keys)
        if values not in group.sound:
            found = tuple(self.findings(group.together))
            if not found:
                group.sound.add(values)
            yield from found
        if group.others:
            yield from self.findings(group.others)

    def finding(self, check: RuleCheck) -> Finding | None:
        """Return what is wrong if the rule is broken; None too where what it needs is not set or inactive."""
        return next((finding for _, finding in self.findings((check,))), None)

    def is_broken(self, check: RuleCheck) -> bool:
        """Return whether there is a ``finding``, without its words."""
        keys = self._keys(check)
        return keys is not None and self._broken_by(check, keys) is not False

    def _broken_by(self, check: RuleCheck, keys: tuple[ValueKey, ...]) -> bool | None:
        """Return whether a rule is broken by values; what it came to for equal ones before is remembered.

        None where a builder's rule makes no sense of values that are all there.
        Our own are tried with all that there are.
        """
        circumstances = self._circumstances(check)
        found = check.expressions.remembered.get((keys, circumstances.key))
        if found is None:
            found = check.expressions.verdict(keys, circumstances)
        return None if found is None and check.is_own and not _is_any_missing(keys) else found is True

    def context_of(self, check: RuleCheck) -> Context:
        """Return what the expressions of a check see now."""
        keys = self._keys(check)
        values = [None] * len(check.names) if keys is None else list(map(value_of, keys))
        return self._context(check, values)

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

    def _keys(self, check: RuleCheck) -> tuple[ValueKey, ...] | None:
        """Return the keys of the values of a check's names; None when one it needs is not there."""
        keys = tuple(map(self._seen.__getitem__, check.reads))
        if None in keys and not (check.is_lenient and (keys := self._lenient_keys(check, keys))):
            return None
        if check.lists:
            keys += tuple([self._lists.get(listed) or self._list(listed) for _, listed in check.lists])
        # A builder may write a rule over the points of a table that costs minutes.
        return None if check.is_own and _too_long(keys) else keys

    def _lenient_keys(self, check: RuleCheck, keys: tuple[ValueKey, ...]) -> tuple[ValueKey, ...]:
        """Return the keys with those of inactive values that count too; none where one is still missing."""
        found = list(keys)
        for n, single in enumerate(check.singles):
            if found[n] is None and single.any_state:
                found[n] = self._inactive(single.address)
            if found[n] is None and not single.optional:
                return ()
        return tuple(found)

    def _inactive(self, address: Address) -> ValueKey:
        evaluation = self._file.evaluation
        return evaluation.keys[address] if evaluation.state(address).state != "hidden" else None

    def _list(self, listed: Listed) -> tuple[ValueKey, ...]:
        seen, values = self._seen, self._file.values
        found = tuple([seen[a] if a in values else None for a in listed.addresses])  # thousands of a table
        self._lists[listed] = found
        return found

    # -- the finding -----------------------------------------------------------

    def _unusable(self, check: RuleCheck) -> Finding:
        """Return the finding about a rule that ends in an error with the values of a file."""
        rule, is_secret = check.rule, self._reads_secret(check)
        given = [f"{s.name} = {MASKED if is_secret else self._value_text(s.address)}" for s in check.singles]
        message = (
            f"{self._places.get(rule.id, 'A rule')}: {rule.id}: it cannot be"
            f" calculated{f' with {_listed(given)}' if given else ''}: a number is too large, divided by zero"
            " or no number."
        )
        return Finding(
            OWN_FAULT, "error", (), message, compared=check.addresses, instance=f"{rule.id} {check.instance}"
        )

    def _finding(self, check: RuleCheck, keys: tuple[ValueKey, ...]) -> Finding:
        """Return the finding of a broken rule: what is at fault, its message with the figures, its fix."""
        rule, effective = check.rule, check.expressions.finding.effective
        given = _KeyedContext(keys, lambda values: self._context(check, values))
        fix = self._fix(check, given)
        causes, compared = about(check, given)
        figures = self._texts(check, given)
        if check.is_lenient or check.lists:  # otherwise all that it reads is active
            causes, compared = self._unhidden(causes), self._unhidden(compared)
        return Finding(
            rule.id,
            rule.severity,
            causes,
            rule.message.format_map(figures),
            fix,
            rule.source if check.is_own else rule.page,
            bool(fix) and all(entry.safe for entry in rule.fix),
            tuple(self._set(check, given, effective)) if effective else (),
            compared,
            check.instance,
            check.is_own,
            "" if check.is_own or rule.page else rule.source,
            figures=tuple(figures.items()),
        )

    def _unhidden(self, addresses: tuple[Address, ...]) -> tuple[Address, ...]:
        """Return what is not hidden, or all of it where everything is."""
        state = self._file.evaluation.state
        return tuple([a for a in addresses if state(a).state != "hidden"]) or addresses

    def _texts(self, check: RuleCheck, given: _KeyedContext) -> dict[str, str]:
        """Return the texts of the names in the message."""
        entries = check.expressions.finding
        texts = {}
        if not entries.check_names.isdisjoint(ALWAYS_THERE):
            circumstances = self._circumstances(check)
            texts = {name: str(getattr(circumstances, name)) for name in ALWAYS_THERE}
        for single in check.singles:
            if single.name in entries.check_names:
                texts[single.name] = self._value_text(single.address)
        for name, listed in check.lists:
            if name in entries.check_names:
                texts[name] = ", ".join(map(self._value_text, listed.addresses))
        if entries.values:
            texts |= self._worked_out_texts(check, given)
        return texts

    def _worked_out_texts(self, check: RuleCheck, given: _KeyedContext) -> dict[str, str]:
        """Return the figures of the message."""
        own = [single.address for single in check.singles]
        turns = any(self._file.evaluation.turns(address) for address in own)
        entered = {value.unit for value in map(self._file.values.get, own) if value is not None}
        is_secret = self._reads_secret(check)
        texts = {}
        for name, expression in check.expressions.finding.values:
            unit = check.rule.units.get(name, "")
            unit = angular(unit) if turns else unit
            # What is worked out of a secret can give it away.
            texts[name] = (
                MASKED if is_secret else self._text(self._result(check, given, expression), unit, entered)
            )
        return texts

    def _reads_secret(self, check: RuleCheck) -> bool:
        parameters = self._file.schema.parameters
        return any(parameters[address[0]].secret for address in check.addresses)

    def _value_text(self, address: Address) -> str:
        return show_value(self._file.schema.parameters[address[0]], self._file.values.get(address))

    def _result(self, check: RuleCheck, given: _KeyedContext, expression: Expression) -> Any:
        return expression.result(given.keys, self._circumstances(check), lambda: given.context)

    def _text(self, found: Any, unit: str, entered: set[str]) -> str:
        """Return what was worked out: a figure in the unit of the values it comes from, or in inches where
        the file is; a list in commas.
        """
        if found is NO_RESULT:
            return "?"
        if isinstance(found, list):
            return ", ".join(map(str, found))
        if isinstance(found, (bool, str)) or not isinstance(found, (int, float)):
            return str(found)
        if unit:
            inch = unit.replace("mm", "in", 1)
            alike = sorted(each for each in entered if dimension(each) == dimension(unit))
            # A message has the units of the values in it, so that they can be compared at a glance.
            other = alike[0] if alike else inch if self._file.header.units == "inch" else unit
            if other != unit:
                found, unit = convert(float(found), unit, other), other
        number, unit_name = write_figure(found), unit_text(unit)
        return f"{number}{unit_name}" if unit_name == "°" else f"{number} {unit_name}".rstrip()

    def _fix(self, check: RuleCheck, given: _KeyedContext) -> tuple[AddressedValue, ...]:
        """Return what the rule would change; nothing if it would not help.
        Whether it does harm is for a trial.
        """
        fixes = check.expressions.finding.fixes
        fix = tuple(self._set(check, given, fixes)) if fixes else ()
        return fix if fix and self._is_met_by(check, given, fix) else ()

    def _set(
        self, check: RuleCheck, given: _KeyedContext, assignments: tuple[tuple[str, Expression], ...]
    ) -> Iterator[AddressedValue]:
        """Yield what the rule sets, if that is another value than the present one; no secret goes
        elsewhere.
        """
        is_secret = self._reads_secret(check)
        for name, expression in assignments:
            address = check.address_of(name)
            if is_secret and not self._file.schema.parameters[address[0]].secret:
                continue
            value = self._value(address, self._result(check, given, expression))
            if value is not None and value != self._file.values.get(address):
                yield AddressedValue(address, value)

    def _is_met_by(self, check: RuleCheck, given: _KeyedContext, fix: tuple[AddressedValue, ...]) -> bool:
        """Return whether the rule is satisfied with its own suggested fixes,
        which were rounded as the parameter needs it.
        """
        fixed = {setting.address: key_of(setting.value) for setting in fix}
        after = list(given.keys)
        for n, single in enumerate(check.singles):
            after[n] = fixed.get(single.address, after[n])
        for n, (_, listed) in enumerate(check.lists, len(check.singles)):
            if not fixed.keys().isdisjoint(listed.addresses):
                before = dict(zip(listed.addresses, self._list(listed), strict=True))
                after[n] = tuple((before | fixed)[a] for a in listed.addresses)
        # None, where no sense can be made of the values, is no cure either.
        return check.expressions.verdict(tuple(after), self._circumstances(check)) is False

    def _value(self, address: Address, found: Any) -> Value | None:
        """Return what was worked out as the parameter stores it, in the unit of the present value;
        None where there is none: a name that another parameter offers may be none of its choices.
        """
        parameter = self._file.schema.parameters[address[0]]
        if isinstance(found, (bool, str)):
            try:
                return checked(parameter, Value(found))
            except InvalidValueError:
                return None
        if not isinstance(found, (int, float)) or not math.isfinite(found):
            return None
        old = self._file.values.get(address)
        unit = old.unit if old else self._file.evaluation.unit(address, self._file.header.units)
        # Twelve digits: the rest is what the conversion of units leaves.
        number = float(f"{convert(float(found), canonical_unit(unit), unit):.12g}")
        if parameter.decimals is not None and (not parameter.ranges or unit in parameter.ranges):
            number = round(number, parameter.decimals)
        return Value(int(number) if parameter.type in ("integer", "bits") else number, unit)


def _is_any_missing(keys: Iterable[ValueKey]) -> bool:
    """Return whether a value, or one of a list, is not set or inactive."""
    return any(key is None or (isinstance(key, tuple) and None in key) for key in keys)


def _listed(given: list[str]) -> str:
    """Return the values that an expression was given, the first of them where there are many."""
    more = f" and {len(given) - _SHOWN} more" if len(given) > _SHOWN else ""
    return ", ".join(given[:_SHOWN]) + more


def _too_long(keys: Iterable[ValueKey]) -> bool:
    """Return whether a text is longer than a builder's rule was found to bear;
    its own check reports that it is too long.
    """
    return any(
        len(key) > LONGEST_TEXT if isinstance(key, str) else isinstance(key, tuple) and _too_long(key)
        for key in keys
    )
