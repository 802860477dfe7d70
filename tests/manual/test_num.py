"""The NUM database holds what its manual prints: every parameter, word, bit, code, default and bound, or says why not.

The facts in num.yaml were taken from the manual without a look at the database (scripts/extract_num.py). Each check
tells all its disagreements at once, each with parameter, line and section of the manual and with both readings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest
from book_9pc import Disagreement, Exempt, exemptions, unsettled
from checks_num import (
    EXEMPTIONS,
    FACTS,
    Book,
    bits_of,
    check_bits,
    check_codes,
    check_defaults,
    check_list,
    check_ranges,
    check_words,
    codes_of,
    defaults_of,
    ranges_of,
    row_of,
    words_of,
)
from manual_facts import Section, read

from amp_studio.schema import Parameter, load_schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import load_compiled

CHECKS: dict[str, Callable[[Book], Iterator[Disagreement]]] = {
    "list": check_list,
    "words": check_words,
    "bits": check_bits,
    "codes": check_codes,
    "defaults": check_defaults,
    "ranges": check_ranges,
}


@pytest.fixture(scope="module")
def book() -> Book:
    return Book(load_schema("num"), read(FACTS))


@pytest.fixture(scope="module")
def exempt() -> tuple[Exempt, ...]:
    return exemptions(EXEMPTIONS)


@pytest.mark.parametrize("check", CHECKS)
def test_the_database_holds_what_the_manual_prints(
    book: Book, exempt: tuple[Exempt, ...], check: str
) -> None:
    disagreements = unsettled(check, CHECKS[check](book), exempt)
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


def test_the_facts_are_those_of_the_whole_manual(book: Book) -> None:
    """Two sections lost their headings: 4.7 (P5) and 8.14 (P45)."""
    kinds = ("listed", "sizes", "words", "bits", "choices", "defaults", "ranges")
    assert [sum(len(getattr(s, kind)) for s in book.sections) for kind in kinds] == [
        111,
        88,
        592,
        42,
        28,
        55,
        34,
    ]
    described = {section.parameter for section in book.sections if section.sizes and section.parameter}
    paged = {number for number, page in book.pages.items() if page[:1].isdigit()}
    assert paged - described == {"P5", "P45"}


def test_an_exception_says_why_in_a_sentence(exempt: tuple[Exempt, ...]) -> None:
    for one in exempt:
        assert one.check in CHECKS
        assert len(one.why.split()) > 4
        assert one.why.endswith(".")
        assert one.about or 0 not in one.span, "nothing else tells what is printed nowhere"


# -- no altered fact of the manual goes unseen ------------------------------------------------------------

OUT_OF_THE_WAY = "87654"
"""A figure that nothing holds and no erratum mentions."""

Judge = Callable[[Book, Section], Iterator[Disagreement]]


def rows_of(book: Book, section: Section) -> Iterator[Disagreement]:
    for row in section.listed:
        yield from row_of(book, row)


ALTERED_FACTS: list[tuple[str, Judge, str, dict[str, object]]] = [
    ("list", rows_of, "listed", {"number": "P999"}),
    ("list", rows_of, "listed", {"type": "3"}),
    ("list", rows_of, "listed", {"page": "1-1"}),
    ("list", rows_of, "listed", {"category": "Unheard of"}),
    ("words", words_of, "sizes", {"words": 9999}),
    ("words", words_of, "sizes", {"type": "3"}),
    ("words", words_of, "sizes", {"number": "P999"}),
    ("words", words_of, "words", {"word": "N99"}),
    ("words", words_of, "words", {"number": "P999"}),
    ("bits", bits_of, "bits", {"bits": "77"}),
    ("bits", bits_of, "bits", {"word": "N99"}),
    ("codes", codes_of, "choices", {"letter": "1000"}),
    ("codes", codes_of, "choices", {"text": "Unheard of"}),
    ("codes", codes_of, "choices", {"applies": "29-28"}),
    ("defaults", defaults_of, "defaults", {"value": OUT_OF_THE_WAY}),
    ("defaults", defaults_of, "defaults", {"word": "N99", "value": OUT_OF_THE_WAY}),
    ("ranges", ranges_of, "ranges", {"low": OUT_OF_THE_WAY}),
    ("ranges", ranges_of, "ranges", {"high": OUT_OF_THE_WAY}),
    ("ranges", ranges_of, "ranges", {"applies": "P97 N99"}),
]


@pytest.mark.parametrize(("check", "judge", "kind", "changes"), ALTERED_FACTS)
def test_no_fact_can_be_altered_unseen(
    book: Book,
    exempt: tuple[Exempt, ...],
    check: str,
    judge: Judge,
    kind: str,
    changes: dict[str, object],
) -> None:
    excused = {line for one in exempt if one.check == check for line in one.span}

    def missed(section: Section, at: int) -> bool:
        facts = list(getattr(section, kind))
        if facts[at].line in excused or getattr(facts[at], "note", "") == "recommended":
            return False
        facts[at] = replace(facts[at], **changes)
        altered = replace(section, **{kind: tuple(facts)})
        return set(judge(book, altered)) <= set(judge(book, section))

    assert [
        (fact.line, section.heading)
        for section in book.sections
        for at, fact in enumerate(getattr(section, kind))
        if section.heading != TYPES and missed(section, at)
    ] == []


TYPES = "Rules for Writing the Parameters"
"""Its ranges are those of the types: a range of the database is held against them, not they against it."""


def test_no_range_of_a_type_can_be_altered_unseen(book: Book) -> None:
    def told(low: str) -> set[Disagreement]:
        sections = tuple(
            replace(s, ranges=tuple(replace(r, low=low) for r in s.ranges)) if s.heading == TYPES else s
            for s in book.sections
        )
        return set(check_ranges(Book(book.schema, sections)))

    assert told("1") - set(check_ranges(book))


# -- nor an altered fact of the database ------------------------------------------------------------------


def changed(book: Book, parameter_id: str, **changes: object) -> Book:
    """Return the book with one parameter of the database changed; a dict changes a model inside it."""
    compiled = load_compiled("num")

    def now(parameter: Parameter) -> Parameter:
        if parameter.id != parameter_id:
            return parameter
        new = {
            key: getattr(parameter, key).model_copy(update=said) if isinstance(said, Nested) else said
            for key, said in changes.items()
        }
        return parameter.model_copy(update=new)

    groups = tuple(
        group.model_copy(update={"parameters": tuple(map(now, group.parameters))})
        for group in compiled.groups
    )
    return Book(schema_of(compiled.model_copy(update={"groups": groups})), book.sections)


class Nested(dict[str, object]):
    """Changes to a model inside a parameter."""


GROUPS, MEASURED, LINE = "axes.cnc_groups", "axes.measured", "comm.master_line"

ALTERED_DATABASE = [
    ("list", MEASURED, {"page": "4-10"}, "page 4-10"),
    ("list", MEASURED, {"storage": Nested(code=0)}, "type 0"),
    ("list", MEASURED, {"numbers": Nested(format="P121N0")}, "P121"),
    ("words", GROUPS, {"numbers": Nested(format="P97N2")}, "has N2"),
    ("words", GROUPS, {"numbers": Nested(format="P97N1")}, "lacks N0"),
    ("words", GROUPS, {"storage": Nested(code=7)}, "type 7"),
    ("bits", "misc.functions_more", {"bits": None, "storage": Nested(bits=4)}, "bit 4"),
    ("codes", "measure.channel_check", {"bits": None}, "000 32 µs"),
    ("defaults", LINE, {"default": None}, "default $FF"),
    ("defaults", "misc.block_time", {"default": Nested(value=21)}, "default 20 ms"),
    ("defaults", "misc.block_time", {"default": Nested(unit="s")}, "default 20 ms"),
    ("ranges", GROUPS, {"ranges": {"": (1, 9)}}, "1 to 8"),
    ("ranges", "axes.increment", {"ranges": {"": (0, 65534)}}, "65534"),
]


@pytest.mark.parametrize(("check", "parameter_id", "changes", "told"), ALTERED_DATABASE)
def test_an_altered_database_is_told(
    book: Book, check: str, parameter_id: str, changes: dict[str, object], told: str
) -> None:
    new = set(CHECKS[check](changed(book, parameter_id, **changes))) - set(CHECKS[check](book))
    assert any(told in str(disagreement) for disagreement in new), new
