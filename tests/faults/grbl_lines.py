"""Grbl controls under faults: downloads, damaged copies of their settings, answers of any kind,
odd bytes at the emulated one.
"""

import contextlib
import random
import shutil
from collections.abc import Iterator
from pathlib import Path

from amp_studio.families.grblhal.content import read_content, write_content
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.families.grblhal.emulated.firmware import MEMORY, Firmware
from amp_studio.families.grblhal.kind import GrblContentKind
from amp_studio.transfer import Waiting
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.image import ImageError
from tests.families.grblhal.bench import Clock
from tests.families.grblhal.conversation import COMMANDS, Player
from tests.families.grblhal.faulty_grbl import download_with_faults

from .texts import violations
from .wire import damaged

KEYS = (
    "state Run",
    "state Idle",
    "state Alarm",
    "alarm 1",
    "alarm 999",
    "message hello",
    "message \x1b[2J",
    "power",
    "status",
    "",
    "state Off",
)


def settings_under_faults(seed: int, runs: int, folder: Path) -> list[str]:
    """Download to emulated controls whose line, power and memory fail;
    what is reported afterwards is true of each setting.
    """
    found = []
    for n in range(runs):
        place = folder / str(n)
        found += download_with_faults(seed * 10_000 + n, place)
        shutil.rmtree(place)
    return found


def _recorded() -> bytes:
    clock = Clock()
    return GrblDriver(Player(clock.sleep).open, Waiting(clock, clock.sleep)).fetch()


def fuzz_contents(seed: int, count: int) -> list[str]:
    """Read damaged copies of settings."""
    chance, whole, kind = random.Random(seed), _recorded(), GrblContentKind()
    classic = write_content(
        type(read_content(whole))(*(getattr(read_content(whole), name) for name in _VALUES))
    )

    def cases() -> Iterator[bytes]:
        for _ in range(count):
            content = chance.choice((whole, classic))
            for _ in range(chance.choice((1, 1, 2, 4))):
                content = damaged(content, chance)
            if chance.random() < 0.7 and b"\nend " in content:  # so that it is not just cut off
                lines = content.split(b"\nend ")[0].split(b"\n")
                content = b"\n".join([*lines, b"end %d" % len(lines), b""])
            yield content

    def look(content: bytes) -> None:
        assert write_content(read_content(content)) == content
        file = kind.decode(content)
        kind.difference(content, whole)
        kind.difference(whole, content)
        with contextlib.suppress(ImageError):
            kind.refit(content, whole)
        assert not kind.difference(kind.encode(file, content), content)

    return violations(cases(), look, (ImageError,))


_VALUES = ("identity", "settings", "offsets", "startup")


def fuzz_answers(seed: int, count: int) -> list[str]:
    """Upload from a control that answers anything: it ends in time, with a content or with a transfer
    error.
    """
    chance = random.Random(seed)

    def look(seed: int) -> None:
        clock, chance = Clock(), random.Random(seed)
        player = Player(clock.sleep)
        read, every = player.read, chance.choice((3, 10, 40))

        def changed(timeout: float) -> bytes:
            data = read(timeout)
            return damaged(data, chance) if data and chance.randrange(every) == 0 else data

        player.read = changed
        driver = GrblDriver(player.open, Waiting(clock, clock.sleep))
        try:
            content = driver.fetch()
        finally:
            assert clock.now < 120
        assert write_content(read_content(content)) == content

    return violations((chance.randrange(1 << 30) for _ in range(count)), look, (TransferError,))


def fuzz_devices(folder: Path, seed: int, count: int) -> list[str]:
    """Send odd bytes and commands to emulated controls, damage their memory; they go on,
    and answer no more than they are asked.
    """
    chance = random.Random(seed)
    memories = [Memory(folder / name) for name in ("hal", "classic")]
    devices = [
        Firmware(DeviceSetup("grblhal", memory, lambda _: None, machine))
        for memory, machine in zip(memories, (None, "grbl-1.1"), strict=True)
    ]
    lines = "\n".join(COMMANDS).encode()

    def look(case: tuple[int, str, bytes, bool]) -> None:
        number, key, data, is_damaged = case
        device, memory = devices[number], memories[number]
        if is_damaged:
            memory.replace(MEMORY, damaged(memory.read(MEMORY) or b"", chance))
            device.power_cycle()
        with contextlib.suppress(ValueError):
            assert len(device.operate(key)) < 500
        device.receive(data)
        for _ in range(2_000):
            if not device.answer():
                return
        raise AssertionError("it sends without an end")

    def cases() -> Iterator[tuple[int, str, bytes, bool]]:
        for _ in range(count):
            at = chance.randrange(len(lines))
            data = damaged(lines[at : at + 200], chance) + chance.choice((b"\n", b"", b"\x7f\n", b"?\x18"))
            yield chance.randrange(2), chance.choice(KEYS), data, chance.random() < 0.05

    return violations(cases(), look, ())
