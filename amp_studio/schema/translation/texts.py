"""Reads the texts of a family in another language, checks them against its facts, and keeps them compiled."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from amp_studio.schema.folder import cache_folder
from amp_studio.schema.load import (
    Compiled,
    DatabaseError,
    FurtherFacts,
    content_key,
    fact_files,
    family_ids,
    folder_of,
    load_compiled,
    read_facts,
)
from amp_studio.schema.model import FactTexts, FactTranslation
from amp_studio.schema.model.compiled_json import cached_record, text_record

from .places import TextPlace, english_texts, figures_in, names_in, own_texts

NO_TEXTS = FactTexts.model_construct()
"""Of English, and of a family that has no other language."""


@cache
def fact_texts(family_id: str, language: str) -> FactTexts:
    """Return the texts of a family in a language; what has none stays English. Raises DatabaseError."""
    if language == "en" or family_id not in family_ids():
        return NO_TEXTS
    folder = folder_of(family_id)
    files = sorted(folder.glob(f"{language}/**/*.yaml"))
    if not files:
        return NO_TEXTS
    own = (Path(__file__), Path(__file__).with_name("places.py"))
    name = f"{family_id}.{language}"
    # With the English facts, by whose texts these are found.
    cached = cache_folder() / f"{name}-{content_key([*own, *fact_files(folder), *files])}.json"
    return cached_record(cached, FactTexts, name, lambda: compile_texts(load_compiled(family_id), files))


def compile_texts(compiled: Compiled, files: list[Path]) -> FactTexts:
    """Parse and check the files of a language; raises DatabaseError with file and line."""
    further: FurtherFacts = text_record(compiled.further)
    english = english_texts(compiled, further)
    sentences: dict[str, str] = {}
    patterns: dict[str, str] = {}
    messages: dict[str, str] = {}
    formulas: dict[str, str] = {}
    for path in files:
        translation, line = read_facts(path, FactTranslation)
        own = own_texts(translation)
        for place, text in own.items():
            if wrong := _fault(place, text, english):
                raise DatabaseError(path, line(place), wrong)
            if place[0] == "rules" and place[2] == "message":
                messages[str(place[1])] = text
            # A message that was made in English is found by its words, as any other sentence.
            has_figures = place[0] == "rules" and figures_in(english[place])
            (patterns if has_figures else sentences)[english[place]] = text
        formulas |= translation.formulas
        for phrase, text in translation.phrases.items():
            if figures_in(phrase) != figures_in(text):
                raise DatabaseError(path, line(("phrases", phrase)), _OTHER_NAMES)
            (patterns if figures_in(phrase) else sentences)[phrase] = text
    return FactTexts.model_construct(
        sentences=sentences, patterns=patterns, messages=messages, formulas=formulas
    )


def missing_texts(family_id: str, language: str) -> Iterator[TextPlace]:
    """Yield the place of each text that decides and has no words in a language."""
    compiled, texts = load_compiled(family_id), fact_texts(family_id, language)
    for place, text in english_texts(compiled, text_record(compiled.further)).items():
        is_message = place[0] == "rules" and place[2] == "message"
        if not (place[1] in texts.messages if is_message else text in texts.sentences):
            yield place


_OTHER_NAMES = "has other names in braces than the English text"


def _fault(place: TextPlace, text: str, english: dict[TextPlace, str]) -> str:
    """Return what is wrong with a text of a language; empty for nothing."""
    there = english.get(place)
    if there is None:
        return f"{'.'.join(map(str, place))}: there is no such text in English"
    return _OTHER_NAMES if place[0] == "rules" and names_in(text) != names_in(there) else ""
