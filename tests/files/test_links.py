"""Links: a save through one writes the file it leads to, which has one lock, one backup, one history,
one journal.
"""

import os
from pathlib import Path

import pytest

from amp_studio.files import (
    Document,
    InUseError,
    Project,
    ProjectInfo,
    SaveError,
    backup_path,
    recover_backup,
    write_atomic,
)
from amp_studio.files.lock import EditLock
from amp_studio.schema import Value

CALIBRATION = ("home.calibration", "1")


def names(folder: Path) -> set[str]:
    """Return everything that lies in a folder."""
    return {path.name for path in folder.iterdir()}


@pytest.fixture
def link(on_disk: Path) -> Path:
    """Return a link in another folder, with another name, to a link to the file."""
    (on_disk.parent / "elsewhere").mkdir()
    (on_disk.parent / "between").symlink_to("bench.amp")
    path = on_disk.parent / "elsewhere" / "other.amp"
    path.symlink_to("../between")
    return path


def test_everything_that_belongs_to_a_file_lies_beside_it_not_beside_its_link(
    on_disk: Path, link: Path
) -> None:
    first = on_disk.read_bytes()
    with Document.open(link) as document:
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
        assert {".bench.amp.lock", ".bench.amp.holder", ".bench.amp.unsaved"} < names(on_disk.parent)
        document.save()
    assert names(link.parent) == {"other.amp"}
    assert (link.is_symlink(), backup_path(link)) == (True, on_disk.with_name("bench.amp.bak"))
    assert names(on_disk.parent) == {
        "bench.amp",
        "bench.amp.bak",
        "bench.amp.history",
        "between",
        "elsewhere",
    }
    with Document.open(on_disk) as document:
        assert [entry.new for entry in document.history()] == ["2 mm"]
    recover_backup(link)
    assert (on_disk.read_bytes(), link.is_symlink()) == (first, True)


def test_work_left_through_a_link_is_offered_to_who_opens_the_file(on_disk: Path, link: Path) -> None:
    document = Document.open(link)
    document.file.set(CALIBRATION, Value(2.0, "mm"))
    document.unsaved_writer()()
    os.close(document._lock._handle or -1)  # it ends as a killed program does
    with Document.open(on_disk) as again:
        left = again.find_unsaved()
        assert left is not None
        assert [change.new for change in left.changes] == [Value(2.0, "mm")]


def test_a_link_that_leads_to_nothing_is_not_written_through(tmp_path: Path, mill) -> None:
    link = tmp_path / "link.amp"
    link.symlink_to("nowhere.amp")
    with pytest.raises(
        SaveError, match=r"link\.amp cannot be written: Is a link to a file that does not exist"
    ):
        write_atomic(link, b"new")
    with pytest.raises(FileExistsError, match=r"link\.amp is a link to a file that does not exist"):
        Document.create(mill, link)
    assert names(tmp_path) == {"link.amp"}


@pytest.mark.parametrize("leads_to", ["loop.amp", "no-folder/x.amp", "file/x.amp", "x" * 300])
def test_a_link_that_cannot_be_followed_stays_a_link(tmp_path: Path, leads_to: str) -> None:
    """``Path.resolve`` would return the link itself, and the save would put a file in its place."""
    link = tmp_path / "loop.amp"
    link.symlink_to(leads_to)
    (tmp_path / "file").write_bytes(b"")
    for write in (lambda: write_atomic(link, b"new"), lambda: write_atomic(link, b"new", None)):
        with pytest.raises(SaveError, match=r"loop\.amp cannot be written: "):
            write()
    with pytest.raises(InUseError, match=r"loop\.amp cannot be locked"):
        EditLock(link).take()
    assert (names(tmp_path), link.is_symlink()) == ({"loop.amp", "file"}, True)


def test_a_file_deleted_behind_its_link_is_recovered_where_it_was(on_disk: Path, link: Path) -> None:
    good = on_disk.read_bytes()
    on_disk.rename(on_disk.with_name("bench.amp.bak"))
    recover_backup(link)
    assert (on_disk.read_bytes(), link.is_symlink()) == (good, True)


def test_planted_links_in_the_place_of_companions_are_not_followed(on_disk: Path) -> None:
    """Anybody who may write to the folder must not reach files elsewhere through the program of another
    user.
    """
    victim = on_disk.with_name("victim")
    victim.write_bytes(b"precious")
    for name in (".bench.amp.holder", ".bench.amp.unsaved", "bench.amp.history", "bench.amp.bak"):
        on_disk.with_name(name).symlink_to(victim)
    with Document.open(on_disk) as document:
        assert (document.find_unsaved(), document.history()) == (None, [])
        document.file.set(CALIBRATION, Value(2.0, "mm"))
        document.unsaved_writer()()
        document.save()
        assert document.notes == [
            "bench.amp: its history could not be written: Too many levels of symbolic links"
        ]
    assert victim.read_bytes() == b"precious"
    lock = on_disk.with_name(".bench.amp.lock")
    lock.symlink_to(victim)
    with pytest.raises(InUseError, match=r"bench\.amp cannot be locked \(\.bench\.amp\.lock\)"):
        Document.open(on_disk)
    assert victim.read_bytes() == b"precious"


# -- projects ------------------------------------------------------------------------------------------------


@pytest.fixture
def project(on_disk: Path, link: Path) -> Project:
    """Return a project whose only file is the link."""
    return Project.create(link.parent, ProjectInfo("bench", "9pc"))


def test_the_backup_of_a_linked_file_is_listed_and_recovered(
    project: Project, on_disk: Path, link: Path
) -> None:
    assert project.backups() == []
    first = on_disk.read_bytes()
    write_atomic(link, b"second")
    link.with_name("other.amp.bak").write_bytes(b"left by an older program beside the link")
    assert project.backups() == [link]
    project.recover(link)
    assert (on_disk.read_bytes(), link.is_symlink()) == (first, True)


def test_deleting_a_link_leaves_the_file_it_leads_to(project: Project, on_disk: Path, link: Path) -> None:
    first = on_disk.read_bytes()
    project.delete(link)
    assert (names(link.parent), on_disk.read_bytes()) == ({"project.yaml"}, first)


def test_renaming_a_link_moves_nothing_of_the_file(project: Project, on_disk: Path, link: Path) -> None:
    write_atomic(link, b"second")
    renamed = project.rename(link, "third")
    assert names(link.parent) == {"project.yaml", "third.amp"}
    assert (renamed.is_symlink(), backup_path(renamed).exists()) == (True, True)


def test_a_link_that_leads_nowhere_keeps_its_name_in_a_project(project: Project, on_disk: Path) -> None:
    from amp_studio.files.project import InvalidNameError

    (project.folder / "taken.amp").symlink_to("nowhere")
    with pytest.raises(InvalidNameError, match="there is a file 'taken' already"):
        project.copy(on_disk, "taken")
