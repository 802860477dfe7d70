"""The lock where a file system has none, where another user has it, and where something else has its name."""

import errno
import fcntl
import os
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import Document, InUseError, new_file
from amp_studio.schema import Value

CALIBRATION = ("home.calibration", "1")
UNSUPPORTED = [errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL, errno.EIO]


@pytest.fixture(params=UNSUPPORTED, ids=lambda number: errno.errorcode[number])
def no_locks(request: pytest.FixtureRequest, monkeypatch) -> int:
    """Let the file system have no locks; return its error."""

    def refused(_handle: int, _operation: int) -> None:
        raise OSError(request.param, os.strerror(request.param))

    monkeypatch.setattr(fcntl, "flock", refused)
    return int(request.param)


def test_a_file_system_without_locks_is_noted_and_the_file_saved(on_disk: Path, no_locks: int) -> None:
    with Document.open(on_disk) as document:
        assert document.is_locked
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.save()
        assert document.notes == [
            f"bench.amp could not be locked ({os.strerror(no_locks)}): see that no other program changes it"
        ]
    left = {path.name for path in on_disk.parent.iterdir() if path.name.startswith(".")}
    assert left == set()


@pytest.mark.usefixtures("no_locks")
def test_a_verb_on_a_file_system_without_locks_does_its_work_and_shows_it(tmp_path: Path, capsys) -> None:
    path = tmp_path / "new.amp"
    assert cli.run(["new", "9pc", str(path)]) == 0
    assert "new.amp could not be locked" in capsys.readouterr().err
    assert cli.run(["set", str(path), "1300=2 mm"]) == 0
    assert "new.amp could not be locked" in capsys.readouterr().err


def test_a_lock_that_cannot_be_given_back_is_no_failure_of_what_was_done(on_disk: Path, monkeypatch) -> None:
    close, unlink = os.close, os.unlink
    document = Document.open(on_disk)
    document.file.set(CALIBRATION, Value(2.0, "mm"))
    document.save()

    def close_fails(handle: int) -> None:
        close(handle)
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    def unlink_fails(*_: object) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(os, "close", close_fails)
    monkeypatch.setattr(os, "unlink", unlink_fails)
    document.close()
    monkeypatch.setattr(os, "close", close)
    monkeypatch.setattr(os, "unlink", unlink)
    assert not document.is_locked
    Document.open(on_disk).close()


@pytest.mark.parametrize("kind", ["directory", "pipe"])
def test_what_is_no_lock_file_is_named(on_disk: Path, kind: str) -> None:
    place = on_disk.with_name(".bench.amp.lock")
    if kind == "directory":
        place.mkdir()
    else:
        os.mkfifo(place)
    with pytest.raises(InUseError, match=r"bench\.amp cannot be locked \(\.bench\.amp\.lock\): Is a "):
        Document.open(on_disk)


def test_a_folder_that_cannot_be_written_to_is_named(on_disk: Path, monkeypatch) -> None:
    def denied(*_: object) -> int:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    monkeypatch.setattr(os, "access", lambda *_, **__: False)
    monkeypatch.setattr("amp_studio.files.lock._opened", denied)
    with pytest.raises(InUseError, match=r"bench\.amp cannot be changed: its folder cannot be written to"):
        Document.open(on_disk)


def test_the_lock_file_of_another_user_is_locked_though_it_cannot_be_written(
    on_disk: Path, monkeypatch
) -> None:
    opened = os.open

    def read_only(path: Path, flags: int, *mode: int) -> int:
        if str(path).endswith(".lock") and flags & os.O_RDWR:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return opened(path, flags, *mode)

    on_disk.with_name(".bench.amp.lock").touch()
    monkeypatch.setattr(os, "open", read_only)
    with Document.open(on_disk) as document:
        assert document.is_locked
        with pytest.raises(InUseError, match="is open in another program"):
            Document.open(on_disk)
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.save()
        assert document.notes == []


def test_the_lock_of_another_file_of_that_name_is_not_taken_for_ours(on_disk: Path, monkeypatch) -> None:
    """A program that waits may lock what its holder has just removed: then it locks the new one."""
    flock, calls = fcntl.flock, []
    place = on_disk.with_name(".bench.amp.lock")

    def removed(handle: int, operation: int) -> None:
        flock(handle, operation)
        calls.append(handle)
        if len(calls) == 1:
            place.unlink()

    monkeypatch.setattr(fcntl, "flock", removed)
    with Document.open(on_disk):
        assert len(calls) == 2
        monkeypatch.setattr(fcntl, "flock", flock)
        with pytest.raises(InUseError):
            Document.open(on_disk)


def test_a_holder_who_writes_anything_is_shown_in_bounds(on_disk: Path) -> None:
    with Document.open(on_disk):
        on_disk.with_name(".bench.amp.holder").write_bytes(b"\xff" * 100_000)
        with pytest.raises(InUseError, match="it left no details"):
            Document.open(on_disk)
        on_disk.with_name(".bench.amp.holder").write_bytes(b"me\n\x1b[2J" + b"x" * 4000)
        with pytest.raises(InUseError, match=r"\(me\\n\\u001b\[2Jx{293}\)"):
            Document.open(on_disk)


def test_a_name_too_long_for_its_companions_is_reported(tmp_path: Path) -> None:
    """Names have 255 bytes; a backup and a lock have longer ones."""
    short, long = tmp_path / f"{'x' * 240}.amp", tmp_path / f"{'x' * 248}.amp"
    mill = new_file("9pc", "mill", ["X"])
    Document.create(mill, short).close()
    with Document.open(short) as document:
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
        document.save()
        assert document.notes == []
    short.rename(long)
    with Document.view(long) as looking:
        assert looking.file.get(CALIBRATION) == Value(2.0, "mm")
    for act in (lambda: Document.open(long), lambda: Document.create(mill, tmp_path / f"{'y' * 250}.amp")):
        with pytest.raises(InUseError, match="The name is too long for the files kept beside it"):
            act()
