"""Pages that one can read: none is longer than it takes a person to find what is there."""

from __future__ import annotations

from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
MOST_WORDS = 1500
LONGER = {
    "architecture.md": 1800,
    "commands.md": 1900,
    "coverage.md": 2500,  # one table
    "formats.md": 4800,  # one section a format
    "schema.md": 4700,  # one section a kind of fact
    "protocols/exchange.md": 4900,  # the protocol, byte by byte
    "protocols/grblhal.md": 1800,
}
"""Pages that are still longer, each with what it may have: none grows."""


def test_a_page_has_at_most_as_many_words_as_one_reads() -> None:
    pages = {path.relative_to(DOCS).as_posix(): path for path in DOCS.rglob("*.md")}
    words = {name: len(path.read_text(encoding="utf-8").split()) for name, path in pages.items()}
    assert {name: count for name, count in words.items() if count > LONGER.get(name, MOST_WORDS)} == {}
    assert set(LONGER) == {name for name, count in words.items() if count > MOST_WORDS}
