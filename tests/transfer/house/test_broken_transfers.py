"""A download that broke off goes on in another run of the program, where the control still has its bytes."""

import os
import random
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.errors import CancelledError, ConnectionCutError
from amp_studio.transfer.house.broken_transfers import LASTING, MAX_KEPT, BrokenTransfers
from amp_studio.transfer.progress import Stop
from tests.transfer.images import OLD, send

LONG = random.Random(3).randbytes(4_000)


def test_a_second_run_sends_only_what_the_control_has_not_staged(
    rig: Callable[..., Any], control: Callable[..., Any], tmp_path: Path
) -> None:
    broken = BrokenTransfers(tmp_path / "begun")
    made = rig(Faults(drop_after_bytes=3_000), control=control(), lines=1, broken=broken)
    session = made.session()
    session.hello()
    with pytest.raises(ConnectionCutError, match=r"the same download goes on from byte \d{4} of 4000"):
        send(session, LONG)
    again = rig(control=made.control, broken=BrokenTransfers(tmp_path / "begun"))
    session, offsets = again.session(), list[int]()
    session.hello()
    sent = send(
        session,
        LONG,
        progress=lambda stage, done, total: offsets.append(done) if stage == "download" else None,
    )
    assert made.control.image == LONG
    assert 1_000 < sent.resumed_at == min(offsets) < 3_000
    assert list((tmp_path / "begun").iterdir()) == [], "a committed download is not taken up again"


def test_an_id_is_forgotten_before_its_commit_is_asked_for(
    rig: Callable[..., Any], control: Callable[..., Any], tmp_path: Path
) -> None:
    seen: list[bool] = []

    def note(stage: str, done: int, total: int) -> None:
        if stage == "commit":
            seen.append(any((tmp_path / "begun").iterdir()))

    made = rig(control=control(), broken=BrokenTransfers(tmp_path / "begun"))
    send(made.session(), LONG, progress=note)
    assert seen == [False, False], "one that was committed would be answered as done, whatever came after it"


def test_who_stops_a_download_gives_it_up(
    rig: Callable[..., Any], control: Callable[..., Any], tmp_path: Path
) -> None:
    made, stop = rig(control=control(), broken=BrokenTransfers(tmp_path / "begun")), Stop()

    def stop_half_way(stage: str, done: int, total: int) -> None:
        if stage == "download" and done > 2_000:
            stop.set()

    with pytest.raises(CancelledError):
        send(made.session(), LONG, progress=stop_half_way, cancel=stop)
    assert list((tmp_path / "begun").iterdir()) == []
    assert made.control.image == OLD


def test_another_image_or_another_old_content_is_another_download(tmp_path: Path) -> None:
    broken = BrokenTransfers(tmp_path / "begun")
    broken.keep(b"image onto old", bytes(range(16)))
    assert broken.find(b"image onto old") == bytes(range(16))
    assert broken.find(b"image onto another") is None
    broken.forget(b"image onto old")
    broken.forget(b"image onto old")
    assert broken.find(b"image onto old") is None


def test_what_is_old_or_damaged_is_not_taken_up_and_few_are_kept(tmp_path: Path) -> None:
    broken = BrokenTransfers(tmp_path / "begun")
    for number in range(MAX_KEPT + 5):
        broken.keep(bytes([number]), bytes(16))
    assert len(list((tmp_path / "begun").iterdir())) == MAX_KEPT
    broken.keep(b"x", bytes(16))
    (path,) = (p for p in (tmp_path / "begun").iterdir() if p.name == broken._path(b"x").name)
    os.utime(path, (0, time.time() - LASTING - 60))
    assert broken.find(b"x") is None
    path.write_bytes(b"\xff" * 32)
    assert broken.find(b"x") is None
    BrokenTransfers(tmp_path / "file" / "below").keep(b"x", bytes(16))
    (tmp_path / "plain").write_text("a file")
    BrokenTransfers(tmp_path / "plain").keep(b"x", bytes(16))
