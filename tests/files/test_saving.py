"""Saving: whatever fails, and wherever, the file is the old one or the new one, whole,
and nothing lies about.
"""

import os
import resource
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from amp_studio.files import (
    ChangedOnDiskError,
    Document,
    SaveError,
    atomic,
    backup_path,
    digest_of,
    open_file,
    write_atomic,
)
from amp_studio.files.atomic import digest
from amp_studio.schema import Value

OLD, NEW = b"the old content\n", b"the new content, a little longer\n"
CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def old(tmp_path: Path) -> Path:
    """Return the path of a file that contains the old content."""
    path = tmp_path / "machine.amp"
    path.write_bytes(OLD)
    return path


def names(folder: Path) -> set[str]:
    """Return everything that lies in a folder."""
    return {path.name for path in folder.iterdir()}


# -- the plain way -----------------------------------------------------------------------------------------


def test_the_previous_file_becomes_the_backup(old: Path) -> None:
    assert digest_of(old) != write_atomic(old, NEW, digest_of(old)) == digest_of(old)
    assert (old.read_bytes(), backup_path(old).read_bytes()) == (NEW, OLD)
    write_atomic(old, b"third", digest_of(old))
    assert (old.read_bytes(), backup_path(old).read_bytes()) == (b"third", NEW)
    assert {"machine.amp", "machine.amp.bak"} == names(old.parent)


@pytest.mark.parametrize("older", [b"older", None])
def test_a_save_that_fails_at_the_last_step_leaves_the_older_backup(
    old: Path, monkeypatch: pytest.MonkeyPatch, older: bytes | None
) -> None:
    if older:
        backup_path(old).write_bytes(older)
    replace = os.replace

    def refused(source: Path, target: Path) -> None:  # as in a folder with the sticky bit
        if target == old:
            raise PermissionError(1, "Operation not permitted")
        replace(source, target)

    monkeypatch.setattr(os, "replace", refused)
    before = names(old.parent)
    with pytest.raises(SaveError, match="Operation not permitted"):
        write_atomic(old, NEW)
    assert (old.read_bytes(), names(old.parent)) == (OLD, before)
    assert not older or backup_path(old).read_bytes() == older


def test_a_new_file_has_no_backup(tmp_path: Path) -> None:
    write_atomic(tmp_path / "new.amp", NEW, None)
    assert {"new.amp"} == names(tmp_path)


def test_a_file_that_comes_at_the_last_moment_is_not_replaced_by_a_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, replace = tmp_path / "new.amp", atomic._replace

    def another_first(*arguments: Any, **options: Any) -> None:
        path.write_bytes(OLD)
        replace(*arguments, **options)

    monkeypatch.setattr(atomic, "_replace", another_first)
    with pytest.raises(ChangedOnDiskError, match=r"new\.amp exists already"):
        write_atomic(path, NEW, None)
    assert (path.read_bytes(), names(tmp_path)) == (OLD, {"new.amp"})


def test_where_a_file_has_one_name_only_a_new_one_is_renamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", refused)
    write_atomic(tmp_path / "new.amp", NEW, None)
    assert ((tmp_path / "new.amp").read_bytes(), names(tmp_path)) == (NEW, {"new.amp"})


def test_without_a_backup_none_is_made(old: Path) -> None:
    write_atomic(old, NEW, keep_backup=False)
    assert {"machine.amp"} == names(old.parent)


def test_the_mode_of_a_file_is_kept_and_a_new_one_has_that_of_any_new_file(old: Path) -> None:
    old.chmod(0o640)
    write_atomic(old, NEW)
    assert 0o640 == stat.S_IMODE(old.stat().st_mode) == stat.S_IMODE(backup_path(old).stat().st_mode)
    plain, new = old.with_name("plain"), old.with_name("new.amp")
    plain.write_bytes(b"")
    write_atomic(new, NEW, None)
    assert stat.S_IMODE(plain.stat().st_mode) == stat.S_IMODE(new.stat().st_mode)


def test_a_link_stays_a_link_to_the_file_that_is_saved(old: Path) -> None:
    link = old.with_name("link.amp")
    link.symlink_to(old)
    write_atomic(link, NEW, digest_of(link))
    assert (link.is_symlink(), old.read_bytes(), backup_path(old).read_bytes()) == (True, NEW, OLD)


def test_who_is_reading_the_old_file_reads_it_to_its_end(old: Path) -> None:
    """The new file takes the name of the old one; not a byte of the old one is written over."""
    with old.open("rb") as reader:
        write_atomic(old, NEW, digest_of(old))
        assert (reader.read(), old.read_bytes()) == (OLD, NEW)


