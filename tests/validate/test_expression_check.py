"""What an expression of a builder's rule can give and cost is known before it runs."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import pytest

from amp_studio.schema import Rule, family_ids, load_schema
from amp_studio.validate.expression_check import ExpressionCheck
from amp_studio.validate.expression_tree import Node, read_expression
from amp_studio.validate.expression_worth import DECIMAL, YES_NO, list_result, text_result
from amp_studio.validate.functions import rule_functions
from amp_studio.validate.rule_review import MAX_STEPS, _functions, review
from tests.campaigns import some
from tests.work import calls_of

NAMES = {
    "n": DECIMAL,
    "on": YES_NO,
    "t": text_result(100),
    "many": list_result(8, DECIMAL),
    "texts": list_result(8, text_result(100)),
}


def checked(text: str) -> ExpressionCheck:
    """Return an expression over some names, looked through."""
    found = ExpressionCheck(NAMES, _functions("9pc"))
    found.result_of(read_expression(text))
    return found


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("n + 1", "'n + 1' mixes a whole number with a decimal one: write 1.0"),
        (
            "n * size(many)",
            "'n * size(many)' mixes a whole number with a decimal one: write double(size(many))",
        ),
        ("n % 2.0", "'%' takes whole numbers only: write mod(n, 2.0)"),
        ("'n is ' + n", "'n is ' is a text, and '+' cannot use it here: write string(...) around the number"),
        ("-t", "'t' is a text, and '-' cannot use it here"),
        ("n == 'x'", "'n' is a number and never equals 'x', a text"),
        ("n < 'x'", "'n' is a number and cannot be compared with 'x', a text"),
        (
            "on == 'yes'",
            "'on' is true or false and never equals 'yes', a text: compare it with true or false",
        ),
        ("n in ['x']", "'n' is a number and never equals what is in '['x']', a text"),
        ("n in t", "'in' needs a list, and 't' is a text"),
        ("n && on", "'n' is a number, where true or false is wanted"),
        ("!t", "'t' is a text, where true or false is wanted"),
        ("many.all(m, m)", "'m' is a number, where true or false is wanted"),
        ("n.all(m, true)", "'all' goes over a list, and 'n' is a number"),
        ("n[0]", "'n' is a number and has no items: take the brackets away"),
        ("many[n]", "'n' is a number, and items are counted by whole numbers: write int(n)"),
        ("abs(t)", "abs takes a number, not 't', a text"),
        ("timestamp(t)", "'timestamp' is no function"),
        ("t.matches(t)", "the pattern of matches must be written out, not 't'"),
        ("t.matches('(?x)a')", "a pattern may begin groups with '(?:' and '(?i)' and no other '(?'"),
        ("m > 1.0 || many.all(m, true)", "'m' is not read: add it under reads, or did you mean 'n'?"),
    ],
)
def test_what_can_never_be_understood_is_reported(text: str, message: str) -> None:
    (slip,) = checked(text).slips
    assert slip.removesuffix("?").split(", or")[0] == message.removesuffix("?").split(", or")[0]


@pytest.mark.parametrize(
    "text",
    [
        "n <= 15000",
        "n == 1",
        "n == null || t == null",
        "double(size(many)) * n > 1.0",
        "size(many) * 2 + 1 > int(n)",
        "(many + [1.0]).exists(m, m in many && m != null)",
        "texts.filter(x, x == t)[0] + 'x' == string(n) + t",
        "many.map(m, m > 1.0, m * 2.0)[0] > (on ? n : many[1])",
        "t.matches('(?i)^[a-z]{3}$')",
    ],
)
def test_what_can_be_understood_is_left_alone(text: str) -> None:
    assert checked(text).slips == []


@pytest.mark.parametrize(
    "text",
    [
        "size([1, 2]" + ".map(x, [x, x])" * 30 + ") > 0",
        "size([many]" + ".map(x, x + x)" * 30 + "[0]) > 0",
        "size(['aaaaaaaaaa']" + ".map(x, x + x)" * 40 + "[0]) > 0",
        "size([t]" + ".map(x, x + x + x + x)" * 20 + "[0]) > 0",
        "many.all(a, " * 9 + "true" + ")" * 9,
        r"t.matches('((\\w{100}){100}){100}')",
        "[" + ",".join(["1"] * 900) + "].map(x, [" + ",".join(["1"] * 900) + "]) == []",
    ],
    ids=range(7),
)
def test_what_would_take_all_memory_or_time_is_beyond_the_budget(text: str) -> None:
    assert checked(text).cost > MAX_STEPS


# ------------------------------------------------------------------------------------- the rules we deliver

DELIVERED = [(family, rule) for family in family_ids() for rule in load_schema(family).rules]
LARGE = {"syntec.mpg.axis-missing": "the pattern of matches must be written out"}
"""What our own rules may do and a builder's may not: a pattern that is worked out."""


