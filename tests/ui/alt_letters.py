"""The Alt letters of what is seen together."""

from collections import Counter
from collections.abc import Iterable, Iterator

from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QAbstractButton, QGroupBox, QLabel, QWidget


def letters(texts: Iterable[str]) -> list[str]:
    """Return the Alt letters of texts."""
    return [found for text in texts if (found := QKeySequence.mnemonic(text).toString())]


def doubled(texts: Iterable[str]) -> dict[str, list[str]]:
    """Return letter -> texts, of the letters that several have."""
    texts = list(texts)
    often = [letter for letter, count in Counter(letters(texts)).items() if count > 1]
    return {letter: [t for t in texts if QKeySequence.mnemonic(t).toString() == letter] for letter in often}


def texts_of(widget: QWidget) -> Iterator[str]:
    """Yield the texts with an Alt letter that are seen in a window, its message boxes and dialogs left
    out.
    """
    for child in widget.findChildren(QWidget):
        if child.window() is not widget.window() or not child.isVisibleTo(widget):
            continue
        if (
            isinstance(child, QLabel) and child.buddy() is not None and child.buddy().isVisibleTo(widget)
        ) or isinstance(child, QAbstractButton):
            yield child.text()
        elif isinstance(child, QGroupBox):
            yield child.title()
