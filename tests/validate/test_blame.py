"""What a finding is about: what is wrong first, then what it was compared with, and nothing that is
innocent.
"""

from collections import defaultdict
from collections.abc import Iterator
from itertools import product

import pytest
from rule_machines import FAMILIES, cases, trial_machine

from amp_studio.files import ParameterFile
from amp_studio.report import finding_json
from amp_studio.schema import Address, Rule, Value, load_schema
from amp_studio.validate import BuilderRules, Finding, Validator
from amp_studio.validate.expressions import RuleError
from amp_studio.validate.plan import RuleCheck, checks_of
from amp_studio.validate.rules import RuleChecks
from tests.campaigns import some

ALWAYS_SO = {
    ("57c422b.command.leds-twice", "leds", False),  # there are two axes, and both are at fault
    ("57c422b.control.geared-to-each-other", "modes", False),
}
"""Conditions that cannot be met, or not be missed, in a file: rule, name, and which of the two."""
PARTS = {"blames": "causes", "compares": "compared"}
"""Part of a rule with conditions -> the field of a finding that they decide."""


def found(family: str, machine: str, changes: dict[str, str | None], rule: str, given: str = "") -> Finding:
    """Return the one finding of a rule after changes; ``given`` is another model of the control."""
    here = trial_machine(family, machine, given)
    with here.changed(changes):
        (finding,) = here.of(rule)
    return finding


def named(*addresses: str) -> tuple[tuple[str, str], ...]:
    """Return addresses that are written ``id@instance``."""
    return tuple((name, instance) for name, _, instance in (text.partition("@") for text in addresses))


def test_of_many_inputs_only_those_that_the_control_does_not_have_are_wrong() -> None:
    """An ACR2000 has inputs 0 to 15; the home switches are a list."""
    finding = found(
        "acromill",
        "router",
        {
            "home.switch_input@X": "16",
            "home.switch_input@Y": "8",
            "home.switch_input@Z": "9",
            "spindle.at_speed_input": "12",
            "io.block_skip_input": "17",
        },
        "acromill.io.acr2000-inputs",
        given="ACR2000",
    )
    assert finding.causes == named("io.block_skip_input@", "home.switch_input@X")
    assert ("home.switch_input", "Y") not in finding.addresses
    assert finding.compared == named("control.io_expansion_modules@")


def test_the_first_point_of_a_cam_is_named_and_the_setup_that_only_decides_whether_it_counts_comes_last() -> (
    None
):
    changes = {"setup.encoder@Y": "0x0404", "cam.position_points@Y.0": "1 counts"}
    finding = found("57c422b", "module", changes, "57c422b.cam.first-point-zero")
    assert finding.causes == named("cam.position_points@Y.0")
    assert finding.compared == named("setup.encoder@Y")


def test_a_gap_between_speed_ranges_lies_between_the_two_words_that_leave_it() -> None:
    finding = found("num", "three-groups", {"spindle.range_min@1.41": "102 rpm"}, "num.spindle.range-gap")
    assert finding.causes == named("spindle.range_min@1.41", "spindle.range_max@1.40")


def test_a_range_that_ends_at_its_limit_speed_leaves_the_gap_with_that() -> None:
    finding = found("num", "three-groups", {"spindle.limit_speed@1.41": "398 rpm"}, "num.spindle.range-gap")
    assert finding.causes == named("spindle.range_min@1.42", "spindle.limit_speed@1.41")


@pytest.mark.parametrize(
    ("rule", "changes", "compared"),
    [
        (
            "9pc.tapping.excess-error",
            {"spindle.gain@2.1": "11.9"},
            named("tapping.max_speed@2.1", "spindle.gain@2.1"),
        ),
        (
            "9pc.spindle.orient-excess-error",
            {"spindle.orient_speed@2": "833.4 rpm"},
            named("spindle.orient_speed@2", "spindle.gain@2.1"),
        ),
    ],
)
def test_the_excess_error_of_the_spindle_is_wrong_and_its_speed_and_gain_are_what_it_is_compared_with(
    rule: str, changes: dict[str, str | None], compared: tuple[tuple[str, str], ...]
) -> None:
    finding = found("9pc", "lathe", changes, rule)
    assert (finding.causes, finding.compared) == (named("servo.excess_error@5"), compared)


@pytest.mark.parametrize(
    ("family", "machine", "changes", "rule", "causes"),
    [
        ("acromill", "router", {"speeds.cut": "0"}, "acromill.speeds.zero", ["speeds.cut@"]),
        (
            "9pc",
            "mill",
            {"jog.increment_third@1": "0.01 mm"},
            "9pc.jog.increment-equal",
            ["jog.increment_third@1"],
        ),
        (
            "9pc",
            "router",
            {"deskew.master@1": "x", "deskew.slave@1": "v", "home.position@7": "1 mm"},
            "9pc.deskew.slave-takes-over",
            ["home.position@7"],
        ),
        (
            "9pc",
            "mill",
            {"servo.analog_negative_voltage@6": "1 V", "servo.analog_positive_voltage@6": "10 V"},
            "9pc.servo.voltage-signs",
            ["servo.analog_negative_voltage@6"],
        ),
    ],
)
def test_a_value_that_is_as_it_should_be_is_not_named(
    family: str, machine: str, changes: dict[str, str | None], rule: str, causes: list[str]
) -> None:
    finding = found(family, machine, changes, rule)
    assert finding.causes == named(*causes)


