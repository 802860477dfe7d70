"""Fixes are tried against the whole file before they are offered, and made one after the other."""

from collections.abc import Callable
from random import Random

import pytest
from fix_campaign import spoil

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Rule, Suppression, Value
from amp_studio.validate import BuilderRules, Finding, Fixed, Validator, apply_all_safe, apply_fixes
from tests.campaigns import CAMPAIGN, some

RAPID, CUTTING = ("feedrate.rapid", "1"), ("feedrate.max_cutting", "1")
EXCESS, SUPPRESSION = ("servo.excess_error", "1"), ("servo.feedrate_suppression", "1")


@pytest.fixture(scope="module")
def one_axis(machine: Callable[[str], ParameterFile]) -> ParameterFile:
    """Return the sound mill with the values of its first axis alone."""
    file = machine("mill").copy()
    for address in [address for address in file.values if address[1] in list("2345678")]:
        del file.values[address]
    file.evaluation.forget()
    return file


@pytest.fixture
def whole_mill(machine: Callable[[str], ParameterFile]) -> ParameterFile:
    return machine("mill").copy()


@pytest.fixture
def mill(one_axis: ParameterFile) -> ParameterFile:
    return one_axis.copy()


def rule(
    name: str, severity: str, check: str, *fix: tuple[str, str], safe: bool = False, **more: object
) -> Rule:
    """Return a rule of a builder's own about rapid and cutting feedrate of axis 1."""
    return Rule.model_validate(
        {
            "id": name,
            "title": name,
            "severity": severity,
            "check": check,
            "message": "{rapid}",
            "page": "1-1",
            "reads": {
                "rapid": "feedrate.rapid@1",
                "cutting": "feedrate.max_cutting@1",
                "excess": "servo.excess_error@1",
            },
            "fix": [{"set": set_, "value": value, "safe": safe} for set_, value in fix],
            **more,
        }
    )


def offered(file: ParameterFile, *own: Rule, suppressed: str = "") -> dict[str, list[Value]]:
    """Return the values that the builder's rules which are broken offer."""
    suppressions = (Suppression(rule=suppressed, reason="as built", by="J. Doe"),) if suppressed else ()
    findings = Validator(file, BuilderRules(own, suppressions)).run()
    return {f.rule: [r.value for r in f.fix] for f in findings if f.rule.startswith("own.")}


def mm(number: float) -> Value:
    return Value(number, "mm/min")


# ---------------------------------------------------------------------------------------------- what is
# offered


@pytest.mark.parametrize(
    ("mended", "brought", "is_offered"),
    some(
        [
            ("error", "error", False),
            ("error", "warning", True),
            ("error", "advice", True),
            ("warning", "error", False),
            ("warning", "warning", False),
            ("warning", "advice", True),
            ("advice", "error", False),
            ("advice", "warning", False),
            ("advice", "advice", False),
        ],
        2,
    ),
)
def test_what_a_fix_brings_is_less_severe_than_what_it_mends(mill, mended, brought, is_offered) -> None:
    own = (
        rule("own.one", mended, "rapid != 12000.0", ("rapid", "11000.0")),
        rule("own.two", brought, "rapid != 11000.0"),
    )
    assert mill.get(RAPID) == mm(12000.0)
    assert offered(mill, *own) == {"own.one": [mm(11000.0)] if is_offered else []}


def test_what_was_found_before_is_not_brought(mill) -> None:
    one = rule("own.one", "advice", "rapid != 12000.0", ("rapid", "11000.0"))
    assert offered(mill, one, rule("own.two", "error", "rapid < 1.0"))["own.one"] == [mm(11000.0)]


@pytest.mark.parametrize(("wrong_rapid", "is_offered"), [(11000.0, False), (9.0, True)])
def test_a_fix_adds_no_value_to_those_that_a_finding_is_about(
    mill, wrong_rapid: float, is_offered: bool
) -> None:
    """The second rule is broken before and after."""
    one = rule("own.one", "advice", "rapid != 12000.0", ("rapid", "11000.0"))
    two = rule(
        "own.two", "error", "rapid < 1.0", blames={"cutting": "it > 0.0", "rapid": f"it == {wrong_rapid}"}
    )
    assert offered(mill, one, two)["own.one"] == ([mm(11000.0)] if is_offered else [])


