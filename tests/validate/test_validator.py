"""Findings of one file: states, rules and their order, kept up to date whatever is written into it."""

import contextlib

import pytest
from findings import found, the

from amp_studio.files import new_file
from amp_studio.report import finding_json, finding_text
from amp_studio.schema import Address, InvalidValueError, Rule, Value
from amp_studio.schema.expression import Circumstances, Decision, program
from amp_studio.validate import SEVERITIES, AddressedValue, BuilderRules, Validator
from amp_studio.validate.plan import RuleCheck

RAPID = ("feedrate.rapid", "1")
CUTTING = ("feedrate.max_cutting", "1")
EXCESS = ("servo.excess_error", "1")


# ------------------------------------------------------------------------------ states, not set, unknown


@pytest.mark.parametrize(
    "address",
    [
        pytest.param(("servo.max_acceleration", "1"), id="hidden: a digital servo has none"),
        pytest.param(("servo.feed_forward", "1"), id="ignored: the loop is not ZFE"),
    ],
)
def test_what_the_control_does_not_look_at_is_not_checked_unless_it_was_forced(
    mill, address: Address
) -> None:
    mill.set(address, Value(10**6, mill.evaluation.unit(address, "metric")))
    assert found(mill, "schema.range") == []
    mill.forced[address] = "by hand"
    assert [finding.addresses for finding in found(mill, "schema.range")] == [(address,)]


def test_what_cannot_be_used_is_still_checked(mill) -> None:
    address = ("servo.reversal_error", "3")
    assert mill.evaluation.state(address).state == "unusable"
    mill.set(address, Value(10.0, "mm"))
    assert [finding.addresses for finding in found(mill, "schema.range")] == [(address,)]


def test_values_that_are_not_set_are_one_piece_of_advice(mill) -> None:
    validator = Validator(mill)
    validator.run()
    taken = [("home.position", str(axis)) for axis in (3, 2, 1)]
    for address in taken:
        mill.set(address, None)
    (advice,) = (f for f in validator.update(taken) if f.rule == "schema.unset")
    assert (advice.severity, advice.fix, advice.page) == ("advice", (), None)
    assert advice.addresses == tuple(reversed(taken))
    assert (
        advice.message
        == "3 active parameters have no value here, so the control keeps its own: 1310 Axis Position After"
        " Homing, 2310 Axis Position After Homing, 3310 Axis Position After Homing."
    )
    for address in taken[1:]:
        mill.set(address, Value(1.0, "mm"))
    (advice,) = (f for f in validator.update(taken) if f.rule == "schema.unset")
    assert advice.message.startswith(
        "1 active parameter has no value here, so the control keeps its own: 3310"
    )
    mill.set(("servo.feed_forward", "1"), None)
    assert validator.update([("servo.feed_forward", "1")]) == validator.findings()
    (advice,) = (f for f in validator.findings() if f.rule == "schema.unset")
    assert ("servo.feed_forward", "1") not in advice.addresses, "it is ignored there"


def test_a_value_for_the_control_as_a_whole_speaks_for_its_processes(mill) -> None:
    groups = [("zone.group_count", process) for process in ("", "1", "2")]
    assert [mill.get(address) for address in groups] == [Value(2), None, None]
    validator = Validator(mill)
    assert validator.run() == ()
    mill.set(groups[0], None)
    (advice,) = validator.update([groups[0]])
    assert advice.addresses == tuple(groups)
    mill.set(groups[0], Value(2))
    assert validator.update([groups[0]]) == ()


def test_entries_of_an_unknown_parameter_are_named(mill) -> None:
    mill.unknown["servo.nonsense@1"] = "5"
    finding = the(mill, "schema.unknown")
    assert (finding.severity, finding.addresses) == ("warning", ())
    assert finding.message == "servo.nonsense@1 is no parameter of this schema; it is kept as it is."
    mill.unknown["home.nonsense"] = "6"
    assert (
        the(mill, "schema.unknown").message
        == "2 entries are no parameters of this schema; they are kept as they are: servo.nonsense@1,"
        " home.nonsense."
    )


# --------------------------------------------------------------------------------------- cross-parameter


