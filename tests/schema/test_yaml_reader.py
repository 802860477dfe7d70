"""The one reader of YAML: what it takes, what it refuses, and where."""

import contextlib
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from amp_studio.files.example_files import examples_folder
from amp_studio.schema.yaml_reader import (
    LARGEST,
    YamlError,
    _plain_lines,
    read_yaml,
    spelled_scalar,
    text_scalar,
)
from tests.campaigns import examples
from tests.work import calls_of


def refused(text: str) -> tuple[str, int | None]:
    """Return why a text is refused, and its line."""
    with pytest.raises(YamlError) as error:
        read_yaml(text)
    return error.value.what.removeprefix("is not readable: "), error.value.line


def test_plain_values_are_what_they_look_like_and_quoted_ones_are_texts() -> None:
    text = "a: 1\nb: 2.5\nc: true\nd: ~\ne: '1'\nf: 0x1F\ng: [yes, 1e3, -.5]\nh: {i: x}\n7: seven\n2.: b\n"
    expected = {
        "a": 1,
        "b": 2.5,
        "c": True,
        "d": None,
        "e": "1",
        "f": 31,
        "g": ["yes", 1000.0, -0.5],
        "h": {"i": "x"},
        "7": "seven",
        "2.": "b",
    }
    assert read_yaml(text).data == expected


@pytest.mark.parametrize(
    "text", ["2001-99-99", "2001-12-14", "<<", ".nan", ".inf", "1e999", "9" * 5000, "1:30", "=", "1_000"]
)
def test_what_other_readers_take_for_dates_merges_and_endless_numbers_is_a_text(text: str) -> None:
    assert read_yaml(f"{text}: 1\nb: {text}\n" if len(text) < 100 else f"b: {text}\n").data["b"] == text


@pytest.mark.parametrize(
    ("text", "what", "line"),
    [
        ("a: 1\nb: &x 2\n", "it uses a YAML reference", 2),
        ("a: 1\nb: *x\n", "it uses a YAML reference", 2),
        ("a:\n  <<: *x\n", "it uses a YAML reference", 2),
        ("s: !!int\n", "it uses a YAML tag", 1),
        ("s: !!python/object:os.system x\n", "it uses a YAML tag", 1),
        ("a: 1\n---\nb: 2\n", "something comes after its end", 2),
        ("a: 1\n...\n...\n", "something comes after its end", 3),
        ("# x\n%YAML 1.1\n---\na: 1\n", "it begins with a YAML directive", 2),
        ("a: 1\nb: 2\na: 3\n", "'a' occurs twice", 3),
        ("? [a, b]\n: 1\n", "a key is no text", 1),
        ("a:\n  b: \x07\n", "the character U+0007 has no place in it", 2),
        ("a: 1\nb: \ufeff\n", "the character U+FEFF has no place in it", 2),
        ("a: " + "[" * 900, "more than 50 lists and mappings in each other", 1),
        ("- " * 900, "more than 50 lists and mappings in each other", 1),
        (f"a:\n  {'x' * 1100}: 1\n", "mapping values are not allowed in this context", 2),
        ("a: [1\nb: 2", "did not find expected ',' or ']'", 2),
    ],
)
def test_what_no_file_here_needs_is_refused_with_its_line(text: str, what: str, line: int) -> None:
    assert refused(text) == (what, line)


@pytest.mark.parametrize(
    "text",
    [
        "[" * 1_000_000,
        "{a: " * 200_000,
        "- " * 500_000,
        "%TAG !a! tag:x\n" * 100_000,
        "a: 1\n...\n" + "%TAG !a! tag:x\n" * 100_000,
        "a: &a [x]\n" + "".join(f"b{n}: &b{n} [*a, *a]\n" for n in range(50_000)),
        "\n" * 300_000 + "a: *x",
        "a: '" + "x" * (LARGEST + 1),
    ],
    ids=[
        "brackets",
        "braces",
        "dashes",
        "directives",
        "directives behind",
        "references",
        "empty lines",
        "too large",
    ],
)
def test_a_text_that_is_made_to_cost_time_or_memory_costs_little(text: str) -> None:
    def refused() -> None:
        with pytest.raises(YamlError):
            read_yaml(text)

    assert calls_of(refused) < 4 * len(text) + 10_000


