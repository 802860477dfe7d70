"""What is found about a secret is shown without it: in messages, reasons and fixes,
a builder's own rules too.
"""

import json

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import finding_json, finding_text, why_text
from amp_studio.schema import MASKED, Rule, Value
from amp_studio.validate import BuilderRules, Validator, explain
from tests.campaigns import some

PASSWORD = ("password.character", "1")


@pytest.fixture
def mill(machine) -> ParameterFile:
    """Return a separate sound mill, with a figure in its password that is found nowhere else."""
    file = machine("mill")
    file.set(PASSWORD, Value(7654321))
    return file


def reported(file: ParameterFile, rule: str, own: BuilderRules = BuilderRules()) -> str:  # noqa: B008  # frozen
    """Return all texts of the findings of a rule."""
    validator = Validator(file, own)
    findings = [f for f in validator.run() if f.rule == rule]
    assert findings
    return "\n".join(
        f"{finding_text(file, f)} {json.dumps(finding_json(file, f))}"
        f" {why_text(file, f, explain(validator, f))}"
        for f in findings
    )


def rule(**words: object) -> BuilderRules:
    given = {
        "id": "own.rule",
        "title": "Own",
        "severity": "warning",
        "message": "no",
        "page": "1",
        "check": "code < 1.0",
        "reads": {"code": "password.character@1", "other": "home.calibration@1"},
    }
    return BuilderRules((Rule.model_validate(given | words),))


def test_a_password_out_of_range_is_found_and_not_written(mill) -> None:
    message = reported(mill, "schema.range")
    assert f"{MASKED} is outside 32 to 95" in message
    assert "7654321" not in message


def test_no_password_that_was_not_chosen_is_offered(mill) -> None:
    (finding,) = (f for f in Validator(mill).run() if f.rule == "schema.range")
    assert finding.fix == ()


@pytest.mark.parametrize(
    "words",
    some(
        [
            {"message": "{code}"},
            {"message": "{twice}", "values": {"twice": "code * 2.0"}},
            {"message": "{digits}", "values": {"digits": "string(int(code))"}},
            {"fix": [{"set": "other", "value": "code"}], "check": "other == code"},
            {"effective": [{"set": "other", "value": "code"}]},
            {"check": "code * 1.0 < other + 0.0"},
            {"reads": {"all": "password.character@*"}, "message": "{all}", "check": "all[0] < 1.0"},
        ],
        2,
    ),
)
def test_a_rule_that_reads_a_password_does_not_report_it(mill, words: dict[str, object]) -> None:
    message = reported(mill, "own.rule", rule(**words))
    assert "7654321" not in message
    assert "15308642" not in message


def test_a_rule_may_still_set_a_password(mill) -> None:
    own = rule(check="code == 66.0", fix=[{"set": "code", "value": "66.0"}])
    (finding,) = (f for f in Validator(mill, own).run() if f.rule == "own.rule")
    assert [(r.address, r.value) for r in finding.fix] == [(PASSWORD, Value(66))]
    assert finding_json(mill, finding)["fix"] == [{"param": "101", "value": None, "secret": True}]


def test_the_factory_password_is_found_without_its_letters_or_codes(machine) -> None:
    mill = machine("mill")
    for instance in "123456":
        mill.set(("password.character", instance), mill.default(("password.character", instance)))
    message = reported(mill, "9pc.password.factory-setting")
    assert "factory setting" in message
    assert not any(code in message for code in ("AB-D4", "66", "65.0", "45"))
