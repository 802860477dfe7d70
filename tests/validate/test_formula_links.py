"""Parameters name their formulas: each name is a formula, and each formula has a parameter that names it."""

import inspect
import re

import pytest

from amp_studio.families.ninepc.formulas import largest_word, word_value
from amp_studio.schema import family_ids, load_schema
from amp_studio.validate import formulas


@pytest.mark.parametrize("family", family_ids())
def test_a_parameter_names_formulas_that_exist_and_each_once(family: str) -> None:
    known = formulas(family)
    for parameter in load_schema(family).parameters.values():
        assert [name for name in parameter.formulas if name not in known] == [], parameter.id
        assert len(set(parameter.formulas)) == len(parameter.formulas), parameter.id


@pytest.mark.parametrize("family", family_ids())
def test_a_formula_is_named_by_a_parameter_of_the_family(family: str) -> None:
    named = {name for parameter in load_schema(family).parameters.values() for name in parameter.formulas}
    assert set(formulas(family)) - named == set()


@pytest.mark.parametrize("name", formulas("9pc"))
def test_the_first_paragraph_of_a_formula_which_is_shown_cites_its_page(name: str) -> None:
    displayed = " ".join((inspect.getdoc(formulas("9pc")[name]) or "").partition("\n\n")[0].split())
    assert re.search(r"\b([0-9]+|A|B)-[0-9]+\b", displayed)


def test_the_word_formulas_read_every_printed_format() -> None:
    named = [p for p in load_schema("9pc").parameters.values() if "largest_word" in p.formulas]
    assert len(named) > 20
    for parameter in named:
        for choice in parameter.choices or ():
            for inch in (True, False):
                assert largest_word(choice.key, inch) >= 9, (parameter.id, choice.key)
                assert word_value("1", choice.key, inch, "leading") <= 1, (parameter.id, choice.key)
