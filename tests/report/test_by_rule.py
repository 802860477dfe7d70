"""Findings by their rule, with the axes that cause them and what their fixes do."""

from dataclasses import replace

from amp_studio.files import new_file
from amp_studio.report import finding_groups, fix_lines, fix_text
from amp_studio.schema import Value
from amp_studio.validate import NOT_SET, AddressedValue, Validator, addresses_not_set

AXES = ["X", "Y", "Z", "B", "S"]


def test_a_fresh_mill_has_six_rules_broken_and_not_twenty_findings() -> None:
    validator = Validator(new_file("9pc", "mill", AXES, "bare"))
    groups = finding_groups(validator, validator.run())
    assert [(group.title, group.axes) for group in groups[:3]] == [
        ("Servo hardware of a fitted axis", ("X", "Y", "Z", "B", "S")),
        ("Servo loop type of a fitted axis", ("X", "Y", "Z", "B", "S")),
        ("Axis jerk within the S-curve filter", ("X", "Y", "Z", "B")),
    ]
    assert len(groups) == 6
    assert sum(len(group.findings) for group in groups) == 20


def test_values_that_are_not_set_are_no_finding_of_a_rule() -> None:
    validator = Validator(new_file("num", "cnc", [], "bare"))
    findings = validator.run()
    assert [finding.rule for finding in findings] == [NOT_SET]
    assert finding_groups(validator, findings) == ()
    assert len(addresses_not_set(findings)) == 921


def test_values_out_of_range_are_one_group_for_each_parameter() -> None:
    file = new_file("9pc", "mill", AXES, "bare")
    wanted = {
        ("servo.excess_error", "1"): Value(1e6, "mm"),
        ("servo.excess_error", "2"): Value(2e6, "mm"),
        ("feedrate.rapid", "1"): Value(1e9, "mm/min"),
    }
    file.set_checked(wanted, force="on a day")
    validator = Validator(file)
    ranges = [g for g in finding_groups(validator, validator.run()) if g.findings[0].rule == "schema.range"]
    assert sorted((group.findings[0].causes[0][0], group.axes) for group in ranges) == [
        ("feedrate.rapid", ("X",)),
        ("servo.excess_error", ("X", "Y")),
    ]


def test_what_a_fix_does_is_in_words() -> None:
    file = new_file("9pc", "mill", AXES, "bare")
    validator = Validator(file)
    hardware, _, jerk, least_jerk, *_ = finding_groups(validator, validator.run())
    assert fix_text(file, hardware.fixable) == "Set Servo Hardware Type to SERCOS Interface"
    assert fix_text(file, jerk.fixable) == "Set Axis Jerk on X, Y, Z, B"
    assert fix_text(file, least_jerk.fixable) == "Set 8 Values"
    assert fix_text(file, ()) == ""
    assert fix_lines(file, hardware.fixable[1]) == ("2030 Servo Hardware Type (Y): None → SERCOS Interface",)


def test_a_fix_of_a_secret_does_not_show_it() -> None:
    file = new_file("9pc", "mill", AXES, "bare")
    secret = next(p for p in file.schema.parameters.values() if p.secret)
    validator = Validator(file)
    hardware = finding_groups(validator, validator.run())[0].fixable[0]
    instance = file.machine_schema.instances(secret)[0]
    displayed = fix_lines(file, replace(hardware, fix=(AddressedValue((secret.id, instance), Value(65)),)))
    assert "65" not in displayed[0].split(":", 1)[1]