def test_what_is_suppressed_may_be_brought(mill) -> None:
    one, two = (
        rule("own.one", "error", "rapid != 12000.0", ("rapid", "11000.0")),
        rule("own.two", "error", "rapid != 11000.0"),
    )
    assert offered(mill, one, two, suppressed="own.two") == {"own.one": [mm(11000.0)]}


def test_a_fix_that_drives_another_value_out_of_its_range_is_not_offered(mill) -> None:
    """Cutting is at most rapid (page 9-2)."""
    assert mill.get(CUTTING) == mm(6000.0)
    slow = rule("own.one", "warning", "rapid <= 5000.0", ("rapid", "5000.0"))
    assert offered(mill, slow) == {"own.one": []}
    both = rule("own.one", "warning", "rapid <= 5000.0", ("rapid", "5000.0"), ("cutting", "4000.0"))
    assert offered(mill, both) == {"own.one": [mm(5000.0), mm(4000.0)]}


def test_two_values_that_bound_each_other_move_together(mill) -> None:
    """Either alone would be out of the range that the other sets."""
    up = rule("own.one", "error", "rapid >= 20000.0", ("cutting", "19000.0"), ("rapid", "20000.0"))
    mill.set(("servo.excess_error", "1"), Value(200.0, "mm"))
    assert offered(mill, up) == {"own.one": [mm(19000.0), mm(20000.0)]}


def test_a_fix_of_the_machine_type_is_tried_with_the_rules_of_that_type(mill) -> None:
    """On a lathe other parameters are there, and what is wrong with them counts."""
    kind = mill.schema.family.machine_parameter
    lathe = rule(
        "own.one", "warning", "kind != 'mill'", ("kind", "'lathe'"), reads={"kind": kind}, message="{kind}"
    )
    spoilt = rule("own.two", "error", "machine != 'lathe'")
    assert offered(mill, lathe, spoilt) == {"own.one": []}


def test_an_edit_elsewhere_takes_an_offer_away_and_gives_it_back(mill) -> None:
    validator = Validator(
        mill, BuilderRules((rule("own.one", "warning", "rapid <= 5000.0", ("rapid", "5000.0")),))
    )

    def offer(changed: Address, value: Value) -> bool:
        mill.set(changed, value)
        findings = validator.update([changed])
        assert findings == Validator(mill, validator.own).run()
        return bool(next(f for f in findings if f.rule == "own.one").fix)

    validator.run()
    assert not offer(EXCESS, Value(14.0, "mm")), "cutting would be above rapid"
    assert offer(CUTTING, mm(5000.0))
    assert not offer(CUTTING, mm(5000.1))


def test_a_trial_leaves_the_file_and_whoever_listens_alone(mill) -> None:
    mill.set_checked({RAPID: mm(250000.0)}, force="by a test")
    reported: list[object] = []
    mill.listen(reported.append)
    values, forced = dict(mill.values), dict(mill.forced)
    findings = Validator(mill).run()
    assert any(finding.fix for finding in findings)
    assert (reported, mill.values, mill.forced) == ([], values, forced)


# ------------------------------------------------------------------------------- pairs that bound each other


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({("zone.overtravel_positive", "1"): Value(-500.0, "mm")}, "no travel would be left (page 6-10)"),
        ({("zone.limit2_min", "1"): Value(900.0, "mm")}, "a zone without width (page 6-8)"),
        ({("jog.increment_smallest", "1"): Value(900.0, "mm")}, "the distance must increase (page 8-6)"),
        ({("jog.speed_second", "1"): mm(90000.0)}, "nobody knows which of the two is meant"),
        ({("spindle.min_speed", "1.1"): Value(9000.0, "rpm")}, "the maximum must be greater (page 12-8)"),
    ],
)
def test_of_a_pair_neither_is_put_onto_the_edge_of_the_other(whole_mill, wrong, why) -> None:
    for address, value in wrong.items():
        whole_mill.set(address, value)
    found = [f for f in Validator(whole_mill).run() if f.rule == "schema.range"]
    assert found
    assert [f.fix for f in found if f.fix] == [], why


