"""The one reader of YAML: what it takes, what it refuses, and where."""

from __future__ import annotations

import contextlib
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema.yaml_reader import LARGEST, YamlError, read_yaml, spelled_scalar, text_scalar


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
        "\n" * 2_000_000 + "a: *x",
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
    begun = time.process_time()
    with pytest.raises(YamlError):
        read_yaml(text)
    assert time.process_time() - begun < 3


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
