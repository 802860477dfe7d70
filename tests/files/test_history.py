"""Every save is in the history of the file, without secrets; a history that cannot be written is a note."""

import getpass
import json
from pathlib import Path

import pytest

from amp_studio.files import Document, ParameterFile, backup_path, open_file
from amp_studio.schema import Value

CALIBRATION, POSITION = ("home.calibration", "1"), ("home.position", "1")

# -- history


def test_every_value_a_save_replaced_is_in_the_history_newest_first(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        assert document.history() == []
        for number in (1.0, 2.0):
            document.file.set(CALIBRATION, Value(number, "mm"))
            document.save("a test")
        document.file.set(CALIBRATION, None)
        document.file.set(POSITION, Value(1.0, "in"))
        document.save("another")
        document.save("nothing changed")
        expected = {
            ("another", "home.calibration@1", "2 mm", ""),
            ("another", "home.position@1", "0 mm", "1 in"),
            ("a test", "home.calibration@1", "1 mm", "2 mm"),
            ("a test", "home.calibration@1", "0 mm", "1 mm"),
        }
        assert expected == {(entry.how, entry.param, entry.old, entry.new) for entry in document.history()}
        assert [entry.how for entry in document.history()] == ["another", "another", "a test", "a test"]
        assert [entry.new for entry in document.history(CALIBRATION)] == ["", "2 mm", "1 mm"]
        assert {getpass.getuser()} == {entry.who for entry in document.history()}
    assert [entry.new for entry in Document.view(on_disk).history(CALIBRATION)] == ["", "2 mm", "1 mm"]


def test_of_a_long_history_the_lines_of_one_value_alone_are_taken_apart(
    on_disk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The window asks with every key: 20,000 lines took 190 ms each time."""
    taken: list[object] = []
    loads = json.loads
    with Document.open(on_disk) as document:
        line = ["2020-01-01T00", "me", "edit", "home.position@1", "0 mm", "1 mm"]
        own = [*line[:3], "home.calibration@1", "1 mm", "2 mm"]
        lines = [own, *[line] * 500, own]
        document.history_path.write_text("".join(json.dumps(each) + "\n" for each in lines))
        monkeypatch.setattr(json, "loads", lambda text: taken.append(text) or loads(text))
        assert [entry.new for entry in document.history(CALIBRATION)] == ["2 mm", "2 mm"]
        assert len(taken) == 2
        document.file.set(CALIBRATION, Value(3.0, "mm"))
        document.save()
        assert [entry.new for entry in document.history(CALIBRATION)] == ["3 mm", "2 mm", "2 mm"]


def test_a_new_file_begins_without_a_history(tmp_path: Path, mill: ParameterFile) -> None:
    with Document.create(mill, tmp_path / "new.amp") as document:
        assert document.history() == []
    assert {"new.amp"} == {path.name for path in tmp_path.iterdir()}


def test_a_damaged_line_of_the_history_costs_that_line_only(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(1.0, "mm"))
        document.save()
        with document.history_path.open("a", encoding="utf-8") as stream:
            stream.write('["2020-01-01", "me", "edit"\n')
            stream.write(
                '["too", "short"]\n{"no": "list"}\n5\nnull\n["2020-01-01T00", "me", "edit", "half a li'
            )
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.save()
        assert [entry.new for entry in document.history()] == ["2 mm", "1 mm"]
        document.history_path.write_bytes(b"\xff\xfe\n" + document.history_path.read_bytes())
        assert [entry.new for entry in document.history()] == ["2 mm", "1 mm"]


def test_a_history_that_cannot_be_written_does_not_undo_the_save(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        document.history_path.mkdir()
        document.file.set(CALIBRATION, Value(1.0, "mm"))
        document.save()
        assert (document.history(), document.is_dirty) == ([], False)
    assert Value(1.0, "mm") == open_file(on_disk).file.get(CALIBRATION)
    assert backup_path(on_disk).exists()
