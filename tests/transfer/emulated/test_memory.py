"""What an emulated control has renamed is on the disk, whole:
no power failure finds a name without its bytes.
"""

import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.emulated.memory import Memory
from tests.transfer.images import NEW, OLD, send


class Disk:
    """Knows what has reached the disk: the bytes of a file and the names of a folder when each was synced."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder = folder
        self.renamed: list[tuple[str, str]] = []
        self.faults: list[str] = []
        self._safe: dict[int, bytes] = {}
        self._unsynced_names: list[str] = []
        replace = os.replace

        def synced(handle: int) -> None:
            found = os.fstat(handle)
            if stat.S_ISDIR(found.st_mode):
                self._unsynced_names.clear()
                return
            (path,) = [p for p in folder.iterdir() if p.stat().st_ino == found.st_ino]
            self._safe[found.st_ino] = path.read_bytes()

        def replaced(source: Path, target: Path) -> None:
            if self._safe.get(source.stat().st_ino) != source.read_bytes():
                self.faults.append(f"{source.name} became {target.name} before its bytes were on the disk")
            if self._unsynced_names:
                self.faults.append(f"{self._unsynced_names} may still have the old name")
            replace(source, target)
            self.renamed.append((source.name, target.name))
            self._unsynced_names.append(target.name)

        monkeypatch.setattr("amp_studio.transfer.emulated.memory.os.fsync", synced)
        monkeypatch.setattr("amp_studio.transfer.emulated.memory.os.replace", replaced)

    def check(self) -> None:
        assert self.faults == []
        assert self._unsynced_names == []


def test_a_file_is_on_the_disk_before_it_gets_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = Disk(tmp_path, monkeypatch)
    Memory(tmp_path).replace("active.img", NEW)
    assert disk.renamed == [("active.img.tmp", "active.img")]
    disk.check()


def test_the_staged_bytes_are_on_the_disk_before_they_become_the_active_image(
    rig: Callable[..., Any], new_control: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "control"
    made = rig(control=new_control(folder, initial=OLD))
    disk = Disk(folder, monkeypatch)
    send(made.session())
    assert [source[:7] for source, target in disk.renamed if target == "active.img"] == ["staged-"]
    disk.check()


@pytest.mark.parametrize("plant", [os.mkfifo, lambda path: path.symlink_to(path.parent.parent / "victim")])
@pytest.mark.parametrize("name", ["active.img", "part"])
def test_nothing_is_written_through_what_a_user_has_planted(
    tmp_path: Path, plant: Callable[[Path], None], name: str
) -> None:
    victim = tmp_path / "victim"
    victim.write_bytes(b"kept")
    memory = Memory(tmp_path / "control")
    plant(memory.folder / "active.img.tmp")
    plant(memory.folder / name)
    memory.replace("active.img", b"new")
    assert (memory.folder / "active.img").read_bytes() == b"new"
    if name == "part":
        with pytest.raises(OSError, match="part"):
            memory.append("part", b"more")
        with pytest.raises(OSError, match="part"):
            memory.sync("part")
    assert victim.read_bytes() == b"kept"
