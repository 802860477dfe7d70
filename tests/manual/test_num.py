"""What only the check of the NUM has: sections that lost their headings, and the ranges of the types."""

from dataclasses import replace

from checks_num import Words, check_ranges
from disagreements import Disagreement
from families import NUM

TYPES = "Rules for Writing the Parameters"
"""Its ranges are those of the types: a range of the database is compared with them, not they against it."""


def test_every_listed_parameter_with_a_page_is_described() -> None:
    """Two sections lost their headings: 4.7 (P5) and 8.14 (P45)."""
    book = NUM.book
    described = {section.parameter for section in book.sections if section.sizes and section.parameter}
    paged = {number for number, page in book.pages.items() if page[:1].isdigit()}
    assert paged - described == {"P5", "P45"}


def test_no_range_of_a_type_can_be_altered_unseen() -> None:
    def disagreements(low: str) -> set[Disagreement]:
        sections = tuple(
            replace(s, ranges=tuple(replace(r, low=low) for r in s.ranges)) if s.heading == TYPES else s
            for s in NUM.book.sections
        )
        return set(check_ranges(Words(NUM.book.schema, sections)))

    assert disagreements("1") - NUM.told["ranges"]
