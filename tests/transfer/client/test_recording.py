"""What the record has of a download however it ends, and with which copies the next reading is compared."""

from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import WantedContent
from amp_studio.transfer.client.kept import CopyError, keep_image
from amp_studio.transfer.client.record import add_exchange, digest_of, exchange_now, read_exchanges
from amp_studio.transfer.client.recording import Recording
from amp_studio.transfer.driver import Receipt
from amp_studio.transfer.errors import ConnectionCutError, TransferError
from amp_studio.transfer.exchange import Exchange
from tests.transfer.client.test_drivers import NEW, OLD, Settings, Sheet


def recording(folder: Path, address: str = "tcp://a") -> Recording:
    return Recording("download", "9pc", address, Exchange(record=folder / "mill.amp"))


def test_a_control_that_cannot_be_read_afterwards_has_no_content_in_the_record(tmp_path: Path) -> None:
    control = Settings(b"1=5\n", cut=ConnectionCutError)
    with pytest.raises(TransferError):
        recording(tmp_path).run(control, WantedContent(b"1=8\n", "s1"), lambda _: "kept")
    (entry,) = read_exchanges(tmp_path)
    assert (entry.state, entry.before, entry.after, entry.kept) == (
        "unknown",
        digest_of(b"1=5\n"),
        "",
        "kept",
    )


def test_a_download_that_was_proven_has_both_contents_in_the_record(tmp_path: Path) -> None:
    recording(tmp_path).run(Sheet(), WantedContent(NEW, "s1"), lambda _: "kept")
    (entry,) = read_exchanges(tmp_path)
    assert (entry.state, entry.before, entry.after) == ("new", digest_of(OLD), digest_of(NEW))


def test_one_that_never_reached_the_control_is_none(tmp_path: Path) -> None:
    with pytest.raises(TransferError):
        recording(tmp_path).run(Sheet(), WantedContent(NEW, "another schema"), lambda _: "kept")
    assert read_exchanges(tmp_path) == []


class Broken(Sheet):
    """An empty control whose line breaks while it takes a content."""

    def fetch(self, *_: Any) -> bytes:
        return b""

    def send(self, *_: Any) -> Receipt:
        raise ConnectionCutError("gone", "unknown")


def test_a_download_into_an_empty_control_that_broke_off_is_in_the_record(tmp_path: Path) -> None:
    with pytest.raises(TransferError):
        recording(tmp_path).run(Broken(), WantedContent(NEW, "s1"), lambda _: "kept")
    (entry,) = read_exchanges(tmp_path)
    assert (entry.state, entry.before, entry.after) == ("unknown", "", "")


class Counting(Sheet):
    """A kind of content in which every line is a setting."""

    def lacks(self, content: bytes, earlier: bytes) -> str:
        return ", ".join(line for line in earlier.decode().split() if line not in content.decode().split())


@pytest.mark.parametrize(("address", "is_refused"), [("tcp://a", True), ("tcp://b", False)])
def test_a_reading_is_compared_with_the_copies_of_its_own_control(
    tmp_path: Path, address: str, is_refused: bool
) -> None:
    kept = keep_image(b"first\nP1\nP2\n", tmp_path, "mill", readable=False)
    file = tmp_path / "mill.amp"
    add_exchange(file, exchange_now("download", file, "9pc", "tcp://a", state="new", kept=str(kept)))
    check = recording(tmp_path, address).check_whole
    check(Counting(), b"first\nP1\nP2\nP3\n", tmp_path)
    check(Counting(), b"another kind\nP1\n", tmp_path)
    if is_refused:
        with pytest.raises(CopyError, match=f"this reading lacks P2, which {kept.name} has"):
            check(Counting(), b"first\nP1\n", tmp_path)
    else:
        check(Counting(), b"first\nP1\n", tmp_path)