def test_an_entry_has_its_place_in_the_text() -> None:
    document = read_yaml("# 😀\na: é\nb:\n  - c: 'x'\n  - {d: 2}\n", spans=True)
    spans = document.spans
    assert spans is not None
    assert {path: document.line(path) for path in spans} == {
        ("a",): 2,
        ("b", 0, "c"): 4,
        ("b", 0): 4,
        ("b", 1, "d"): 5,
        ("b", 1): 5,
        ("b",): 3,
    }
    told = spans["b", 0, "c"]
    assert (document.text[told.start : told.value], document.text[told.value : told.end]) == ("c: ", "'x'")
    assert document.line(("b", 1, "no such key")) == 5


def test_a_number_can_remember_how_it_is_spelled() -> None:
    found = read_yaml("a: 1.10\nb: 0x1F\nc: 2.5\n", spelled_scalar).data
    assert found == {"a": 1.1, "b": 31, "c": 2.5}
    assert [getattr(found[key], "spelling", None) for key in "abc"] == ["1.10", "0x1F", None]


@given(st.text(st.characters(codec="utf-8"), max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    for scalar in (None, text_scalar, spelled_scalar):
        with contextlib.suppress(YamlError):
            read_yaml(text, scalar, spans=True)


# -- lines that can mean but one thing ---------------------------------------------------------------------

LINES = """a: 1|b:|  c: 'x'|  d: 2 mm|  e:|# r||  # r|...|f: x y|  g@X: -5 mm # c|h: 'it''s'|i: "x"|j: [1]
  k: '#'|l: x#y|m: x #y|n:x|  o: ~|p: null|q: 0x1F
r: 1.10|---| s: 1|    t: 1|u: - 1|v: -|w: 'a' b|x: .|y: +|  z: 10 %
aa: a: b|1300: 5|bb: yes|cc: 5  6|dd: 5 |\tee: 1|ff: 1\r|  a: 3|gg: %x|hh: @x|ii: 1, 2|jj: a;b|kk: <x>|ll: =1
...x|... # c|mm: a-|nn: -.5|oo: -x|pp: °|qq: é|rr: .inf|- a|? a|ss: 2001-01-01|tt: *a|uu: a*b@c|vv: ''
ww: ' a '|xx: $FF (default)|yy: G22 - 2 & 3|zz: &a b|ab: C16 ~ C19|ac: ~x|ad: !x|ae: |af: >|ag: %""".replace(
    "\n", "|"
).split("|")


@settings(max_examples=examples(300))
@given(st.lists(st.sampled_from(LINES), min_size=1, max_size=8), st.sampled_from(["", "\n", "\n...\n"]))
@example(["a: 1", "  b: 2"], "")
@example(["b:", "  c: 'x'", "  c: 'y'"], "\n")
@example(["b:", "# r", "a: 1"], "\n...\n")
def test_a_text_of_plain_lines_is_what_the_parser_makes_of_it(lines: list[str], end: str) -> None:
    text = "\n".join(lines) + end
    for scalar in (text_scalar, spelled_scalar):
        quick = _plain_lines(text, scalar)
        if quick is not None:
            whole = read_yaml(text, scalar, spans=True)
            assert (repr(quick.data), quick.is_closed) == (repr(whole.data), whole.is_closed)


@pytest.mark.parametrize("path", sorted(examples_folder().glob("*/*.amp")), ids=lambda path: path.stem)
def test_a_file_of_this_program_needs_no_parser(path: Path) -> None:
    text = path.read_text("utf-8")
    quick, whole = _plain_lines(text, text_scalar), read_yaml(text, text_scalar, spans=True)
    assert quick is not None
    assert (quick.data, list(quick.data["values"]), quick.is_closed) == (
        whole.data,
        list(whole.data["values"]),
        True,
    )
