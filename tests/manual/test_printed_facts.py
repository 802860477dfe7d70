"""The databases hold what their manuals print: numbers, names, bounds, choices, units and defaults,
or say why not.

The facts in ``<family>.yaml`` were taken from each manual without a look at the database
(``scripts/extract_*.py``). Each check lists all its disagreements at once,
each with line and section of the manual and with both readings.
"""

from itertools import islice
from typing import Any

import pytest
from altered import altered_facts
from disagreements import Disagreement, Exempt, unsettled
from families import FAMILIES
from family import AlteredEntry, AlteredFact, Family
from manual_facts import KINDS

from tests.campaigns import CAMPAIGN

AnyFamily = Family[Any]
EACH = 1 if CAMPAIGN else 40
"""Every how many facts of a manual are altered; `make mutants` alters each."""
EVERY_FAMILY = pytest.mark.parametrize("family", FAMILIES.values(), ids=FAMILIES)


@pytest.mark.parametrize(
    ("family", "check"),
    [
        pytest.param(family, check, id=f"{family.key}-{check}")
        for family in FAMILIES.values()
        for check in family.checks
    ],
)
def test_the_database_contains_what_the_manual_prints(family: AnyFamily, check: str) -> None:
    disagreements = unsettled(check, family.checks[check](family.book), family.exempt)
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


@EVERY_FAMILY
def test_the_facts_are_those_of_the_whole_manual(family: AnyFamily) -> None:
    counts = {kind: sum(len(getattr(section, kind)) for section in family.book.sections) for kind in KINDS}
    assert {kind: count for kind, count in counts.items() if count} == family.counts
    numbers = [number for section in family.book.sections for number in section.numbers]
    assert len({number.number for number in numbers if number.place == "table"}) == family.described


# -- exceptions -------------------------------------------------------------------------------------------


@EVERY_FAMILY
def test_an_exception_shows_why_in_a_sentence(family: AnyFamily) -> None:
    for exempt in family.exempt:
        assert exempt.check in family.checks
        assert len(exempt.why.split()) > 4
        assert exempt.why.endswith(".")
        assert exempt.about or 0 not in exempt.span, "nothing else tells what is printed nowhere"


def test_an_exception_covers_its_lines_and_fails_where_it_is_not_needed() -> None:
    def odd(line: int, about: str) -> Disagreement:
        return Disagreement("ranges", line, about, "5-10 Home Calibration", "0 to 1 mm", "0 to 2 mm")

    exempt = [
        Exempt(check="ranges", lines="10-11", why="The scan is torn."),
        Exempt(check="choices", lines="99", why="Of another check."),
    ]
    assert unsettled("ranges", [odd(10, "a"), odd(11, "b")], exempt) == []
    assert unsettled("ranges", [odd(10, "a"), odd(11, "b"), odd(12, "c")], exempt) == [str(odd(12, "c"))]
    (spare,) = unsettled("ranges", [odd(10, "a")], exempt)
    assert "line 11" in spare
    assert "not needed" in spare
    narrow = [Exempt(check="ranges", lines="10", about=("a",), why="Only this one.")]
    assert unsettled("ranges", [odd(10, "a"), odd(10, "b")], narrow) == [str(odd(10, "b"))]


# -- no altered fact of a manual goes unseen, nor one of the database --------------------------------------


def cases(kind: str) -> list[Any]:
    """Return every family with each of its altered facts, or of its altered entries."""
    return [
        pytest.param(family, one, id=f"{family.key}-{at}-{'-'.join(one[:2])}")
        for family in FAMILIES.values()
        for at, one in enumerate(getattr(family, kind))
    ]


@pytest.mark.parametrize(("family", "fact"), cases("facts"))
def test_no_fact_of_the_manual_can_be_altered_unseen(family: AnyFamily, fact: AlteredFact) -> None:
    excused = family.excused(fact.check)
    every = (
        (at, *one)
        for at, section in enumerate(family.book.sections)
        for one in altered_facts(section, fact.kind, fact.alter)
        if one[0] not in excused
    )
    altered = [
        (line, what, bool(family.new_with_section(fact.check, at, now)))
        for at, line, what, now in islice(every, None, None, EACH)
    ]
    assert altered
    assert [(line, what) for line, what, seen in altered if not seen] == []


@pytest.mark.parametrize(("family", "entry"), cases("entries"))
def test_an_altered_database_is_reported(family: AnyFamily, entry: AlteredEntry) -> None:
    new = family.new_with_entry(entry)
    assert any(entry.told in str(disagreement) for disagreement in new), new
