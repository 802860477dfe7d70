"""A machine builder's own rules and suppressions beside his files."""

import os
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.atomic import SaveError
from amp_studio.report import finding_text, why_text
from amp_studio.schema import Value, load_schema
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.validate import (
    AddressedValue,
    Finding,
    Validator,
    explain,
    read_builder_rules,
    rules_beside,
    suppress,
)

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
    validator = Validator(mill, rules_beside(path.with_name("mill.amp"), mill))
    own = of(validator.run(), "builder.rapid")
    assert len(own) == 7
    assert own[0].message == "Rapid 12000 mm/min is more than the screws of this machine bear."
    assert own[0].fix == (AddressedValue(RAPID, Value(10000.0, "mm/min")),)
    mill.set(RAPID, Value(10000.0, "mm/min"))
    assert len(of(validator.update([RAPID]), "builder.rapid")) == 6
    assert of(Validator(mill).run(), "builder.rapid") == [], "another validator does not know it"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "severity: warning",
            "severity: fatal",
            "line 5: builder.rapid: severity: 'fatal' is not 'error', 'warning' or 'advice'.",
        ),
        (
            "severity: warning",
            "severity: waring",
            (
                "line 5: builder.rapid: severity: 'waring' is not 'error', 'warning' or 'advice', did you"
                " mean 'warning'?"
            ),
        ),
        ("check: ", "chek: ", "line 7: builder.rapid: chek: there is no such key, did you mean 'check'?"),
        ("    check: rapid <= 10000.0\n", "", "line 3: builder.rapid: check: is missing."),
        (
            "title: Rapid of this machine",
            "title: 1",
            "line 4: builder.rapid: title: must be a text: put '1' in quotes.",
        ),
        (
            "id: builder.rapid",
            "id: Builder rapid",
            "line 3: Builder rapid: id: 'Builder rapid' is no id: small letters",
        ),
        ("rules:", "rules: [", "line 3: "),
        ("rules:", "rule:", "line 2: rule: this file contains only rules, suppressions."),
        (
            "feedrate.rapid}",
            "feedrate.rapids}",
            (
                "line 6: builder.rapid: reads rapid: 'feedrate.rapids' is no parameter of 9pc, did you mean"
                " 'feedrate.rapid'?"
            ),
        ),
        ("severity:", "family: 9pc\n    severity:", ""),
        ("severity:", "family: 9PC\n    severity:", "line 5: builder.rapid: family: '9PC' is no family"),
        (
            "feedrate.rapid}",
            "feedrate.rapid@9}",
            (
                "line 6: builder.rapid: reads rapid: Rapid Feedrate for Positioning has no instance '9'; it"
                " has 1, 2, 3, 4, 5, 6, 7, 8."
            ),
        ),
        (
            "{rapid: feedrate",
            "{loop: axis.type, rapid: feedrate",
            "line 6: builder.rapid: reads loop: 'loop' is a word of the language and can be no name.",
        ),
        ("<= 10000.0", "<=", "line 7: builder.rapid: check: a value is missing behind '<=' at the end."),
        ("<= 10000.0", "= 10000.0", "line 7: builder.rapid: check: '=' is no operator: write '=='."),
        (
            "check: rapid",
            "check: rapit",
            "line 7: builder.rapid: check: 'rapit' is not read: add it under reads, or did you mean 'rapid'?",
        ),
        (
            "<= 10000.0",
            "* 2 <= 10000.0",
            "line 7: builder.rapid: check: 'rapid * 2' mixes a whole number with a decimal one: write 2.0.",
        ),
        (
            "check: rapid <=",
            "check: maxi(rapid, 1.0) <=",
            "line 7: builder.rapid: check: 'maxi' is no function, did you mean 'max'?",
        ),
        (
            "check: rapid <=",
            "check: max(rapid) <=",
            "line 7: builder.rapid: check: max takes 2 values, not 1.",
        ),
        (" <= 10000.0", "", "line 7: builder.rapid: check: it does not give true or false."),
        (
            "Rapid {rapid} is",
            "Rapid {rapit} is",
            (
                "line 8: builder.rapid: message: {rapit} is neither read nor among its values, did you mean"
                " 'rapid'?"
            ),
        ),
        (
            "Rapid {rapid} is",
            "Rapid {rapid:>1000000000} is",
            "line 8: builder.rapid: message: {rapid} is shown as it is: leave out what comes after the name.",
        ),
        (
            "{set: rapid,",
            "{set: rapt,",
            "line 10: builder.rapid: fix 1 set: 'rapt' is not read, did you mean 'rapid'?",
        ),
        (
            'value: "10000.0"',
            "value: 10000.0",
            "line 10: builder.rapid: fix 1 value: must be a text: put '10000.0' in quotes.",
        ),
        (
            'value: "10000.0"',
            "value: \"'fast'\"",
            (
                "line 10: builder.rapid: fix 1 value: it does not give a number for Rapid Feedrate for"
                " Positioning."
            ),
        ),
        (
            "id: builder.rapid",
            "id: 9pc.axis.consecutive",
            "line 3: 9pc.axis.consecutive: id: a rule of 9pc has this id already.",
        ),
        ("rules:", "suppressions: [{rule: builder.rapid, by: me}]\nrules:", "line 2: reason: is missing."),
        (
            "rules:",
            "suppressions: [{rule: builder.rapids, by: me, reason: why}]\nrules:",
            "line 2: rule: 'builder.rapids' is no rule, did you mean 'builder.rapid'?",
        ),
        (
            "rules:",
            "suppressions: [{rule: builder.rapid, params: [feedrate.rapit], by: me, reason: why}]\nrules:",
            "line 2: params 1: 'feedrate.rapit' is no parameter of 9pc, did you mean 'feedrate.rapid'?",
        ),
    ],
)
def test_what_cannot_be_used_is_a_finding_with_file_and_the_line_of_the_field(
    mill, path: Path, old: str, new: str, message: str
) -> None:
    assert old in OWN_RULE
    reported = faults(path, OWN_RULE.replace(old, new), mill)
    assert [one.startswith(f"rules.yaml, {message}") for one in reported] == ([True] if message else [])


