"""What people type for what the manuals call otherwise: German and trade words,
and what they see at the machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from amp_studio.schema import database_folder, read_yaml

from .words import distance, words_of

SYNONYMS_FILE = database_folder() / "synonyms.yaml"
_BEGUN = 5
"""Letters from which the last word of a question may be only begun."""
_SLIP = 6
"""Letters from which a word may have one slip."""
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_ENDINGS = ("", "e", "n", "en", "er", "s", "es")
"""What a German word may have behind it: ``Endschaltern``, ``Rampen``."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """Another question that a question may mean."""

    query: str
    typed: str
    """The words that were taken to mean something else."""
    means: str
    place: int
    """0 for the likeliest meaning of those words."""
    rest: tuple[str, ...] = ()
    """The words around them."""


def meanings(query: str) -> Iterator[Meaning]:
    """Yield what a question may mean in the words of the manuals, the likeliest first;
    nothing for one without a synonym.

    The longest group of words counts; what is around it stays in the question.
    """
    words = [word.translate(_UMLAUTS) for word in words_of(query)]
    # The longest group first: two words together mean something narrower than each alone.
    for length in range(len(words), 0, -1):
        for start in range(len(words) - length + 1):
            typed = tuple(words[start : start + length])
            known = _known(typed, is_last=start + length == len(words))
            if known is None:
                continue
            for place, mean in enumerate(_table()[known]):
                asked = " ".join((*words[:start], mean, *words[start + length :]))
                rest = (*words[:start], *words[start + length :])
                yield Meaning(asked, " ".join(typed), mean, place, rest)
            return


def known_words(query: str) -> list[str]:
    """Return the words of a question that are a word of the trade, each by itself or all together."""
    words = words_of(query)
    if _table().get(tuple(word.translate(_UMLAUTS) for word in words)):
        return words
    return [word for word in words if (word.translate(_UMLAUTS),) in _table()]


def _known(typed: tuple[str, ...], *, is_last: bool) -> tuple[str, ...] | None:
    """Return the words of the table that are meant: equal, with an ending, only begun, or with one slip."""
    if typed in _table():
        return typed
    if not any(len(word) >= _BEGUN for word in typed):
        return None
    same_length = [words for words in _table() if len(words) == len(typed)]
    if is_last and len(typed[-1]) >= _BEGUN and (begun := _begun(typed, same_length)):
        # The shortest that begins so is the nearest to what was typed.
        return min(begun, key=lambda words: len(words[-1]))
    return next((w for w in same_length if all(map(_is_like, typed, w))), None)


def _begun(typed: tuple[str, ...], known: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    return [w for w in known if w[:-1] == typed[:-1] and w[-1].startswith(typed[-1])]


def _is_like(typed: str, word: str) -> bool:
    if typed == word:
        return True
    if len(word) < _SLIP or len(typed) < _SLIP:
        return False
    return typed.removeprefix(word) in _ENDINGS or distance(typed, word, 1) <= 1


def synonym_table() -> list[tuple[list[str], list[str]]]:
    """Return what people type, and what each of it means in the words of the manuals, the likeliest first."""
    data = read_yaml(SYNONYMS_FILE.read_text("utf-8")).data
    return [(list(each["words"]), list(each["mean"])) for each in data["synonyms"]]


@cache
def _table() -> dict[tuple[str, ...], tuple[str, ...]]:
    """Return words -> what they mean."""
    return {
        tuple(word.translate(_UMLAUTS) for word in words_of(words)): tuple(mean)
        for typed, mean in synonym_table()
        for words in typed
    }


def nearest_synonym(query: str) -> str:
    """Return the known word that is most alike a question; empty where none is near."""
    typed = " ".join(word.translate(_UMLAUTS) for word in words_of(query))
    most = max(2, len(typed) // 4)
    near = min((distance(typed, " ".join(words), most), " ".join(words)) for words in _table())
    return near[1] if typed and near[0] <= most else ""


def prepare_synonyms() -> None:
    """Read the table now, in a thread that is not waited for."""
    _table()
