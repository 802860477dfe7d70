"""The decisions: one a page, short, in one form, and all in the index."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs/decisions"
PAGES = sorted(FOLDER.glob("[0-9]*.md"))
HEADINGS = ["Context", "Decision", "Consequence", "Rejected"]
MAX_LINES = 40


def faults(text: str) -> list[str]:
    """Return what is wrong with the form of a page."""
    _, *sections = re.split(r"^## ", text, flags=re.MULTILINE)
    found = [] if [section.partition("\n")[0] for section in sections] == HEADINGS else ["headings"]
    if any(not section.partition("\n")[2].strip() for section in sections):
        found.append("empty section")
    if text.count("\n") > MAX_LINES:
        found.append("too long")
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_decision_has_its_four_parts_on_one_page(page: Path) -> None:
    assert faults(page.read_text("utf-8")) == []


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("## Rejected\n\nX\n", "", "headings"),
        ("## Context", "## Background", "headings"),
        ("## Decision\n\nX\n", "## Decision\n\n", "empty section"),
        ("X\n", "X\n" * 30, "too long"),
    ],
)
def test_a_fault_of_the_form_is_found(old: str, new: str, fault: str) -> None:
    right = "# 0001 A\n\n" + "".join(f"## {heading}\n\nX\n\n" for heading in HEADINGS).rstrip("\n") + "\n"
    assert faults(right) == []
    assert faults(right.replace(old, new, 1)) == [fault]


def test_the_pages_are_numbered_without_a_gap() -> None:
    assert [page.name[:5] for page in PAGES] == [f"{number:04d}-" for number in range(1, len(PAGES) + 1)]


def test_the_index_lists_every_page_by_its_title() -> None:
    listed = re.findall(r"^- \[(.+)\]\((.+)\)$", (FOLDER / "index.md").read_text("utf-8"), re.MULTILINE)
    titles = [page.read_text("utf-8").partition("\n")[0].removeprefix("# ") for page in PAGES]
    assert listed == [(title, page.name) for title, page in zip(titles, PAGES, strict=True)]
    assert [title[:4] for title in titles] == [page.name[:4] for page in PAGES]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_decision_names_in_the_tree_is_there(page: Path) -> None:
    text = page.read_text("utf-8")
    named = re.findall(r"`([a-z_]\w*/(?:[\w./-]*\w)?/?)(?::[^`]*)?`", text)
    gone = [name for name in named if not any((root / name).exists() for root in (ROOT, ROOT / "amp_studio"))]
    links = re.findall(r"\]\(([^)]+\.md)\)", text)
    gone += [link for link in links if not (page.parent / link).is_file()]
    assert gone == []
