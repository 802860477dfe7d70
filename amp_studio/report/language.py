"""The languages of documents, and in the window of what is made below it:
the words of the program's own frame.

The texts are in ``amp_studio/languages``, each under its id; what is made in English is found by the English
text of its id. Names, choices, help and findings stay as they are.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cache
from html import escape, unescape

from amp_studio.languages import TextSection, name_of_language, own_texts

from .wording import counted

_WORDS = re.compile(r"(>\s*)([^<>]*?[^<>\s])(\s*<)")


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
        """Return what the program itself calls something: the title of a step or a picture, a heading,
        a note of a picture.
        """
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


@cache
def language_of(code: str) -> Language:
    """Return a language by its code; raises ValueError for another one."""
    if code == "en":
        return ENGLISH
    name = name_of_language(code)
    return Language(
        code,
        name,
        _own(code, "phrases"),
        _compiled(_own(code, "patterns")),
        {noun: (forms[0], forms[-1]) for noun, forms in own_texts(code, "nouns").items()},
        _own(code, "titles"),
        _compiled(_own(code, "title_patterns")),
        _own(code, "messages"),
        _compiled(_own(code, "message_patterns")),
    )


def _own(code: str, section: TextSection) -> dict[str, str]:
    """Return English text -> own text of a section in which no text has several forms."""
    return {english: str(own) for english, own in own_texts(code, section).items()}


def _compiled(patterns: dict[str, str]) -> tuple[tuple[re.Pattern[str], str], ...]:
    return tuple((re.compile(pattern), own) for pattern, own in patterns.items())