def test_all_slips_of_an_entry_are_reported_at_once(mill, path: Path) -> None:
    wrong = OWN_RULE.replace("warning", "fatal").replace("<= 10000.0", "<= rapit && rapid == 'fast'")
    wrong = wrong.replace("{rapid} is", "{rapit} is").replace('"10000.0"', "7")
    assert [
        reported.split(": ")[0] + ": " + reported.split(": ")[2] for reported in faults(path, wrong, mill)
    ] == [
        "rules.yaml, line 5: severity",
        "rules.yaml, line 7: check",
        "rules.yaml, line 7: check",
        "rules.yaml, line 8: message",
        "rules.yaml, line 10: fix 1 value",
    ]


CHOICE = """
rules:
  - id: works.choice
    title: A choice
    severity: advice
    reads: {baud: servo.sercos_baud, type: axis.type, types: axis.type@*}
    check: CHECK
    message: no
"""


@pytest.mark.parametrize(
    ("check", "message"),
    [
        ("baud == '4 MHz'", "'baud' is never '4 MHz': write the key 'mhz4'"),
        ("'4 mhz' != baud", "'baud' is never '4 mhz': write the key 'mhz4'"),
        ("baud in ['mhz2', 'mhz5']", "'baud' is never 'mhz5': write a key, did you mean 'mhz4'?"),
        ("types.exists(t, t == 'Linear')", "'t' is never 'Linear': write the key 'linear'"),
        ("types[0] == 'rotery'", "'types[0]' is never 'rotery': write a key, did you mean 'rotary'?"),
        ("'lineal' in types", "'types' is never 'lineal': write a key, did you mean 'linear'?"),
        (
            "type == (machine == 'mill' ? 'linear' : 'round')",
            "'type' is never 'round': its keys are linear, rotary, spindle, unfitted",
        ),
        ("machine == 'Mill'", "'machine' is never 'Mill': write the key 'mill'"),
        (
            "{'linear': 1, 'roundish': 2}[type] == 1",
            "'type' is never 'roundish': its keys are linear, rotary, spindle, unfitted",
        ),
        ("type == 3.0", "'type' is a text and never equals '3.0', a number"),
        (
            "type == true",
            (
                "'type' is a text and never equals 'true', true or false: its keys are linear, rotary,"
                " spindle, unfitted"
            ),
        ),
        ("baud.contains('MHz')", "no key of 'baud' has 'MHz' there: its keys are mhz2, mhz4"),
        ("baud.startsWith('4')", "no key of 'baud' has '4' there: its keys are mhz2, mhz4"),
        (
            "type.endsWith('Y')",
            "no key of 'type' has 'Y' there: its keys are linear, rotary, spindle, unfitted",
        ),
        ("string(baud) == '4 MHz'", "'string(baud)' is never '4 MHz': write the key 'mhz4'"),
        ("type == baud", "'type' and 'baud' have no choice in common"),
        ("type == 'rotary' || baud != 'mhz4' || type in ['linear', 'spindle'] || type == null", ""),
        ("type + 'x' == 'anything'", ""),
    ],
)
def test_a_choice_is_compared_with_its_keys_only(mill, path: Path, check: str, message: str) -> None:
    """A comparison with anything else is silently false, so the rule would never be broken."""
    reported = faults(path, CHOICE.replace("CHECK", f'"{check}"'), mill)
    assert reported == (
        [f"rules.yaml, line 7: works.choice: check: {message}" + "." * (message[-1] != "?")]
        if message
        else []
    )


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


