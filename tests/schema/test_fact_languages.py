"""The facts of a family in another language: nothing that decides is missing, and a slip has its file and
line.
"""

import re
from pathlib import Path

import pytest

from amp_studio.schema import database_folder, fact_texts, family_ids, load_schema
from amp_studio.schema.load import DatabaseError, fact_files, load_compiled
from amp_studio.schema.translation.texts import NO_TEXTS, compile_texts, missing_texts

FAMILIES = sorted(path.parent.name for path in database_folder().glob("*/de"))


@pytest.mark.parametrize("family", FAMILIES)
def test_what_decides_in_a_family_that_has_german_has_german(family: str) -> None:
    assert [".".join(map(str, place)) for place in missing_texts(family, "de")] == []


def test_a_start_neither_reads_nor_hashes_the_facts_of_another_language() -> None:
    folder = database_folder() / "9pc"
    assert not [path for path in fact_files(folder) if path.relative_to(folder).parts[0] == "de"]


def test_english_and_a_family_without_a_language_have_no_texts() -> None:
    assert fact_texts("9pc", "en") is fact_texts("9pc", "fr") is fact_texts("small", "de") is NO_TEXTS


def test_the_id_of_a_rule_begins_with_its_family() -> None:
    rules = [
        (rule.id.partition(".")[0], family) for family in family_ids() for rule in load_schema(family).rules
    ]
    assert [pair for pair in rules if pair[0] != pair[1]] == []


SLIPS = {
    'rules: {9pc.home.position-outside-travel: {title: T, message: "{position} {negative}"}}': (
        "has other names in braces than the English text"
    ),
    "rules: {9pc.home.nonsense: {title: T, message: M}}": (
        "rules.9pc.home.nonsense.title: there is no such text"
    ),
    "help: {home.calibration: {warning: [a, b]}}": "help.home.calibration.warning.1: there is no such text",
    'phrases: {"as {it} is": wie es ist}': "has other names in braces",
    "rule: {}": "rule",
}


@pytest.mark.parametrize(("text", "wrong"), SLIPS.items(), ids=range(len(SLIPS)))
def test_a_slip_in_a_language_has_its_file_and_its_line(tmp_path: Path, text: str, wrong: str) -> None:
    path = tmp_path / "slip.yaml"
    path.write_text(text + "\n", encoding="utf-8")
    with pytest.raises(DatabaseError, match=re.escape(wrong)) as error:
        compile_texts(load_compiled("9pc"), [path])
    assert "slip.yaml" in str(error.value)
    assert "1" in str(error.value)


def test_a_sentence_that_several_parameters_have_is_written_once() -> None:
    texts = fact_texts("9pc", "de")
    help_of = load_schema("9pc").parameters["zone.limit3_min"].help
    assert texts.sentences[" ".join(help_of.danger[0].says.split())].startswith("Zonen und Softwareendlagen")


@pytest.mark.parametrize("family", family_ids())
def test_a_danger_is_known_in_three_to_five_words_too_which_are_german_in_a_german_window(
    family: str,
) -> None:
    dangers = [each for p in load_schema(family).parameters.values() for each in p.help.danger]
    german = fact_texts(family, "de").sentences
    assert [each.says for each in dangers if not 3 <= len(each.brief.split()) <= 5] == []
    if family in FAMILIES:
        assert [each.brief for each in dangers if not 3 <= len(german.get(each.brief, "").split()) <= 5] == []
