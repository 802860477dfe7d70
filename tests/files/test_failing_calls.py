"""Whatever call of the system fails, once or for ever, and at whichever of them Ctrl-C comes: a file is the
old one or the new one, whole, and nothing lies about.
"""

from collections import Counter
from pathlib import Path

import pytest
from failing_calls import Ended, each_failure

from amp_studio.files import (
    Document,
    Project,
    ProjectInfo,
    SaveError,
    open_file,
    recover_backup,
    write_atomic,
)
from amp_studio.files.atomic import digest
from amp_studio.schema import Value

OLD, NEW = b"the old content\n", b"the new content, a little longer\n"
CALIBRATION = ("home.calibration", "1")
CAN_STAY = ("unlink",)
"""Where a temporary file cannot be removed it stays."""


def names(folder: Path) -> set[str]:
    """Return everything that lies in a folder."""
    return {path.name for path in folder.iterdir()}


def empty(folder: Path) -> None:
    """Remove all files of a folder."""
    for path in folder.iterdir():
        path.unlink()


def temporaries_left(ended: Ended, folder: Path) -> set[str]:
    """Return the temporary files that have no excuse for being there."""
    excused = ended.for_ever or ended.call in CAN_STAY
    return set() if excused else {name for name in names(folder) if name.endswith(".tmp")}


def test_a_save_leaves_the_old_file_or_the_new_one(tmp_path: Path) -> None:
    path, ends = tmp_path / "machine.amp", Counter[str]()

    def prepare() -> None:
        empty(tmp_path)
        path.write_bytes(OLD)
        (tmp_path / "machine.amp.bak").write_bytes(b"older")

    for ended in each_failure(prepare, lambda: write_atomic(path, NEW, digest(OLD))):
        content, backup = path.read_bytes(), (tmp_path / "machine.amp.bak").read_bytes()
        if isinstance(ended.error, KeyboardInterrupt):
            assert (content, backup) in ((OLD, b"older"), (OLD, OLD), (NEW, OLD)), ended
        elif ended.error is None:
            assert (content, backup) == (NEW, OLD), ended
        else:
            assert isinstance(ended.error, SaveError), ended
            assert (content, backup) in ((OLD, b"older"), (OLD, OLD)), ended
            assert str(ended.error).startswith(f"{path} cannot be written: "), ended
        assert not temporaries_left(ended, tmp_path), ended
        ends[type(ended.error).__name__] += 1
    assert ends["SaveError"] > 100
    assert ends["KeyboardInterrupt"] > 30
    assert ends["NoneType"] > 7


def test_a_first_save_leaves_no_file_or_the_whole_of_it(tmp_path: Path) -> None:
    path = tmp_path / "machine.amp"
    for ended in each_failure(
        lambda: empty(tmp_path),
        lambda: write_atomic(path, lambda _: NEW, None),
        failures=("EIO", "interrupt"),
    ):
        if ended.error is None:
            assert path.read_bytes() == NEW, ended
        elif isinstance(ended.error, SaveError):
            assert not path.exists(), ended
        else:
            assert not path.exists() or path.read_bytes() == NEW, ended
        assert not temporaries_left(ended, tmp_path), ended


def test_a_new_document_that_fails_leaves_nothing_and_one_that_does_not_is_whole(
    tmp_path: Path, small: Path
) -> None:
    mill, path = open_file(small).file, tmp_path / "machine.amp"
    for ended in each_failure(
        lambda: empty(tmp_path), lambda: Document.create(mill, path).close(), failures=("EACCES", "interrupt")
    ):
        if ended.error is None:
            assert open_file(path).file.values == mill.values, ended
        elif isinstance(ended.error, OSError):
            assert not path.exists(), f"a failure after the fact: {ended}"
        assert not temporaries_left(ended, tmp_path), ended


@pytest.mark.parametrize("failure", ["ENOSPC", "EACCES", "interrupt"])
def test_a_document_whose_save_fails_can_be_saved_again(tmp_path: Path, small: Path, failure: str) -> None:
    """It knows what is on disk and keeps what is not."""
    content, folder = small.read_bytes(), small.parent
    documents: list[Document] = []

    def prepare() -> None:
        for document in documents:
            document.close()
        documents.clear()
        empty(folder)
        small.write_bytes(content)
        documents.append(Document.open(small))
        documents[0].file.set(CALIBRATION, Value(7.0, "mm"))
        documents[0].unsaved_writer()()

    def act() -> None:
        documents[0].save()

    for ended in each_failure(prepare, act, failures=(failure,), lasting=(False,)):
        on_disk = open_file(small).file.get(CALIBRATION)
        if ended.error is None:
            assert (on_disk, documents[0].is_dirty) == (Value(7.0, "mm"), False), ended
        elif isinstance(ended.error, OSError):
            assert isinstance(ended.error, SaveError), ended
            assert (on_disk, documents[0].is_dirty) == (Value(1.5, "mm"), True), ended
            documents[0].save()
        assert not temporaries_left(ended, folder), ended
        assert folder == tmp_path


def test_a_backup_put_back_leaves_one_of_the_two_files_in_each_place(small: Path) -> None:
    content, folder = small.read_bytes(), small.parent
    other = content.replace(b"1.5 mm", b"2.5 mm")

    def prepare() -> None:
        empty(folder)
        small.write_bytes(content)
        (folder / "small.amp.bak").write_bytes(other)

    for ended in each_failure(prepare, lambda: recover_backup(small), failures=("EIO", "interrupt")):
        found = (small.read_bytes(), (folder / "small.amp.bak").read_bytes())
        if ended.error is None:
            assert found == (other, content), ended
        else:
            assert found[0] in (content, other), ended
            assert set(found) <= {content, other}, ended
        assert not temporaries_left(ended, folder), ended


def test_a_file_that_is_renamed_has_its_old_name_or_its_new_one(small: Path) -> None:
    content, folder = small.read_bytes(), small.parent / "project"
    project = Project.create(folder, ProjectInfo("bench", "9pc"))
    kept = (folder / "project.yaml").read_bytes()
    path = folder / "machine.amp"

    def prepare() -> None:
        empty(folder)
        (folder / "project.yaml").write_bytes(kept)
        path.write_bytes(content)
        path.with_name("machine.amp.bak").write_bytes(b"backup")
        path.with_name("machine.amp.history").write_bytes(b"history")

    for ended in each_failure(
        prepare, lambda: project.rename(path, "other"), failures=("ENOSPC", "interrupt")
    ):
        there = [name for name in ("machine", "other") if (folder / f"{name}.amp").exists()]
        assert len(there) == 1, ended
        assert (folder / f"{there[0]}.amp").read_bytes() == content, ended
        assert (folder / f"{there[0]}.amp.bak").read_bytes() == b"backup", ended
        assert (folder / f"{there[0]}.amp.history").read_bytes() == b"history", ended
        if ended.error is None:
            assert there == ["other"], ended
        elif isinstance(ended.error, OSError):
            assert there == ["machine"], f"a failure after the fact: {ended}"
