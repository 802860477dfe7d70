"""Every language has every text under its id, and an English text has one id in its section."""

from collections import Counter
from typing import get_args

import pytest

from amp_studio.languages import language_codes, name_of_language
from amp_studio.languages.catalogue import TextSection, texts_of
from amp_studio.schema import program_texts
from scripts.translations import calls, new_id, updated

SECTIONS = get_args(TextSection)


@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize("code", language_codes())
def test_a_language_has_a_text_for_each_id_and_for_no_other(code: str, section: TextSection) -> None:
    own = texts_of(code, section)
    assert set(own) == set(texts_of("en", section))
    assert [key for key, text in own.items() if not text or not all(text)] == []


@pytest.mark.parametrize("section", SECTIONS)
def test_an_english_text_has_one_id(section: TextSection) -> None:
    sources = Counter(
        text if isinstance(text, str) else text[-1] for text in texts_of("en", section).values()
    )
    assert [text for text, count in sources.items() if count > 1] == []


def test_a_text_with_a_number_has_its_forms_in_every_language() -> None:
    numbered = {key for key, text in texts_of("en", "window").items() if isinstance(text, list)}
    for code in language_codes():
        assert {key for key, text in texts_of(code, "window").items() if isinstance(text, list)} == numbered
    assert program_texts("de", "window")["%n axes"] == ["%n Achse", "%n Achsen"]


def test_an_unknown_language_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(ValueError, match=r"Unknown language 'xx'\. Known: en, de"):
        name_of_language("xx")


def test_a_new_text_of_the_code_gets_an_id_and_a_place_and_what_is_gone_goes() -> None:
    import ast

    code = (
        "class A:\n    def a(self, n):\n        return self.tr('A new text: {x}'), f\"{tr('%n more', '',"
        ' n)}"'
    )
    assert list(calls(ast.parse(code))) == [("A new text: {x}", False), ("%n more", True)]
    assert new_id("A new text: {x}", ["b"]) == "a_new_text"
    assert new_id("A new text: {x}", ["a_new_text"]) == "a_new_text_2"
    content = updated("de", {"a_new_text": "A new text: {x}"}, {"gone": "weg"})
    assert 'a_new_text = ""\n' in content
    assert "gone" not in content
    assert content.count("[phrases]") == 1
