"""Findings of one file: ranges, choices, units, states, and kept up to date whatever is written into it."""

from __future__ import annotations

import math

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import finding_json, finding_text
from amp_studio.schema import (
    Address,
    Rule,
    Value,
)
from amp_studio.schema.expression import Circumstances, Decision, program
from amp_studio.validate import SEVERITIES, BuilderRules, Finding, Setting, Validator

RAPID = ("feedrate.rapid", "1")
CUTTING = ("feedrate.max_cutting", "1")
EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def mill(machine) -> ParameterFile:
    """Return a sound mill of its own."""
    return machine("mill")


def found(file: ParameterFile, rule: str) -> list[Finding]:
    """Return the findings of one rule in a file."""
    return [finding for finding in Validator(file).run() if finding.rule == rule]


def the(file: ParameterFile, rule: str) -> Finding:
    """Return the only finding of a rule."""
    (finding,) = found(file, rule)
    return finding


# ------------------------------------------------------------------------------------- ranges and choices


def test_a_value_out_of_range_is_an_error_with_its_range_page_and_fix(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(10161.0, "mm/min"))
    assert the(mill, "schema.range") == Finding(
        rule="schema.range",
        severity="error",
        causes=(("home.g28_speed", "1"),),
        message="G28 Home Speed 10161 mm/min is outside 0 to 10160 mm/min.",
        fix=(Setting(("home.g28_speed", "1"), Value(10160.0, "mm/min")),),
        page="5-16",
    )


def test_a_negative_speed_is_not_mended_by_an_axis_that_stands_still(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(-5000.0, "mm/min"))
    assert the(mill, "schema.range").fix == ()


def test_a_range_is_checked_in_the_unit_of_entry(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(400.0, "in/min"))
    assert found(mill, "schema.range") == []
    mill.set(("home.g28_speed", "1"), Value(400.0001, "in/min"))
    finding = the(mill, "schema.range")
    assert finding.message == "G28 Home Speed 400.0001 in/min is outside 0 to 400 in/min."
    assert finding.fix == (Setting(("home.g28_speed", "1"), Value(400.0, "in/min")),)


def test_a_bound_that_another_parameter_sets_is_named(mill) -> None:
    mill.set(CUTTING, Value(12000.00001, "mm/min"))
    finding = the(mill, "schema.range")
    assert finding.message == (
        "Maximum Cutting Feedrate 12000.00001 mm/min is outside 0 to 12000 mm/min "
        "(set by 1203 Rapid Feedrate for Positioning, 12000 mm/min)."
    )
    assert finding.fix == (Setting(CUTTING, Value(12000.0, "mm/min")),)


def test_a_bound_that_moves_is_noticed(mill) -> None:
    validator = Validator(mill)
    validator.run()
    mill.set(RAPID, Value(5000.0, "mm/min"))
    assert [f.addresses for f in validator.update([RAPID]) if f.rule == "schema.range"] == [(CUTTING, RAPID)]


def test_a_code_without_a_choice_is_an_error_that_no_default_mends(mill) -> None:
    """Nobody but the control knows what the code does: a default in its place may turn an axis the other way."""
    mill.set(("servo.sercos_baud", ""), Value("raw:999"))
    assert the(mill, "schema.choice") == Finding(
        rule="schema.choice",
        severity="error",
        causes=(("servo.sercos_baud", ""),),
        message="999 is no code of Baud Rate for SERCOS.",
        page="7-3",
    )


@pytest.mark.parametrize(
    ("speed", "mended"),
    [
        (243840.1, 243840.0),
        (268224.0, 243840.0),
        (268224.1, None),
        (2438400.0, None),
        (1e300, None),
        (-1.0, None),
    ],
)
def test_a_number_that_just_misses_its_range_goes_to_the_bound_and_one_far_beyond_to_none(
    mill, speed: float, mended: float | None
) -> None:
    """A digit too many means nobody knows what; the bound is the fastest that there is."""
    mill.set(RAPID, Value(speed, "mm/min"))
    finding = next(f for f in Validator(mill).run() if f.rule == "schema.range" and f.causes == (RAPID,))
    assert [setting.value.value for setting in finding.fix] == [mended] * (mended is not None)


