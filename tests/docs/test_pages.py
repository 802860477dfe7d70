"""Pages that one can read: none is longer than it takes a person to find what is there."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
MAX_WORDS = 1500


def words_of(page: str) -> int:
    """Count the words of a page without its tables and examples, in which one looks something up."""
    lines = re.sub(r"^```.*?^```", "", page, flags=re.DOTALL | re.MULTILINE).splitlines()
    return sum(len(line.split()) for line in lines if not line.startswith(("|", "    ")))


def test_a_page_has_at_most_as_many_words_as_one_reads() -> None:
    pages = {path.relative_to(DOCS).as_posix(): path for path in DOCS.rglob("*.md")}
    words = {name: words_of(path.read_text(encoding="utf-8")) for name, path in pages.items()}
    assert {name: count for name, count in words.items() if count > MAX_WORDS} == {}
