"""Whether values break a rule is what the engine makes of "it applies and is not satisfied",
however it is worked out.
"""

from itertools import product

import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Rule, Value, expression, program
from amp_studio.schema.cel_engine import Context
from amp_studio.schema.expression import Circumstances, ValueKey
from amp_studio.validate import Validator
from amp_studio.validate.expressions import Expressions, RuleError

WHENS = (
    "true",
    "a > 2.0",
    "a == b",
    "a / b > 1.0 // a remark",
    "int(a * 1e300) > 5",
    "a",
    "instance == '2'",
    "null",
)
CHECKS = (
    "a < b",
    "b != 0.0 // a remark",
    "int(b * 1e300) > 5",
    "b",
    "part == null",
    "[a, b].exists(x, x > 4.0)",
)
VALUES: tuple[float | None, ...] = (0.0, 3.0, 5.0, None)


def rule(when: str, check: str) -> Rule:
    return Rule(
        id="any.rule",
        title="T",
        severity="error",
        reads={"a": "any.a", "b": "any.b"},
        when=when,
        check=check,
        message="Broken.",
        page="1-1",
    )


def by_the_engine(when: str, check: str, a: float | None, b: float | None, instance: str) -> bool | None:
    seen = {"a": a, "b": b, "instance": instance, "part": None}
    try:
        return program(f"({when}\n) && !({check}\n)").execute(Context(seen)) is True
    except (TypeError, ValueError, RuntimeError, ArithmeticError, LookupError):
        return None


@pytest.mark.parametrize("when", WHENS)
def test_a_verdict_is_that_of_both_expressions_together(when: str) -> None:
    for check in CHECKS:
        expressions = Expressions(rule(when, check), {})
        for a, b, instance in product(VALUES, VALUES, ("1", "2")):
            keys: tuple[ValueKey, ...] = (a, b)
            wanted = by_the_engine(when, check, a, b, instance)
            for _ in range(2):  # worked out, and remembered
                assert expressions.verdict(keys, Circumstances("mill", "", instance)) is wanted, (check, keys)
            assert expressions.remembered.get(keys) in (None, wanted)


def test_what_depends_on_the_instance_is_not_remembered_by_its_values_alone() -> None:
    expressions = Expressions(rule("instance == '2'", "a < b"), {})
    assert expressions.verdict((5.0, 3.0), Circumstances("mill", "", "1")) is False
    assert expressions.verdict((5.0, 3.0), Circumstances("mill", "", "2")) is True


def test_the_check_of_a_rule_that_does_not_apply_is_not_looked_at() -> None:
    expressions = Expressions(rule("a > 4.0", "nothing_like(it) < b"), {})
    assert expressions.verdict((3.0, 1.0), Circumstances("mill", "", "1")) is False
    with pytest.raises(RuleError, match="names 'it', which it does not read"):
        expressions.verdict((5.0, 1.0), Circumstances("mill", "", "1"))


def test_a_list_that_is_only_counted_is_never_copied_into_the_engine(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cam has thousands of points, and CEL would copy each of them with every edit."""
    seen: list[object] = []

    def context(values: dict[str, object]) -> object:
        seen.extend(values.values())
        return Context(values)

    monkeypatch.setattr(expression, "Context", context)
    file = open_file(examples_folder() / "57c422b-label-press" / "LABEL_PRESS.amp").file
    validator = Validator(file)
    validator.run()
    for number in (300001.0, 20.0):  # above and within what the encoder inputs take
        seen.clear()
        file.set_checked({("cam.time_points", "Y.3"): Value(number, "counts")}, force="a slip")
        found = validator.update([("cam.time_points", "Y.3")])
        assert ("57c422b.cam.speed-encoder" in {f.rule for f in found}) is (number > 1e5)
    assert any(isinstance(value, bytes) for value in seen)
    assert sum(isinstance(value, list) for value in seen) <= 1, "one rule asks for points by their places"
