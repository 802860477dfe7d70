"""Damaged contents of a module's registers, odd lines and commands at an emulated rack,
and odd answers of one.
"""

import contextlib
import random
from collections.abc import Iterator
from pathlib import Path

from amp_studio.families.servo57c422b.emulated.rack import Rack
from amp_studio.families.servo57c422b.lines.content import RegisterContent, settings, written_content
from amp_studio.families.servo57c422b.lines.driver import RegisterDriver
from amp_studio.families.servo57c422b.lines.register_line import framed
from amp_studio.transfer import Waiting
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.image import ImageError
from tests.transfer.null_modem import VirtualClock

from .texts import violations
from .wire import damaged

COMMANDS = (
    "patch R3=160",
    "show R72",
    "fault 4 X",
    "stop-all",
    "power",
    "status",
    "patch R66=512",
    "patch R65=1",
)
REQUESTS = (b"ID", b"R 0 32", b"W 3 160", b"W 66 512", b"W 66 0", b"R 72 2")
CONTENT = written_content(dict.fromkeys(settings(), 0))


class _OddRack:
    """Answers a driver with something else than it asked for."""

    bytes_per_second = None

    def __init__(self, rack: Rack, chance: random.Random, clock: VirtualClock) -> None:
        self._rack, self._chance, self._clock = rack, chance, clock

    def read(self, timeout: float) -> bytes:
        answer = self._rack.answer()
        self._clock.sleep(timeout if not answer else 0.001)
        if self._chance.random() < 0.9:
            return answer
        odd = framed(
            self._chance.randrange(20), self._chance.choice(("ID", "R 0 x", "R 0 70000", "W 3 99999", "E no"))
        )
        return self._chance.choice((damaged(answer, self._chance), odd))

    def write(self, data: bytes) -> None:
        self._rack.receive(data)

    def close(self) -> None:
        """Close nothing."""


def fuzz_racks(folder: Path, seed: int, count: int) -> list[str]:
    """Try them in turn: whatever is refused is refused with the documented error,
    and nothing waits or grows without an end.
    """
    chance = random.Random(seed)
    rack = Rack(DeviceSetup("57c422b", Memory(folder / "rack"), lambda _: None))

    def look(way: int) -> None:
        if way == 0:
            RegisterContent().decode(damaged(CONTENT, chance))
        elif way == 1:
            with contextlib.suppress(ValueError):
                rack.operate(damaged(chance.choice(COMMANDS).encode(), chance).decode("latin-1"))
            rack.receive(damaged(framed(chance.randrange(1_000), chance.choice(REQUESTS).decode()), chance))
            assert len(rack.answer()) < 500
            assert len(rack._line) < 100
            assert all(0 <= word <= 0xFFFF for word in rack.module.words)
        else:
            clock = VirtualClock()
            driver = RegisterDriver(lambda _: _OddRack(rack, chance, clock), Waiting(clock, clock.sleep))
            begun = clock.now
            driver.identify()
            assert clock.now - begun < 60

    def ways() -> Iterator[int]:
        for _ in range(count):
            yield chance.choice((0, 1, 1, 2))

    return violations(ways(), look, (ImageError, TransferError))