def test_a_bound_that_binds_one_way_is_where_a_value_belongs(mill) -> None:
    mill.set(CUTTING, mm(13000.0))
    (found,) = [f for f in Validator(mill).run() if f.rule == "schema.range"]
    assert [r.value for r in found.fix] == [mm(12000.0)]


def test_a_bound_that_leaves_one_value_is_what_is_wrong_itself(mill) -> None:
    """Rapid is 0, and cutting is not to be 0 for that."""
    mill.set(RAPID, mm(0.0))
    (found,) = [f for f in Validator(mill).run() if f.rule == "schema.range" and CUTTING in f.addresses]
    assert found.fix == ()


def test_a_bound_in_another_unit_is_rounded_inwards(mill) -> None:
    """100 mm/min are 3.937007874 in/min, and the parameter takes five decimals."""
    mill.set(RAPID, mm(100.0))
    mill.set(CUTTING, Value(5.0, "in/min"))
    (found,) = [f for f in Validator(mill).run() if f.rule == "schema.range" and CUTTING in f.addresses]
    assert [r.value for r in found.fix] == [Value(3.937, "in/min")]


@pytest.mark.parametrize(("suppression", "mended"), [(11.5, 10.5), (12.0, 10.5)])
def test_suppression_is_not_put_below_the_following_error_at_rapid(whole_mill, suppression, mended) -> None:
    """With a rapid of 10 m/min and gain 1 the axis trails by 10 mm; a tenth below 11 mm would be 9.9 mm;
    5 % over it are left.
    """
    whole_mill.set(RAPID, mm(10000.0))
    whole_mill.set(EXCESS, Value(11.0, "mm"))
    whole_mill.set(SUPPRESSION, Value(suppression, "mm"))
    validator = Validator(whole_mill)
    (found,) = [f for f in validator.run() if f.rule == "9pc.servo.suppression-within-excess"]
    assert {r.address: r.value for r in found.fix} == {
        SUPPRESSION: Value(mended, "mm"),
        EXCESS: Value(11.66667, "mm"),
    }
    apply_fixes(validator, lambda _: True)
    assert [f for f in validator.findings() if not f.rule.startswith(("schema.unset", "plausible."))] == []


# ---------------------------------------------------------------------------------------------- one after the
# other


def findings_of(validator: Validator) -> list[str]:
    return [f.rule for f in validator.findings() if f.rule.startswith("own.")]


def test_of_two_findings_the_more_severe_has_its_way(mill) -> None:
    """Both mend what both find: with the other order cutting would stay and rapid go."""
    sum_ = "rapid + cutting <= 15000.0"
    own = (
        rule("own.a-warning", "warning", sum_, ("rapid", "9000.0"), safe=True),
        rule("own.an-error", "error", sum_, ("cutting", "3000.0"), safe=True),
    )
    for order in (own, own[::-1]):
        file = mill.copy()
        validator = Validator(file, BuilderRules(order))
        validator.run()
        assert [
            (f.change.address, f.rule)
            for f in apply_fixes(validator, lambda f: f.rule in ("own.a-warning", "own.an-error"))
        ] == [(CUTTING, "own.an-error")]
        assert (file.get(RAPID), file.get(CUTTING)) == (mm(12000.0), mm(3000.0))
        assert findings_of(validator) == []


def test_of_two_values_for_one_parameter_the_more_severe_finding_has_its_own(mill) -> None:
    own = (
        rule("own.a-warning", "warning", "rapid <= 8000.0", ("rapid", "7000.0"), safe=True),
        rule("own.an-error", "error", "rapid <= 9000.0", ("rapid", "6500.0"), safe=True),
    )
    validator = Validator(mill, BuilderRules(own))
    validator.run()
    assert list(apply_all_safe(validator)) == [RAPID]
    assert mill.get(RAPID) == mm(6500.0)


