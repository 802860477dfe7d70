"""Danger, warning and note of every parameter, against a second reading of the manuals.

``graded/`` lists what each manual marks with a word (ATTENTION, CAUTION, Important …) and its other
statements on danger and damage, each with its line and page, and where it is shown to a person,
or why nowhere.
"""

from collections import Counter
from pathlib import Path

import pytest
from statements import schema_of, statements, untold

GRADED = Path(__file__).with_name("graded")
LISTS = sorted(GRADED.glob("*.yaml"))
GRADES = ("danger", "warning", "note")
MARKED = {  # as often as the text of each manual has the word before a statement
    "9pc": {"attention": 30, "important": 209},
    "num": {"caution": 22},
    "57c422b": {"danger": 3, "warning": 6, "caution": 2},
    "acromill": {"caution": 1, "note": 5},
    "syntec": {"warn": 1, "note": 1, "attention": 1},
    "grblhal": {"note": 11, "beware": 1},
}
GRAVE = ("attention", "danger", "warning", "warn", "caution")


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_whatever_a_manual_warns_of_is_reported_or_left_with_a_reason(path: Path) -> None:
    assert untold(path) == []
    words = Counter(s.word for s in statements(path) if s.word not in ("plain", "message"))
    assert words == MARKED[path.stem]


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_no_parameter_warns_of_what_the_second_reading_did_not_find_on_that_page(path: Path) -> None:
    heard = {(teller, s.page) for s in statements(path) for teller in s.told_by()}
    reported = {
        (f"{grade} {parameter.id}", note.page)
        for parameter in schema_of(path).parameters.values()
        for grade in GRADES
        for note in getattr(parameter.help, grade)
    }
    assert reported - heard == set()


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_no_statement_is_graded_below_the_word_of_its_manual(path: Path) -> None:
    grave = [s for s in statements(path) if s.word in GRAVE]
    assert [s.line for s in grave if any(t.startswith("note ") for t in s.told_by())] == []


def test_a_manual_that_warns_of_injury_is_a_danger_at_the_parameter() -> None:
    reported = {
        teller for s in statements(GRADED / "57c422b.yaml") if s.word == "warning" for teller in s.told_by()
    }
    assert {teller.partition(" ")[0] for teller in reported} == {"danger"}
