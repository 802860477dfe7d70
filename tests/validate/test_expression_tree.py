"""Expressions of builders' rules are read into trees, with bounds, before the engine gets them."""

import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.schema import family_ids, load_schema, program
from amp_studio.validate.expression_tree import (
    DEEPEST,
    DEEPEST_BRACKETS,
    LONGEST,
    ExpressionError,
    Node,
    read_expression,
)
from tests.campaigns import examples


def told(text: str) -> str:
    """Return why a text is no expression."""
    with pytest.raises(ExpressionError) as refused:
        read_expression(text)
    return str(refused.value)


def written(node: Node) -> str:
    """Return a tree with all its brackets."""
    parts = [written(part) for part in node.parts]
    if node.kind in ("value", "name"):
        return repr(node.value)
    name = f"{node.value} " if node.value is not None else ""
    return f"({node.kind} {name}{' '.join(parts)})"


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("1 + 2 * 3", "(+ 1 (* 2 3))"),
        ("1.5 - 2.0 - 3.0", "(- (- 1.5 2.0) 3.0)"),
        ("a < 1 == true", "(== (< 'a' 1) True)"),
        ("a || b && !c || d", "(|| 'a' (&& 'b' (! 'c')) 'd')"),
        ("a ? b : c ? d : e", "(?: 'a' 'b' (?: 'c' 'd' 'e'))"),
        ("-a[0]", "(negative (index 'a' 0))"),
        ("'it' in ['it', \"is\"]", "(in 'it' (list 'it' 'is'))"),
        ("a.all(x, x > 0.0)", "(over all 'a' (> 'x' 0.0))"),
        ("name.startsWith('x')", "(call startsWith 'name' 'x')"),
        ("{'a': 1}['a']", "(index (table 'a' 1) 'a')"),
        (r"'a\'b' + '\n'", r"""(+ "a'b" '\n')"""),
        ("0x1F + 1e3 // and so on", "(+ 31 1000.0)"),
        ("null == .5", "(== None 0.5)"),
    ],
)
def test_an_expression_is_read_as_the_engine_reads_it(text: str, tree: str) -> None:
    assert written(read_expression(text)) == tree


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        (" // nothing", "is empty"),
        ("a = 1", "'=' is no operator: write '=='"),
        ("a and b", "'and' is no operator: write '&&'"),
        ("a & b", "'&' is no operator: write '&&'"),
        ("not a", "'not' is no operator: write '!'"),
        ("a ==", "a value is missing behind '==' at the end"),
        ("(a + 1", "')' is missing at the end"),
        ("[1, 2", "']' is missing at the end"),
        ("a ? b", "':' is missing behind '?' at the end"),
        ("a b", "'b' behind 'a' makes no sense"),
        ("a)) || ((true", "')' behind 'a' makes no sense"),
        ("a.b.c", "'a.b': a value has no parts"),
        ("a.all(true, true)", "'all' takes a name for the items, a comma and an expression"),
        ("loop > 1.0", "'loop' is a word of the language and can be no name"),
        ("1e400", "'1e400' is too large a number"),
        ("9223372036854775808", "'9223372036854775808' is too large a whole number; write it with a point"),
        ("a\0b", "'\\u0000' has no place in an expression"),
        ("é", "'é' has no place in an expression"),
        ("r'raw'", "'raw' behind 'r' makes no sense"),
        ("'''three'''", "'three' behind '' makes no sense"),
        ("'\ud800'", "'\\ud800' is no text"),
    ],
)
def test_a_slip_is_told_in_plain_words(text: str, said: str) -> None:
    assert told(text) == said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (" + ".join(["1"] * 20_000), f"and {LONGEST:,} are the most"),
        ("(" * 100_000 + ")" * 100_000, f"and {LONGEST:,} are the most"),
        ("(" * 100 + "1" + ")" * 100, f"more than {DEEPEST_BRACKETS} brackets"),
        ("[" * 100 + "]" * 100, f"more than {DEEPEST_BRACKETS} brackets"),
        ("a ? b : " * 100 + "c", f"more than {DEEPEST_BRACKETS} brackets or alternatives"),
        ("abs(" * 100 + "1" + ")" * 100, f"more than {DEEPEST_BRACKETS} brackets"),
        ("+".join(["1"] * 500), f"more than {DEEPEST} operations"),
        ("!" * 500 + "a", f"more than {DEEPEST} operations"),
        ("a" + "[0]" * 500, f"more than {DEEPEST} operations"),
        ("a" + ".abs()" * 500, f"more than {DEEPEST} operations"),
    ],
    ids=range(10),
)
def test_what_would_end_the_engine_is_refused(text: str, said: str) -> None:
    assert said in told(text)


DEEP = f"""
import threading
from amp_studio.schema.cel_engine import Context, compile_expression
from amp_studio.validate.expression_tree import read_expression
n, deep = {DEEPEST_BRACKETS - 1}, {DEEPEST - 2}
texts = ["(" * n + "1" + ")" * n, "[" * n + "1" + "]" * n, "true ? 1 : " * n + "1", "+".join(["1"] * deep),
         "[1].all(x, " * n + "true" + ")" * n, "!(" * n + "true" + ")" * n, "1 in [" * n + "]" * n,
         "abs(" * n + "1.0" + ")" * n, "[1]" + ".map(x, x)" * deep, "1.0" + ".abs()" * deep,
         "&&".join(["true"] * 600)]
done = []
def run():
    for text in texts:
        read_expression(text)
        context = Context({{}})
        context.add_function("abs", abs)
        compile_expression(text).execute(context)
        done.append(text)
threading.stack_size(512 * 1024)
thread = threading.Thread(target=run)
thread.start()
thread.join()
assert len(done) == len(texts), texts[len(done)][:30]
"""


def test_the_deepest_expressions_fit_into_the_stack_of_any_thread() -> None:
    """A thread of macOS has 512 kB; a process that ran out of it would just end."""
    subprocess.run([sys.executable, "-c", DEEP], check=True, timeout=60)


def test_every_rule_that_we_deliver_is_read() -> None:
    for rule in (rule for family in family_ids() for rule in load_schema(family).rules):
        assert read_expression(rule.check).text == rule.check.split("//")[0].strip() or rule.check
        for text in (rule.when, *rule.values.values(), *(s.value for s in (*rule.fix, *rule.effective))):
            read_expression(text)


PIECES = st.sampled_from(
    [
        "a",
        "b",
        "1",
        "2.5",
        "'x'",
        '"y"',
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        ",",
        ":",
        "?",
        ".",
        "+",
        "-",
        "*",
        "/",
        "%",
        "!",
        "&&",
        "||",
        "==",
        "!=",
        "<",
        "<=",
        "in",
        "true",
        "null",
        "size",
        "all",
        ".all(x, ",
        "'",
        "\\",
        "//",
        "\n",
        " ",
        "0x",
        "e5",
        "r",
        "`",
        ";",
        "é",
        "\0",
        "in",
    ]
)


@settings(max_examples=examples(400))
@given(st.one_of(st.lists(PIECES, max_size=12).map("".join), st.text(max_size=30)))
def test_whatever_is_read_the_engine_reads_too(text: str) -> None:
    try:
        read_expression(text)
    except ExpressionError:
        return
    program(text)