@pytest.mark.parametrize(
    ("address", "value", "said"),
    [
        (("servo.sercos_baud", ""), Value("9 MHz"), "9 MHz is no choice of Baud Rate for SERCOS."),
        (("servo.sercos_baud", ""), Value(2.0), "2.0 is no choice of Baud Rate for SERCOS."),
        (("zone.overtravel_used", "1"), Value("yes"), "yes is no choice of Software Overtravel Used."),
        (EXCESS, Value("much", "mm"), "Excess Error takes a number, not much."),
        (EXCESS, Value(True), "Excess Error takes a number, not True."),
        (EXCESS, Value(math.nan, "mm"), "Excess Error takes a number, not nan."),
        (EXCESS, Value(math.inf, "mm"), "Excess Error takes a number, not inf."),
        (("servo.sercos_cycle", ""), Value(2.5, "ms"), "Cycle Time for SERCOS takes whole numbers, not 2.5."),
    ],
)
def test_a_value_of_the_wrong_kind_is_an_error(mill, address: Address, value: Value, said: str) -> None:
    mill.set(address, value)
    (finding,) = (f for f in Validator(mill).run() if f.rule.startswith("schema.") and f.severity == "error")
    assert finding.message == said
    assert [setting.value for setting in finding.fix] == [mill.default(address)]


@pytest.mark.parametrize(
    ("address", "value", "said", "mended"),
    [
        (EXCESS, Value(20.0, "deg"), "Excess Error 20° should be in mm here.", Value(20.0, "mm")),
        (
            ("servo.excess_error", "4"),
            Value(20.0, "mm"),
            "Excess Error 20 mm should be in ° here.",
            Value(20.0, "deg"),
        ),
        (EXCESS, Value(20.0), "Excess Error 20 should be in mm here.", Value(20.0, "mm")),
        (
            ("servo.initial_gain", "1"),
            Value(1.0, "mm"),
            "Initial Gain of Position Loop 1 mm should be in a bare number here.",
            Value(1.0),
        ),
    ],
)
def test_a_value_in_a_unit_that_measures_something_else_is_an_error(
    mill, address: Address, value: Value, said: str, mended: Value
) -> None:
    mill.set(address, value)
    finding = the(mill, "schema.range")
    assert finding.message == said
    assert finding.fix == (Setting(address, mended),), "the control knows the figure only"


def test_an_axis_that_turns_wants_degrees(mill) -> None:
    validator = Validator(mill)
    validator.run()
    mill.set(("axis.type", "1"), Value("rotary"))
    wrong = {f.addresses[0] for f in validator.update([("axis.type", "1")]) if f.rule == "schema.range"}
    assert EXCESS in wrong
    assert {address[1] for address in wrong} == {"1"}


def test_a_fix_that_would_be_wrong_too_is_not_offered(mill) -> None:
    positive, negative = ("zone.overtravel_positive", "1"), ("zone.overtravel_negative", "1")
    mill.set(negative, Value(2540001.0, "mm"))
    offered = {f.addresses[0]: [r.value for r in f.fix] for f in found(mill, "schema.range")}
    assert offered == {positive: [], negative: []}


def test_a_value_set_out_of_range_on_purpose_says_so(mill) -> None:
    mill.set_many({EXCESS: Value(500.0, "mm")}, force="by J. Fitter on 2026-07-01")
    assert the(mill, "schema.range").message == (
        "Excess Error 500 mm is outside 0 to 214.1 mm. It was forced by J. Fitter on 2026-07-01."
    )


