"""The texts of the program in another language by their English texts, kept as facts are: the TOML of English
alone is a twentieth of a start of the window.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import get_args

from amp_studio.languages import Forms, TextSection, sources_of_texts, texts_of
from amp_studio.schema.compiled_cache import cached_data


def program_texts(code: str, section: TextSection) -> dict[str, Forms]:
    """Return English text -> text in a language, of what is translated in a section;
    several forms are found by the form for several.
    """
    return _sections(code)[section]


@cache
def _sections(code: str) -> dict[str, dict[str, Forms]]:
    sources = (*sources_of_texts(code), Path(__file__))
    found: dict[str, dict[str, Forms]] = cached_data(
        f"_texts.{code}",
        sources,
        lambda: {section: _read(code, section) for section in get_args(TextSection)},
    )
    return found


def _read(code: str, section: TextSection) -> dict[str, Forms]:
    own = texts_of(code, section)
    return {
        english if isinstance(english, str) else english[-1]: own[key]
        for key, english in texts_of("en", section).items()
        if own.get(key)
    }
