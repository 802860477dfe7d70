"""An index over entries: which have the words of a question, the best first, and why."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from .entries import KINDS, WEIGHT, Entry, Where, searched_words
from .words import Vocabulary, asked_words, parts_of, words_of

_EQUAL, _BEGINS, _WITHIN = 6.0, 3.0, 2.0
"""What the whole question is worth as the whole title, its beginning, or a part of it."""
_LOOKED_AT = 20
"""Further matches of which the texts are searched for the whole question."""
_FORGOTTEN = 4
"""Words of a question of which one may be missing although another entry has them all."""
_MISSING = 0.4
"""What is left for each word of the question that an entry does not have."""


class Match(NamedTuple):
    """An entry that was found."""

    entry: Entry
    score: float
    where: tuple[Where, ...]
    """Where the words of the question are in it, the best place first."""
    words: tuple[str, ...] = ()
    """The known words that were found for the question."""
    typed: tuple[tuple[str, str], ...] = ()
    """Words of the question that are mistyped or only begun, with those that were found for them."""


class _WordMatch(NamedTuple):
    score: float
    where: Where
    word: str


def _with_enough(
    found: dict[int, dict[str, _WordMatch]], words: Sequence[str]
) -> Iterator[tuple[int, list[str]]]:
    """Yield the entries that have enough of the words, and which words each of them lacks."""
    # Where one entry has all words, others may lack few of them; where none has, up to half may be missing.
    whole = any(len(hits) == len(words) for hits in found.values())
    most = len(words) // (_FORGOTTEN if whole else 2)
    for n, hits in found.items():
        missing = [word for word in words if word not in hits]
        # A number is never forgotten: who types 1300 does not mean another parameter.
        if len(missing) <= most and not any(map(_has_digit, missing)):
            yield n, missing


def _has_digit(word: str) -> bool:
    return any(letter.isdigit() for letter in word)


def _title(entry: Entry) -> str:
    """Return the text that names an entry: of a message without its code."""
    return next((text for where, text in entry.texts if where in ("name", "text", "choice")), entry.title)


class SearchIndex:
    """Words -> the entries that have them."""

    def __init__(self, entries: Iterable[Entry]) -> None:
        self.entries = tuple(entries)
        self._having: dict[str, dict[int, Where]] = {}
        """Word -> entry -> the best place in which it has the word."""
        for n, entry in enumerate(self.entries):
            for where, text in entry.texts:
                for word in searched_words(where, text):
                    places = self._having.setdefault(word, {})
                    if n not in places or WEIGHT[where] > WEIGHT[places[n]]:
                        places[n] = where
        self.vocabulary = Vocabulary(self._having)
        self._plain: dict[int, list[tuple[float, str]]] = {}
        """Entry -> its texts as their words alone, made when they are first compared,
        with what they are worth."""
        self._titles = [" ".join(words_of(_title(entry))) for entry in self.entries]

    def search(self, query: str, most: int) -> list[Match]:
        """Return the best matches of a question, the best first: with all its words,
        or most of them and every number.
        """
        words = self.asked(query)
        if not words:
            return []
        found: dict[int, dict[str, _WordMatch]] = {}
        weights = {}
        for word in words:
            per_entry = self._entries_like(word)
            weights[word] = self._weight(len(per_entry))
            for n, hit in per_entry.items():
                found.setdefault(n, {})[word] = hit
        total = sum(weights.values())
        asked = " ".join(words_of(query))
        best = []
        for n, missing in _with_enough(found, words):
            score = sum(weights[word] * hit.score for word, hit in found[n].items()) / total
            score = (score + self._phrase(asked, n)) * KINDS[self.entries[n].kind] * _MISSING ** len(missing)
            # The place as a negative number: of equal scores the one that is earlier in the manual sorts
            # first.
            best.append((score, -n))
        best.sort(reverse=True)
        # All texts of all matches would take too long at every key; only these can still come to the top.
        best = [(score + self._elsewhere(asked, -n), n) for score, n in best[: most + _LOOKED_AT]]
        best.sort(reverse=True)
        return [self._match(score, -n, found[-n]) for score, n in best[:most]]

    def nearest(self, query: str) -> str:
        """Return the question with its unknown word replaced by the nearest known one; empty where nothing
        is near, and for several unknown words: what would be near each of them is another question.
        """
        words = words_of(query)
        unknown = [word for word in words if not self.vocabulary.like(word)]
        if len(unknown) != 1:
            return ""
        near = self.vocabulary.nearest(unknown[0])
        return " ".join(near if word == unknown[0] else word for word in words) if near else ""

    def knows(self, words: Iterable[str]) -> bool:
        """Return whether each word is there, whole, begun or mistyped."""
        return all(map(self.vocabulary.like, words))

    # -- parts of a search --------------------------------------------------------

    def asked(self, query: str) -> list[str]:
        """Return the words to look for: two that are known as one are one,
        and one that is known as two is both.
        """
        typed, words = asked_words(query), []
        n = 0
        while n < len(typed):
            joined = "".join(typed[n : n + 2])
            # Two numbers in a row are two numbers, even where both together are a third one.
            if n + 1 < len(typed) and joined in self.vocabulary and not joined.isdigit():
                words.append(joined)
                n += 2
                continue
            words += self._parted(typed[n])
            n += 1
        return list(dict.fromkeys(words))

    def _parted(self, word: str) -> list[str]:
        """Return the words that a compound is made of where the vocabulary has them, else the word alone."""
        if self.vocabulary.like(word):
            return [word]
        parts = parts_of(word)
        if len(parts) > 1 and "." not in word and all(part in self.vocabulary for part in parts):
            return parts
        # From three letters on each side: shorter parts, as of "in", are in nearly every word.
        for n in range(3, len(word) - 2):
            if word[:n] in self.vocabulary and word[n:] in self.vocabulary:
                return [word[:n], word[n:]]
        return [word]

    def _entries_like(self, word: str) -> dict[int, _WordMatch]:
        """Return for each entry the best of its words that a typed one can be."""
        best: dict[int, _WordMatch] = {}
        bare = word.lstrip("0") if word.isdigit() else ""
        likes = self.vocabulary.like(word)
        if bare and bare not in likes:
            likes = likes | {bare: 1.0}
        for known, likeness in likes.items():
            for n, where in self._having.get(known, {}).items():
                score = WEIGHT[where] * likeness
                if n not in best or score > best[n].score:
                    best[n] = _WordMatch(score, where, known)
        return best

    def _weight(self, count: int) -> float:
        """Return how much a word decides: one that few entries have more than one that all have."""
        # From 1 to 2: a rare word counts twice as much as one that all entries have, never more.
        return 1.0 + math.log((len(self.entries) + 1) / (count + 1)) / math.log(len(self.entries) + 2)

    def _phrase(self, asked: str, n: int) -> float:
        title = self._titles[n]
        if asked not in title:
            return 0.0
        return _EQUAL if asked == title else _BEGINS if title.startswith(asked) else _WITHIN

    def _elsewhere(self, asked: str, n: int) -> float:
        """Return what the whole question is worth that is in another text than the title."""
        # One word was scored by its places already.
        if " " not in asked:
            return 0.0
        texts = self._plain.get(n)
        if texts is None:
            own = ((where, text) for where, text in self.entries[n].texts if where not in ("number", "code"))
            texts = self._plain[n] = [(WEIGHT[where] / 4, " ".join(words_of(text))) for where, text in own]
        return max((score for score, text in texts if asked in text), default=0.0)

    def _match(self, score: float, n: int, hits: dict[str, _WordMatch]) -> Match:
        ordered = sorted(hits.items(), key=lambda hit: -hit[1].score)
        where = tuple(dict.fromkeys(hit.where for _, hit in ordered))
        typed = tuple((word, hit.word) for word, hit in ordered if word != hit.word)
        return Match(self.entries[n], score, where, tuple(hit.word for _, hit in ordered), typed)
