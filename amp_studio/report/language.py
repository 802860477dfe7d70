"""The languages of documents, and in the window of what is made below it: the words of the program's own frame.

Names, choices, help and findings stay as they are.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cache
from html import escape, unescape
from pathlib import Path

from .wording import counted

_WORDS = re.compile(r"(>\s*)([^<>]*?[^<>\s])(\s*<)")
_FOLDER = Path(__file__).parent / "languages"


@dataclass(frozen=True)
class Language:
    """One language: English phrase -> its own, and patterns for phrases with a part that changes."""

    code: str
    name: str
    phrases: dict[str, str] = field(default_factory=dict)
    patterns: tuple[tuple[re.Pattern[str], str], ...] = ()
    nouns: dict[str, tuple[str, str]] = field(default_factory=dict)
    """Noun of a count -> one, several."""
    titles: dict[str, str] = field(default_factory=dict)
    """Titles of steps, pictures and pages -> their own: a parameter may have the same name, which stays."""
    title_patterns: tuple[tuple[re.Pattern[str], str], ...] = ()
    messages: dict[str, str] = field(default_factory=dict)
    """Parts of the program's own findings -> their own; names of parameters are not among them."""
    message_patterns: tuple[tuple[re.Pattern[str], str], ...] = ()

    def text(self, english: str) -> str:
        """Return a phrase in this language; as it is where the language has no other words for it."""
        known = self.phrases.get(english)
        if known is not None:
            return known
        for pattern, own in self.patterns:
            if found := pattern.fullmatch(english):
                return own.format(*(self.text(group) for group in found.groups("0")))
        return english

    def of_help(self, title: str) -> str:
        """Return the title of a part of a parameter's help: its Note is the manual's, not a person's."""
        return self.phrases.get(f"help: {title}") or self.text(title)

    def title(self, english: str) -> str:
        """Return what the program itself calls something: the title of a step or a picture, a heading, a note of a picture."""
        known = self.titles.get(english)
        if known is not None:
            return known
        for pattern, own in self.title_patterns:
            if found := pattern.fullmatch(english):
                return own.format(*(self.title(group) for group in found.groups()))
        return self.text(english)

    def message(self, english: str) -> str:
        """Return a finding of the program itself in this language; a rule stays in the words of its facts."""
        known = self.messages.get(english)
        if known is not None:
            return known
        for pattern, own in self.message_patterns:
            if found := pattern.fullmatch(english):
                return own.format(*map(self.message, found.groups()))
        return english

    def drawing(self, svg: str) -> str:
        """Return a drawing (SVG) with its texts in this language."""
        if self.code == "en":
            return svg
        return _WORDS.sub(
            lambda found: (
                found[1] + escape(" · ".join(map(self.title, unescape(found[2]).split(" · ")))) + found[3]
            ),
            svg,
        )

    def counted(self, number: int, noun: str) -> str:
        """Return ``1 error``, ``2 errors`` in this language."""
        if noun in self.nouns:
            return f"{number} {self.nouns[noun][number != 1]}"
        return counted(number, noun)


ENGLISH = Language("en", "English")


def language_codes() -> tuple[str, ...]:
    """Return the codes of the languages, English first."""
    return ("en", *sorted(path.stem for path in _FOLDER.glob("*.yaml")))


@cache
def language_of(code: str) -> Language:
    """Return a language by its code; raises ValueError for another one."""
    if code == "en":
        return ENGLISH
    path = _FOLDER / f"{code}.yaml"
    if code not in language_codes():
        raise ValueError(f"Unknown language '{code}'. Known: {', '.join(language_codes())}")
    from amp_studio.schema import read_yaml

    data = read_yaml(path.read_text("utf-8")).data
    return Language(
        code,
        data["name"],
        data["phrases"],
        _compiled(data["patterns"]),
        {noun: (one, several) for noun, (one, several) in data["nouns"].items()},
        data["titles"],
        _compiled(data["title_patterns"]),
        data["messages"],
        _compiled(data["message_patterns"]),
    )


def _compiled(patterns: dict[str, str]) -> tuple[tuple[re.Pattern[str], str], ...]:
    return tuple((re.compile(pattern), own) for pattern, own in patterns.items())