def test_a_rule_without_a_family_applies_where_its_parameters_exist(mill, path: Path) -> None:
    other = OWN_RULE.replace("builder.rapid", "builder.num").replace("feedrate.rapid", "travel.limit_min")
    path.write_text(OWN_RULE + other.removeprefix("\nrules:\n"), encoding="utf-8")
    num = load_schema("num")
    for schema, used in ((mill.schema, ["builder.rapid"]), (num, ["builder.num"])):
        own = read_builder_rules(path, schema)
        assert ([rule.id for rule in own.rules], own.faults) == (used, ())


def test_a_rule_of_a_family_that_reads_another_s_parameter_shows_whose_it_is(mill, path: Path) -> None:
    parameter = next(p for p in load_schema("num").parameters if p not in mill.schema.parameters)
    text = OWN_RULE.replace("severity:", "family: 9pc\n    severity:").replace("feedrate.rapid", parameter)
    (reported,) = faults(path, text, mill)
    assert reported.endswith(f"reads rapid: '{parameter}' is a parameter of num, not of 9pc.")


def test_a_suppression_of_one_family_is_not_unused_in_a_file_of_another(mill, path: Path) -> None:
    path.write_text(
        """
rules:
  - {id: works.num, family: num, title: T, severity: advice, reads: {}, check: "true", message: no}
suppressions:
  - {rule: works.num, reason: looked at, by: J. Doe}
  - {rule: num.axes.anything, reason: looked at, by: J. Doe}
  - {rule: schema.range, params: [P21N3], reason: looked at, by: J. Doe}
""",
        encoding="utf-8",
    )
    assert Validator(mill, read_builder_rules(path, mill.schema)).run() == ()


def test_a_suppression_of_a_rule_that_cannot_be_used_is_no_second_finding(mill, path: Path) -> None:
    text = OWN_RULE.replace("<= 10000.0", "<=")
    text += "suppressions:\n  - {rule: builder.rapid, reason: looked at, by: J. Doe}\n"
    assert len(faults(path, text, mill)) == 1


def test_two_rules_of_one_id_are_reported_with_the_line_of_the_first(mill, path: Path) -> None:
    (reported,) = faults(path, OWN_RULE + OWN_RULE.removeprefix("\nrules:\n"), mill)
    assert reported == "rules.yaml, line 11: builder.rapid: id: the rule in line 3 has this id already."


