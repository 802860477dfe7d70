"""Symptoms: what a person sees or hears, as messages of our own in each family."""

import re

import pytest

from amp_studio.find import Finder
from amp_studio.scenarios import scenario_names
from amp_studio.schema import fact_texts, family_ids, load_schema

SYMPTOMS = {
    f"symptom-{name}"
    for name in (
        "oscillates",
        "creeps",
        "runs-away",
        "hot-motor",
        "stays-in-estop",
        "wrong-size",
        "drifts",
        "bangs-at-reversal",
        "loses-home",
    )
}
OPEN_LOOP = {"grblhal": {"symptom-oscillates"}}
"""What a control without a servo loop cannot have."""
HEARD = {
    "symptom-creeps": ("axis creeps", "Achse kriecht"),
    "symptom-runs-away": ("motor runs away", "Motor geht durch"),
    "symptom-hot-motor": ("hot motor", "Motor heiß"),
    "symptom-stays-in-estop": ("won't come out of E-stop", "kommt nicht aus Not-Halt"),
    "symptom-wrong-size": ("parts have the wrong size", "falsches Maß"),
    "symptom-drifts": ("position drifts", "verliert Schritte"),
    "symptom-bangs-at-reversal": ("bangs at reversal", "schlägt bei Umkehr"),
    "symptom-loses-home": ("loses home", "verliert Referenz"),
}


@pytest.mark.parametrize("family", family_ids())
def test_each_symptom_leads_to_parameters_and_scenarios_in_two_languages(family: str) -> None:
    schema = load_schema(family)
    if not schema.messages:
        pytest.skip("a plain family has no messages")
    listed = {m.id: m for m in schema.messages.values() if m.reaction == "symptom"}
    assert set(listed) == SYMPTOMS - OPEN_LOOP.get(family, set())
    german = fact_texts(family, "de").sentences
    for symptom in listed.values():
        assert len(symptom.params) >= 2
        assert set(symptom.scenarios) <= set(scenario_names())
        for text in (symptom.title, symptom.means, *symptom.causes, *symptom.cures):
            assert german[text] != text
            assert family not in OPEN_LOOP or not re.search(
                r"\b(loop|feedback|following error|gains?)\b", text
            )


@pytest.mark.parametrize("family", ["9pc", "grblhal", "linuxcnc"])
@pytest.mark.parametrize("symptom", HEARD)
def test_a_symptom_is_found_by_the_words_of_both_languages(family: str, symptom: str) -> None:
    schema = load_schema(family)
    finder = Finder(schema, schema.family.default_machine)
    for question in HEARD[symptom]:
        assert symptom in [hit.key for hit in finder.find(question)[:6]], question
