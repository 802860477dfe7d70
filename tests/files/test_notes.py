"""What people note about a value, a group or the machine is part of the file: saved, undone, merged,
and lost by nobody.
"""

from pathlib import Path

import pytest

from amp_studio.files import (
    Document,
    ParameterFile,
    ParameterFileError,
    content_of,
    open_file,
    read_content,
    swap_axes,
)
from amp_studio.files.merging import Merge
from amp_studio.files.notes import (
    MachineNote,
    NoteError,
    all_notes,
    group_note,
    machine_note,
    set_group_note,
    set_machine_note,
    set_value_note,
    value_note,
)
from amp_studio.formats import export_file, import_file
from amp_studio.schema import Value

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def path(tmp_path: Path, checkout: Path) -> Path:
    """Return a copy of the example mill."""
    found = tmp_path / "mill.amp"
    found.write_bytes((checkout / "examples" / "mill-1394" / "MILL_1394.amp").read_bytes())
    return found


@pytest.fixture
def file(path: Path) -> ParameterFile:
    """Return the example mill."""
    return open_file(path).file


def test_notes_are_saved_with_the_file_and_nothing_else_of_it_changes(path: Path) -> None:
    before = path.read_text(encoding="utf-8")
    with Document.open(path) as document:
        assert set_value_note(document.file, EXCESS, "11.5 with the long spindle:\n  see 'order' #4711 — ü")
        assert set_group_note(document.file, "home", "Switches renewed")
        assert document.is_dirty
        document.save()
        assert not document.is_dirty
    again = open_file(path).file
    assert value_note(again, EXCESS) == "11.5 with the long spindle:\n  see 'order' #4711 — ü"
    assert group_note(again, "home") == "Switches renewed"
    kept = [line for line in path.read_text(encoding="utf-8").splitlines() if line in before.splitlines()]
    assert kept == before.splitlines(), "every line of the old file is there"
    with Document.open(path) as document:
        set_value_note(document.file, EXCESS, "")
        set_group_note(document.file, "home", " \n")
        document.save()
    assert path.read_text(encoding="utf-8").splitlines() == before.splitlines() or not list(
        all_notes(open_file(path).file)
    )


def test_all_notes_come_in_the_order_of_the_manual(file: ParameterFile) -> None:
    set_value_note(file, EXCESS, "third")
    set_value_note(file, ("home.calibration", "1"), "second")
    set_group_note(file, "home", "first")
    set_machine_note(file, "of the machine")
    assert [note.text for note in all_notes(file)] == ["of the machine", "first", "second", "third"]
    assert list(all_notes(file))[-1] == MachineNote(
        "value", "servo.excess_error@1", "1750 Excess Error, Axis 1", "third"
    )
    assert machine_note(file) == "of the machine"


def test_a_note_about_what_this_schema_does_not_have_stays(file: ParameterFile) -> None:
    text = (
        content_of(file)
        .decode()
        .replace("\n...", "\nvalue_notes:\n  gone.away@1: still true\ngroup_notes: {old: kept}\n...")
    )
    again = read_content(Path("x.amp"), text.encode())
    assert [note.about for note in all_notes(again)] == ["old", "gone.away@1"]
    assert b"gone.away@1: still true" in content_of(again)


@pytest.mark.parametrize("entry", ["value_notes: [1, 2]", "value_notes:\n  a@1: [x]", "group_notes: 5"])
def test_notes_that_are_none_are_refused_and_not_dropped(file: ParameterFile, entry: str) -> None:
    text = content_of(file).decode().replace("\n...", f"\n{entry}\n...")
    with pytest.raises(ParameterFileError):
        read_content(Path("x.amp"), text.encode())


@pytest.mark.parametrize("text", ["x" * 4_001, "a\x00b", "a\ud800b", "a\uffffb"])
def test_what_no_file_can_contain_is_refused(file: ParameterFile, text: str) -> None:
    with pytest.raises(NoteError):
        set_value_note(file, EXCESS, text)
    assert not list(all_notes(file))


def test_a_group_that_there_is_not_is_refused(file: ParameterFile) -> None:
    with pytest.raises(NoteError, match="there is no group 'hime'"):
        set_group_note(file, "hime", "x")


def test_notes_survive_a_killed_program(path: Path) -> None:
    document = Document.open(path)
    set_value_note(document.file, EXCESS, "unsaved")
    document.unsaved_writer()()
    document._journal_is_ours = False  # as after a kill
    found = document.find_unsaved()
    assert found is not None
    assert found.header == {"value_notes": {"servo.excess_error@1": "unsaved"}}
    document.journal_path.unlink()
    document.close()


def test_a_merge_brings_the_notes_of_both_along(file: ParameterFile) -> None:
    ours, theirs = file.copy(), file.copy()
    set_value_note(ours, EXCESS, "ours")
    set_value_note(theirs, ("home.calibration", "1"), "theirs")
    theirs.set(EXCESS, Value(12.0, "mm"))
    merged = Merge(ours, theirs, file).result()
    assert value_note(merged, EXCESS) == "ours"
    assert value_note(merged, ("home.calibration", "1")) == "theirs"
    assert merged.get(EXCESS) == Value(12.0, "mm")
    assert value_note(ours, ("home.calibration", "1")) == "", "the sources are as they were"


def test_notes_go_through_a_table_for_a_spreadsheet(file: ParameterFile, tmp_path: Path) -> None:
    set_value_note(file, EXCESS, "two\nlines, =1+1")
    export_file(file, tmp_path / "mill.csv")
    again = import_file(tmp_path / "mill.csv", "9pc")
    assert value_note(again, EXCESS) == "two\nlines, =1+1"
    assert again.get(EXCESS) == file.get(EXCESS)


def test_a_note_goes_with_its_value_when_axes_change_places(file: ParameterFile) -> None:
    set_value_note(file, EXCESS, "of X")
    set_value_note(file, ("home.calibration", "3"), "of Z")
    swap_axes(file, "1", "2")
    assert value_note(file, ("servo.excess_error", "2")) == "of X"
    assert value_note(file, EXCESS) == ""
    assert value_note(file, ("home.calibration", "3")) == "of Z"
