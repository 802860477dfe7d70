"""An open file: one program at a time, unsaved work that survives, and a history."""

import getpass
import json
import os
import re
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import (
    Change,
    ChangedOnDiskError,
    Document,
    InUseError,
    ParameterFile,
    ParameterFileError,
    SaveError,
    Unsaved,
    open_file,
)
from amp_studio.files import lock as locking
from amp_studio.files.atomic import digest_of
from amp_studio.files.storage import save_file
from amp_studio.schema import Value

CALIBRATION, POSITION = ("home.calibration", "1"), ("home.position", "1")

OPEN = """
    import sys
    from pathlib import Path
    from amp_studio.files import Document
    document = Document.open(Path(sys.argv[1]))
    print("open", flush=True)
    sys.stdin.readline()
    document.close()
    print("closed", flush=True)
"""
"""Another program that opens a file, waits for a line, and closes it."""

WORK = """
    import sys
    from pathlib import Path
    from amp_studio.files import Document
    from amp_studio.schema import Value
    document = Document.open(Path(sys.argv[1]))
    document.file.set(("home.calibration", "1"), Value(7.5, "mm"))
    document.file.set(("home.position", "1"), None)
    document.file.set(("axis.type", "2"), Value("rotary"))
    document.unsaved_writer()()
    print("kept", flush=True)
    sys.stdin.readline()
    document.close()
"""
"""Another program that opens a file, changes three values, keeps them in its journal, and waits."""


def hidden(folder: Path) -> set[str]:
    """Return the companions of a file that a person does not see."""
    return {path.name for path in folder.iterdir() if path.name.startswith(".")}


# -- opening and saving --------------------------------------------------------------------------------------


