"""Other versions of an open file: as opened, as saved, with its defaults, before its saves."""

from pathlib import Path

import pytest

from amp_studio.files import Document, HistoryEntry, compare, new_file
from amp_studio.files.versions import before_saves, with_defaults
from amp_studio.schema import Value, family_ids

CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def document(tmp_path: Path):
    """Return an open document of a new mill."""
    document = Document.create(new_file("9pc", "mill", ["X"]), tmp_path / "mill.amp")
    yield document
    document.close()


def test_a_file_is_known_as_it_was_opened_and_as_it_was_saved(document: Document) -> None:
    document.file.set(CALIBRATION, Value(1.0, "mm"))
    document.file.header.notes, document.file.unknown["future.thing"] = "first", "1"
    document.save()
    document.file.set(CALIBRATION, Value(2.0, "mm"))
    document.file.header.notes = "second"
    saved = document.as_saved()
    assert document.opened.get(CALIBRATION) == Value(0.0, "mm")
    assert (saved.get(CALIBRATION), saved.header.notes) == (Value(1.0, "mm"), "first")
    assert saved.unknown == {"future.thing": "1"}


def test_an_entry_that_the_schema_does_not_know_is_unsaved_work_too(document: Document) -> None:
    assert not document.is_dirty
    document.file.unknown["future.thing"] = "1"
    assert document.is_dirty


def test_the_history_leads_back_to_what_a_file_was(document: Document) -> None:
    for value in (1.0, 2.0):
        document.file.set(CALIBRATION, Value(value, "mm"))
        document.save()
    entries = document.history()
    assert before_saves(document.file, entries[:1]).get(CALIBRATION) == Value(1.0, "mm")
    assert before_saves(document.file, entries).get(CALIBRATION) == Value(0.0, "mm")


@pytest.mark.parametrize("param", ["home.calibration@99", "no.such", "home.calibration@1@2", "\ud800", ""])
def test_an_entry_of_the_history_that_means_nothing_changes_nothing(document: Document, param: str) -> None:
    entry = HistoryEntry("2026-01-01T00:00:00+00:00", "J. Doe", "edit", param, "5 mm", "6 mm")
    assert before_saves(document.file, [entry]).values == document.file.values


@pytest.mark.parametrize("family", family_ids())
def test_a_new_file_has_its_defaults_and_a_value_without_one_stays(family: str) -> None:
    file = new_file(family)
    differing = compare(file.schema, file.values, with_defaults(file).values).differences
    assert [d for d in differing if d.b is None] == []
    assert [d for d in differing if file.is_default(d.address)] == []
