"""A rule may ask for the model of the control, and asks again when the file is given to another one."""

from amp_studio.files import new_file
from amp_studio.schema import Rule
from amp_studio.validate import BuilderRules, Validator

RULE = Rule.model_validate(
    {
        "id": "num.try.model",
        "title": "One of the controls",
        "severity": "advice",
        "reads": {"blocks": "misc.backup_blocks"},
        "when": "application == '1060 UCSII'",
        "check": "blocks < 2.0",
        "message": "{blocks} blocks on a {application}.",
        "page": "9-30",
    }
)


def test_a_rule_may_hold_for_one_model_of_the_control_only() -> None:
    file = new_file("num")
    validator = Validator(file, BuilderRules((RULE,)))

    def message() -> list[str]:
        return [finding.message for finding in validator.findings() if finding.rule == RULE.id]

    blocks = file.find("P114N0")
    file.set(blocks, file.read(blocks, "2"))
    validator.run()
    assert message() == []
    file.header.application = "1060 UCSII"
    validator.update([blocks])
    assert message() == ["2 blocks on a 1060 UCSII."]
    file.header.application = "1040"
    validator.run()
    assert message() == []
