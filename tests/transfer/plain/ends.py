"""Two ends in one process: links that pass bytes between threads, and one that sends what a seed chooses."""

import queue
import random
import threading
from collections.abc import Callable
from typing import Any

from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.plain.blocks import encode_block
from amp_studio.transfer.plain.line import ByteLine, Patience

QUICK = Patience(start=60, answer=0.3, ask=0.15, gap=0.1, noise=0.1, quiet=0.02, stall=60)


class Pipe:
    """One end of a line in memory; ``change`` may alter what is written."""

    bytes_per_second: float | None = None

    def __init__(self, change: Callable[[bytes], bytes] = bytes) -> None:
        self.incoming: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self.other: Pipe | None = None
        self.change = change

    def read(self, timeout: float) -> bytes:
        try:
            data = self.incoming.get(timeout=max(timeout, 0.0001))
        except queue.Empty:
            return b""
        if not data:
            raise LinkError("pipe", "cut")
        return data

    def write(self, data: bytes) -> None:
        assert self.other is not None
        if data:
            self.other.incoming.put(self.change(data))

    def close(self) -> None:
        assert self.other is not None
        self.other.incoming.put(b"")


def pair(noise: int = 0, seed: int = 1) -> tuple[Pipe, Pipe]:
    """Return the two ends of a line that changes one of so many bytes."""
    chance = random.Random(seed)

    def change(data: bytes) -> bytes:
        changed = bytearray(data)
        for at in range(len(changed) if noise else 0):
            if chance.randrange(noise) == 0:
                changed[at] ^= 1 << chance.randrange(8)
        return bytes(changed)

    near, far = Pipe(change), Pipe(change)
    near.other, far.other = far, near
    return near, far


def both(
    one: Callable[[ByteLine], Any], other: Callable[[ByteLine], Any], noise: int = 0, seed: int = 1
) -> Any:
    """Run two ends against each other and return what the second makes of it; raises what either raises."""
    near, far = pair(noise, seed)
    errors: list[Exception] = []

    def run() -> None:
        try:
            one(ByteLine(near, QUICK))
        except Exception as error:
            errors.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        return other(ByteLine(far, QUICK))
    finally:
        thread.join(60)
        if errors:
            raise errors[0]


class Wild:
    """An end that sends anything, in virtual time: whole blocks, answers, cancels, floods, nothing."""

    bytes_per_second: float | None = None

    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)
        self.now = 0.0
        self.number = self.chance.choice((0, 1, 1))
        self.talkative = self.chance.random()
        self.written = 0

    def clock(self) -> float:
        self.now += 0.0001
        return self.now

    def read(self, timeout: float) -> bytes:
        if self.chance.random() > self.talkative:
            self.now += timeout
            return b""
        self.now += timeout * self.chance.random() / 10
        kind = self.chance.randrange(8)
        if kind < 3:
            self.number += self.chance.choice((1, 1, 1, 1, 0, 2))
            name = self.chance.choice(
                (b"", b"../../etc/passwd\x0099999999999999 7", b"a\0", b"\xff\x1b[2J\0-5")
            )
            return encode_block(self.number - 1, name, crc=self.chance.random() < 0.9)
        if kind == 3:
            return self.chance.randbytes(self.chance.choice((1, 130, 5_000)))
        return self.chance.choice(
            (
                b"\x06",
                b"\x15",
                b"C",
                b"\x04",
                b"\x18",
                b"\x18\x18",
                b"\x06C",
                b"G",
                b"%\n",
                b"\x02",
                b"\0" * 9,
            )
        )

    def write(self, data: bytes) -> None:
        self.written += len(data)
        if self.chance.random() < 0.001:
            raise LinkError("wild", "cut")

    def close(self) -> None:
        pass