@pytest.mark.parametrize("page", ["works standard 4711, sheet 2", ""])
def test_a_builder_s_rule_is_cited_with_his_own_page(mill, path: Path, page: str) -> None:
    path.write_text(OWN_RULE + (f"    page: {page}\n" if page else ""), encoding="utf-8")
    validator = Validator(mill, read_builder_rules(path, mill.schema))
    finding = of(validator.run(), "builder.rapid")[0]
    text = why_text(mill, finding, explain(validator, finding))
    assert "; ".join(filter(None, (page, "rules.yaml, line 3"))) in text.splitlines()[-1]
    assert "Manual" not in text.splitlines()[-1]
    assert finding_text(mill, finding).splitlines()[0].endswith(f" ({page})" if page else "bear.")


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


def test_a_suppression_that_meets_nothing_is_reported(mill, path: Path) -> None:
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


STORED = "{rule: a.b, reason: why, by: me}"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "# nothing yet",
        "suppressions:\n",
        "suppressions: []  # none\n",
        f"suppressions: [{STORED}]\n",
        f"suppressions:  # looked at\n- {STORED} # by us\n# the end\n",
        f"suppressions:\n    - {STORED}\nrules: []  # later\n",
        (
            "suppressions:\r\n  -\r\n    rule: a.b\r\n    reason: |\r\n      why - not\r\n    by:"
            " me\r\nrules:\r\n"
        ),
        "\ufeffrules: []\n",
        "rules: []\n...\n# behind\n",
        "---\nrules: []",
    ],
)
def test_a_suppression_changes_no_other_line(path: Path, text: str) -> None:
    path.write_bytes(text.encode())
    before = read_yaml(text).data or {}
    suppress(path, "builder.rapid", ["1203"], reason="# no: remark", by="J. Doe")
    after = path.read_bytes().decode()
    new = {"rule": "builder.rapid", "params": ["1203"], "reason": "# no: remark", "by": "J. Doe"}
    assert read_yaml(after).data == before | {"suppressions": [*(before.get("suppressions") or []), new]}
    lines = after.splitlines(keepends=True)
    assert [line for line in text.splitlines() if line not in after and "suppressions: [" not in line] == []
    assert len({line.endswith("\r\n") for line in lines}) == 1


def test_a_suppression_that_would_be_read_back_otherwise_is_not_written(path: Path) -> None:
    path.write_bytes(b"{rules: []}\n")
    with pytest.raises(SaveError, match="was not written"):
        suppress(path, "builder.rapid", [], reason="why", by="J. Doe")
    assert path.read_bytes() == b"{rules: []}\n"


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
    block = page[page.index("    rules:\n") : page.index("\nThe first line is for an editor")]
    path.write_text(dedent(block), encoding="utf-8")
    lathe = machine("lathe")
    own = read_builder_rules(path, lathe.schema)
    assert (own.faults, len(own.rules), len(own.suppressions)) == ((), 1, 1)
    lathe.set(RAPID, Value(20000.0, "mm/min"))
    (finding,) = of(Validator(lathe, own).run(), "works.lathe-rapid")
    assert finding.message == "Rapid of axis 1 is 20000 mm/min; our lathes are built for 15000 mm/min."
    assert finding.fix == (AddressedValue(RAPID, Value(15000.0, "mm/min")),)
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
    found = rules_beside(machine, ParameterFile(load_schema("9pc"))).faults
    assert [fault.rule for fault in found] == ["rules.unusable"]
    assert found[0].message.startswith("rules.yaml: ")


@pytest.mark.parametrize("named", ["P21", "P21N2", "p21n2", "21N2", "servo.loop_gain@Z", "Servo.Loop_Gain"])
def test_a_suppression_names_a_parameter_as_every_verb_does(path: Path, named: str, checkout: Path) -> None:
    file = open_file(checkout / "examples/num-1060-mill/MILL_1060.amp").file
    file.set(("servo.loop_gain", "2"), Value(0))
    entry = f"{{rule: num.servo.gain-set, params: ['{named}'], by: me, reason: none}}"
    path.write_text(f"suppressions: [{entry}]\n", "utf-8")
    validator = Validator(file, read_builder_rules(path, file.schema))
    assert [f for f in validator.run() if f.rule.startswith("rules.")] == []
    assert [s.finding.instance for s in validator.suppressed] == ["2"]