def test_a_name_twice_is_wrong_where_it_comes_second_and_the_first_is_named_after_it() -> None:
    finding = found("9pc", "mill", {"axis.name@6": "b"}, "9pc.axis.name-duplicate")
    assert (finding.causes, finding.compared) == (named("axis.name@6"), named("axis.name@4", "axis.type@6"))


def test_the_parameter_that_sets_a_bound_is_named_after_the_value_and_with_its_own(mill) -> None:
    mill.set(("feedrate.rapid", "1"), Value(5000.0, "mm/min"))
    finding = next(f for f in Validator(mill).run() if f.rule == "schema.range")
    assert (finding.causes, finding.compared) == (named("feedrate.max_cutting@1"), named("feedrate.rapid@1"))
    assert finding.message.endswith("(set by 1203 Rapid Feedrate for Positioning, 5000 mm/min).")
    assert finding_json(mill, finding)["params"] == ["1201", "1203"]
    assert finding_json(mill, finding)["compared"] == ["1203"]


def test_a_value_beyond_a_bound_of_its_own_names_no_other_parameter(mill) -> None:
    mill.set(("feedrate.max_cutting", "1"), Value(-1.0, "mm/min"))
    finding = next(f for f in Validator(mill).run() if f.rule == "schema.range")
    assert finding.compared == ()


def own(mill, **parts: object) -> Finding:
    """Return what a builder's rule finds in a mill."""
    rule = Rule(
        id="own.pair",
        title="t",
        severity="warning",
        message="m",
        page="1",
        reads={"rapid": "feedrate.rapid@1", "slow": "home.speed_off_switch@1", "type": "axis.type@1"},
        when="type == 'linear'",
        check="slow > rapid",
        **parts,
    )
    return next(f for f in Validator(mill, BuilderRules((rule,))).run() if f.rule == "own.pair")


def test_a_rule_that_shows_nothing_blames_the_first_it_reads_and_ends_with_what_decides_whether_it_counts(
    mill,
) -> None:
    finding = own(mill)
    assert finding.causes == named("feedrate.rapid@1")
    assert finding.compared == named("home.speed_off_switch@1", "axis.type@1")


def test_a_rule_may_say_what_is_wrong(mill) -> None:
    finding = own(mill, blames=["slow", "rapid"])
    assert finding.causes == named("home.speed_off_switch@1", "feedrate.rapid@1")


def test_where_no_condition_is_met_all_that_were_named_are_wrong(mill) -> None:
    finding = own(mill, blames={"slow": "it < 0.0", "rapid": "it == 'text'"})
    assert finding.causes == named("home.speed_off_switch@1", "feedrate.rapid@1")


@pytest.mark.parametrize(
    "wrong", [{"blames": ["fast"]}, {"blames": {"slow": "fast > 1.0"}}, {"compares": {"slow": "it >"}}]
)
def test_a_slip_in_what_a_rule_blames_is_a_fault_of_the_rule(mill, wrong: dict[str, object]) -> None:
    with pytest.raises(RuleError, match=r"own\.pair"):
        own(mill, **wrong)


@pytest.mark.parametrize("family", some(FAMILIES))
def test_every_condition_is_met_by_one_value_of_the_cases_and_missed_by_another(family: str) -> None:
    """So none is always true, never true, or misspelt into a value of another kind."""
    rules = {rule.id: rule for rule in load_schema(family).rules}
    conditions = {
        (part, rule.id, name)
        for part in PARTS
        for rule in rules.values()
        for name, text in getattr(rule, part).items()
        if text != "true"
    }
    seen: dict[tuple[str, str, str], set[bool]] = defaultdict(set)
    for case in cases(family):
        rule = rules[case.rule]
        parts = [part for part in PARTS if getattr(rule, part)]
        if case.breaks is None or not parts:
            continue
        with case.machine.changed(case.given), case.machine.changed(case.breaks):
            for check, finding in found_by(rule, case.machine.file):
                for part, (name, addresses) in product(parts, read_by(check)):
                    about = getattr(finding, PARTS[part])
                    seen[part, case.rule, name].update(address in about for address in addresses)
    missing = {(*at, wanted) for at in conditions for wanted in (True, False) if wanted not in seen[at]}
    assert {at[1:] for at in missing} - ALWAYS_SO == set()


def found_by(rule: Rule, file: ParameterFile) -> Iterator[tuple[RuleCheck, Finding]]:
    """Yield the findings of a rule in a file, each with the check that it is of."""
    values = RuleChecks(file, file.machine)
    for check in checks_of(file.evaluation, (rule,)):
        if (finding := values.finding(check)) is not None:
            yield check, finding


def read_by(check: RuleCheck) -> list[tuple[str, tuple[Address, ...]]]:
    """Return what the names of a rule read in a check."""
    singles = [(single.name, (single.address,)) for single in check.singles]
    return [*singles, *((name, listed.addresses) for name, listed in check.lists)]
