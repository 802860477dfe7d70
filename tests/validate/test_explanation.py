"""Why a finding is there."""

import contextlib
import re

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import why_text
from amp_studio.schema import InvalidValueError, Rule, Value, load_schema
from amp_studio.validate import BuilderRules, Explanation, Validator, explain
from tests.campaigns import CAMPAIGN, some

RAPID = ("feedrate.rapid", "1")


def why(file: ParameterFile, rule: str, own: BuilderRules = BuilderRules()) -> Explanation:  # noqa: B008  # frozen
    """Return the explanation of the first finding of a rule."""
    validator = Validator(file, own)
    finding = next(finding for finding in validator.run() if finding.rule == rule)
    return explain(validator, finding)


def test_the_values_stand_in_the_place_of_the_names(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(10000.0, "mm/min"))
    mill.set(RAPID, Value(9000.0, "mm/min"))
    reported = why(mill, "9pc.home.g28-speed-above-rapid")
    assert (reported.demand, reported.with_values) == ("speed <= rapid", "10000 mm/min <= 9000 mm/min")
    assert [(s.name, s.address, s.value) for s in reported.seen] == [
        ("speed", ("home.g28_speed", "1"), "10000 mm/min"),
        ("rapid", RAPID, "9000 mm/min"),
    ]


def rule(**words: object) -> Rule:
    """Return a rule of a builder's own about the rapid feedrate."""
    given = {
        "id": "own.rule",
        "title": "Own",
        "severity": "warning",
        "reads": {"rapid": "feedrate.rapid"},
        "check": "rapid < 1.0",
        "message": "no",
        "page": "1",
    }
    return Rule.model_validate(given | words)


def test_what_a_side_comes_to_is_worked_out(mill) -> None:
    mill.set(RAPID, Value(9000.0, "mm/min"))
    reported = why(mill, "own.rule", BuilderRules((rule(check="rapid * 2.0 < max(3.0, 4.0) * 10.0"),)))
    assert reported.sides == (("rapid * 2.0", "18000"), ("max(3.0, 4.0) * 10.0", "40"))


@pytest.mark.parametrize(
    "check", ["rapid < 1.0 && rapid > 2.0", "rapid == 1.0 ? true : rapid < 1.0", "false"]
)
def test_only_a_plain_comparison_has_two_sides(mill, check: str) -> None:
    assert why(mill, "own.rule", BuilderRules((rule(check=check),))).sides == ()


def test_lists_choices_and_words_of_the_machine_are_put_in(mill) -> None:
    reported = why(
        mill,
        "own.rule",
        BuilderRules(
            (
                rule(
                    reads={"types": "axis.type@*", "type": "axis.type@1"},
                    check=(
                        "machine == 'lathe' && type == 'type' && types.exists(t, t == 'none') // in two\n||"
                        " false"
                    ),
                ),
            )
        ),
    )
    assert reported.with_values.startswith("mill == 'lathe' && 'linear' == 'type' && ['linear', ")
    assert reported.with_values.endswith("].exists(t, t == 'none') || false")


def test_a_range_is_explained_by_what_bounds_it(mill) -> None:
    mill.set(("feedrate.max_cutting", "1"), Value(20000.0, "mm/min"))
    reported = why(mill, "schema.range")
    assert reported.title == "A value outside its range"
    assert [s.address for s in reported.seen] == [("feedrate.max_cutting", "1"), RAPID]


def test_values_that_are_not_set_are_listed(mill) -> None:
    mill.set(RAPID, None)
    assert ("not set", RAPID) in [(s.value, s.address) for s in why(mill, "schema.unset").seen]


def test_an_inactive_value_is_shown_with_the_word_for_its_state_and_the_reason(mill) -> None:
    """Axis 3 has a linear scale and so no reversal error; the code of the state is 'unusable',
    which nobody reads.
    """
    own = rule(reads={"reversal": "servo.reversal_error"}, check="reversal < 0.0", any_state=["reversal"])
    validator = Validator(mill, BuilderRules((own,)))
    (finding,) = (f for f in validator.run() if (f.rule, f.instance) == ("own.rule", "3"))
    text = why_text(mill, finding, explain(validator, finding))
    assert re.search(r"Reads +reversal = \S+ mm \(not available: .+\): 3340 Reversal", text), text


@pytest.mark.parametrize("family", some(["9pc", "num", "syntec", "57c422b", "acromill"], 2))
def test_every_finding_of_a_machine_with_nothing_right_can_be_explained(family: str) -> None:
    """Whatever is in a file, each finding has its words; ``make test`` has it in one value of five."""
    file = ParameterFile(load_schema(family))
    for n, address in list(enumerate(file.addresses()))[:: 1 if CAMPAIGN else 5]:
        parameter = file.schema.parameters[address[0]]
        if parameter.access != "read":
            with contextlib.suppress(InvalidValueError):
                file.set(address, Value("raw:999") if parameter.choices else Value(n * 7 - 900))
    validator = Validator(file)
    findings = validator.run()
    assert len({finding.rule for finding in findings}) > 2
    for finding in findings[:: max(1, len(findings) // (200 if CAMPAIGN else 40))]:
        text = why_text(file, finding, explain(validator, finding))
        assert finding.rule in text
