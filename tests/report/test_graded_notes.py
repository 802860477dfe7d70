"""Danger, warning and note of a parameter's help, as machine manuals grade them."""

from __future__ import annotations

import pytest

from amp_studio.report import help_parts, page_of
from amp_studio.schema import family_ids, load_schema


def test_a_danger_stands_before_the_help_with_its_page() -> None:
    schema = load_schema("9pc")
    parts = help_parts(schema, schema.parameters["servo.position_sign"])
    assert parts[0] == ("Danger", "A wrong sign can make the axis run away. (page 7-36)")
    assert parts[1][0] == "What it does"


def test_the_page_of_a_parameter_shows_what_the_manual_warns_of() -> None:
    page = page_of(load_schema("57c422b"), "R31")
    assert "Warning\n  Always limit the voltage reference" in page
    assert "(page 4-17)" in page


@pytest.mark.parametrize("family", family_ids())
def test_every_statement_is_whole_sentences_and_not_the_help_again(family: str) -> None:
    for parameter in load_schema(family).parameters.values():
        texts = parameter.help
        for statement in (*texts.danger, *texts.warning, *texts.note):
            assert statement.says.endswith("."), parameter.id
            assert statement.says not in " ".join((texts.what, texts.find, texts.wrong)), parameter.id