def test_the_content_is_on_the_disk_before_the_name_is_and_the_name_at_the_end(tmp_path: Path, disk) -> None:
    disk.fail(999, for_ever=False)
    write_atomic(tmp_path / "new.amp", NEW, None)
    steps = [name for name in disk.made if name in ("fsync", "link", "replace")]
    assert steps == ["fsync", "link", "fsync"]


# -- somebody else's changes ---------------------------------------------------------------------------------


def test_what_another_program_saved_is_not_overwritten(old: Path) -> None:
    opened = digest_of(old)
    old.write_bytes(b"theirs")
    with pytest.raises(ChangedOnDiskError, match=r"machine\.amp has been changed by another program"):
        write_atomic(old, NEW, opened)
    assert (b"theirs", {"machine.amp"}) == (old.read_bytes(), names(old.parent))


def test_a_file_that_is_gone_or_has_come_counts_as_changed(old: Path) -> None:
    opened = digest_of(old)
    old.unlink()
    with pytest.raises(ChangedOnDiskError):
        write_atomic(old, NEW, opened)
    assert set() == names(old.parent)
    old.write_bytes(b"theirs")
    with pytest.raises(ChangedOnDiskError):
        write_atomic(old, NEW, None)
    assert old.read_bytes() == b"theirs"


def test_a_change_while_the_file_is_being_saved_is_seen(old: Path, monkeypatch) -> None:
    opened, sync = digest_of(old), os.fsync

    def another_saves(handle: int) -> None:
        sync(handle)
        old.write_bytes(b"theirs")

    monkeypatch.setattr(os, "fsync", another_saves)
    with pytest.raises(ChangedOnDiskError, match="while it was saved"):
        write_atomic(old, NEW, opened)
    assert (b"theirs", {"machine.amp"}) == (old.read_bytes(), names(old.parent))


# -- a disk that fails


def failures(disk, act: Callable[[], object], for_ever: bool) -> list[Exception | None]:
    """Fail at call 1, 2, 3, … of an act until it passes untouched; return how each try ended,
    the last one untouched.
    """
    ends: list[Exception | None] = []
    for at in range(1, 200):
        disk.fail(at, for_ever)
        try:
            act()
            ends.append(None)
        except OSError as error:
            ends.append(error)
        finally:
            disk.mend()
        if not disk.failed:
            return ends
    raise AssertionError("it never passed")


@pytest.mark.parametrize("for_ever", [False, True])
def test_a_save_that_fails_at_any_call_leaves_the_old_file_and_one_that_passes_the_new(
    old: Path, disk, for_ever: bool
) -> None:
    seen = []

    def save() -> None:
        old.write_bytes(OLD)
        try:
            write_atomic(old, NEW, digest(OLD))
        except SaveError as fault:
            seen.append(str(fault))
            assert old.read_bytes() == OLD
            raise
        assert old.read_bytes() == NEW

    ends = failures(disk, save, for_ever)
    assert None is ends[-1]
    assert 5 < sum(isinstance(end, SaveError) for end in ends) == len(seen)
    assert all(isinstance(end, SaveError | None) for end in ends), ends
    assert {f"{old} cannot be written: No space left on device"} == set(seen)
    assert names(old.parent) <= {"machine.amp", "machine.amp.bak"}, "no temporary file is left"
    assert backup_path(old).read_bytes() == OLD


@pytest.mark.parametrize("for_ever", [False, True])
def test_a_first_save_that_fails_leaves_no_file_at_all(tmp_path: Path, disk, for_ever: bool) -> None:
    path = tmp_path / "new.amp"

    def save() -> None:
        path.unlink(missing_ok=True)
        try:
            write_atomic(path, NEW, None)
        except SaveError:
            assert set() == names(tmp_path)
            raise
        assert (NEW, {"new.amp"}) == (path.read_bytes(), names(tmp_path))

    ends = failures(disk, save, for_ever)
    assert sum(isinstance(end, SaveError) for end in ends) > 3
    assert None is ends[-1]


def test_a_save_that_only_fails_to_sync_the_folder_has_been_made(old: Path, monkeypatch) -> None:
    """The rename has happened: to report that the file is still the old one would be wrong."""
    sync = os.fsync

    def folders_fail(handle: int) -> None:
        if stat.S_ISDIR(os.fstat(handle).st_mode):
            raise OSError(22, "Invalid argument")
        sync(handle)

    monkeypatch.setattr(os, "fsync", folders_fail)
    assert write_atomic(old, NEW, digest_of(old)) == digest_of(old)
    assert (old.read_bytes(), backup_path(old).read_bytes()) == (NEW, OLD)


