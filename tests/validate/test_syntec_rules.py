"""Every Syntec rule is broken by the changes of its cases, holds beside them, and its repair mends it.

The cases stand in ``rule_cases/syntec/``; the machines they change are the example, and that with the motors of a
serial controller.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.demo import examples_folder
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Rule, Value, load_schema
from amp_studio.validate import Finding, Validator
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

RULES = {rule.id: rule for rule in load_schema("syntec").rules}

Change = Mapping[str, str | None]
"""Number or id -> the value as a person writes it; None takes the value away."""

SERIAL: Change = {
    **{f"Pr{n}": "262144" for n in (61, 62, 63, 64)},  # 1.3.2
    **{f"Pr{n}": "Absolute encoder" for n in (201, 202, 203)},
}


@dataclass(frozen=True)
class Case:
    """One way to break a rule, and one that nearly does."""

    rule: str
    n: int
    of: str
    given: Change = field(default_factory=dict)
    breaks: Change | None = None
    times: int = 1
    holds: Change | None = None

    def __str__(self) -> str:
        return f"{self.rule}-{self.n}"


def read_cases() -> Iterator[Case]:
    for path in sorted((Path(__file__).parent / "rule_cases" / "syntec").glob("*.yaml")):
        for rule, rows in YAML(typ="safe").load(path.read_text("utf-8")).items():
            yield from (Case(rule, n, **row) for n, row in enumerate(rows, 1))


CASES = tuple(read_cases())
BREAKING = [case for case in CASES if case.breaks is not None]


def change(file: ParameterFile, texts: Change) -> None:
    """Write values into a file as a person would."""
    for name, text in texts.items():
        address = file.find(name)
        file.set(address, None if text is None else file.read(address, text))


def machine(name: str) -> ParameterFile:
    """Return a sound machine: the example, or that with the motors of a serial controller."""
    file = open_file(examples_folder() / "syntec-mill" / "SYNTEC_MILL.amp").file
    if name == "serial":
        file.header.machine = "serial"
        file.situation.forget()
        change(file, SERIAL)
    return file


def findings(file: ParameterFile, rule: str) -> list[Finding]:
    return [finding for finding in Validator(file).run() if finding.rule == rule]


@contextmanager
def broken(case: Case) -> Iterator[tuple[ParameterFile, list[Finding]]]:
    """Give the machine of a case after the change that breaks its rule, and what is found."""
    file = machine(case.of)
    change(file, case.given)
    assert findings(file, case.rule) == []
    change(file, case.breaks or {})
    yield file, findings(file, case.rule)


@pytest.mark.parametrize("name", ["generic", "serial"])
def test_in_a_sound_machine_nothing_is_found(name: str) -> None:
    assert Validator(machine(name)).run() == ()


def test_every_rule_has_cases_and_every_case_a_rule() -> None:
    assert {case.rule for case in BREAKING} == RULES.keys() == {case.rule for case in CASES}
    assert {case.rule for case in CASES if case.holds is not None} == RULES.keys()


@pytest.mark.parametrize("case", BREAKING, ids=str)
def test_a_broken_rule_is_found(case: Case) -> None:
    with broken(case) as (_, found):
        assert len(found) == case.times
        for finding in found:
            assert (finding.severity, finding.page) == (RULES[case.rule].severity, RULES[case.rule].page)
            assert finding.addresses
            assert not re.search(r"[{}?]", finding.message), "every name of the message has its value"


@pytest.mark.parametrize("case", [case for case in CASES if case.holds is not None], ids=str)
def test_a_rule_that_just_holds_says_nothing(case: Case) -> None:
    file = machine(case.of)
    change(file, case.given)
    change(file, case.holds or {})
    assert findings(file, case.rule) == []


@pytest.mark.parametrize("case", [case for case in BREAKING if RULES[case.rule].fix], ids=str)
def test_the_repairs_of_a_rule_mend_it(case: Case) -> None:
    with broken(case) as (file, found):
        assert found[0].repairs
        for finding in found:
            for repair in finding.repairs:
                file.set(repair.address, repair.value)
        assert findings(file, case.rule) == []


# -- the cases are sharp: a rule changed in one place no longer gives what they say ---------------------------------

FLIPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
PLACE = re.compile(r"<=|>=|==|!=|&&|\|\||<|>|(?<![\w.\[])\d+\.\d+|'[^']*'")


def mutants(rule: Rule) -> Iterator[Rule]:
    """Yield a rule with one operator, one number or one choice changed after the other."""
    for part in ("check", "when"):
        text = " ".join(getattr(rule, part).split())
        for found in PLACE.finditer(text):
            before, after = text[: found.start()], text[found.end() :]
            other = (
                "'other'" if found[0].startswith("'") else FLIPS.get(found[0]) or repr(float(found[0]) + 1)
            )
            if other == "<=" and after.startswith(" size("):
                continue  # one position more is an error of the index, which exists() passes over
            yield rule.model_copy(update={part: before + other + after})


def times_broken(file: ParameterFile, rule: Rule) -> int:
    checks = RuleChecks(file, file.machine)
    return sum(checks.finding(check) is not None for check in checks_of(file.situation, (rule,)))


@pytest.mark.parametrize("rule", RULES)
def test_no_mutant_of_a_rule_passes_its_cases(rule: str) -> None:
    """A rule changed in one place no longer gives what the cases say, or speaks on a sound machine."""
    alive = list(mutants(RULES[rule]))
    stands = [(machine(name), 0) for name in ("generic", "serial")]
    for case in (case for case in CASES if case.rule == rule):
        for texts, times in (({}, 0), (case.breaks, case.times), (case.holds, 0)):
            if texts is not None:
                file = machine(case.of)
                change(file, case.given)
                change(file, texts)
                stands.append((file, times))
    for file, times in stands:
        alive = [mutant for mutant in alive if times_broken(file, mutant) == times]
    assert [(mutant.check, mutant.when) for mutant in alive] == [], "add a case that tells them from the rule"


def test_an_axis_without_a_port_is_not_looked_at() -> None:
    """Section 1.1: an axis is activated by its port; 0 is taken for none."""
    file = machine("generic")
    file.set(("resolution.encoder", "5"), Value(0))
    assert Validator(file).run() == ()
    file.set(("axis.port", "5"), Value(5))
    assert findings(file, "syntec.resolution.encoder-zero") != []


def test_jog_far_above_the_limit_is_the_fatal_alarm() -> None:
    """Sections 1.5.3 and 1.5.4: twice the error is MOT-019, four times MOT-023."""
    file = machine("generic")
    for speed, alarm in ((96000, "MOT-019"), (96001, "MOT-023")):
        file.set(("jog.feedrate", "1"), Value(speed, "mm/min"))
        assert alarm in findings(file, "syntec.servo.jog-behind")[0].message


def test_the_dda_limit_is_told_with_its_time() -> None:
    """Section 1.4.2: 1966usec and 62.472 m/min."""
    file = machine("generic")
    file.set(("feed.rapid", "3"), Value(70000, "mm/min"))
    (finding,) = findings(file, "syntec.dda.rapid")
    assert "of 1966 µs" in finding.message
    assert "The limit is 62472 mm/min." in finding.message
    assert [repair.value for repair in finding.repairs] == [Value(62472, "mm/min")]
