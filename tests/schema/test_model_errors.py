"""What does not fit a model is reported in plain words, with the key that was meant,
and all of an entry at once.
"""

import pytest

from amp_studio.schema import DatabaseError
from amp_studio.schema.load import compile_family

PARAMETER = """
- id: a.speed
  name: Speed
  type: real
  ranges: {mm: [0, 10]}
  states: [{state: hidden, when: slow}]
  choices: [{key: one, label: One}]
  help: {what: How fast., wrong: Too slow.}
  page: "1"
"""


def refused(facts, head, parameters: str) -> DatabaseError:
    """Return the error of a small family with these parameters."""
    with pytest.raises(DatabaseError) as error:
        facts.schema(parameters, head)
    return error.value


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("name: Speed", "nmae: Speed", "a.speed: nmae: there is no such key, did you mean 'name'?"),
        (
            "name: Speed",
            "name: Speed\n  defualt: 3",
            "a.speed: defualt: there is no such key, did you mean 'default'?",
        ),
        ("wrong: Too", "wronge: Too", "a.speed: help: wronge: there is no such key, did you mean 'wrong'?"),
        (
            "label: One}",
            "lable: One}",
            "a.speed: choices: lable: there is no such key, did you mean 'label'?",
        ),
        ("when: slow", "wen: slow", "a.speed: states: wen: there is no such key, did you mean 'when'?"),
        ("name: Speed", "name: Speed\n  zzz: 3", "a.speed: zzz: there is no such key"),
        (
            "state: hidden",
            "state: hiden",
            (
                "a.speed: states: state: 'hiden' is not 'ignored', 'unusable' or 'hidden', did you mean"
                " 'hidden'?"
            ),
        ),
        (
            "type: real",
            "type: 7",
            "a.speed: type: '7' is not 'integer', 'real', 'choice', 'boolean', 'bits', 'text' or 'format'",
        ),
        ("name: Speed", "name: 7", "a.speed: name: must be a text: put '7' in quotes"),
        ("name: Speed", "name:", "a.speed: name: is empty"),
        ("{mm: [0, 10]}", "{mm: [0, fast]}", "a.speed: ranges: mm: must be a number"),
        ("{mm: [0, 10]}", "{mm: [0]}", "a.speed: ranges: mm: is missing"),
        ("{mm: [0, 10]}", "mm", "a.speed: ranges: must be names with what they are: {name: ...}"),
        ("name: Speed", "name: Speed\n  tunable: sometimes", "a.speed: tunable: must be true or false"),
        ("name: Speed", "name: Speed\n  decimals: 1.5", "a.speed: decimals: must be a whole number"),
        (
            "key: one",
            "key: One",
            "a.speed: choices: key: 'One' is no key: small letters, digits and _ . + - without a blank",
        ),
        ("name: Speed", "name: Speed\n  errata: e-1", "a.speed: errata: must be a list: [...]"),
    ],
)
def test_a_slip_is_reported_in_plain_words(facts, head, old, new, message) -> None:
    assert old in PARAMETER
    assert refused(facts, head, PARAMETER.replace(old, new)).what == message


def test_all_slips_of_one_entry_are_reported_at_once_each_with_its_line(facts, head) -> None:
    text = PARAMETER.replace("name: Speed", "colur: red").replace("type: real", "type: reel")
    other = "- {id: a.other, nam: Other}\n"
    error = refused(facts, head, text + other)
    assert (
        error.what
        == "a.speed: name: is missing; colur: there is no such key (line 7); type: 'reel' is not 'integer',"
        " 'real', 'choice', 'boolean', 'bits', 'text' or 'format', did you mean 'real'? (line 8)"
    )
    assert error.line == 6, "where the entry begins"


def test_an_entry_of_nothing_but_slips_is_reported_in_one_line_of_some_length(facts, head) -> None:
    many = "".join(f"  key_{n}: 1\n" for n in range(200))
    error = refused(facts, head, PARAMETER.rstrip() + "\n" + many)
    assert error.what.endswith("; and 191 more")
    assert len(error.what) < 600


def test_the_family_itself_is_reported_with_the_key_that_was_understood(facts, head) -> None:
    facts.write("family.yaml", head.replace("default_machine:", "defaultmachine:"))
    with pytest.raises(DatabaseError) as error:
        compile_family(facts.folder)
    assert error.value.what == "defaultmachine: there is no such key, did you mean 'default_machine'?"


def test_a_long_value_is_repeated_in_short(facts, head) -> None:
    error = refused(facts, head, PARAMETER.replace("type: real", f"type: {'r' * 100_000}"))
    assert error.what.startswith("a.speed: type: 'rrrr")
    assert len(error.what) < 200
