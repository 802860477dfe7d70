"""Reads the texts of a language: ``LANGUAGE.toml`` beside this module, in sections, each text under its id.

The English file has the texts as the code writes them, so a text with better words keeps its id and its
translations. The window and documents ask ``schema.program_texts``, which keeps what was read.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Literal

FOLDER = Path(__file__).parent
TextSection = Literal[
    "window",
    "phrases",
    "patterns",
    "titles",
    "title_patterns",
    "sentences",
    "nouns",
    "units",
    "messages",
    "message_patterns",
]
Forms = str | list[str]
"""A text; of one with a number its forms, for one and for several."""


def language_codes() -> tuple[str, ...]:
    """Return the codes of the languages, English first."""
    return ("en", *sorted(path.stem for path in FOLDER.glob("*.toml") if path.stem != "en"))


def sources_of_texts(code: str) -> tuple[Path, ...]:
    """Return the files on which the texts of a language hang: it, the English one, and this module."""
    return FOLDER / f"{code}.toml", FOLDER / "en.toml", Path(__file__)


@cache
def _file(code: str) -> dict[str, dict[str, Forms]]:
    import tomllib  # a start reads texts that were read before

    with (FOLDER / f"{code}.toml").open("rb") as file:
        return tomllib.load(file)


def name_of_language(code: str) -> str:
    """Return the name of a language in itself; raises ValueError for an unknown code."""
    if code not in language_codes():
        raise ValueError(f"Unknown language '{code}'. Known: {', '.join(language_codes())}")
    import tomllib

    head = (FOLDER / f"{code}.toml").read_text(encoding="utf-8").partition("\n[")[0]
    return str(tomllib.loads(head)["name"])


def texts_of(code: str, section: TextSection) -> dict[str, Forms]:
    """Return id -> text of a section; an empty text is not translated yet."""
    return _file(code)[section]
