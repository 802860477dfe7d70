"""The verb ``find``: from what a person remembers, or what the control shows, to the parameters."""

import json
from pathlib import Path

EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


def test_a_message_without_a_family_is_found_in_the_one_that_has_it(amp) -> None:
    sentence = amp("find", "SERVO AMP FE LIMITS")
    lines = sentence.out.splitlines()
    assert (sentence.code, lines[0]) == (0, "9pc      SERVO AMP FE LIMITS CORRECTED")
    assert "    - 1750 Excess Error" in lines
    assert "  Page 7-20, 7-21, 7-22, 7-24" in lines


def test_a_slip_in_a_family_is_forgiven_and_named(amp) -> None:
    lines = amp("find", "9pc", "exess", "error").out.splitlines()
    assert lines[0] == "1750 Excess Error: Servo Parameters, page 7-20 (name, 'exess' as 'excess')"
    assert amp("find", "--family", "9pc", "exess error").out.splitlines()[0] == lines[0]


def test_a_file_shows_the_values_of_the_message_and_the_rules_it_breaks(amp, example: Path) -> None:
    assert amp("set", example, "1740=20", "1750=10").code == 0
    data = amp("find", example, "SERVO AMP FE LIMITS", "--json").json
    message = data["hits"][0]
    assert (message["kind"], message["id"], message["source"]) == (
        "message",
        "following-error-limits-corrected",
        "7-20",
    )
    excess = next(p for p in message["params"] if p["id"] == "servo.excess_error")
    assert {"param": "servo.excess_error@1", "value": "10 mm"} in excess["values"]
    broken = [rule["rule"] for rule in message["rules"] if rule["broken"]]
    assert "9pc.servo.suppression-within-excess" in broken
    assert "Broken in this file: " in amp("find", example, "SERVO AMP FE LIMITS").out


def test_a_value_leads_to_the_number_of_its_parameter(amp, example: Path) -> None:
    assert amp("set", example, "2750=17.125").code == 0
    hit = amp("find", example, "17.125", "mm", "--json").json["hits"][0]
    assert (hit["kind"], hit["param"], hit["instance"], hit["title"]) == ("value", "2750", "2", "17.125 mm")


def test_a_question_without_an_answer_names_the_other_families_and_where_everything_is(amp) -> None:
    sentence = amp("find", "syntec", "debounce")
    assert sentence.out == "Nothing found for 'debounce'\n"
    assert "In another family: grblhal: $26 Homing switch debounce delay" in sentence.err
    assert "amp-studio guide syntec" in sentence.err
    first, *_ = json.loads(amp("find", "syntec", "debounce", "--json").out)["elsewhere"]
    assert first == {
        "family": "grblhal",
        "id": "homing.debounce",
        "title": "$26 Homing switch debounce delay",
    }


def test_a_german_word_finds_what_the_manual_calls_otherwise(amp) -> None:
    best, *_ = json.loads(amp("find", "9pc", "Schleppfehler", "--json").out)["hits"]
    assert (best["id"], best["why"]) == ("servo.excess_error", "'schleppfehler' as 'excess error'")


def test_where_nothing_is_found_the_nearest_is_offered(amp) -> None:
    assert amp("find", "num", "ssaamplingg").out == "Nothing found for 'ssaamplingg'. Nearest: sampling\n"
    assert amp("find", "num", "qxqxqxq", "--json").json == {"query": "qxqxqxq", "hits": [], "nearest": ""}


def test_what_steers_a_terminal_is_shown_and_not_obeyed(amp) -> None:
    sentence = amp("find", "num", "qq\x1b[31mqqqq")
    assert (sentence.code, "\x1b" in sentence.out) == (0, False)
    assert amp("find", "num", "q" * 9000).code == 0


def test_the_number_of_hits_is_bounded(amp) -> None:
    assert len(amp("find", "9pc", "servo", "--limit", "3").out.splitlines()) == 3
    assert len(amp("find", "9pc", "servo", "--json").json["hits"]) == 20


def test_what_cannot_be_searched_is_refused(amp, tmp_path: Path) -> None:
    assert (
        amp("find", "9pc").err
        == "amp-studio: Nothing to find: give a number, a word, a value or a message of the control\n"
    )
    assert amp("find", "--family", "9pcc", "x").code == 2
    assert amp("find", tmp_path / "no.amp", "x").code == 2
