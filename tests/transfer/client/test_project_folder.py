"""What lies in a project folder belongs to its files."""

from pathlib import Path

import pytest

from amp_studio.transfer.client.project_folder import folder_content
from amp_studio.transfer.client.record import add_exchange, exchange_now


def test_backups_and_copies_belong_to_their_file(tmp_path: Path) -> None:
    for name in (
        "mill.amp",
        "mill.amp.bak",
        "mill.before-20260101-120000.img",
        "mill.before-20260101-120000.amp",
        "mill.before-20260301-120000.img",
        "lathe.amp",
        "gone.amp.bak",
        "rules.yaml",
        "notes.txt",
        "mill.before-20260101-120000.img.sha256",
    ):
        (tmp_path / name).write_text("")
    add_exchange(tmp_path / "mill.amp", exchange_now("upload", tmp_path / "mill.amp", "9pc", "tcp://a:1"))
    add_exchange(tmp_path / "mill.amp", exchange_now("download", tmp_path / "mill.amp", "9pc", "tcp://b:1"))

    found = folder_content(tmp_path)

    lathe, mill = found.files
    assert [p.name for p in mill.copies] == [
        "mill.before-20260301-120000.img",
        "mill.before-20260101-120000.img",
    ]
    assert mill.backup == tmp_path / "mill.amp.bak"
    assert mill.exchange is not None
    assert (mill.exchange.verb, mill.exchange.control) == ("download", "tcp://b:1"), "the last one"
    assert (lathe.backup, lathe.copies, lathe.exchange) == (None, (), None)
    assert [p.name for p in found.deleted] == ["gone.amp.bak"]
    assert found.rules == tmp_path / "rules.yaml"


def test_a_record_that_cannot_be_read_hides_no_file(tmp_path: Path) -> None:
    (tmp_path / "mill.amp").write_text("")
    (tmp_path / "exchanges.jsonl").mkdir()
    assert [f.path.name for f in folder_content(tmp_path).files] == ["mill.amp"]


def test_a_folder_that_is_gone_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        folder_content(tmp_path / "gone")