def test_a_file_that_grows_too_large_for_the_disk_is_not_saved(old: Path) -> None:
    """A real write that fails half way, as on a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))
    try:
        with pytest.raises(SaveError, match="File too large"):
            write_atomic(old, b"x" * 10_000, digest_of(old))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert (OLD, {"machine.amp"}) == (old.read_bytes(), names(old.parent))


@pytest.mark.parametrize("place", ["no/such/folder/machine.amp", "machine.amp/below"])
def test_a_place_that_does_not_exist_is_reported_in_one_line(old: Path, place: str) -> None:
    with pytest.raises(SaveError) as fault:
        write_atomic(old.parent / place, NEW, None)
    assert f"{old.parent / place} cannot be written: " in str(fault.value)
    assert {"machine.amp"} == names(old.parent)


def test_a_folder_is_not_replaced_by_a_file(tmp_path: Path) -> None:
    (tmp_path / "machine.amp").mkdir()
    with pytest.raises(SaveError, match="Is a directory"):
        write_atomic(tmp_path / "machine.amp", NEW, None)
    assert ({"machine.amp"}, set()) == (names(tmp_path), names(tmp_path / "machine.amp"))


def test_a_folder_in_the_place_of_the_backup_is_named(old: Path) -> None:
    backup_path(old).mkdir()
    with pytest.raises(
        SaveError, match=r"machine\.amp cannot be written \(machine\.amp\.bak\): Is a directory"
    ):
        write_atomic(old, NEW)
    assert old.read_bytes() == OLD


@pytest.mark.parametrize("for_ever", [False, True])
def test_a_document_whose_save_fails_is_still_open_with_its_changes(
    on_disk: Path, disk, for_ever: bool
) -> None:
    before = open_file(on_disk).file.values
    with Document.open(on_disk) as document:
        number = 0.0

        def save() -> None:
            nonlocal number, before
            number += 1.0
            document.file.set(CALIBRATION, Value(number, "mm"))
            try:
                document.save()
            except OSError:
                assert document.is_dirty
                assert Value(number, "mm") == document.file.get(CALIBRATION)
                raise
            assert not document.is_dirty
            before = dict(document.file.values)

        for end in failures(disk, save, for_ever):
            assert isinstance(end, SaveError | None), end
        disk.mend()
        assert before == open_file(on_disk).file.values
        document.file.set(CALIBRATION, Value(-1.0, "mm"))
        document.save()
        assert digest_of(on_disk) == document.digest
    assert Value(-1.0, "mm") == open_file(on_disk).file.get(CALIBRATION)
    assert names(on_disk.parent) == {"bench.amp", "bench.amp.bak", "bench.amp.history"}


# -- a program that is killed

KILLED = """
    import os, signal, sys
    from pathlib import Path
    from amp_studio.files import open_file
    from amp_studio.files.storage import save_file
    from amp_studio.schema import Value

    original = Path(sys.argv[1])

    def save_and_die(path, at):
        made = 0
        def dying(call):
            def dies(*args, **options):
                nonlocal made
                made += 1
                if made == at:
                    os.kill(os.getpid(), signal.SIGKILL)
                return call(*args, **options)
            return dies
        for name in ("open", "fsync", "replace", "chmod", "unlink"):
            setattr(os, name, dying(getattr(os, name)))
        save_file(opened.file, path, opened.digest)

    opened = open_file(original)
    opened.file.set(("home.calibration", "1"), Value(7.0, "mm"))
    for at in range(1, 100):
        path = original.with_name(f"run{at}.amp")
        path.write_bytes(original.read_bytes())
        child = os.fork()
        if child == 0:
            save_and_die(path, at)
            os._exit(0)
        status = os.waitpid(child, 0)[1]
        print(at, "killed" if os.WIFSIGNALED(status) else "saved", flush=True)
        if not os.WIFSIGNALED(status):
            break
"""


def test_a_program_killed_at_any_call_of_a_save_leaves_a_whole_file(on_disk: Path, other) -> None:
    before = open_file(on_disk).file.values
    after = before | {CALIBRATION: Value(7.0, "mm")}
    program, runs = other(KILLED, on_disk), []
    while not runs or runs[-1][1] == "killed":
        runs.append(program.says().split())
    assert len(runs) > 8
    assert [str(n) for n in range(1, len(runs) + 1)] == [at for at, _ in runs]
    found = [open_file(on_disk.with_name(f"run{at}.amp")).file.values for at, _ in runs]
    assert all(values in (before, after) for values in found)
    assert (before, after) == (found[0], found[-1])
    backups = [path for at, _ in runs if (path := on_disk.with_name(f"run{at}.amp.bak")).exists()]
    assert {on_disk.read_bytes()} == {path.read_bytes() for path in backups}
