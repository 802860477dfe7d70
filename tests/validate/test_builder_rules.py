"""A machine builder's own rules and suppressions beside his files."""

from __future__ import annotations

import os
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value, load_schema
from amp_studio.validate import Finding, Setting, Validator, read_builder_rules, rules_beside, suppress

RAPID = ("feedrate.rapid", "1")
OWN_RULE = """
rules:
  - id: builder.rapid
    title: Rapid of this machine
    severity: warning
    reads: {rapid: feedrate.rapid}
    check: rapid <= 10000.0
    message: "Rapid {rapid} is more than the screws of this machine bear."
    fix:
      - {set: rapid, value: "10000.0"}
"""


@pytest.fixture
def mill(machine) -> ParameterFile:
    """Return a sound mill of its own, whose rapid is 12000 mm/min on seven axes."""
    return machine("mill")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the rules of a builder lie."""
    return tmp_path / "rules.yaml"


def faults(path: Path, text: str, file: ParameterFile) -> list[str]:
    """Return what is wrong with a file of rules."""
    path.write_text(text, encoding="utf-8")
    read = read_builder_rules(path, file.schema)
    assert all((f.rule, f.severity) == ("rules.unusable", "error") for f in read.faults)
    return [finding.message for finding in read.faults]


def of(findings: tuple[Finding, ...], rule: str) -> list[Finding]:
    """Return the findings of one rule."""
    return [finding for finding in findings if finding.rule == rule]


def test_a_machine_builder_adds_rules(mill, path: Path) -> None:
    path.write_text(OWN_RULE, encoding="utf-8")
    validator = Validator(mill, rules_beside(path.with_name("mill.amp"), mill.schema))
    own = of(validator.run(), "builder.rapid")
    assert len(own) == 7
    assert own[0].message == "Rapid 12000 mm/min is more than the screws of this machine bear."
    assert own[0].repairs == (Setting(RAPID, Value(10000.0, "mm/min")),)
    mill.set(RAPID, Value(10000.0, "mm/min"))
    assert len(of(validator.update([RAPID]), "builder.rapid")) == 6
    assert of(Validator(mill).run(), "builder.rapid") == [], "another validator does not know it"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("severity: warning", "severity: fatal", "line 5: builder.rapid: severity: Input should be"),
        ("check: ", "chek: ", "line 3: builder.rapid: check: Field required"),
        ("title: Rapid of this machine", "title: 1", "line 4: builder.rapid: title: Input should be a valid str"),
        ("rules:", "rules: [", "line 3: is not readable: did not find expected"),
        ("rules:", "rule:", "line 2: rule: here stand rules, suppressions"),
        ("feedrate.rapid}", "feedrate.rapids}", "line 3: rule builder.rapid: reads 'feedrate.rapids', which the"),
        ("<= 10000.0", "<=", "line 3: rule builder.rapid: check: "),
        ("id: builder.rapid", "id: 9pc.feedrate.rapid-zero", ""),
        ("rules:", "suppressions: [{rule: builder.rapid, by: me}]\nrules:", "line 2: reason: Field required"),
        ("rules:", "suppressions: [{rule: builder.rapids, by: me, reason: why}]\nrules:",
         "line 2: suppresses 'builder.rapids', which is no rule"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_a_finding_with_file_and_line(
    mill, path: Path, old: str, new: str, said: str
) -> None:
    assert old in OWN_RULE
    if not said:
        new, said = (
            f"id: {mill.schema.rules[0].id}",
            f"line 3: rule {mill.schema.rules[0].id}: there are two rules",
        )
    (told,) = faults(path, OWN_RULE.replace(old, new), mill)
    assert told.startswith(f"rules.yaml, {said}")


def test_one_wrong_rule_hides_neither_the_others_nor_the_family_s(mill, path: Path) -> None:
    wrong = (
        OWN_RULE.replace("builder.rapid", "builder.wrong").replace("<= ", "=< ").removeprefix("\nrules:\n")
    )
    path.write_text(OWN_RULE + wrong, encoding="utf-8")
    mill.set(("home.g28_speed", "1"), Value(10161.0, "mm/min"))
    findings = Validator(mill, read_builder_rules(path, mill.schema)).run()
    assert findings[0].rule == "rules.unusable"
    assert len(of(findings, "builder.rapid")) == 7
    assert of(findings, "schema.range") == of(Validator(mill).run(), "schema.range") != []


@pytest.mark.parametrize("text", ["", "# nothing yet\n", "rules: []\n"])
def test_a_file_without_rules_is_no_fault(mill, path: Path, text: str) -> None:
    assert faults(path, text, mill) == []


def test_a_rule_for_another_family_is_left_to_it(mill, path: Path) -> None:
    other = OWN_RULE.replace("severity:", "family: num\n    severity:").replace(
        "feedrate.rapid", "axes.rapid"
    )
    other += "suppressions:\n  - {rule: num.axes.anything, reason: looked at, by: J. Doe}\n"
    assert faults(path, other, mill) == []
    assert Validator(mill, read_builder_rules(path, mill.schema)).run() == ()


@pytest.mark.parametrize(
    ("params", "left"), [([], 7), (["1203"], 1), (["feedrate.rapid@2"], 1), (["feedrate.rapid"], 7)]
)
def test_a_finding_is_suppressed_for_all_or_for_named_parameters(
    mill, path: Path, params: list[str], left: int
) -> None:
    path.write_text(OWN_RULE, encoding="utf-8")
    suppress(path, "builder.rapid", params, reason="the screws were changed", by="J. Doe")
    validator = Validator(mill, read_builder_rules(path, mill.schema))
    assert len(of(validator.run(), "builder.rapid")) == 7 - left
    assert len(validator.suppressed) == left
    assert validator.suppressed[0].suppression.by == "J. Doe"


def test_a_suppression_that_meets_nothing_is_told(mill, path: Path) -> None:
    path.write_text(OWN_RULE.replace("10000.0\n", "90000.0\n"), encoding="utf-8")
    suppress(path, "builder.rapid", [], reason="the screws were changed", by="J. Doe")
    (finding,) = Validator(mill, read_builder_rules(path, mill.schema)).run()
    assert (finding.rule, finding.severity) == ("rules.unused", "advice")


def test_a_suppression_is_added_and_the_rest_of_the_file_stays(path: Path) -> None:
    path.write_text("# ours\n" + OWN_RULE, encoding="utf-8")
    suppress(path, "builder.rapid", ["1203"], reason=" the screws were changed ", by="J. Doe")
    text = path.read_text(encoding="utf-8")
    assert text.startswith("# ours\n")
    assert 'message: "Rapid {rapid} is more than' in text
    assert "reason: the screws were changed\n" in text


@pytest.mark.parametrize(("reason", "by"), [("", "J. Doe"), ("why", "  ")])
def test_a_suppression_without_reason_or_name_is_refused(path: Path, reason: str, by: str) -> None:
    path.write_text(OWN_RULE, encoding="utf-8")
    with pytest.raises(ValueError, match="needs a reason and a name"):
        suppress(path, "builder.rapid", [], reason=reason, by=by)
    assert path.read_text(encoding="utf-8") == OWN_RULE


def test_the_page_about_rules_of_your_own_shows_a_file_that_works(
    checkout: Path, machine, path: Path
) -> None:
    page = (checkout / "docs" / "rules.md").read_text(encoding="utf-8")
    block = page[page.index("    rules:\n") : page.index("\n## A rule")]
    path.write_text(dedent(block), encoding="utf-8")
    lathe = machine("lathe")
    own = read_builder_rules(path, lathe.schema)
    assert (own.faults, len(own.rules), len(own.suppressions)) == ((), 1, 1)
    lathe.set(RAPID, Value(20000.0, "mm/min"))
    (finding,) = of(Validator(lathe, own).run(), "works.lathe-rapid")
    assert finding.message == "Rapid of axis 1 is 20000 mm/min; our lathes are built for 15000 mm/min."
    assert finding.repairs == (Setting(RAPID, Value(15000.0, "mm/min")),)
    assert of(Validator(machine("mill"), own).run(), "works.lathe-rapid") == []


@pytest.mark.parametrize("kind", ["pipe", "folder", "endless", "loop", "nowhere"])
def test_rules_that_are_no_file_are_a_finding_at_once(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "rules.yaml"
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "endless":
            path.symlink_to("/dev/zero")
        case "loop":
            path.symlink_to(path)
        case "nowhere":
            path.symlink_to("nothing")
    machine = tmp_path / "machine.amp"
    machine.touch()
    found = rules_beside(machine, load_schema("9pc")).faults
    assert [fault.rule for fault in found] == ["rules.unusable"]
    assert found[0].message.startswith("rules.yaml: ")
