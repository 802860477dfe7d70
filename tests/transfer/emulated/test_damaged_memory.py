"""A damaged memory is refused by name and stays as it is;
nothing in it makes an emulated control take half a download.
"""

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import StateError
from amp_studio.transfer.house.message import OpenDownload

TRANSFER = bytes(range(16))
NEW = b"new image\n" * 40


def begun(control: Control) -> int:
    """Begin a download, or take it up again; return how much of it has come."""
    return control.open_download(
        OpenDownload(TRANSFER, len(NEW), hashlib.sha256(NEW).digest(), control.sha256, "s1")
    )


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("control.json", {"incarnation": "many"}),
        ("control.json", {"incarnation": 1 << 40}),
        ("control.json", {"estop": 1}),
        ("control.json", {"committed": {"transfer": 5}}),
        ("control.json", {"committed": []}),
        ("commit.json", {}),
        ("commit.json", {"to": "00", "answer": {"incarnation": 1}}),
    ],
)
def test_a_state_that_no_control_has_written_is_refused_with_its_file(
    new_control: Callable[..., Control], tmp_path: Path, name: str, content: dict[str, Any]
) -> None:
    folder = tmp_path / "control"
    new_control(folder).close()
    path = folder / name
    before = json.loads(path.read_text()) if path.exists() else {}
    path.write_text(json.dumps(before | content))
    with pytest.raises(StateError, match=name):
        new_control(folder)


def test_a_state_nested_beyond_reason_is_refused(new_control: Callable[..., Control], tmp_path: Path) -> None:
    folder = tmp_path / "control"
    new_control(folder).close()
    (folder / "control.json").write_text("[" * 100_000)
    with pytest.raises(StateError, match="damaged"):
        new_control(folder)


@pytest.mark.parametrize("name", ["control.json", "commit.json", f"staged-{TRANSFER.hex()}.json"])
def test_a_memory_that_is_refused_stays_as_it_is(
    new_control: Callable[..., Control], tmp_path: Path, name: str
) -> None:
    folder = tmp_path / "control"
    control = new_control(folder)
    begun(control)
    control.close()
    (folder / "active.img").unlink()
    (folder / "left.tmp").write_bytes(b"by a replace that was cut off")
    (folder / name).write_bytes(b"damaged")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(StateError, match="damaged"):
        new_control(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize(
    "change",
    [
        {"size": True},
        {"size": -1},
        {"size": 1e300},
        {"size": "12"},
        {"transfer": "00"},
        {"sha256": ""},
        {"expected": "0 0"},
    ],
)
def test_a_download_that_no_control_has_begun_is_refused(
    new_control: Callable[..., Control], tmp_path: Path, change: dict[str, Any]
) -> None:
    folder = tmp_path / "control"
    control = new_control(folder)
    begun(control)
    control.close()
    note = folder / f"staged-{TRANSFER.hex()}.json"
    note.write_text(json.dumps(json.loads(note.read_text()) | change))
    with pytest.raises(StateError, match=r"staged-.* is damaged"):
        new_control(folder)


def test_a_download_of_which_more_has_come_than_there_is_begins_again(
    new_control: Callable[..., Control], tmp_path: Path
) -> None:
    folder = tmp_path / "control"
    control = new_control(folder)
    begun(control)
    control.close()
    (folder / f"staged-{TRANSFER.hex()}.part").write_bytes(NEW + b"more")
    control = new_control(folder)
    assert begun(control) == 0
    assert control.staged_size == 0
