"""The AcroMill database holds what its guide prints, pictures included: names, pages, units, defaults, ranges, gains.

The facts in acromill.yaml were taken from the guide without a look at the database (scripts/extract_acromill.py).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from altered import OUT_OF_THE_WAY, altered_facts, altered_schema
from book_9pc import Disagreement, exemptions, unsettled
from checks_acromill import Guide, check_names, check_ranges, check_runs, check_typical, check_values
from manual_facts import Section, read

from amp_studio.files import new_file
from amp_studio.schema import load_schema, show_value

HERE = Path(__file__).parent
COUNTS = [0, 3, 3, 268, 108]
CHECKS: dict[str, Callable[[Guide], Iterator[Disagreement]]] = {
    "names": check_names,
    "values": check_values,
    "ranges": check_ranges,
    "typical": check_typical,
    "runs": check_runs,
}


@cache
def printed() -> tuple[Section, ...]:
    return read(HERE / "acromill.yaml")


EXEMPT = exemptions(HERE / "exceptions_acromill.yaml")


@pytest.fixture(scope="module")
def book() -> Guide:
    return Guide(load_schema("acromill"), printed())


@pytest.mark.parametrize("check", CHECKS)
def test_the_database_holds_what_the_manual_print(book: Guide, check: str) -> None:
    disagreements = unsettled(check, CHECKS[check](book), EXEMPT)
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


def test_the_facts_are_those_of_the_chapters() -> None:
    kinds = ("numbers", "ranges", "choices", "stored", "defaults")
    assert [sum(len(getattr(s, kind)) for s in printed()) for kind in kinds] == COUNTS


def test_the_letters_of_the_axes_are_delivered_in_their_order() -> None:
    """X,Y... is the default, and X,Y,Z,A,B,C,U,V are typical (page 60)."""
    file, schema = new_file("acromill"), load_schema("acromill")
    name = schema.parameter("axes.name")
    held = [file.default((name.id, axis)) for axis in schema.instances(name, "mill")]
    assert [one and show_value(name, one) for one in held] == list("XYZABCUV")


def test_an_exception_says_why_in_a_sentence() -> None:
    for exempt in EXEMPT:
        assert exempt.check in CHECKS
        assert len(exempt.why.split()) > 4
        assert exempt.why.endswith(".")
        assert exempt.about or 0 not in exempt.span


# -- no altered fact goes unseen --------------------------------------------------------------------------

ALTERABLE = [
    ("names", "stored", {"name": ("Unheard of",)}),
    ("values", "stored", {"default": (OUT_OF_THE_WAY,), "unit": ("Hz",)}),
    ("ranges", "ranges", {"low": (OUT_OF_THE_WAY,), "high": (OUT_OF_THE_WAY,), "applies": ("Unheard of",)}),
    ("ranges", "choices", {"letter": ("99",), "number": ("Unheard of",)}),
    ("typical", "stored", {"codes": ({"typical": OUT_OF_THE_WAY},)}),
    ("runs", "defaults", {"number": ("Unheard of",), "value": (OUT_OF_THE_WAY,)}),
]


@pytest.mark.parametrize(("check", "kind", "wrong"), ALTERABLE)
def test_no_fact_of_the_tabs_can_be_altered_unseen(
    book: Guide, check: str, kind: str, wrong: dict[str, tuple[object, ...]]
) -> None:
    usual = set(CHECKS[check](book))
    exempt = {line for e in EXEMPT if e.check == check for line in e.span}
    assert [
        (line, key)
        for line, key, sections in altered_facts(printed(), kind, wrong)
        if line not in exempt and set(CHECKS[check](Guide(book.schema, sections))) <= usual
    ] == []


def test_no_page_can_be_altered_unseen(book: Guide) -> None:
    usual = {*check_names(book), *check_runs(book)}
    for at, section in enumerate(printed()):
        sections = (*printed()[:at], replace(section, page="1"), *printed()[at + 1 :])
        other = Guide(book.schema, sections)
        assert not {*check_names(other), *check_runs(other)} <= usual, section.heading


ALTERED = [
    ("names", "home.preset", {"name": "Shift"}),
    ("names", "axes.inposition_band", {"page": "61"}),
    ("values", "jog.rapid", {"default": None}),
    ("values", "jog.rapid", {"quantity": "length"}),
    ("values", "home.stop", {"quantity": "velocity"}),
    ("values", "fov.increment_percent", {"default": load_schema("acromill").parameters["jog.rapid"].default}),
    ("ranges", "control.path_color", {"ranges": {"": (0.0, 14.0)}}),
    (
        "typical",
        "jog.deceleration",
        {"help": load_schema("acromill").parameters["jog.stop"].help.model_copy(update={"find": ""})},
    ),
]


@pytest.mark.parametrize(("check", "parameter_id", "changes"), ALTERED)
def test_an_altered_database_is_told(
    book: Guide, check: str, parameter_id: str, changes: dict[str, object]
) -> None:
    other = Guide(altered_schema("acromill", parameter_id, changes), printed())
    assert set(CHECKS[check](other)) - set(CHECKS[check](book))
