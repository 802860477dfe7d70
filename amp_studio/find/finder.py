"""One question over everything that a family and a file contain, and what each hit leads to."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Schema,
    UnknownParameterError,
    resolve_address,
    resolve_axis,
    show_value,
)

from .entries import Entry, HitKind, Where, entries_of
from .file_values import FileValues, asked_number
from .index import Match, SearchIndex
from .places import place_of
from .synonyms import known_words, meanings, nearest_synonym
from .words import words_of

_EXACT, _VALUE, _DEFAULT = 100.0, 11.0, 7.0
"""Scores of what is no matter of words: a whole number, a value, a value that is the printed default."""
_SYNONYM_WEIGHT, _LESS_LIKELY = 0.95, 0.85
"""What a hit is worth that has what the question means, and each further meaning against the one before
it."""
_WITHOUT_THE_REST = 0.7
"""What a meaning is worth without the words around it, where the manuals do not have these:
``Endschalter ausgelöst``."""
_TAIL = 0.2
"""Part of the best score below which a hit only buries the others."""
_SURE = 4.0
"""Score from which another family is worth naming: the words are in a name, not in the help alone."""
_MAX_VALUES = 40
"""Parameters with the same value that are worth showing."""
_LONGEST = 200
"""Letters of a question; more is a text that was pasted by mistake."""


@dataclass(frozen=True, slots=True)
class Hit:
    """Something that was found, why, and where it leads."""

    kind: HitKind
    title: str
    """What is read first: number and name, the text of a message, the value."""
    detail: str
    """What is read second: group and page, the parameter of a choice."""
    why: str
    """What of the question it has: ``number``, ``name``, ``help: …``."""
    key: str
    """Id of the parameter or message, key of the group or command."""
    score: float
    address: Address | None = None
    """The value it leads to, where it leads to one."""
    others: tuple[Address, ...] = ()
    """Further values with the same choice or number."""


@lru_cache(maxsize=16)
def index_of(schema: Schema, machine: str) -> SearchIndex:
    """Return the index of a family on a machine type: made once, in 0.1 s, and safe to be made in a
    thread.
    """
    return SearchIndex(entries_of(schema, machine))


class Finder:
    """Answers questions about a family, and a file of it where there is one."""

    def __init__(
        self, schema: Schema, machine: str, file: ParameterFile | None = None, commands: Iterable[Entry] = ()
    ) -> None:
        self.schema, self.machine, self.file = schema, machine, file
        self._here = schema.on(machine)
        self._commands = SearchIndex(commands)
        self._values: FileValues | None = None
        self._texts = SearchIndex(())

    def forget_values(self) -> None:
        """Read the values and notes of the file again at the next question, after an edit."""
        self._values = None

    def find(self, query: str, most: int = 40) -> list[Hit]:
        """Return the best hits, the best first."""
        query = " ".join(query.split())[:_LONGEST]
        # Before the axis is parted from it: the letter behind @ is part of the address.
        hits = self._addressed(query)
        query, axis = self._axis(query)
        hits += self._numbered(query) + self._valued(query)
        of_the_trade = set(known_words(query))
        for index in (index_of(self.schema, self.machine), self._texts, self._commands):
            # A word of the trade is not mistyped: "chatter" is no "cutter".
            match = [m for m in index.search(query, most) if not _takes_for_a_slip(m, of_the_trade)]
            # A choice of which only the parameter was named is no more than that parameter.
            hits += [self._hit(m) for m in match if m.entry.kind != "choice" or "choice" in m.where]
        hits += self._found_by_synonym(query, most)
        best = _best_of_each(hits)
        # A number that fits exactly does not count here: beside its score every hit by words would be cut
        # off.
        least = _TAIL * max((hit.score for hit in best if hit.score < _EXACT - 1), default=0.0)
        return [self._of_axis(hit, axis) for hit in best if hit.score >= least][:most]

    def nearest(self, query: str) -> str:
        """Return the nearest question that has words which are known; empty where there is none but this
        one.
        """
        query = query[:_LONGEST]
        near = index_of(self.schema, self.machine).nearest(query) or nearest_synonym(query)
        return near if near != query.casefold().strip() else ""

    # -- what is no matter of words -------------------------------------------------

    def _axis(self, query: str) -> tuple[str, str]:
        """Part the letter of an axis from the end of a question: ``excess error Y``, ``1750@X``."""
        head, _, last = re.sub("@", " ", query).rpartition(" ")
        if self.file is None or not head or not re.fullmatch("[A-Za-z][0-9]?", last):
            return query, ""
        axes = self.schema.family.scopes.get("axis")
        try:
            return head, resolve_axis(self.file.evaluation, axes.instances, last) if axes else ""
        except UnknownParameterError:
            return query, ""

    def _of_axis(self, hit: Hit, axis: str) -> Hit:
        """Return a hit on the axis that was named, where its parameter has one."""
        if not axis or hit.kind not in ("parameter", "choice"):
            return hit
        parameter = self.schema.parameters[hit.key]
        is_of_axes = self._here.kin(self._here.scopes[hit.key], "axis")
        if not is_of_axes or axis not in self._here.instances(parameter):
            return hit
        address = (hit.key, axis)
        return replace(
            hit, address=address, title=self._label(address) if hit.kind == "parameter" else hit.title
        )

    def _addressed(self, query: str) -> list[Hit]:
        """Return the one value that a question addresses as files and verbs do: ``home.calibration@X``,
        ``P3N0.5``.
        """
        if self.file is None or " " in query or not {"@", "."} & set(query):
            return []
        try:
            return [self._of_number(resolve_address(self.file.evaluation, query).address, _EXACT)]
        except UnknownParameterError:
            return []

    def _of_number(self, address: Address, score: float) -> Hit:
        detail = f"{self.schema.group_of[address[0]].name}, page {self.schema.page(address)}"
        return Hit("parameter", self._label(address), detail, "number", address[0], score, address)

    def _numbered(self, query: str) -> list[Hit]:
        """Return the parameters of a whole number: ``1300``, ``P21N3``, ``Pr61``, or all words of ``P21``."""
        claims = self._here.addressed_by(query) or self._here.words(query)
        found: dict[str, Hit] = {}
        for n, address in enumerate(claims):
            # The small difference keeps the manual's order among equal hits.
            found.setdefault(address[0], self._of_number(address, _EXACT - n / 100))
        return list(found.values())

    def _valued(self, query: str) -> list[Hit]:
        """Return the values of the file that are the number asked for, one hit a parameter."""
        file = self.file
        if file is None:
            return []
        if self._values is None:
            self._values = FileValues(file)
            self._texts = SearchIndex(self._values.entries(file))
        number = asked_number(query)
        found: dict[str, list[Address]] = {}
        for address in self._values.having(number) if number is not None else ():
            if file.evaluation.state(address).state != "hidden":
                found.setdefault(address[0], []).append(address)
            if len(found) > _MAX_VALUES:
                break
        return [self._value_hit(addresses, "value") for addresses in found.values()]

    def _value_hit(self, addresses: list[Address], why: str) -> Hit:
        """Return the hit of one value that several addresses have, the first of them one that was chosen."""
        assert self.file is not None
        file, first = self.file, addresses[0]
        own = [a for a in addresses if not file.is_default(a)]
        ordered = own + [a for a in addresses if a not in own]
        parameter = file.schema.parameters[first[0]]
        title = show_value(parameter, file.get(first))
        detail = f"{parameter.name} {', '.join(self._place(a) for a in ordered)}".rstrip()
        # A value that the user chose is more likely meant than one of many defaults.
        score = _VALUE if own else _DEFAULT
        return Hit("value", title, detail, why, first[0], score, ordered[0], tuple(ordered[1:]))

    # -- what the words mean -----------------------------------------------------------

    def _found_by_synonym(self, query: str, most: int) -> list[Hit]:
        """Return what is found for the words that the manuals have for those of a question."""
        index, hits = index_of(self.schema, self.machine), []
        for meaning in meanings(query):
            score = _SYNONYM_WEIGHT * _LESS_LIKELY**meaning.place
            why = f"'{meaning.typed}' as '{meaning.means}'"
            all_words = len(index.asked(meaning.means))
            questions = {meaning.query: score}
            # Where the manuals do not have the words around it, a search with them finds nothing.
            if not index.knows(meaning.rest):
                questions[meaning.means] = score * _WITHOUT_THE_REST
            hits += [
                replace(self._hit(match), score=match.score * likely, why=why)
                for question, likely in questions.items()
                for match in index.search(question, most)
                # A part of the meaning is another thing: of "limit switch" neither every limit nor every
                # switch.
                if len(match.words) >= all_words and match.entry.kind != "choice"
            ]
        return hits

    # -- words --------------------------------------------------------------------------

    def _hit(self, match: Match) -> Hit:
        """Return what a search offers for a match: an entry of the index, or a place in the file."""
        entry = match.entry
        why = self._why(match)
        if entry.kind == "parameter":
            return replace(
                Hit("parameter", entry.title, entry.detail, why, entry.key, match.score),
                title=self._label((entry.key, ""), span=True),
            )
        if entry.kind == "choice":
            return self._choice_hit(match, why)
        if entry.kind in ("value", "note"):
            address = (entry.key, entry.detail)
            return Hit(entry.kind, entry.title, self._label(address), why, entry.key, match.score, address)
        detail = self._of_span(match) or entry.detail
        return Hit(entry.kind, entry.title, detail, why, entry.key, match.score)

    def _of_span(self, match: Match) -> str:
        """Return which axis the number of a message means, where it counts them."""
        message = self.schema.messages.get(match.entry.key) if match.entry.kind == "message" else None
        numbers = [int(word) for word in match.words if word.isdigit()]
        if message is None or message.span is None or not numbers:
            return ""
        return f"axis of address {numbers[0] - message.span[0]}, {match.entry.detail}"

    def _choice_hit(self, match: Match, why: str) -> Hit:
        """Return a choice; a value of the file where it has it somewhere."""
        entry = match.entry
        parameter = self.schema.parameters[entry.key]
        key = next((c.key for c in parameter.choices or () if c.label == entry.title), "")
        addresses = self._values.choices.get((entry.key, key), []) if self._values and key else []
        if addresses:
            # A choice that the file has comes before one with the same words that it has not.
            return replace(self._value_hit(addresses, why), score=match.score * 1.1)
        return Hit(
            "choice", entry.title, self._label((entry.key, ""), span=True), why, entry.key, match.score
        )

    def _why(self, match: Match) -> str:
        parts = [_snippet(match, w) if w in ("help", "meaning") else w for w in match.where]
        parts += [f"'{typed}' as '{found}'" for typed, found in match.typed if not found.startswith(typed)]
        return ", ".join(parts)

    def _label(self, address: Address, span: bool = False) -> str:
        """Return number and name; with ``span`` of the first instance,
        as a parameter with many is known by that.
        """
        parameter = self.schema.parameters[address[0]]
        if span:
            numbers = (self._here.number((address[0], i)) for i in self._here.instances(parameter))
            return f"{next(filter(None, numbers), '')} {parameter.name}".lstrip()
        place = self._place(address)
        label = self._here.label(address)
        return f"{label} {place}" if place and self._here.number(address) else label

    def _place(self, address: Address) -> str:
        return place_of(self.file, address) if self.file is not None else self._here.instance_label(address)


def _takes_for_a_slip(match: Match, known: set[str]) -> bool:
    """Return whether a match takes one of these words for another one that was mistyped."""
    return any(typed in known and not found.startswith(typed) for typed, found in match.typed)


def _best_of_each(hits: Iterable[Hit]) -> list[Hit]:
    """Return the hits, the best first, each parameter, choice and note once."""
    best: dict[tuple[str, str, str], Hit] = {}
    # The best first, so that setdefault keeps it; a stable sort keeps the order of equal ones.
    for hit in sorted(hits, key=lambda hit: -hit.score):
        best.setdefault((hit.kind, hit.key, hit.title if hit.kind in ("choice", "note") else ""), hit)
    return list(best.values())


def elsewhere(query: str, finders: Iterable[Finder], most: int = 3) -> list[tuple[Schema, Hit]]:
    """Return the best hit of each family that has all words of a question, the best first."""
    found = []
    for finder in finders:
        best = next(iter(finder.find(query, 1)), None)
        if best is not None and best.score >= _SURE:
            found.append((finder.schema, best))
    return sorted(found, key=lambda each: -each[1].score)[:most]


def _snippet(match: Match, where: Where) -> str:
    """Return the sentence of a help or a meaning that has most of the words."""
    text = next(text for place, text in match.entry.texts if place == where)
    found = set(match.words)
    sentences = re.split(r"(?<=[.;:])\s+", " ".join(text.split()))
    best = max(sentences, key=lambda sentence: len(found & set(words_of(sentence))))
    return f"{where}: {best[:100]}{'…' if len(best) > 100 else ''}"
