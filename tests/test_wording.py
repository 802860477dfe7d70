"""The words of messages, help, docstrings, comments and documents: the terms of the field, no private idiom.

Every room of the program is checked, and every document listed here. Code identifiers, names in backquotes
and the values in braces of a message are not looked at, and neither is a text of a single word (a key).
"""

from __future__ import annotations

import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

FORBIDDEN = {
    "told": "shown, listed, reported",
    "tell": "return, show",
    "tells": "returns, shows",
    "said": "message, text",
    "says": "is, contains",
    "held": "contained, stored, constant",
    "holds": "contains, is stored",
    "stands": "is",
    "wants": "needs, requires",
    "out of force": "inactive",
    "in force": "active",
    "advice": "recommendation",
    "repair": "suggested fix",
    "repairs": "suggested fixes",
    "unset": "not set",
    "absent": "not set",
    "of its own": "separate",
    "where that is": "if",
    "gives way": "has lower precedence",
    "given up": "cancelled",
    "all the same": "anyway",
    "the other way round": "in the opposite direction",
    "born": "default",
    "looked at": "checked",
    "stand": "are",
    "stood": "was",
    "speaks of": "names",
}
"""Word or phrase -> what to write instead."""

ALLOWED: dict[tuple[str, str], str] = {}
"""(file, word) -> why it may stay there."""

ROOMS = sorted(
    p.name
    for p in (ROOT / "amp_studio").iterdir()
    if p.suffix == ".py" or (p.is_dir() and p.name != "__pycache__")
)
DOCUMENTS = (
    "README.md",
    "CONTRIBUTING.md",
    "docs/architecture.md",
    "docs/formats.md",
    "docs/rules.md",
    "docs/schema.md",
    "docs/simulation.md",
    "docs/protocols/image.md",
    "docs/protocols/exchange.md",
    "Makefile",
    *sorted(p.relative_to(ROOT).as_posix() for p in ROOT.glob("examples/*/README.md")),
)

_PATTERN = re.compile(rf"\b({'|'.join(map(re.escape, FORBIDDEN))})\b", re.IGNORECASE)
_NAMES = re.compile(r"``.*?``|`[^`\n]*`|\{[^{}]*\}|[\w-]+\.[\w.-]+|\"[^\"\n]*\"")


_PART_OF_A_MESSAGE = getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)
"""From Python 3.12 on an f-string is several tokens."""


def texts_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of every docstring, message and comment of a module."""
    with path.open(encoding="utf-8") as source:
        for token in tokenize.generate_tokens(io.StringIO(source.read()).readline):
            is_text = token.type in (tokenize.STRING, _PART_OF_A_MESSAGE) and " " in token.string
            if token.type == tokenize.COMMENT or is_text:
                yield token.start[0], token.string.strip("frb").strip("\"'")


def modules_of(room: Path) -> list[Path]:
    """Return the modules of a folder, or the one module."""
    return sorted(room.rglob("*.py")) if room.is_dir() else [room]


def words_in(text: str) -> list[str]:
    """Return the forbidden words of a text, without those in names and values."""
    return [found.casefold() for found in _PATTERN.findall(_NAMES.sub(" ", text))]


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_uses_the_words_of_the_field(room: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: '{word}' ({FORBIDDEN[word]}) in: {text.strip()[:90]}"
        for path in modules_of(ROOT / "amp_studio" / room)
        for line, text in texts_of(path)
        for word in words_in(text)
        if (path.relative_to(ROOT).as_posix(), word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("document", DOCUMENTS)
def test_a_document_uses_the_words_of_the_field(document: str) -> None:
    text = re.sub(
        r"^    .*$|^```.*?^```", "", (ROOT / document).read_text("utf-8"), flags=re.MULTILINE | re.DOTALL
    )
    found = [
        f"{document}:{n}: '{word}' ({FORBIDDEN[word]}) in: {line.strip()[:90]}"
        for n, line in enumerate(text.splitlines(), 1)
        for word in words_in(line)
        if (document, word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


def test_an_exception_is_still_needed() -> None:
    for name, word in ALLOWED:
        path = ROOT / name
        texts = (
            [t for _, t in texts_of(path)] if path.suffix == ".py" else path.read_text("utf-8").splitlines()
        )
        assert any(word in words_in(text) for text in texts), f"{name} has no '{word}' any more"


def test_the_check_finds_a_word_and_leaves_names_alone() -> None:
    assert words_in("The parameter is unset and out of force") == ["unset", "out of force"]
    assert words_in("the rule schema.unset, the option `advice`, {told}") == []