def test_a_finding_of_a_rule_has_its_values_page_and_fix(mill) -> None:
    mill.set(EXCESS, Value(11.0, "mm"))
    mill.set(("servo.feedrate_suppression", "1"), Value(11.0, "mm"))
    finding = the(mill, "9pc.servo.excess-below-following-error")
    assert (
        finding.message
        == "At rapid 12000 mm/min the axis trails its command by 12 mm, more than Excess Error 11 mm allows:"
        " rapid moves end in E-Stop with EXCESS FOLLOWING ERROR. The smallest sensible value is 13.2 mm."
    )
    assert (finding.page, finding.severity, finding.safe) == ("7-20", "error", False)
    suppression_stays_off = AddressedValue(("servo.feedrate_suppression", "1"), Value(13.2, "mm"))
    assert finding.fix == (AddressedValue(EXCESS, Value(13.2, "mm")), suppression_stays_off)


def test_an_inch_file_is_reported_in_inches_and_mended_in_the_unit_of_the_value(mill) -> None:
    mill.header.units = "inch"
    mill.set(EXCESS, Value(0.4, "in"))
    finding = the(mill, "9pc.servo.excess-below-following-error")
    assert "trails its command by 0.472441 in, more than Excess Error 0.4 in allows" in finding.message
    assert finding.fix == (AddressedValue(EXCESS, Value(0.51969, "in")),), (
        "five decimals, as the parameter has them"
    )


def test_a_figure_is_reported_in_the_inches_of_the_values_it_comes_from(mill) -> None:
    mill.set(EXCESS, Value(0.4, "in"))
    message = the(mill, "9pc.servo.excess-below-following-error").message
    assert "trails its command by 0.472441 in, more than Excess Error 0.4 in allows" in message


def test_an_axis_that_turns_is_reported_in_degrees(mill) -> None:
    mill.set(("servo.excess_error", "4"), Value(11.0, "deg"))
    assert "by 12°, more than Excess Error 11° allows" in the(
        mill, "9pc.servo.excess-below-following-error"
    ).message.replace(" °", "°")


def test_another_unit_system_is_noticed(mill) -> None:
    mill.values["servo.lead_screw_pitch", "1"] = Value(4.0, "deg")
    validator = Validator(mill)
    assert any("4° should be in mm here." in finding.message for finding in validator.run())
    mill.header.units = "inch"
    findings = validator.update([])
    assert findings == Validator(mill).run()
    assert any("4° should be in in here." in finding.message for finding in findings)


def test_a_fix_that_cannot_change_motion_is_safe(mill) -> None:
    mill.set(("servo.sercos_transmit", "1"), Value("low"))
    assert the(mill, "9pc.servo.transmit-level-high").safe


def test_what_the_control_uses_instead_is_shown_in_the_unit_of_the_value(mill) -> None:
    own = Rule(
        id="own.clamp",
        title="Rapid feedrate above what this control takes",
        severity="warning",
        reads={"rapid": "feedrate.rapid"},
        check="rapid <= 2540.0",
        message="{rapid}",
        effective=({"set": "rapid", "value": "2540.0"},),
        page="1",
    )
    mill.set(RAPID, Value(200.0, "in/min"))
    mill.set(("feedrate.rapid", "2"), Value(2540.0, "mm/min"))
    validator = Validator(mill, BuilderRules((own,)))
    (finding,) = (f for f in validator.run() if f.rule == "own.clamp" and f.addresses == (RAPID,))
    assert finding.effective == (AddressedValue(RAPID, Value(100.0, "in/min")),)
    assert finding.fix == ()
    assert "effective value: 1203 Rapid Feedrate for Positioning = 100 in/min" in finding_text(mill, finding)
    assert finding_json(mill, finding)["effective"] == [{"param": "1203", "value": "100 in/min"}]


def test_a_list_that_a_rule_works_out_is_reported_with_commas(mill) -> None:
    own = Rule(
        id="own.names",
        title="Two at once",
        severity="warning",
        reads={"rapid": "feedrate.rapid"},
        check="false",
        values={
            "who": "[['fast', rapid], ['slow', 0.0]].filter(one, one[1] > 0.0).map(one, one[0]) + ['none']"
        },
        message="{who}.",
        page="1",
    )
    validator = Validator(mill, BuilderRules((own,)))
    (finding,) = (f for f in validator.run() if f.rule == "own.names" and f.addresses == (RAPID,))
    assert finding.message == "fast, none."


