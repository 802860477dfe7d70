"""German and trade words, and what people see: each leads to something in the manuals' words."""

from collections import Counter

import pytest

from amp_studio.find import Finder, elsewhere
from amp_studio.find.synonyms import SYNONYMS_FILE, meanings, nearest_synonym
from amp_studio.schema import family_ids, load_schema, read_yaml

SYNONYMS = read_yaml(SYNONYMS_FILE.read_text("utf-8")).data["synonyms"]


@pytest.fixture(scope="module")
def finders() -> dict[str, Finder]:
    schemas = {name: load_schema(name) for name in family_ids()}
    return {name: Finder(schema, schema.family.default_machine) for name, schema in schemas.items()}


def test_no_word_means_two_things() -> None:
    words = Counter(word.casefold() for each in SYNONYMS for word in each["words"])
    assert [word for word, count in words.items() if count > 1] == []


def test_each_group_of_words_leads_to_something_in_a_family(finders: dict[str, Finder]) -> None:
    def leads(word: str, finder: Finder) -> bool:
        return any(word.casefold() in hit.why or hit.score > 5 for hit in finder.find(word, 3))

    words = [each["words"][0] for each in SYNONYMS]
    assert [word for word in words if not any(leads(word, finder) for finder in finders.values())] == []


@pytest.mark.parametrize(
    ("query", "means"),
    [
        ("Schleppfehler", "excess error"),
        ("schleppfehlr", "excess error"),
        ("Schleppf", "excess error"),
        ("größter Schleppfehler", "excess error"),
        ("Endschaltern", "limit switch"),
        ("Not-Halt", "emergency stop"),
        ("axis oscillates at 3 m", "initial gain of position loop at 3 m"),
        ("ruckelt", "initial gain of position loop"),
        ("Nullpunkt stimmt nicht", "home calibration"),
        ("falsche Richtung", "direction invert"),
        ("Spindel dreht nicht", "spindle enable"),
    ],
)
def test_a_word_is_known_begun_mistyped_with_an_ending_and_among_others(query: str, means: str) -> None:
    assert next(meanings(query)).query == means


def test_words_that_no_manual_has_leave_the_synonym_beside_them_found(finders: dict[str, Finder]) -> None:
    for family, query, wanted in (
        ("num", "Endschalter spricht an", "travel.limit_min"),
        ("9pc", "Achse fährt in die falsche Richtung", "servo.position_sign"),
        ("syntec", "Achse schwingt bei hohem Vorschub", "servo.loop_gain"),
        ("syntec", "cant leave home dog", "mot-036"),  # known words count, mistyped too
    ):
        assert finders[family].find(query, 1)[0].key == wanted


@pytest.mark.parametrize("query", ["1300", "lead screw", "qwertz", "", "not", "12.7 mm"])
def test_what_is_no_word_of_it_stays_as_it_is(query: str) -> None:
    assert list(meanings(query)) == []


def test_a_question_without_an_answer_has_a_near_word_and_the_families_that_have_it(
    finders: dict[str, Finder],
) -> None:
    assert finders["syntec"].find("debounce") == []
    others = elsewhere("debounce", [f for n, f in finders.items() if n != "syntec"])
    assert others[0][0].family.family == "grblhal"
    assert nearest_synonym("Umkerschpiel") == "umkehrspiel"
    assert nearest_synonym("zzzzzzzzzz") == ""
