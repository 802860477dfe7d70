"""A bench without a line and without waiting: an emulated control, its faults,
and a clock that only moves when one waits.
"""

import random
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from amp_studio.families.grblhal.content import GrblContent, read_content, write_content
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.families.grblhal.emulated.firmware import Firmware
from amp_studio.files import ParameterFile
from amp_studio.transfer import Waiting
from amp_studio.transfer.client.exchange import Outcome, WantedContent, download
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.links.link import Link, LinkError

PIECE = 64


class Clock:
    """Seconds that pass when somebody waits."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


class Bench:
    """A control on a line whose bytes ``spoil`` may change; ``tick`` is called with each answer that
    begins.
    """

    def __init__(self, folder: Path, machine: str | None = None, axes: str = "XYZ") -> None:
        self.clock = Clock()
        self.folder = folder
        self.firmware = Firmware(DeviceSetup("grblhal", Memory(folder), lambda _: None, machine), axes)
        self.spoil_in: Callable[[bytes], bytes] = lambda data: data
        self.spoil_out: Callable[[bytes], bytes] = lambda data: data
        self.is_cut = False
        self.received: list[bytes] = []
        self.driver = GrblDriver(self.open, Waiting(self.clock, self.clock.sleep))

    def open(self, look: Callable[[], None]) -> Link:
        look()
        if self.is_cut:
            self.clock.now += 1.0
            raise LinkError("bench", "nothing listens there")
        self.firmware.connected()
        return BenchLink(self, look)

    @property
    def lines(self) -> list[str]:
        """The lines that the control was sent."""
        return b"".join(self.received).replace(b"\x7f", b"").decode().split("\n")


class BenchLink:
    """One connection to the control of a bench."""

    bytes_per_second = None

    def __init__(self, bench: Bench, look: Callable[[], None]) -> None:
        self._bench, self._look = bench, look
        self.is_open = True

    def read(self, timeout: float) -> bytes:
        self._check()
        data = self._bench.spoil_out(self._bench.firmware.answer())
        if not data:
            self._bench.clock.now += timeout
        return data

    def write(self, data: bytes) -> None:
        self._check()
        self._look()
        self._bench.received.append(data)
        self._bench.firmware.receive(self._bench.spoil_in(data))

    def close(self) -> None:
        self.is_open = False

    def _check(self) -> None:
        if not self.is_open or self._bench.is_cut:
            raise LinkError("bench", "the cable is out")


def damage(random_: random.Random, every: int) -> Callable[[bytes], bytes]:
    """Return a line that changes one bit of one byte in so many."""

    def spoil(data: bytes) -> bytes:
        return bytes(b ^ 1 << random_.randrange(7) if random_.randrange(every) == 0 else b for b in data)

    return spoil


def current(bench: Bench) -> GrblContent:
    return read_content(bench.driver.fetch())


def put(bench: Bench, settings: Mapping[int, str], **others: object) -> Outcome:
    """Download the settings that the control has, with these changed."""
    present = current(bench)
    wanted = replace(present, settings={**present.settings, **settings}, **others)
    return download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "kept")


def sent(bench: Bench) -> list[str]:
    """Return the settings that were sent."""
    return [line for line in bench.lines if "=" in line]


def edited(bench: Bench, **values: float | str) -> ParameterFile:
    """Return what the control contains as a file, with numbers changed: ``n130=5`` is $130."""
    file = decode_content(bench.driver.fetch())
    for name, value in values.items():
        address = file.find("$" + name[1:])
        file.take({**file.values, address: replace(file.values[address], value=value)})
    return file
