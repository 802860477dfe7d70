"""The 57C422B database holds what its manual prints: every register, bit, range, unit and default, or says why not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from altered import OUT_OF_THE_WAY, altered_facts, altered_schema
from book_9pc import Disagreement, exemptions, unsettled
from checks_57c422b import Module, check_choices, check_numbers, check_ranges, check_stored
from manual_facts import Section, read

from amp_studio.schema import load_schema

HERE = Path(__file__).parent
COUNTS = [267, 15, 124, 17]
DESCRIBED = 56
CHECKS: dict[str, Callable[[Module], Iterator[Disagreement]]] = {
    "numbers": check_numbers,
    "choices": check_choices,
    "ranges": check_ranges,
    "stored": check_stored,
}


@cache
def printed() -> tuple[Section, ...]:
    return read(HERE / "57c422b.yaml")


EXEMPT = exemptions(HERE / "exceptions_57c422b.yaml")


@pytest.fixture(scope="module")
def book() -> Module:
    return Module(load_schema("57c422b"), printed())


@pytest.mark.parametrize("check", CHECKS)
def test_the_database_holds_what_the_manual_print(book: Module, check: str) -> None:
    disagreements = unsettled(check, CHECKS[check](book), EXEMPT)
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


def test_the_facts_are_those_of_the_chapters() -> None:
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
    "numbers": {"number": ("7654", "7654,7655"), "name": ("Unheard of",)},
    "choices": {"letter": ("99",), "text": ("Unheard of",), "number": ("7654",)},
    "ranges": {"low": (OUT_OF_THE_WAY,), "high": (OUT_OF_THE_WAY,)},
    "stored": {"default": (OUT_OF_THE_WAY,), "unit": ("Hz",), "numbers": (("7654",),)},
}


@pytest.mark.parametrize("check", CHECKS)
def test_no_fact_of_the_manual_can_be_altered_unseen(book: Module, check: str) -> None:
    usual = set(CHECKS[check](book))
    exempt = {line for e in EXEMPT if e.check == check for line in e.span}
    assert [
        (line, key)
        for line, key, sections in altered_facts(printed(), check, WRONG[check])
        if line not in exempt and set(CHECKS[check](Module(book.schema, sections))) <= usual
    ] == []


ALTERED = [
    ("numbers", "setup.in_position_tolerance", {"page": "4-11"}),
    ("numbers", "setup.in_position_tolerance", {"name": "Window"}),
    ("numbers", "setup.overtravel_positive", {"storage": None}),
    ("numbers", "cam.time_points", {"page": "4-58"}),
    ("choices", "control.mode", {"bits": ()}),
    ("ranges", "output.max_voltage", {"ranges": {"V": (0.0, 12.0)}}),
    ("ranges", "setup.in_position_tolerance", {"ranges": {"counts": (0.0, 9.0)}}),
    ("stored", "status.velocity_period", {"default": None}),
    ("stored", "setup.in_position_tolerance", {"storage": None}),
]


@pytest.mark.parametrize(("check", "parameter_id", "changes"), ALTERED)
def test_an_altered_database_is_told(
    book: Module, check: str, parameter_id: str, changes: dict[str, object]
) -> None:
    other = Module(altered_schema("57c422b", parameter_id, changes), printed())
    assert set(CHECKS[check](other)) - set(CHECKS[check](book))