def test_a_fix_that_would_not_help_is_not_offered(mill) -> None:
    """Nine tenths of no suppression point are not below it."""
    mill.set(("servo.feedrate_suppression", "1"), Value(0.0, "mm"))
    assert the(mill, "9pc.servo.gain-break-below-suppression").fix == ()


def test_a_rule_over_the_whole_control_is_about_what_is_in_force(mill) -> None:
    mill.set(("servo.loop_type", "5"), Value("digital"))
    finding = the(mill, "9pc.axis.more-than-one-1394")
    assert finding.causes == tuple(("servo.loop_type", str(axis)) for axis in range(1, 8)), (
        "axis 8 is unfitted"
    )


def test_a_formula_that_is_wrong_itself_is_logged(caplog) -> None:
    decision = Decision(program("wrong(speed) > 0.0"), {"wrong": lambda speed: speed.nothing})
    assert not decision.is_true((5.0,), ("speed",), Circumstances("mill", "", ""))
    (record,) = caplog.records
    assert "'wrong' failed: AttributeError" in record.getMessage()


@pytest.mark.parametrize("is_edited", [False, True])
def test_the_rules_that_read_a_value_are_known(mill, is_edited: bool) -> None:
    validator = Validator(mill)
    if is_edited:
        validator.prepare_edits()
    rules = [rule.id for rule in validator.rules_of(("zone.group_count", ""))]
    assert rules == [
        "9pc.zone.group-not-checked",
        "9pc.zone.group-empty",
        "9pc.zone.home-in-zone2",
        "9pc.powerup.zones-without-groups",
        "9pc.deskew.slave-zone",
    ]
    assert [rule.id for rule in validator.rules_of(("zone.group_count", "2"))] == [
        "9pc.zone.group-empty",
        "9pc.powerup.zones-without-groups",
    ]


def test_the_rules_that_read_a_value_are_looked_for_once(mill, monkeypatch: pytest.MonkeyPatch) -> None:
    """The window asks with every edit: 900 checks are woken by the type of an axis, and few read it."""
    validator, asked = Validator(mill), list[RuleCheck]()
    is_about = RuleCheck.is_about
    monkeypatch.setattr(RuleCheck, "is_about", lambda c, a: asked.append(c) or is_about(c, a))
    first = validator.rules_of(("axis.type", "1"))
    number = len(asked)
    assert number > 0
    assert validator.rules_of(("axis.type", "1")) == first
    validator.rules_without_values(("axis.type", "1"))
    assert len(asked) == number


# ------------------------------------------------------------------------------------------------- order


def test_findings_are_sorted_by_severity_and_by_the_manual(mill) -> None:
    for n, address in enumerate(mill.addresses()):
        if n % 3 == 0 and address[0] not in ("axis.type", "control.type"):
            with contextlib.suppress(InvalidValueError):
                mill.set(address, Value("raw:999"))
        elif n % 7 == 0:
            mill.set(address, None)
    mill.unknown["nonsense"] = ""
    findings = Validator(mill).run()
    order = {address: n for n, address in enumerate(mill.addresses())}
    keys = [
        (SEVERITIES.index(f.severity), min((order[a] for a in f.causes), default=-1), f.rule)
        for f in findings
    ]
    assert keys == sorted(keys)
    assert {finding.severity for finding in findings} == set(SEVERITIES)


def test_a_validator_that_has_not_run_runs_when_it_is_asked() -> None:
    file = new_file("9pc", "mill", ["X"])
    file.set(file.find("1300"), Value(1e9, "mm"))
    assert Validator(file).findings() == Validator(file).run() != ()


def test_findings_are_never_those_of_earlier_values() -> None:
    file = new_file("9pc", "mill", ["X"])
    validator = Validator(file)
    validator.run()
    file.set(file.find("1300"), Value(1e9, "mm"))
    assert validator.findings() == Validator(file).run()
