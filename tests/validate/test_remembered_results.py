"""What is remembered across files changes no finding: not the order of files, not another schema,
not another rule.
"""

from random import Random

import pytest
from rule_machines import FAMILIES, cases

from amp_studio.files import ParameterFile
from amp_studio.schema import Value, conditions
from amp_studio.schema.expression import MAX_REMEMBERED, Circumstances, Decision, Remembered, key_of, program
from amp_studio.schema.model import BuilderRule
from amp_studio.validate import BuilderRules, Validator, plan, ranges
from tests.campaigns import CAMPAIGN, some

HERE = Circumstances("mill", "", "1")


def forget_all() -> None:
    """Forget what was remembered of every file."""
    for remembered in (conditions.conditions_of, plan._make, ranges._facts, program):
        remembered.cache_clear()


def found(file: ParameterFile, own: BuilderRules | None = None) -> list[str]:
    """Return the findings of a file as texts, in which 1 and True are different."""
    return [repr(finding) for finding in (Validator(file, own) if own else Validator(file)).run()]


@pytest.mark.parametrize("numbers", [(0.0, -0.0), (-0.0, 0.0)])
def test_zero_and_minus_zero_are_one_value_whichever_came_first(numbers: tuple[float, float]) -> None:
    """A length of -0 mm can be typed, and 1 / -0 is below every bound."""
    decision = Decision(program("1.0 / x > 0.0"), {})
    assert [decision.is_true((key_of(Value(n, "mm")),), ("x",), HERE) for n in numbers] == [True, True]


def test_a_number_and_a_yes_are_two_values_whichever_came_first() -> None:
    for values in ((Value(1.0), Value(True)), (Value(True), Value(1.0))):
        decision = Decision(program("x == true"), {})
        got = [decision.is_true((key_of(value),), ("x",), HERE) for value in values]
        assert got == [value.value is True for value in values]


def test_results_of_one_expression_are_bounded() -> None:
    remembered = Remembered()
    for n in range(3 * MAX_REMEMBERED):
        remembered[n] = True
        assert len(remembered) <= MAX_REMEMBERED


def test_machine_model_and_instance_are_distinguished() -> None:
    decision = Decision(program("machine == 'mill' && application == 'A' && instance == '1'"), {})
    for _ in range(2):
        for machine in ("mill", "lathe"):
            for application in ("A", "B"):
                for instance in ("1", "2"):
                    here = Circumstances(machine, application, instance)
                    expected = (machine, application, instance) == ("mill", "A", "1")
                    assert decision.is_true((), (), here) is expected


@pytest.mark.parametrize("family", some(FAMILIES if CAMPAIGN else FAMILIES[::2], 2))
def test_a_file_that_comes_after_others_has_the_findings_of_one_that_comes_first(family: str) -> None:
    breaking = [case for case in cases(family) if case.breaks]
    if len({case.rule for case in breaking}) < 2:
        pytest.skip("has no two rules")
    files = []
    for case in Random(family).sample(breaking, 2):
        with case.machine.changed(case.given), case.machine.changed(case.breaks or {}):
            files.append(case.machine.file.copy())
    forget_all()
    in_turn = [found(file.copy()) for file in (*files, *files)]
    alone = []
    for file in reversed(files):
        forget_all()
        alone.append(found(file.copy()))
    assert in_turn == [*reversed(alone), *reversed(alone)]
    assert len({*map(tuple, in_turn)}) == 2, "two files with two answers"


def test_two_builders_rules_of_one_name_are_two_rules(mill) -> None:
    def rules(bound: str, message: str) -> BuilderRules:
        reads = {"rapid": "feedrate.rapid"}
        own = {"id": "own.rapid", "title": "Rapid", "severity": "warning", "reads": reads}
        return BuilderRules((BuilderRule(**own, check=f"rapid < {bound}", message=message),))

    strict, lenient, other = (
        rules("1.0", "{rapid}"),
        rules("1000000.0", "{rapid}"),
        rules("1.0", "other {rapid}"),
    )
    for _ in range(2):
        messages = [
            {f.message for f in Validator(mill, own).run() if (f.rule, f.instance) == ("own.rapid", "1")}
            for own in (strict, lenient, other)
        ]
        assert messages == [{"12000 mm/min"}, set(), {"other 12000 mm/min"}]


def test_values_that_were_sound_while_one_of_them_was_inactive_are_checked_where_all_count(mill) -> None:
    """The gains count in any state, the motor type does not (7-6, 7-14)."""
    forget_all()
    mill.set(("servo.standard_motor_values", ""), Value(True))
    mill.set(("servo.motor_type", "1"), Value("b430g"))
    detached, attached = mill.copy(), mill.copy()
    detached.set(("servo.position_loop_type", "1"), Value("detached"))
    rules = [
        {finding.rule for finding in Validator(file).run() if finding.instance == "1"}
        for file in (detached, attached)
    ]
    assert ["9pc.servo.standard-motor-gains" in found for found in rules] == [False, True]