def test_safe_fixes_are_made_together_until_nothing_is_left(mill) -> None:
    """A fix may bring another finding, if that is less severe."""
    one = rule("own.one", "error", "rapid != 12000.0", ("rapid", "8000.0"), safe=True)
    two = rule("own.two", "warning", "rapid != 8000.0", ("rapid", "7000.0"), safe=True)
    three = rule("own.three", "advice", "cutting != 6000.0", ("cutting", "5000.0"))
    validator = Validator(mill, BuilderRules((one, two, three)))
    validator.run()
    assert list(apply_all_safe(validator)) == [RAPID]
    assert mill.get(RAPID) == mm(7000.0)
    assert mill.get(CUTTING) == mm(6000.0), "that would change motion"
    assert validator.findings() == Validator(mill, validator.own).run()


def test_fixes_that_contradict_each_other_are_not_offered(mill) -> None:
    one = rule("own.one", "warning", "rapid != 12000.0", ("rapid", "8000.0"), safe=True)
    two = rule("own.two", "warning", "rapid != 8000.0", ("rapid", "12000.0"), safe=True)
    validator = Validator(mill, BuilderRules((one, two)))
    validator.run()
    assert apply_fixes(validator, lambda _: True) == []


def test_only_the_fixes_that_are_wanted_are_made(mill) -> None:
    own = (
        rule("own.one", "error", "rapid < 9000.0", ("rapid", "8000.0")),
        rule("own.two", "error", "cutting < 5000.0", ("cutting", "4000.0")),
    )
    validator = Validator(mill, BuilderRules(own))
    validator.run()

    def second(finding: Finding) -> bool:
        return finding.rule == "own.two"

    (fixed,) = apply_fixes(validator, second)
    assert (fixed.change.address, fixed.change.old, fixed.change.new) == (CUTTING, mm(6000.0), mm(4000.0))
    assert findings_of(validator) == ["own.one"]


# ------------------------------------------------------------------------------------ a badly damaged file


def damaged(file: ParameterFile, seed: int, times: int) -> ParameterFile:
    """Return a copy in which so many values were changed at random."""
    copy = file.copy()
    spoil(copy, Random(seed), times)
    return copy


@pytest.mark.parametrize("seed", [1, 2, 3] if CAMPAIGN else [2, 3])
def test_fixes_made_together_are_those_of_a_full_check_before_each(machine, seed) -> None:
    one, other, each = damaged(machine("lathe"), seed, 60), damaged(machine("lathe"), seed, 60), []
    while finding := next((f for f in Validator(one).run() if f.fix), None):
        changes = one.set_checked({setting.address: setting.value for setting in finding.fix})
        each += [Fixed(change, finding.rule) for change in changes]
    validator = Validator(other)
    validator.run()
    assert each == apply_fixes(validator, lambda _: True) != []
    assert list(map(repr, validator.findings())) == list(map(repr, Validator(one).run()))


def test_a_fix_that_is_made_has_few_others_tried_again(whole_mill, monkeypatch) -> None:
    file, tried = damaged(whole_mill, 2, 400), []
    validator = Validator(file)
    validator.run()
    set_checked = ParameterFile.set_checked
    monkeypatch.setattr(
        ParameterFile, "set_checked", lambda *given: tried.append(given) or set_checked(*given)
    )
    done = apply_fixes(validator, lambda _: True)
    assert len(done) > 40
    assert len(tried) < 3 * len(done), "a trial for each, and some of those that are not good"


def test_a_fix_that_would_set_a_name_which_its_parameter_does_not_offer_is_left_out(machine) -> None:
    """An axis may be called $C, and no axis of that name lies along the center line (28-9)."""
    lathe = machine("lathe")
    lathe.set(("axis.name", "2"), Value("dollar-c"))
    lathe.set(("virtual_c.center_line_axis", ""), Value("none"))
    lathe.set(("virtual_c.rotary_axis", ""), Value("c"))
    (missing,) = (f for f in Validator(lathe).run() if f.rule == "9pc.virtual-c.center-line-missing")
    assert missing.fix == ()
