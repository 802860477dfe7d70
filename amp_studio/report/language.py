"""The languages of documents, and in the window of what is made below it.

The words of the program's own frame are in ``amp_studio/languages``, each under its id; what is made in
English is found by the English text of its id. What decides in the facts of a family (rules, dangers, steps,
reasons, assumptions) has its words beside them, in ``parameter_db/<family>/<language>``. Names and choices
stay as the control shows them, and help stays English.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import cache
from html import escape, unescape

from amp_studio.languages import TextSection, name_of_language
from amp_studio.schema import NO_TEXTS, UNITS, FactTexts, fact_texts, figures_in, program_texts, unit_text
from amp_studio.validate import Argument, Calculator, Finding

from .wording import counted, joined_places

_WORDS = re.compile(r"(>\s*)([^<>]*?[^<>\s])(\s*<)")
_NUMBER = re.compile(r"(?<![\w.$@])[-−]?\d+\.\d+(?:e[-+]\d+)?(?!\w|\.\d)")
"""A number in a sentence; no address (``P3N0.5``, ``$22.0``), version or network address."""

_SIGN = re.compile(r"(?<![\w.$@)\]-])-(?=\d)")
"""The hyphen that is the sign of a number; none of a page (``7-20``), an address or a word."""
_REMARK = re.compile(
    r"(?<=\()(?:inferred|codes lost|figure (?:lost|\d\S*))(?=\))|(?<=: )codes lost$|^Unnamed \(figure .+\)$"
)
"""What the facts remark on a label that a manual does not print, or whose figure is lost."""

_PAGES = ("page", "source")
"""What a sentence is from, by its names there: the point of section 3.2 stays."""


@dataclass(frozen=True)
class SentencePattern:
    """A sentence whose figures and names are ``{names}``, and its words in another language."""

    words: str
    """Its longest part without a name: a text that lacks it is another sentence."""
    pattern: re.Pattern[str]
    """Each name is a group."""
    own: str

    def found(self, text: str) -> dict[str, str] | None:
        """Return name -> what the text has in its place; None for another sentence."""
        found = self.pattern.fullmatch(text) if self.words in text else None
        return None if found is None else found.groupdict()


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
    facts: FactTexts = NO_TEXTS
    """What decides in the facts of a family."""
    sentences: tuple[SentencePattern, ...] = ()
    """Sentences with figures in them, those of a family first, and the longest of each first: a long one is
    not taken for what a short one puts into its name."""
    units: dict[str, str] = field(default_factory=dict)
    """Printed unit -> its own spelling."""
    point: str = "."
    """The decimal separator."""

    def text(self, english: str) -> str:
        """Return a phrase in this language; as it is where the language has no other words for it."""
        own = self._phrase(english, self.text)
        return english if own is None else own

    def figure(self, name: str, unit: str) -> str:
        """Return the name of a figure; one name may be another word in another unit (a speed in rpm)."""
        return self.titles.get(f"{name} ({unit})") or self.sentence(name)

    def scenario(self, name: str) -> str:
        """Return the name of a scenario of the simulator."""
        return self.phrases.get(f"scenario {name}") or name.capitalize()

    def of_formula(self, part: Calculator | Argument) -> str:
        """Return the title of a published formula, or of what it asks for."""
        return self.facts.formulas.get(part.name, part.title)

    def of_help(self, title: str) -> str:
        """Return the title of a part of a parameter's help: its Note is the manual's, not a person's."""
        return self.phrases.get(f"help: {title}") or self.text(title)

    def of_place(self, name: str, place: str) -> str:
        """Return a name that stays, with the axis or instance behind it in this language."""
        if not place or self.code == "en":
            return name
        return f"{name.removesuffix(place).rstrip()}, {self.title(place)}"

    def listed(self, places: Iterable[str]) -> str:
        """Return the places of a value (axes, spindles) in one line."""
        return joined_places(map(self.text, places))

    def title(self, english: str) -> str:
        """Return what the program itself calls something: the title of a step or a picture, a heading,
        a note of a picture.
        """
        own = self._titled(english, self.title)
        return english if own is None else own

    def sentence(self, english: str) -> str:
        """Return a sentence of the program or of the family's facts. The figures put into it are written as
        this language writes them; in its words a number (``figure 4.2``) is that of the manual.
        """
        text = " ".join(english.split())
        # What is put into a sentence may be one itself, as a reason in a finding.
        own = self._titled(text, self.sentence)
        return self.unit(self.quantity(text)) if own is None else own

    def _titled(self, english: str, part: Callable[[str], str]) -> str | None:
        """Return what is known of a text by facts, titles and phrases; ``part`` words what changes in it."""
        # The family first: its words for its own sentence come before the program's for an equal one.
        known = self.facts.sentences.get(english) or self.titles.get(english)
        if known is not None:
            return known
        for sentence in self.sentences:
            if (figures := sentence.found(english)) is not None:
                given = {
                    name: (self.title if name in _PAGES else part)(text) for name, text in figures.items()
                }
                return sentence.own.format_map(given)
        for pattern, own in self.title_patterns:
            if match := pattern.fullmatch(english):
                return own.format(*map(part, match.groups()))
        return self._phrase(english, part)

    def _phrase(self, english: str, part: Callable[[str], str]) -> str | None:
        known = self.phrases.get(english)
        if known is not None:
            return known
        for pattern, own in self.patterns:
            if match := pattern.fullmatch(english):
                return own.format(*map(part, match.groups("0")))
        return None

    def finding(self, finding: Finding) -> str:
        """Return the message of a finding in this language; a builder's rule has the words of its builder."""
        if finding.is_own:
            return finding.message
        message = self.facts.messages.get(finding.rule)
        # Without its figures the words of the rule cannot be filled; the English message has them.
        if message is None or finding.figures is None:
            return self.quantity(self.message(finding.message))
        return message.format_map({name: self._given(text) for name, text in finding.figures})

    def cited(self, finding: Finding) -> str:
        """Return the message of a finding in this language, and where it is from."""
        return self.finding(finding) + (f" ({self.title(finding.cited)})" if finding.cited else "")

    def _given(self, text: str) -> str:
        """Return what a rule puts into its message: a phrase of its facts, or a value with its unit."""
        return self.facts.sentences.get(text) or self.quantity(text)

    def label(self, label: str) -> str:
        """Return a label of the control, with what the facts remark on it in this language."""
        return _REMARK.sub(lambda found: self.text(found[0]), label)

    def number(self, figure: str) -> str:
        """Return a number with its sign, and the decimal separator of this language."""
        return _SIGN.sub("−", figure).replace(".", self.point)

    def unit(self, printed: str) -> str:
        """Return a printed unit as this language spells it."""
        return self.units.get(printed, printed)

    def quantity(self, text: str) -> str:
        """Return a text with its numbers, and the units behind them, as this language writes them."""
        text = _SIGN.sub("−", text)
        if self.point != ".":
            text = _NUMBER.sub(lambda found: self.number(found[0]), text)
        return _behind_a_number(*self.units).sub(self._unit_behind, text) if self.units else text

    def _unit_behind(self, found: re.Match[str]) -> str:
        unit = self.unit(unit_text(found[1]))
        return unit if unit == "°" else f" {unit}"

    def pages(self, cited: str) -> str:
        """Return the pages of a manual that are cited: ``7-17 to 7-19``."""
        return f" {self.text('to')} ".join(cited.split(" to "))

    def moment(self, date: datetime) -> str:
        """Return date and time as this language writes them."""
        return date.strftime(self.text("%Y-%m-%d %H:%M"))

    def message(self, english: str) -> str:
        """Return a finding of the program itself in this language."""
        known = self.messages.get(english)
        if known is not None:
            return known
        for pattern, own in self.message_patterns:
            if match := pattern.fullmatch(english):
                return own.format(*map(self.message, match.groups()))
        return self.unit(english)

    def drawing(self, svg: str) -> str:
        """Return a drawing (SVG) with its texts in this language."""
        if self.code == "en":
            return svg
        return _WORDS.sub(
            lambda found: (
                found[1] + escape(" · ".join(map(self.sentence, unescape(found[2]).split(" · ")))) + found[3]
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
def _behind_a_number(*others: str) -> re.Pattern[str]:
    """Return what finds a unit behind a number, with the space before it: as it is printed, or as facts and
    parameter files spell it; ``others`` are no units of a parameter.
    """
    # The longest first: of "mm/min" a pattern that begins with "mm" would take that alone.
    spelled = sorted({*UNITS, *map(unit_text, UNITS), *others} - {"", "%"}, key=len, reverse=True)
    return re.compile(rf"(?<=\d) ({'|'.join(map(re.escape, spelled))})(?![\w/])")


@cache
def language_of(code: str, family: str = "", *more: str) -> Language:
    """Return a language by its code, with the facts of a family where one is named, and of ``more`` families
    where it has no words; raises ValueError for another code.
    """
    if code == "en":
        return ENGLISH
    name = name_of_language(code)
    if family:
        facts, shared = fact_texts(family, code), language_of(code, *more)
        # Those of the family win over those of the families behind it.
        facts = facts.model_copy(update={"sentences": {**shared.facts.sentences, **facts.sentences}})
        return replace(shared, facts=facts, sentences=(*_sentences(facts.patterns), *shared.sentences))
    sentences = _own(code, "sentences")
    return Language(
        code,
        name,
        _own(code, "phrases"),
        _compiled(_own(code, "patterns")),
        {noun: (forms[0], forms[-1]) for noun, forms in program_texts(code, "nouns").items()},
        _own(code, "titles") | {text: own for text, own in sentences.items() if not figures_in(text)},
        _compiled(_own(code, "title_patterns")),
        _own(code, "messages"),
        _compiled(_own(code, "message_patterns")),
        sentences=_sentences({text: own for text, own in sentences.items() if figures_in(text)}),
        units=_own(code, "units"),
        point=_own(code, "window")["."],
    )


def _sentences(texts: dict[str, str]) -> tuple[SentencePattern, ...]:
    """Return sentences (English -> own), the one with the most words beside its names first."""
    sentences = []
    for english, own in texts.items():
        parts = re.split(r"\{([a-z_]+)\}", english)  # words, a name, words, a name, words
        words = parts[::2]
        pattern = ""
        for n, part in enumerate(parts):
            # A name that comes twice must be the same text both times, and a group may be named once only.
            again = part in parts[1:n:2]
            name = f"(?P={part})" if again else f"(?P<{part}>.+?)"
            pattern += name if n % 2 else re.escape(part)
        sentences.append(
            (sum(map(len, words)), SentencePattern(max(words, key=len), re.compile(pattern), own))
        )
    return tuple(sentence for _, sentence in sorted(sentences, key=lambda each: -each[0]))


def _own(code: str, section: TextSection) -> dict[str, str]:
    """Return English text -> own text of a section, of those that have one form."""
    return {english: own for english, own in program_texts(code, section).items() if isinstance(own, str)}


def _compiled(patterns: dict[str, str]) -> tuple[tuple[re.Pattern[str], str], ...]:
    return tuple((re.compile(pattern), own) for pattern, own in patterns.items())