# -------------------------------------------------------------------------------- states, unset, unknown


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
    assert advice.message == (
        "3 active parameters have no value here, so the control keeps its own: 1310 Axis Position After Homing, "
        "2310 Axis Position After Homing, 3310 Axis Position After Homing."
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


# --------------------------------------------------------------------------------------- cross-parameter


def test_a_finding_of_a_rule_has_its_values_page_and_fix(mill) -> None:
    mill.set(EXCESS, Value(11.0, "mm"))
    mill.set(("servo.feedrate_suppression", "1"), Value(11.0, "mm"))
    finding = the(mill, "9pc.servo.excess-below-following-error")
    assert finding.message == (
        "At rapid 12000 mm/min the axis trails its command by 12 mm, more than Excess Error 11 mm allows: rapid moves "
        "end in E-Stop with EXCESS FOLLOWING ERROR. The smallest sensible value is 13.2 mm."
    )
    assert (finding.page, finding.severity, finding.safe) == ("7-20", "error", False)
    suppression_stays_off = Setting(("servo.feedrate_suppression", "1"), Value(13.2, "mm"))
    assert finding.fix == (Setting(EXCESS, Value(13.2, "mm")), suppression_stays_off)


def test_an_inch_file_is_told_in_inches_and_mended_in_the_unit_of_the_value(mill) -> None:
    mill.header.units = "inch"
    mill.set(EXCESS, Value(0.4, "in"))
    finding = the(mill, "9pc.servo.excess-below-following-error")
    assert "trails its command by 0.4724409 in, more than Excess Error 0.4 in allows" in finding.message
    assert finding.fix == (Setting(EXCESS, Value(0.51969, "in")),), "five decimals, as the parameter has them"


def test_a_figure_is_told_in_the_inches_of_the_values_it_comes_from(mill) -> None:
    mill.set(EXCESS, Value(0.4, "in"))
    message = the(mill, "9pc.servo.excess-below-following-error").message
    assert "trails its command by 0.4724409 in, more than Excess Error 0.4 in allows" in message


def test_an_axis_that_turns_is_told_in_degrees(mill) -> None:
    mill.set(("servo.excess_error", "4"), Value(11.0, "deg"))
    assert "by 12°, more than Excess Error 11° allows" in the(
        mill, "9pc.servo.excess-below-following-error"
    ).message.replace(" °", "°")


def test_another_unit_system_is_noticed(mill) -> None:
    validator = Validator(mill)
    mill.set(EXCESS, Value(11.0, "mm"))
    validator.run()
    mill.header.units = "inch"
    findings = validator.update([])
    assert findings == Validator(mill).run()
    assert any("trails its command by 0.4724409 in" in finding.message for finding in findings)


def test_a_fix_that_cannot_change_motion_is_safe(mill) -> None:
    mill.set(("servo.sercos_transmit", "1"), Value("low"))
    assert the(mill, "9pc.servo.transmit-level-high").safe


def test_what_the_control_uses_instead_is_said_in_the_unit_of_the_value(mill) -> None:
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
    assert finding.effective == (Setting(RAPID, Value(100.0, "in/min")),)
    assert finding.fix == ()
    assert "effective value: 1203 Rapid Feedrate for Positioning = 100 in/min" in finding_text(mill, finding)
    assert finding_json(mill, finding)["effective"] == [{"param": "1203", "value": "100 in/min"}]


def test_a_list_that_a_rule_works_out_is_told_with_commas(mill) -> None:
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


def test_a_formula_that_makes_no_sense_of_a_value_says_nothing(mill, caplog) -> None:
    """The remainder of an infinite turn; CEL warns of every function that raises."""
    mill.set(("axis.rollover", "4"), Value(math.inf, "deg"))
    assert [finding.rule for finding in Validator(mill).run()] == ["schema.range", "9pc.format.rollover"]
    assert caplog.records == []


def test_a_formula_that_is_wrong_itself_is_logged(caplog) -> None:
    decision = Decision(program("wrong(speed) > 0.0"), {"wrong": lambda speed: speed.nothing})
    assert not decision.is_true((5.0,), ("speed",), Circumstances("mill", "", ""))
    (record,) = caplog.records
    assert "'wrong' failed: AttributeError" in record.getMessage()


def test_a_number_in_the_place_of_a_yes_is_noticed(mill) -> None:
    """Python takes 1 and True for equal; a rule does not."""
    used, loop = ("zone.overtravel_used", "6"), ("servo.position_loop_type", "6")
    validator = Validator(mill)
    mill.set(loop, Value("open"))
    assert "9pc.zone.overtravel-never-homed" in {finding.rule for finding in validator.run()}
    mill.set(used, None)
    mill.set(used, Value(1.0))
    assert "9pc.zone.overtravel-never-homed" not in {finding.rule for finding in validator.update([used])}


def test_the_rules_that_read_a_value_are_known(mill) -> None:
    rules = [rule.id for rule in Validator(mill).rules_of(("zone.group_count", ""))]
    assert rules == [
        "9pc.zone.group-not-checked",
        "9pc.zone.group-empty",
        "9pc.zone.home-in-zone2",
        "9pc.powerup.zones-without-groups",
        "9pc.deskew.slave-zone",
    ]
    assert [rule.id for rule in Validator(mill).rules_of(("zone.group_count", "2"))] == [
        "9pc.zone.group-empty",
        "9pc.powerup.zones-without-groups",
    ]


# ------------------------------------------------------------------------------------------------- order


def test_findings_are_sorted_by_severity_and_by_the_manual(mill) -> None:
    for n, address in enumerate(mill.addresses()):
        if n % 3 == 0 and address[0] not in ("axis.type", "control.type"):
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