def test_a_saved_change_is_on_disk_and_the_document_is_clean(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        assert (document.is_dirty, document.unsaved_changes()) == (False, [])
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        assert (True, [Change(CALIBRATION, Value(0.0, "mm"), Value(2.0, "mm"))]) == (
            document.is_dirty,
            document.unsaved_changes(),
        )
        document.save()
        assert (document.is_dirty, digest_of(on_disk)) == (False, document.digest)
    assert Value(2.0, "mm") == open_file(on_disk).file.get(CALIBRATION)
    assert set() == hidden(on_disk.parent)


def test_what_is_unsaved_is_known_without_comparing_every_value(
    on_disk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The window counts it after each key."""
    compared, equal = list[Value](), Value.__eq__
    with Document.open(on_disk) as document:
        new = next(a for a in document.file.addresses() if a not in document.file.values)
        same = next(a for a, value in document.saved.items() if value.unit == "mm" and a[0] != CALIBRATION[0])
        document.file.values[same] = Value(document.saved[same].value, "mm")
        document.file.set(CALIBRATION, Value(7.5, "mm"))
        document.file.set(POSITION, None)
        document.file.values[new] = Value(1)
        monkeypatch.setattr(Value, "__eq__", lambda a, b: compared.append(a) or equal(a, b))
        assert set(document.unsaved_addresses()) == {CALIBRATION, POSITION, new}
        assert len(compared) <= 2
        assert {change.address for change in document.unsaved_changes()} == {CALIBRATION, POSITION, new}


def test_what_is_changed_and_changed_back_is_not_dirty(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        change = document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.file.apply(change.reversed())
        assert not document.is_dirty


def test_closing_without_saving_leaves_the_file(on_disk: Path) -> None:
    before = on_disk.read_bytes()
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
    assert (before, {"bench.amp"}) == (on_disk.read_bytes(), {path.name for path in on_disk.parent.iterdir()})


def test_a_new_document_does_not_overwrite(tmp_path: Path, mill: ParameterFile) -> None:
    path = tmp_path / "new.amp"
    with Document.create(mill, path) as document:
        assert (False, path) == (document.is_dirty, document.path)
    before = path.read_bytes()
    with pytest.raises(FileExistsError, match=r"new\.amp exists already"):
        Document.create(mill, path)
    with pytest.raises(FileNotFoundError, match=r"there is no folder .*nowhere"):
        Document.create(mill, tmp_path / "nowhere" / "new.amp")
    assert (before, {"new.amp"}) == (path.read_bytes(), {p.name for p in tmp_path.iterdir()})


def test_save_as_makes_a_second_document_and_leaves_the_first(on_disk: Path) -> None:
    before = on_disk.read_bytes()
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        with document.save_as(on_disk.with_name("second.amp")) as second:
            assert ("second", Value(2.0, "mm")) == (second.file.header.name, second.file.get(CALIBRATION))
            second.file.set(CALIBRATION, Value(3.0, "mm"))
            assert Value(2.0, "mm") == document.file.get(CALIBRATION)
    assert before == on_disk.read_bytes()


def test_what_another_program_saved_is_noticed_and_not_overwritten(
    on_disk: Path, mill: ParameterFile
) -> None:
    with Document.open(on_disk) as document:
        mill.set(POSITION, Value(4.0, "mm"))
        save_file(mill, on_disk, document.digest)
        theirs = on_disk.read_bytes()
        assert digest_of(on_disk) != document.digest
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        with pytest.raises(ChangedOnDiskError):
            document.save()
        assert document.is_dirty
        on_disk.unlink()
        assert digest_of(on_disk) is None
        with pytest.raises(ChangedOnDiskError):
            document.save()
        on_disk.write_bytes(theirs)


def test_a_file_that_cannot_be_used_is_not_left_locked(on_disk: Path) -> None:
    good = on_disk.read_bytes()
    on_disk.write_bytes(good[:100])
    with pytest.raises(ParameterFileError):
        Document.open(on_disk)
    on_disk.write_bytes(good)
    Document.open(on_disk).close()
    assert set() == hidden(on_disk.parent)


# -- two programs --------------------------------------------------------------------------------------------


def test_a_second_program_is_reported_who_has_the_file(on_disk: Path, other) -> None:
    program = other(OPEN, on_disk)
    assert program.says() == "open"
    with pytest.raises(
        InUseError,
        match=r"bench\.amp is open in another program \(.*process \d+, since 20\d\d-\d\d-\d\d \d\d:\d\d\)",
    ) as refused:
        Document.open(on_disk)
    assert f"{getpass.getuser()} on " in str(refused.value)
    assert f"process {program.process.pid}," in str(refused.value)
    with Document.view(on_disk) as looking:
        assert (False, Value(0.0, "mm")) == (looking.is_locked, looking.file.get(CALIBRATION))
        looking.file.set(CALIBRATION, Value(1.0, "mm"))
        with pytest.raises(InUseError):
            looking.save()
    program.go_on()
    assert program.says() == "closed"
    with Document.open(on_disk) as document:
        assert document.is_locked


def test_the_lock_of_a_killed_program_ends_with_it(on_disk: Path, other) -> None:
    program = other(OPEN, on_disk)
    assert program.says() == "open"
    program.kill()
    assert {".bench.amp.lock", ".bench.amp.holder"} == hidden(on_disk.parent), "it had no chance to tidy up"
    with Document.open(on_disk) as document:
        assert document.is_locked
        program = other(OPEN, on_disk)
        assert program.says() == ""
        assert program.end() == 1, "and the new holder is told to the next"
    assert set() == hidden(on_disk.parent)


def test_two_documents_of_one_program_notice_each_other_too(on_disk: Path) -> None:
    with Document.open(on_disk), pytest.raises(InUseError, match=f"process {os.getpid()}"):
        Document.open(on_disk)
    Document.open(on_disk).close()


def test_a_link_is_locked_with_the_file_it_leads_to(on_disk: Path) -> None:
    link = on_disk.with_name("link.amp")
    link.symlink_to(on_disk)
    with Document.open(on_disk), pytest.raises(InUseError):
        Document.open(link)


def test_giving_up_the_lock_twice_does_not_take_it_from_the_next(on_disk: Path) -> None:
    first = Document.open(on_disk)
    first.close()
    with Document.open(on_disk) as second:
        first.close()
        assert second.is_locked
        with pytest.raises(InUseError):
            Document.open(on_disk)


def test_a_holder_that_left_no_details_still_locks(on_disk: Path) -> None:
    with Document.open(on_disk):
        on_disk.with_name(".bench.amp.holder").unlink()
        with pytest.raises(InUseError, match="it left no details"):
            Document.open(on_disk)


def test_the_file_is_read_again_when_it_changed_before_the_lock_was_given(
    on_disk: Path, mill: ParameterFile, monkeypatch
) -> None:
    take = locking.EditLock.take

    def another_was_faster(self: locking.EditLock) -> None:
        take(self)
        if mill.set(CALIBRATION, Value(6.0, "mm")):
            save_file(mill, on_disk, Document.view(on_disk).digest)

    monkeypatch.setattr(locking.EditLock, "take", another_was_faster)
    with Document.open(on_disk) as document:
        assert Value(6.0, "mm") == document.file.get(CALIBRATION)
        assert digest_of(on_disk) == document.digest
        assert document.is_locked


def test_a_system_that_has_no_name_for_the_user_is_no_reason_to_stop(on_disk: Path, monkeypatch) -> None:
    def no_user() -> str:
        raise KeyError("getpwuid(): uid not found: 4711")

    monkeypatch.setattr(getpass, "getuser", no_user)
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
        document.save()
        assert [entry.who for entry in document.history()] == ["unknown"]


# -- unsaved work


@pytest.fixture
def left(on_disk: Path, other) -> Path:
    """Return the path of a file whose program was killed with three changes unsaved."""
    program = other(WORK, on_disk)
    assert program.says() == "kept"
    program.kill()
    return on_disk


EXPECTED = (
    Change(("axis.type", "2"), Value("linear"), Value("rotary")),
    Change(POSITION, Value(0.0, "mm"), None),
    Change(CALIBRATION, Value(0.0, "mm"), Value(7.5, "mm")),
)


def test_the_work_of_a_killed_program_is_offered_and_can_be_taken(left: Path) -> None:
    with Document.open(left) as document:
        found = document.find_unsaved()
        assert isinstance(found, Unsaved)
        assert set(EXPECTED) == set(found.changes)
        assert (True, getpass.getuser()) == (found.fits, found.who)
        assert re.match(r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d", found.when)
        document.file.set_checked({change.address: change.new for change in found.changes})
        document.save()
        assert document.find_unsaved() is not None, "taken or not, it waits for an answer"
        document.discard_unsaved()
    with Document.open(left) as again:
        assert (Value(7.5, "mm"), None) == (again.file.get(CALIBRATION), again.file.get(POSITION))
        assert again.find_unsaved() is None


def test_work_that_is_not_wanted_is_thrown_away(left: Path) -> None:
    with Document.open(left) as document:
        document.discard_unsaved()
        assert document.find_unsaved() is None
        document.discard_unsaved()
        assert not document.is_dirty
    assert set() == hidden(left.parent)


def test_unsaved_work_without_an_answer_waits_for_the_next_time(left: Path) -> None:
    Document.open(left).close()
    with Document.open(left) as document:
        assert set(EXPECTED) == set(document.find_unsaved().changes)


def test_a_change_from_the_command_line_leaves_the_offer_and_shows_it_may_not_fit(left: Path, capsys) -> None:
    assert cli.run(["set", str(left), "1330=-5"]) == 0
    capsys.readouterr()
    with Document.open(left) as document:
        found = document.find_unsaved()
        assert (set(EXPECTED), False) == (set(found.changes), found.fits)


def test_the_journal_follows_the_work_and_goes_with_the_save(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(1.0, "mm"))
        document.unsaved_writer()()
        assert document.journal_path.exists()
        assert document.find_unsaved() is None, "a program's own work is not offered to itself"
        document.file.set(CALIBRATION, Value(0.0, "mm"))
        document.unsaved_writer()()
        assert not document.journal_path.exists(), "there is nothing left to lose"
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
        document.save()
        assert not document.journal_path.exists()


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"null",
        b"[]",
        b"{}",
        b"\xff",
        b'{"when": 1, "who": 2, "digest": 3}',
        b'{"changes": [[1]]}',
        b'{"changes": 5, "when": "", "who": "", "digest": ""}',
        b'{"changes": [["a", "b", "c"]], "when": "", "who": "", "digest": ""}',
    ],
)
def test_a_journal_that_cannot_be_read_is_no_reason_not_to_open(on_disk: Path, content: bytes) -> None:
    on_disk.with_name(".bench.amp.unsaved").write_bytes(content)
    with Document.open(on_disk) as document:
        assert document.find_unsaved() is None
    assert content == on_disk.with_name(".bench.amp.unsaved").read_bytes()


def test_what_this_schema_cannot_read_of_a_journal_is_left_out(on_disk: Path) -> None:
    changes = [
        ["home.calibration@1", "3 mm"],
        ["home.position@1", "3 kg"],
        ["future.thing@1", "3 mm"],
        ["axis.type@1", "square"],
    ]
    journal = {"when": "2020-01-01T00:00:00+00:00", "who": "me", "digest": "", "changes": changes}
    on_disk.with_name(".bench.amp.unsaved").write_text(json.dumps(journal), encoding="utf-8")
    with Document.open(on_disk) as document:
        found = document.find_unsaved()
        assert ((Change(CALIBRATION, Value(0.0, "mm"), Value(3.0, "mm")),), False) == (
            found.changes,
            found.fits,
        )


def test_a_full_disk_does_not_cost_the_journal_that_was_there(on_disk: Path, disk) -> None:
    with Document.open(on_disk) as document:
        document.file.set(CALIBRATION, Value(1.0, "mm"))
        document.unsaved_writer()()
        kept = document.journal_path.read_bytes()
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        disk.fail(1, for_ever=True)
        with pytest.raises(SaveError):
            document.unsaved_writer()()
        disk.mend()
        assert kept == document.journal_path.read_bytes()
        assert {".bench.amp.lock", ".bench.amp.holder", ".bench.amp.unsaved"} == hidden(on_disk.parent)
