"""A few hundred damaged texts for every reader; ``texts`` makes as many as are wanted."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.faults import texts as damaged


@pytest.mark.parametrize("seed", [1, 2])
def test_damaged_yaml_is_read_or_refused_with_a_line(seed: int) -> None:
    assert damaged.fuzz_yaml(seed, 400) == []


@pytest.mark.parametrize("seed", [1, 2])
def test_a_damaged_parameter_file_is_refused_or_saved_as_what_it_holds(seed: int) -> None:
    assert damaged.fuzz_parameter_files(seed, 150) == []


def test_a_damaged_project_is_refused_or_saved_as_what_it_holds(tmp_path: Path) -> None:
    assert damaged.fuzz_projects(tmp_path, 1, 100) == []


def test_damaged_rules_are_read_entry_by_entry(tmp_path: Path) -> None:
    assert damaged.fuzz_rules(tmp_path, 1, 200) == []


def test_a_damaged_journal_keeps_nobody_from_the_file(tmp_path: Path) -> None:
    assert damaged.fuzz_journals(tmp_path, 1, 100) == []


def test_a_damaged_text_of_a_control_is_refused_or_becomes_a_file_that_can_be_read(tmp_path: Path) -> None:
    assert damaged.fuzz_imports(tmp_path, 1, 220) == []


def test_whatever_is_said_of_a_value_is_refused_or_read_back_as_it_was_meant() -> None:
    assert damaged.fuzz_entries(1, 250) == []


def test_the_same_seed_makes_the_same_texts_and_another_one_others() -> None:
    first, again, other = (list(damaged.mutants([damaged.SMALL], seed, 50)) for seed in (1, 1, 2))
    assert (first == again, first == other) == (True, False)
    assert sum(text != damaged.SMALL for text in first) > 45
