"""A cable that is cut after any byte of a download, or a user who stops there: what is then reported of the
control, and of each value, is what it contains.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.transfer import Exchange, TransferError, Waiting
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.links.link import Link, LinkError
from tests.campaigns import CAMPAIGN
from tests.families.acromill.lines.bench import CardBench
from tests.families.grblhal.bench import Bench as GrblBench
from tests.families.num.lines.bench import NumBench
from tests.families.servo57c422b.lines.bench import RackBench


@dataclass
class Cable:
    """Is cut, or has a user stop, after ``left`` bytes both ways; None for never."""

    how: str = "cut"
    left: int | None = None
    passed: int = 0
    is_out: bool = False
    stop: threading.Event = field(default_factory=threading.Event)

    def takes(self, data: bytes) -> bytes:
        """Return what of it passes."""
        self.passed += len(data)
        if self.left is None:
            return data
        whole, self.left = data, self.left - len(data)
        if self.left >= 0:
            return data
        if self.how == "stop":
            self.stop.set()
            return data
        cut, self.left, self.is_out = len(whole) + self.left, None, True
        return whole[:cut]

    def plug(self, link: Link) -> Link:
        """Return a line through it; one that comes back does so at the next try."""
        if self.is_out and self.how == "cut for good":
            raise LinkError("bench", "the cable is out")
        self.is_out = False
        return _CutLink(link, self)


class _CutLink:
    bytes_per_second = None

    def __init__(self, link: Link, cable: Cable) -> None:
        self._link, self._cable = link, cable

    def read(self, timeout: float) -> bytes:
        return self._passed(self._link.read(timeout))

    def write(self, data: bytes) -> None:
        if part := self._cable.takes(data):
            self._link.write(part)
        self._check()

    def close(self) -> None:
        self._link.close()

    def _passed(self, data: bytes) -> bytes:
        self._check()
        part = self._cable.takes(data)
        self._check()
        return part

    def _check(self) -> None:
        if self._cable.is_out:
            self._link.close()
            raise LinkError("bench", "the cable was cut")


@dataclass
class Rig:
    driver: Any
    numbers: dict[str, float]
    """What is to be sent: number or address -> value."""
    progress: Callable[[str, int, int], None] = lambda *_: None


def rig(family: str, folder: Path, cable: Cable) -> Rig:
    """Return a driver at an emulated control whose line goes through a cable."""
    if family == "grblhal":
        control = GrblBench(folder)
        waiting = Waiting(control.clock, control.clock.sleep)
        driver = GrblDriver(lambda look: cable.plug(control.open(look)), waiting)
        return Rig(driver, {"$110": 700.0, "$120": 33.0, "$130": 333.0})
    if family == "57c422b":
        rack = RackBench(folder)
        rack.wrap = cable.plug
        return Rig(rack.driver, {"R3": 17595.0, "R2051": 4000.0, "R4": 77.0})
    if family == "num":
        num = NumBench(folder, is_checked=True)
        num.wrap = cable.plug
        return Rig(num.driver, {"P9N0": 7.0, "P9N31": 8.0}, num.progress)
    card = CardBench(folder)
    card.wrap = cable.plug
    return Rig(card.driver, {"axes.pulses_per_unit@X": 4096.0, "servo.p_gain@X": 0.08})


def wanted_of(content: bytes, numbers: dict[str, float]) -> ParameterFile:
    file = decode_content(content)
    for name, number in numbers.items():
        address = file.find(name)
        old = file.values[address]
        file.take({address: Value(type(old.value)(number), old.unit)})
    return file


def swept(family: str, folder: Path, how: str, left: int | None) -> tuple[str, int]:
    """Do one download that is broken off after so many bytes; returns how it ended and how many bytes there
    were.
    """
    cable = Cable(how)
    at = rig(family, folder, cable)
    before = at.driver.fetch(Exchange(at.progress))
    file = wanted_of(before, at.numbers)
    wanted = at.driver.encode(file, before)
    kept: list[bytes] = []

    def keep(old: bytes) -> str:
        cable.left, cable.passed = left, 0
        return str(kept.append(old))

    error: TransferError | None = None
    try:
        target = WantedContent(lambda _: wanted, file.schema.signature)
        download(at.driver, target, keep, Exchange(at.progress, cable.stop))
    except TransferError as found:
        error = found
    passed = cable.passed
    cable.left, cable.is_out, cable.how = None, False, "whole"
    truth = at.driver.fetch(Exchange(at.progress))
    check(at.driver, before, wanted, truth, error)
    return error.at_control if error is not None else "done", passed


def check(driver: Any, before: bytes, wanted: bytes, truth: bytes, error: TransferError | None) -> None:
    """Compare what is reported of a control with what it contains."""
    old, new, now = (driver._names(driver.displayed(each, truth)) for each in (before, wanted, truth))
    assert error is not None or now == new
    if error is None:
        return
    states = {"old": now == old, "new": now == new, "mixed": now not in (old, new), "unknown": True}
    assert states[error.at_control], (error.at_control, str(error))
    if error.at_control == "mixed":
        assert {n for n in new if now[n] == new[n] != old[n]} == {*error.new}
    if error.remains is None or error.at_control == "old":
        return
    least, most = (
        driver._names(driver.displayed(each, truth)) for each in (error.remains.least, error.remains.most)
    )
    assert not error.remains.is_read or least == now
    for name in new:
        assert least[name] == old[name] or now[name] == new[name], f"{name} is not new"
        assert most[name] != old[name] or now[name] == old[name], f"{name} is not old"


STEPS = {"acromill": 8, "grblhal": 40, "57c422b": 12, "num": 1500}
"""Bytes from one break to the next in a campaign."""


@pytest.mark.parametrize("how", ["cut", "cut for good", "stop"])
@pytest.mark.parametrize("family", STEPS)
def test_wherever_a_download_is_broken_off_what_is_reported_of_each_value_is_true(
    family: str, how: str, tmp_path: Path
) -> None:
    done, total = swept(family, tmp_path / "whole", how, None)
    assert done == "done"
    step = STEPS[family] if CAMPAIGN else total // 6
    ends = [swept(family, tmp_path / str(left), how, left)[0] for left in range(0, total, step)]
    assert {"done", "old"} != {*ends}, "some of them are in the middle"