def test_no_rule_that_we_deliver_compares_what_can_never_be_equal() -> None:
    for family, rule in DELIVERED:
        slips = [slip for _, slip in review(rule, load_schema(family), any_family=False).slips]
        assert [LARGE.get(rule.id, "no slip") in slip for slip in slips] == [True] * (rule.id in LARGE), (
            rule.id
        )


def compared(node: Node) -> Iterator[str]:
    """Yield the texts that choices are compared with, as far as a plain look can find them."""
    if node.kind in ("==", "!="):
        yield from (part.text for part in node.parts if part.kind == "value" and isinstance(part.value, str))
    for part in node.parts:
        yield from compared(part)


def choices_of(rule: Rule, family: str) -> set[str]:
    parameters = load_schema(family).parameters
    read = (parameters[text.partition("@")[0]] for text in rule.reads.values())
    return {
        choice.key for parameter in read if parameter.type == "choice" for choice in parameter.choices or ()
    }


@pytest.mark.parametrize("family", ["9pc", "num", "syntec", "acromill"])
def test_a_mistyped_key_in_any_rule_that_we_deliver_would_be_noticed(family: str) -> None:
    tried = 0
    for rule in load_schema(family).rules:
        for text in dict.fromkeys(compared(read_expression(rule.check))):
            if text[1:-1] in choices_of(rule, family) and "filter" not in rule.check:
                wrong = rule.model_copy(update={"check": rule.check.replace(text, f"{text[:-1]}zz'")})
                message = [slip for _, slip in review(wrong, load_schema(family), any_family=False).slips]
                assert any("is never" in slip for slip in message), (rule.id, text)
                tried += 1
    assert tried >= {"9pc": 80, "num": 1, "syntec": 2, "acromill": 1}[family]


# ------------------------------------------------------------------------------------- functions for rules

ABSURD = (
    0.0,
    -1.0,
    1e10,
    1e300,
    -1e300,
    float("inf"),
    float("nan"),
    5e-324,
    10**18,
    -(10**18),
    None,
    "abc",
    [1.0],
    [],
)


def _small_or_refused(name: str, function: Callable[..., object], arguments: int) -> None:
    for first in ABSURD:
        for other in ABSURD:
            try:
                found = function(*([first] + [other] * (arguments - 1)))
            except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError):
                continue
            assert len(re.sub(r"\s", "", repr(found))) < 1000, (name, first, other)


@pytest.mark.parametrize("family", some(family_ids(), 2))
def test_no_function_for_rules_takes_long_or_much_whatever_it_is_given(family: str) -> None:
    """A field of 10^10 bits, a round to 10^9 places, a text times a billion: each is refused,
    or is quick and small.
    """
    for name, function in rule_functions(family).items():
        most = _functions(family)[name].most
        assert calls_of(partial(_small_or_refused, name, function, most)) < 20_000, name


def test_signatures_come_from_the_formulas() -> None:
    functions = _functions("9pc")
    assert (functions["min"].fewest, functions["min"].most) == (2, 2)
    assert functions["rollover_position"].fewest == 2
    assert replace(functions["lowest_terms"].gives, item=None).kind == "list"
