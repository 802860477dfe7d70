"""A campaign against the fixes: machines of every family with random values,
and every fix that is offered in them.

``campaign(seed, count)`` may be called with any count; ``test_fix_campaign.py`` runs it briefly.
"""

from collections.abc import Iterable, Iterator
from functools import cache
from random import Random

from rule_machines import FAMILIES, machines, sound
from test_any_values import anything, fitting, often, set_if_possible

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value
from amp_studio.validate import NO_RULES, SEVERITIES, BuilderRules, Finding, Validator, apply_fixes

FACTORS = [0, -1, 0.1, 0.5, 0.9, 0.999, 1.001, 1.1, 2, 10, 1000]
NO_FINDING_OF_A_VALUE = ("schema.unset", "rules.unused", "plausible.")
"""Values that are not set, suppressions, and what experience asks about whatever a rule
of the manual makes of a value."""


@cache
def place() -> list[tuple[str, ParameterFile]]:
    """Return every sound machine, with its name."""
    return [
        (f"{family} {name}", sound(family, name))
        for family in FAMILIES
        for name in machines(family)["machines"]
    ]


def campaign(seed: int, count: int) -> tuple[int, list[str]]:
    """Try the fixes of so many machines; returns how many fixes were tried,
    and each broken promise in a sentence.
    """
    tried, broken = 0, []
    for n in range(seed, seed + count):
        random = Random(n)
        name, base = random.choice(place())
        file = base.copy()
        spoil(file, random)
        number, message = broken_promises(file)
        tried += number
        broken += [f"seed {n}, {name}: {sentence}" for sentence in (*message, *not_ended(file))]
    return tried, broken


def spoil(file: ParameterFile, random: Random, times: int | None = None) -> None:
    """Change a few values, or many: beside the present ones, at bounds, or to anything whatever."""
    addresses, much = file.addresses(), often(file.schema, file.machine)
    for _ in range(times or random.choice([1, 1, 2, 3, 5, 10, 40, 150])):
        address = random.choice(
            [random.choice(addresses), random.choice(much), random.choice(list(file.values))]
        )
        set_if_possible(file, address, _another(file, address, random))


def _another(file: ParameterFile, address: Address, random: Random) -> Value | None:
    old, parameter = file.values.get(address), file.schema.parameters[address[0]]
    kind = random.random()
    if kind < 0.03:
        return None
    if kind < 0.06:
        return anything(random)
    if (
        old is not None
        and kind < 0.6
        and isinstance(old.value, (int, float))
        and not isinstance(old.value, bool)
    ):
        number = old.value * random.choice(FACTORS)
        whole = isinstance(old.value, int) and abs(number) < 1e15
        return Value(int(number) if whole else round(number, random.choice([1, 3, 5])), old.unit)
    if old is not None and kind < 0.7:  # the same as a sibling's, as of a pair whose two are equal
        kinds = {a: file.schema.parameters[a[0]] for a in file.values}
        others = [
            a
            for a in file.values
            if a[1] == address[1]
            and file.values[a].unit == old.unit
            and (kinds[a].type, kinds[a].choices) == (parameter.type, parameter.choices)
        ]
        return file.values[random.choice(others)] if others else old
    return fitting(file.schema, parameter, random)


def broken_promises(file: ParameterFile, own: BuilderRules = NO_RULES) -> tuple[int, list[str]]:
    """Apply each offered fix alone, to a copy that is checked again; returns how many,
    and what they do not keep.
    """
    before, message = Validator(file, own).run(), list[str]()
    offered = [finding for finding in before if finding.fix]
    for finding in offered:
        twin = file.copy()
        twin.set_checked(
            {setting.address: setting.value for setting in finding.fix}
        )  # raises if one is not allowed
        message += unkept(finding, before, Validator(twin, own).run())
    return len(offered), message


def unkept(finding: Finding, before: Iterable[Finding], after: Iterable[Finding]) -> Iterator[str]:
    """Say what the fix of a finding does not keep, by the findings before and after it was made."""
    who = f"{finding.rule} {finding.fix}"
    there, left = filed(before), filed(after)
    if finding.key in left:
        yield f"{who}: its finding is still there"
    for key in left.keys() - there.keys():
        if not left[key].rule.startswith(NO_FINDING_OF_A_VALUE) and _rank(left[key]) <= _rank(finding):
            yield f"{who}: brings {key}"


def not_ended(file: ParameterFile, own: BuilderRules = NO_RULES) -> Iterator[str]:
    """Apply fix after fix to a copy and say what is wrong at the end: errors that are new,
    fixes that are left.
    """
    twin = file.copy()
    validator = Validator(twin, own)
    before = validator.run()
    fixed = apply_fixes(validator, lambda _: True, even_doubtful=True)
    after = Validator(twin, own).run()
    if list(map(repr, after)) != list(map(repr, validator.findings())):
        yield "edit by edit the findings are not those of a full run"
    if any(finding.fix for finding in after):
        yield f"fixes are left after {len(fixed)} changes"
    new = {key for key, f in filed(after).items() if f.severity == "error"} - filed(before).keys()
    if new:
        yield f"fixes together brought {new}"


def filed(findings: Iterable[Finding]) -> dict[tuple[str, object], Finding]:
    """Return findings by what they are about."""
    return {finding.key: finding for finding in findings}


def _rank(finding: Finding) -> int:
    return SEVERITIES.index(finding.severity)
