"""The Syntec database holds what its slides print: every number, value, range, unit and default, or says why not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from altered import OUT_OF_THE_WAY, altered_facts, altered_schema
from book_9pc import Disagreement, exemptions, unsettled
from checks_syntec import Slides, check_choices, check_numbers, check_ranges, check_stored
from manual_facts import Section, read

from amp_studio.schema import load_schema

HERE = Path(__file__).parent
COUNTS = [106, 2, 30, 11]
DESCRIBED = 27
CHECKS: dict[str, Callable[[Slides], Iterator[Disagreement]]] = {
    "numbers": check_numbers,
    "choices": check_choices,
    "ranges": check_ranges,
    "stored": check_stored,
}


@cache
def printed() -> tuple[Section, ...]:
    return read(HERE / "syntec.yaml")


EXEMPT = exemptions(HERE / "exceptions_syntec.yaml")


@pytest.fixture(scope="module")
def book() -> Slides:
    return Slides(load_schema("syntec"), printed())


@pytest.mark.parametrize("check", CHECKS)
def test_the_database_holds_what_the_slides_print(book: Slides, check: str) -> None:
    disagreements = unsettled(check, CHECKS[check](book), EXEMPT)
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


def test_the_facts_are_those_of_all_slides() -> None:
    kinds = ("numbers", "ranges", "choices", "stored")
    assert [sum(len(getattr(s, kind)) for s in printed()) for kind in kinds] == COUNTS
    assert len({n.number for s in printed() for n in s.numbers if n.place == "table"}) == DESCRIBED


def test_an_exception_says_why_in_a_sentence() -> None:
    for exempt in EXEMPT:
        assert exempt.check in CHECKS
        assert len(exempt.why.split()) > 4
        assert exempt.why.endswith(".")
        assert exempt.about or 0 not in exempt.span


# -- no altered fact goes unseen --------------------------------------------------------------------------

WRONG: dict[str, dict[str, tuple[object, ...]]] = {
    "numbers": {"number": ("7654", "7654~7673"), "name": ("Unheard of",)},
    "choices": {"letter": ("9",), "text": ("Unheard of",), "number": ("7654",)},
    "ranges": {"low": (OUT_OF_THE_WAY,), "high": (OUT_OF_THE_WAY,), "unit": ("Hz",)},
    "stored": {"default": (OUT_OF_THE_WAY,), "unit": ("Hz",), "codes": ({"21 series": "77"},)},
}


@pytest.mark.parametrize("check", CHECKS)
def test_no_fact_of_the_slides_can_be_altered_unseen(book: Slides, check: str) -> None:
    usual = set(CHECKS[check](book))
    exempt = {line for e in EXEMPT if e.check == check for line in e.span}
    assert [
        (line, key)
        for line, key, sections in altered_facts(printed(), check, WRONG[check])
        if line not in exempt and set(CHECKS[check](Slides(book.schema, sections))) <= usual
    ] == []


def test_no_described_span_can_be_moved_unseen(book: Slides) -> None:
    usual = set(check_numbers(book))
    for at, section in enumerate(printed()):
        for i, fact in enumerate(section.numbers):
            first, _, last = fact.number.partition("~")
            for number in (f"{int(first) + 1}~{last}", f"{first}~{int(last) - 1}") if last else ():
                now = (*section.numbers[:i], replace(fact, number=number), *section.numbers[i + 1 :])
                sections = (*printed()[:at], replace(section, numbers=now), *printed()[at + 1 :])
                assert not set(check_numbers(Slides(book.schema, sections))) <= usual, (fact.line, number)


ALTERED = [
    ("numbers", "home.offset", {"page": "2.2.2.1"}),
    ("numbers", "home.offset", {"name": "Shift"}),
    ("numbers", "home.zero_speed_window", {"page": "2.2.5.1"}),
    ("numbers", "home.zero_speed_window", {"instances": ("1", "2")}),
    ("choices", "resolution.multiplication", {"choices": None}),
    ("ranges", "limit.first_positive", {"ranges": {"BLU": (0, 1)}}),
    ("ranges", "limit.second_positive", {"ranges": {"BLU": (0, 1)}}),
    ("stored", "limit.first_positive", {"default": None}),
    ("stored", "mpg.acceleration_time", {"unit": "s"}),
    ("stored", "mpg.port", {"unit": "ms"}),
]


@pytest.mark.parametrize(("check", "parameter_id", "changes"), ALTERED)
def test_an_altered_database_is_told(
    book: Slides, check: str, parameter_id: str, changes: dict[str, object]
) -> None:
    other = Slides(altered_schema("syntec", parameter_id, changes), printed())
    assert set(CHECKS[check](other)) - set(CHECKS[check](book))
