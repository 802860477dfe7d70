"""What else a file has than its content survives a save, or the save reports what does not."""

import errno
import grp
import os
import stat
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import Document, SaveError, backup_path, open_file, write_atomic
from amp_studio.files.paths import history_path
from amp_studio.schema import Value

CALIBRATION = ("home.calibration", "1")
as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root may give files away")


def saved(path: Path) -> list[str]:
    """Change a value, save, and return the notes."""
    with Document.open(path) as document:
        document.file.set(CALIBRATION, Value(7.0, "mm"))
        document.unsaved_writer()()
        document.save()
        return document.notes


@as_root
def test_the_owner_of_a_file_keeps_it_when_a_user_else_saves(small: Path) -> None:
    os.chown(small, 12_345, 23_456)
    small.chmod(0o2640)
    assert saved(small) == []
    for path in (small, backup_path(small)):
        found = path.stat()
        assert (found.st_uid, found.st_gid, stat.S_IMODE(found.st_mode)) == (12_345, 23_456, 0o2640)


def test_an_owner_that_cannot_be_kept_is_reported_and_his_group_gets_only_what_others_get(
    small: Path, monkeypatch
) -> None:
    def not_permitted(*_: object) -> None:
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

    fstat, other = os.fstat, grp.getgrall()[-1].gr_name

    def of_another(handle: int) -> os.stat_result:
        found = list(fstat(handle))
        found[5] = grp.getgrall()[-1].gr_gid  # the group that the new file has
        return os.stat_result(found)

    small.chmod(0o664)
    owner, group = small.owner(), small.group()
    monkeypatch.setattr(os, "fchown", not_permitted)
    monkeypatch.setattr(os, "fstat", of_another)
    notes: list[str] = []
    write_atomic(small, b"new", notify=notes.append)
    assert notes == [f"small.amp: owner and group are now {owner}:{other}; {owner}:{group} could not be kept"]
    assert stat.S_IMODE(small.stat().st_mode) == 0o644


def test_that_other_names_of_a_file_keep_the_old_content_is_reported(small: Path, capsys) -> None:
    old, other = small.read_bytes(), small.with_name("other")
    other.hardlink_to(small)
    assert cli.run(["set", str(small), "1300=7 mm"]) == 0
    message = "small.amp: 1 other name of this file (a hard link) still has the old content"
    assert message in capsys.readouterr().err
    assert other.read_bytes() == old != small.read_bytes()
    third = small.with_name("third")
    third.hardlink_to(small)
    small.with_name("fourth").hardlink_to(small)
    assert saved(small) == ["small.amp: 2 other names of this file (hard links) still have the old content"]


def test_attributes_that_a_user_gave_a_file_are_kept(small: Path, monkeypatch) -> None:
    try:
        os.setxattr(small, "user.approved", b"by Ann")
    except OSError:
        pytest.skip("the file system of the tests has no attributes")
    assert saved(small) == []
    assert os.getxattr(small, "user.approved") == b"by Ann"

    def refused(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "setxattr", refused)
    notes: list[str] = []
    write_atomic(small, b"new", notify=notes.append)
    assert notes == ["small.amp: user.approved could not be kept"]


def test_permissions_that_a_file_system_does_not_have_are_reported(small: Path, monkeypatch) -> None:
    def refused(*_: object) -> None:
        raise OSError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "fchmod", refused)
    assert saved(small) == ["small.amp: its permissions could not be kept: Operation not permitted"]


def test_what_is_kept_beside_a_private_file_is_private(small: Path) -> None:
    small.chmod(0o600)
    with Document.open(small) as document:
        document.file.set(CALIBRATION, Value(7.0, "mm"))
        document.unsaved_writer()()
        assert stat.S_IMODE(document.journal_path.stat().st_mode) == 0o600
        document.save()
    for path in (small, backup_path(small), history_path(small)):
        assert stat.S_IMODE(path.stat().st_mode) == 0o600


def test_the_mask_of_the_user_is_not_read(tmp_path: Path, monkeypatch) -> None:
    """To ask for it is to set it, for all threads of the program."""
    before = os.umask(0o027)
    try:
        monkeypatch.delattr(os, "umask")
        write_atomic(tmp_path / "new.amp", b"new", None)
    finally:
        monkeypatch.undo()
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "new.amp").stat().st_mode) == 0o640


def test_a_write_protected_file_is_not_replaced(small: Path, monkeypatch) -> None:
    old = small.read_bytes()
    monkeypatch.setattr(os, "access", lambda *_, **__: False)
    with pytest.raises(SaveError, match=r"small\.amp cannot be written: Is write-protected"):
        write_atomic(small, b"new")
    assert small.read_bytes() == old


# -- line ends


@pytest.mark.parametrize("comment", ["", "# by hand\n"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_a_file_of_windows_stays_one(small: Path, mark: bytes, comment: str) -> None:
    text = comment + small.read_text(encoding="utf-8")
    small.write_bytes(mark + text.replace("\n", "\r\n").encode())
    assert saved(small) == []
    content = small.read_bytes()
    assert content.startswith(mark + b"# by hand\r\n" if comment else mark + b"amp_studio: 1\r\n")
    assert content.count(b"\r\n") == content.count(b"\n") == content.count(b"\r")
    assert content.count(b"\xef\xbb\xbf") == bool(mark)
    assert open_file(small).file.get(CALIBRATION) == Value(7.0, "mm")


def test_mixed_line_ends_stay_as_they_are(small: Path) -> None:
    lines = small.read_bytes().split(b"\n")
    mixed = b"\r\n".join(lines[:5]) + b"\n" + b"\n".join(lines[5:])
    small.write_bytes(mixed)
    assert saved(small) == []
    added = small.read_bytes().split(b"signature: ")[1].split(b"\r\n")[0]
    assert small.read_bytes().replace(b"signature: " + added + b"\r\n", b"") == mixed.replace(
        b"1.5 mm", b"7 mm"
    )


def test_a_text_of_several_lines_keeps_its_own_line_ends_in_a_file_of_windows(on_disk: Path) -> None:
    with Document.open(on_disk) as document:
        document.file.header.notes = "one\ntwo\r\nthree\n\nfour\n"
        document.save()
    on_disk.write_bytes(on_disk.read_bytes().replace(b"\n", b"\r\n"))
    assert saved(on_disk) == []
    assert open_file(on_disk).file.header.notes == "one\ntwo\r\nthree\n\nfour\n"
