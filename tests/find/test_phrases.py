"""What an integrator types at a machine: the first three hits of each family that has it have what he
needs."""

import re
from pathlib import Path

import pytest

from amp_studio.find import Finder
from amp_studio.schema import family_ids, load_schema, read_yaml

PHRASES = read_yaml(Path(__file__).with_name("phrases.yaml").read_text("utf-8")).data


def test_there_are_sixty_of_them_in_two_languages() -> None:
    asked = [phrase for each in PHRASES for phrase in each["ask"]]
    assert len(asked) >= 60
    assert all(set(each.get("not", ())) < set(family_ids()) for each in PHRASES)


@pytest.mark.parametrize("family", family_ids())
def test_the_first_three_have_what_is_needed(family: str) -> None:
    schema = load_schema(family)
    finder = Finder(schema, schema.family.default_machine)
    missed = {
        phrase: [hit.key for hit in finder.find(phrase)[:3]]
        for each in PHRASES
        if family not in each.get("not", ())
        for phrase in each["ask"]
        if not any(re.search(each["first"], hit.key) for hit in finder.find(phrase)[:3])
    }
    assert missed == {}


@pytest.mark.parametrize(("family", "query"), [("grblhal", "chatter"), ("acromill", "hunting")])
def test_a_word_of_the_trade_is_not_taken_for_a_mistyped_one(family: str, query: str) -> None:
    schema = load_schema(family)
    found = Finder(schema, schema.family.default_machine).find(query)
    assert not any(re.search("[Cc]utt", hit.title) for hit in found)
