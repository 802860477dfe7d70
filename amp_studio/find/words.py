"""Words of a text, and the known words that a mistyped one may be.

A typing error is one letter too many, too few, another one, or two neighbours exchanged (Damerau, optimal
string alignment). A library for that (rapidfuzz) is 3 MB of C++ for one distance over some thousand short
words: here letter pairs choose the few dozen words that can be near, and only those are measured.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable

_WORD = re.compile(r"\d+(?:\.\d+)+|[^\W_]+")
_PARTS = re.compile(r"\d+|[^\W\d]+")
_COMMON = frozenset(
    _WORD.findall(
        "a an and are as at be by come comes do does for from goes how i in into is it my of on or per shows"
        " that the there this to what when where which why with auf bei beim das dem den der die ein eine"
        " einen im ist nach sich vom von wird werden wie warum wenn wo zum zur"
    )
)
"""Words that decide nothing in a question; they count where they are all that is asked."""
_SHORTEST = 4
"""Letters from which a word is taken to be mistyped."""
_TWO = 7
"""Letters from which a word may have two slips."""
_REMEMBERED = 200
"""Words of which is remembered what they can be."""
_MEASURED = 40
"""Words that are measured for one that is mistyped; those with the most pairs of letters in common."""
_PREFIX, _ONE_SLIP, _TWO_SLIPS = 0.85, 0.7, 0.5
"""What a match is worth where a word is only begun, or mistyped; an equal word is worth 1."""


def words_of(text: str) -> list[str]:
    """Return the words and numbers of a text in their order, in small letters; ``0.5`` is one word,
    ``MOT-022`` two.
    """
    return _WORD.findall(text.casefold())


def asked_words(query: str) -> list[str]:
    """Return the words of a question that decide, each once."""
    words = list(dict.fromkeys(words_of(query)))
    return [word for word in words if word not in _COMMON] or words


def parts_of(word: str) -> list[str]:
    """Return letters and figures of a word apart: ``mot022`` is ``mot`` and ``022``."""
    return _PARTS.findall(word)


def distance(a: str, b: str, most: int) -> int:
    """Return the number of slips between two words, or ``most`` + 1 where there are more."""
    if abs(len(a) - len(b)) > most:
        return most + 1
    # Row by row over the first word (optimal string alignment: a letter more, less, another, or two swapped).
    # A swap reaches back two rows, so three are enough.
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        before_that, before, row = before, row, [i]
        for j, y in enumerate(b, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                cost = min(cost, before_that[j - 2] + 1)
            row.append(cost)
        # No later row has less than the least of this one and the one before, from which a swap goes on.
        if min(row) > most and (not before or min(before) > most):
            return most + 1
    return min(row[-1], most + 1)


def _slips(word: str) -> int:
    """Return how many slips a word may have: none in a number or a short word."""
    if len(word) < _SHORTEST or any(letter.isdigit() for letter in word):
        return 0
    return 2 if len(word) >= _TWO else 1


def _pairs(word: str) -> set[str]:
    # The frame gives a word of n letters n + 1 pairs: first and last letter count, and short words have
    # enough of them.
    framed = f"^{word}$"
    return {framed[n : n + 2] for n in range(len(framed) - 1)}


class Vocabulary:
    """The words that are known."""

    def __init__(self, words: Iterable[str]) -> None:
        self.words = sorted(set(words))
        self._at = {word: n for n, word in enumerate(self.words)}
        self._like: dict[str, dict[str, float]] = {}
        self._with: dict[str, list[int]] = {}
        """Pair of letters -> the places of the words that may be mistyped and have it."""
        for n, word in enumerate(self.words):
            # One letter shorter than a mistyped word may be: a letter too many is a slip too.
            if len(word) >= _SHORTEST - 1 and word.isalpha():
                for pair in _pairs(word):
                    self._with.setdefault(pair, []).append(n)

    def __contains__(self, word: str) -> bool:
        return word in self._at

    def begun(self, start: str) -> list[str]:
        """Return the words that begin with these letters and go on."""
        first = bisect_left(self.words, start)
        # The last character of all: behind every word that begins so.
        end = bisect_left(self.words, start + "\U0010ffff")
        return [word for word in self.words[first:end] if word != start]

    def like(self, word: str) -> dict[str, float]:
        """Return every known word that a typed one can be, and what the match is worth (0 to 1)."""
        known = self._like.get(word)
        if known is None:  # the words of a question stay while the next is typed
            if len(self._like) >= _REMEMBERED:
                self._like.clear()
            known = self._like[word] = self._similar_words(word)
        return known

    def _similar_words(self, word: str) -> dict[str, float]:
        """Return the words of the index that a typed one may be, with 0 to 1 for how likely."""
        found = {word: 1.0} if word in self._at else {}
        for longer in self.begun(word):
            # The less is still to be typed, the likelier; never as much as the whole word.
            found[longer] = _PREFIX + (1 - _PREFIX) * len(word) / (len(longer) + 1)
        most = _slips(word)
        # Slips are looked for only where nothing fits: beside a right word they are noise.
        if most and not found:
            for near, slips in self._near(word, most):
                found.setdefault(near, _ONE_SLIP if slips == 1 else _TWO_SLIPS)
        return found

    def nearest(self, word: str) -> str:
        """Return the known word that is most alike, or nothing."""
        near = sorted(self._near(word, max(2, (len(word) + 1) // 3)), key=lambda found: found[1])
        return near[0][0] if near else ""

    def _near(self, word: str, most: int) -> list[tuple[str, int]]:
        """Return known words within a number of slips, or that begin with such a word; with the number."""
        shared: Counter[int] = Counter()
        for pair in _pairs(word):
            shared.update(self._with.get(pair, ()))
        found = []
        # A word that shares few pairs is not within two slips, and measuring is slow.
        for n, _ in shared.most_common(_MEASURED):
            known = self.words[n]
            slips = distance(word, known, most)
            if slips > most and len(known) > len(word) >= _TWO - 1:  # only begun, and mistyped
                slips = 1 + distance(word, known[: len(word)], most - 1)
            if slips <= most:
                found.append((known, slips))
        return found
