"""A tick of a step is kept in the head of the file, and lost neither by older programs nor by an undo."""

from pathlib import Path

import pytest

from amp_studio.files import Document, ParameterFileError, open_file
from amp_studio.files.creation import new_file
from amp_studio.files.diff import merge
from amp_studio.files.storage import content_of, save_file
from amp_studio.guide import find_step, tick

TICKED = """amp_studio: 1
family: syntec
# by hand
done:
  home: 2026-11-22T20:00:00Z by ann   # on the machine
  heating: 2026-11-22T21:00:00Z by ben
values: {}
...
"""


def test_ticks_are_saved_and_read_again(tmp_path: Path) -> None:
    file = new_file("syntec")
    tick(file, find_step(file.schema, "home"), "2026-11-22T20:00:00Z by ann")
    save_file(file, tmp_path / "new.amp")
    again = open_file(tmp_path / "new.amp").file
    assert again.header.done == {"home": "2026-11-22T20:00:00Z by ann"}
    assert again.header.extra == {}


def test_a_file_without_ticks_shows_nothing_about_them(tmp_path: Path) -> None:
    file = new_file("syntec")
    save_file(file, tmp_path / "new.amp")
    assert "done" not in (tmp_path / "new.amp").read_text("utf-8")


def test_another_tick_leaves_the_rest_of_the_file_as_a_user_wrote_it(tmp_path: Path) -> None:
    path = tmp_path / "ticked.amp"
    path.write_text(TICKED, "utf-8")
    file = open_file(path).file
    tick(file, find_step(file.schema, "mpg"), "cid")
    text = content_of(file, path.read_bytes()).decode()
    assert "  mpg: cid\n" in text
    assert "# by hand\n" in text
    assert "by ann   # on the machine\n" in text
    assert "  heating: 2026-11-22T21:00:00Z by ben\n" in text  # a step of another version of the program


def test_the_last_tick_takes_its_heading_along(tmp_path: Path) -> None:
    path = tmp_path / "ticked.amp"
    path.write_text(TICKED.replace("  heating: 2026-11-22T21:00:00Z by ben\n", ""), "utf-8")
    file = open_file(path).file
    tick(file, find_step(file.schema, "home"), None)
    text = content_of(file, path.read_bytes()).decode()
    assert "home" not in text
    assert "done" not in text


def test_a_tick_that_is_no_text_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "ticked.amp"
    path.write_text(TICKED.replace("2026-11-22T21:00:00Z by ben", "[ann, ben]"), "utf-8")
    with pytest.raises(ParameterFileError, match=r"line 6.*heating does not say who has done it"):
        open_file(path)


def test_a_step_that_fails_takes_its_tick_back() -> None:
    file = new_file("syntec")

    def fail() -> None:
        with file.step():
            tick(file, find_step(file.schema, "home"), "ann")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert file.header.done == {}


def test_a_tick_survives_a_kill(tmp_path: Path) -> None:
    save_file(new_file("syntec"), tmp_path / "new.amp")
    with Document.open(tmp_path / "new.amp") as document:
        tick(document.file, find_step(document.file.schema, "home"), "ann")
        document.unsaved_writer()()
        kept = document.journal_path.read_bytes()
    (tmp_path / document.journal_path.name).write_bytes(kept)
    left = Document.open(tmp_path / "new.amp").find_unsaved()
    assert left is not None
    assert left.header == {"done": {"home": "ann"}}


def test_a_merge_has_the_ticks_of_both_sides(tmp_path: Path) -> None:
    base = new_file("syntec")
    ours, theirs = base.copy(), base.copy()
    tick(ours, find_step(base.schema, "home"), "ann")
    tick(theirs, find_step(base.schema, "mpg"), "ben")
    merged, conflicts = merge(base, ours, theirs)
    assert conflicts == []
    assert merged.header.done == {"home": "ann", "mpg": "ben"}


def test_a_copy_has_the_ticks_and_keeps_its_own() -> None:
    file = new_file("syntec")
    tick(file, find_step(file.schema, "home"), "ann")
    twin = file.copy()
    tick(twin, find_step(file.schema, "home"), None)
    assert file.header.done == {"home": "ann"}
    assert twin.header.done == {}
