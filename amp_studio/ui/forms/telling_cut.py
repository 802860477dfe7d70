"""A text that has no room, cut so that it cannot be taken for another one of its column."""

from collections.abc import Collection

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetrics

_CUT = "…"


def telling_cut(metrics: QFontMetrics, text: str, others: Collection[str], room: int) -> str:
    """Return a text cut in the middle; where that would be the cut of another one too, the words of it that
    the fewest others have.
    """
    cut = metrics.elidedText(text, Qt.TextElideMode.ElideMiddle, room)
    head, is_cut, tail = cut.partition(_CUT)
    if cut == text or not is_cut:
        return cut
    alike = [set(each.split(" ")) for each in others if each.startswith(head) and each.endswith(tail)]
    if len(alike) < 2:
        return cut
    words, kept = text.split(" "), frozenset[int]()
    # The last one first: what a name ends with is the thing, what it begins with the room it is in.
    order = sorted(range(len(words)), key=lambda n: (sum(words[n] in each for each in alike), -n))
    for n in order:
        if metrics.horizontalAdvance(_with_gaps(words, kept | {n})) <= room:
            kept |= {n}
    if order[0] in kept:
        return _with_gaps(words, kept)
    return metrics.elidedText(f"{_CUT}{words[order[0]]}", Qt.TextElideMode.ElideRight, room)


def _with_gaps(words: list[str], kept: frozenset[int]) -> str:
    """Return the words that are kept, with a mark in the place of others."""
    text = ""
    for n, word in enumerate(words):
        if n in kept:
            text += word if text.endswith(_CUT) or not text else f" {word}"
        elif not text.endswith(_CUT):
            text += _CUT
    return text
