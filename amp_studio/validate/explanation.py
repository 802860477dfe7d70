"""Why a finding is there: its rule with the values put in, and the parameters it hangs on."""

from __future__ import annotations

import re
from dataclasses import dataclass

from amp_studio.schema import (
    EVALUATION_ERRORS,
    MASKED,
    Address,
    Context,
    Rule,
    StateInfo,
    canonical_unit,
    program,
    show_value,
    unit_text,
    write_number,
)

from .finding import Finding
from .plan import RuleCheck
from .plausible import TITLES
from .validator import Validator

# Quoted texts match first, so that no word inside of one is taken for a name; a name before ``(`` is a
# function.
_NAME = re.compile(r"'[^']*'|(?<![\w.])[a-z][a-z0-9_]*(?!\w*\()")
_COMPARISON = re.compile(r"<=|>=|==|!=|<|>")
_LONG_LIST = 8
_TITLES = {
    "schema.range": "A value outside its range",
    "schema.choice": "A value that is no choice",
    "schema.unset": "Values that are not set",
    "schema.unknown": "An entry that the schema does not know",
    **TITLES,
}
_OWN_RULES = "The builder's own rules"


@dataclass(frozen=True, slots=True)
class SeenValue:
    """A parameter that a finding hangs on."""

    name: str
    """What the rule calls it; empty where no rule names it."""
    address: Address
    value: str
    state: StateInfo


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why a finding is there."""

    title: str
    demand: str
    """What is demanded, as the rule has it; empty for a range or a choice."""
    when: str
    """In which case it is demanded; empty for always."""
    with_values: str
    """The demand with the values in the place of the names."""
    sides: tuple[tuple[str, str], ...]
    """What the two sides of a comparison come to, where they are more than a name or a number."""
    seen: tuple[SeenValue, ...]
    errata: tuple[str, ...]
    """Of the parameters it hangs on, where the manual contradicts itself."""
    source: str = ""
    """Where it is written: a page of the manual, or the source that a builder gives for his own rule."""


def explain(validator: Validator, finding: Finding) -> Explanation:
    """Return why one of the validator's findings is there."""
    check = validator.check_of(finding)
    if check is None:
        return _of_a_value(validator, finding)
    context, rule = validator.context_of(check), check.rule
    named = _named(check)
    seen = tuple(
        _seen(validator, address, name) for name, address in named if not _is_hidden(validator, address)
    )
    return Explanation(
        rule.title,
        _plain(rule.check),
        "" if rule.when == "true" else _plain(rule.when),
        _with_values(validator, check, rule),
        # A side that is worked out would give a secret away, even where its value is masked.
        () if any(_is_secret(validator, address) for _, address in named) else tuple(_sides(rule, context)),
        seen,
        _errata(validator, {address[0] for _, address in named}),
        _source(validator, finding),
    )


def _named(check: RuleCheck) -> list[tuple[str, Address]]:
    """Return name and address of each value that a check reads."""
    named = [(single.name, single.address) for single in check.singles]
    return named + [(name, address) for name, listed in check.lists for address in listed.addresses]


def rule_title(validator: Validator, finding: Finding) -> str:
    """Return the name of the rule that one of the validator's findings is of."""
    check = validator.check_of(finding)
    return check.rule.title if check else _TITLES.get(finding.rule, _OWN_RULES)


def _source(validator: Validator, finding: Finding) -> str:
    if finding.is_own:
        return "; ".join(filter(None, (finding.page, validator.own.places.get(finding.rule, ""))))
    if finding.reason:
        return finding.reason
    return f"{validator.file.schema.family.title}, page {finding.page}" if finding.page else ""


def _of_a_value(validator: Validator, finding: Finding) -> Explanation:
    """Explain a finding about a value by itself: with the parameters that bound it."""
    evaluation, addresses = validator.file.evaluation, list(finding.addresses)
    hung_on: list[Address] = []
    for address in addresses[:1] if finding.rule.startswith("schema.") else []:
        hung_on += evaluation.bound_sources(address)
    every = dict.fromkeys(addresses[:_LONG_LIST] + hung_on)
    seen = tuple(_seen(validator, a, "") for a in every if not _is_hidden(validator, a))
    return Explanation(
        _TITLES.get(finding.rule, _OWN_RULES),
        "",
        "",
        "",
        (),
        seen,
        _errata(validator, {a[0] for a in every}),
        _source(validator, finding),
    )


