"""The paper of a migration in German: what is lost, what to do, and questions."""

import re
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.meaning import migrate
from amp_studio.report.papers.migration import migration_paper, write_migration_folder
from tests.report.test_german import FUNCTION_WORDS

OF_WORDS = [
    "Weniger sicher als vorher",
    "Offene Fragen: ihre Schlüssel sind ausgelassen",
    "An der Maschine zu messen",
    "Nicht möglich",
]
"""Tables of sentences; the others have numbers, keys and values as the controls have them."""
WRITTEN = re.compile(r"yes oder no|'[^']*'")
"""Answers as they are typed."""


@pytest.mark.parametrize(
    ("example", "target"), [("mill-1394/MILL_1394", "grblhal"), ("syntec-mill/SYNTEC_MILL", "linuxcnc")]
)
def test_a_migration_states_nothing_in_english(example: str, target: str) -> None:
    file = open_file(examples_folder() / f"{example}.amp").file
    paper = migration_paper(migrate(file, target, {}), language="de")
    tables = [table for table in paper.tables if table.title in OF_WORDS]
    words = [cell for table in tables for row in table.rows for cell in row[-2:] if " " in cell]
    names = sorted((p.name for p in file.schema.parameters.values()), key=len, reverse=True)
    known = re.compile("|".join((*map(re.escape, names), WRITTEN.pattern)))
    assert len(words) > 20
    assert [text for text in words if FUNCTION_WORDS.search(known.sub("", text.replace("−", "-")))] == []
    assert [table.title for table in tables] == OF_WORDS


def test_formulas_and_figures_stay_as_the_controls_write_them_and_words_beside_them_do_not() -> None:
    file = open_file(examples_folder() / "acromill-router/ROUTER.amp").file
    paper = migration_paper(migrate(file, "linuxcnc", {}), language="de")
    cells = [cell for table in paper.tables for row in table.rows for cell in row]
    assert "band > 0.0 ? band : null" in cells
    assert "806.299213, Vorzeichen offen" in cells
    assert "geschrieben" in cells
    assert {"written", "left out"} & set(cells) == set()


@pytest.mark.parametrize(("target", "rows"), [("linuxcnc", 1), ("grblhal", 0)])
def test_the_paper_names_hal_where_there_is_one(target: str, rows: int) -> None:
    file = open_file(examples_folder() / "mill-1394" / "MILL_1394.amp").file
    paper = migration_paper(migrate(file, target, {}))
    assert sum(name == "HAL" for name, _ in paper.facts) == rows


def test_the_lines_of_a_migration_are_german_and_names_and_values_are_not(tmp_path: Path) -> None:
    file = open_file(examples_folder() / "mill-1394" / "MILL_1394.amp").file
    write_migration_folder(migrate(file, "linuxcnc", {}), tmp_path / "retrofit", language="de")
    text = (tmp_path / "retrofit" / "migration.txt").read_text("utf-8")
    assert "\nWeniger sicher als vorher\n" in text
    assert "Vorher: eine Trapezrampe; Jetzt: eine gerade Rampe" in text
    assert ": Axis 1-8 Word Format\n" in text, "the name of a parameter stays"
    assert "= 165130.079, Vorzeichen offen (counts" in text, "a value and its formula are the control's"
    assert not re.search(r"\b(before|the new|left out|page)\b", text)