def _plain(expression: str) -> str:
    """Return an expression in one line, without the comments of its lines."""
    return " ".join(" ".join(line.split("//")[0] for line in expression.splitlines()).split())


def _is_hidden(validator: Validator, address: Address) -> bool:
    return validator.file.evaluation.state(address).state == "hidden"


def _is_secret(validator: Validator, address: Address) -> bool:
    return validator.file.schema.parameters[address[0]].secret


def _seen(validator: Validator, address: Address, name: str) -> SeenValue:
    file = validator.file
    value = show_value(file.schema.parameters[address[0]], file.values.get(address))
    return SeenValue(name, address, value, file.evaluation.state(address))


def _with_values(validator: Validator, check: RuleCheck, rule: Rule) -> str:
    """Return the demand with the values in the place of the names, in the units in which rules compare."""
    file = validator.file
    texts = {single.name: _value(validator, single.address) for single in check.singles}
    for name, listed in check.lists:
        unit_text = [_value(validator, a) for a in listed.addresses if not _is_hidden(validator, a)]
        texts[name] = f"[{', '.join(unit_text[:_LONG_LIST])}{', …' if len(unit_text) > _LONG_LIST else ''}]"
    texts |= {"machine": file.machine, "application": file.header.application, "instance": check.instance}
    return _NAME.sub(lambda m: texts.get(m[0], m[0]), _plain(rule.check))


def _value(validator: Validator, address: Address) -> str:
    """Return a value as a rule sees it, with its unit."""
    evaluation = validator.file.evaluation
    found = evaluation.canonical(address)
    if found is None or evaluation.state(address).state == "hidden":
        return "null"
    if _is_secret(validator, address):
        return MASKED
    if isinstance(found, bool):
        return str(found).lower()
    if isinstance(found, str):
        return f"'{found}'"
    value = validator.file.values.get(address)
    unit = canonical_unit(value.unit) if value else ""
    # Nine digits: the conversion into the canonical unit leaves a tail that no user has typed.
    return f"{write_number(float(f'{found:.9g}'))} {unit_text(unit)}".rstrip()


def _sides(rule: Rule, context: Context) -> list[tuple[str, str]]:
    """Return what the sides of a plain comparison come to."""
    text = _plain(rule.check)
    parts = _split(text)
    if parts is None:
        return []
    found = []
    for side in parts:
        # A name or a number alone is beside the values already.
        if not re.fullmatch(r"[\w.]+|'[^']*'", side):
            try:
                worth = program(side).execute(context)
            except (*EVALUATION_ERRORS, ValueError):
                continue
            if isinstance(worth, float):
                found.append((side, write_number(float(f"{worth:.9g}"))))
    return found


def _split(text: str) -> tuple[str, str] | None:
    """Return the two sides of an expression that is a single comparison and nothing else."""
    depth, places = 0, []
    # Of several comparisons it is not known which one failed.
    if "&&" in text or "||" in text or "?" in text:
        return None
    for found in re.finditer(r"'[^']*'|[()\[\]]|<=|>=|==|!=|<|>", text):
        if found[0] in "([":
            depth += 1
        elif found[0] in ")]":
            depth -= 1
        elif depth == 0 and _COMPARISON.fullmatch(found[0]):
            places.append(found.span())
    # ``a < b == c`` compares a truth with a value: there are no two sides to show.
    if len(places) != 1:
        return None
    ((start, end),) = places
    return text[:start].strip(), text[end:].strip()


def _errata(validator: Validator, parameters: set[str]) -> tuple[str, ...]:
    schema = validator.file.schema
    ids = [e for p in schema.parameters if p in parameters for e in schema.parameters[p].errata]
    return tuple(dict.fromkeys(e for e in ids if e in schema.errata))
