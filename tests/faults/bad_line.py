"""A line that does to its bytes what a seed chooses: it changes, loses, repeats, reorders and delays them,
pauses and is cut.
"""

import random
from collections.abc import Callable, Mapping
from typing import Protocol, TypeVar

from amp_studio.transfer.links.link import Link, LinkError
from tests.transfer.emulated.memory_steps import PowerLoss

T = TypeVar("T")
DELAYS = (0.02, 0.2, 0.9, 1.1, 3.0)
"""Seconds by which a piece comes late: around those that the drivers wait for an answer."""
PAUSES = (1.0, 4.0, 25.0, 200.0)
"""Seconds in which nothing passes, once."""


class Seconds(Protocol):
    """A simulated time."""

    now: float


class BadLine:
    """A link with faults, by name: one byte or piece in so many, or the byte at which it happens, once.

    ``change``, ``lose``, ``repeat`` and ``swap`` are of single bytes, ``delay`` is of pieces that come late;
    at ``pause`` nothing passes for a while, at ``cut`` the line breaks,
    at ``kill`` the control loses its power too (``die``).
    """

    def __init__(
        self,
        link: Link,
        time: Seconds,
        chance: random.Random,
        faults: dict[str, int],
        die: Callable[[], None],
    ) -> None:
        self._link, self._time, self._chance, self._faults, self._die = link, time, chance, faults, die
        self._passed = 0
        self._late: list[tuple[float, bytes]] = []
        self.bytes_per_second = link.bytes_per_second

    def read(self, timeout: float) -> bytes:
        end = self._time.now + timeout
        data = self._pass(self._powered(lambda: self._link.read(0 if self._late else timeout)))
        if data:
            due = max([self._time.now + self._delay(), *(at for at, _ in self._late[-1:])])
            self._late.append((due, data))
        if self._late and self._late[0][0] <= max(end, self._time.now):
            at, data = self._late.pop(0)
            self._time.now = max(at, self._time.now)
            return data
        self._time.now = max(end, self._time.now)
        return b""

    def write(self, data: bytes) -> None:
        data = self._pass(data)
        self._powered(lambda: self._link.write(data))

    def close(self) -> None:
        self._link.close()

    def _powered(self, act: Callable[[], T]) -> T:
        try:
            return act()
        except PowerLoss:
            self._die()
        self._cut("the control has no power")
        raise AssertionError("cut")

    def _cut(self, why: str) -> None:
        self._link.close()
        raise LinkError("bad line", why)

    def _delay(self) -> float:
        return self._chance.choice(DELAYS) if self._strikes("delay") else 0.0

    def _strikes(self, name: str) -> bool:
        one_in = self._faults.get(name, 0)
        return one_in > 1 and self._chance.random() * one_in > one_in - 1

    def _is_due(self, name: str) -> bool:
        """Return whether what happens once happens at this byte."""
        return self._passed == self._faults.get(name) and bool(self._faults.pop(name))

    def _pass(self, data: bytes) -> bytes:
        passed = bytearray()
        content = b""
        for byte in data:
            self._passed += 1
            if self._is_due("cut"):
                self._cut("cut")
            if self._is_due("kill"):
                self._die()
                self._cut("killed")
            if self._is_due("pause"):
                self._time.now += self._chance.choice(PAUSES)
            if self._strikes("lose"):
                continue
            piece = bytes((byte ^ 1 << self._chance.randrange(8) if self._strikes("change") else byte,))
            if self._strikes("repeat"):
                piece *= 2
            if not content and self._strikes("swap"):
                content = piece
                continue
            passed += piece + content
            content = b""
        return bytes(passed + content)


def choose_faults(chance: random.Random, size: int, without: tuple[str, ...] = ()) -> dict[str, int]:
    """Return what goes wrong on one line and at its control;
    ``size`` is about what a whole download moves in bytes.

    ``power`` is the step on the control's disk at which its power goes, ``forget`` the write that the control
    acknowledges and does not do, ``stop`` the call of the progress that is Ctrl-C.
    """
    once: Mapping[str, range] = {
        "cut": range(1, size),
        "kill": range(1, size),
        "pause": range(1, size),
        "power": range(1, 12),
        "forget": range(1, 6),
        "stop": range(1, 400),
        "delay": range(3, 60),
    }
    ways = {**once, **dict.fromkeys(("lose", "change", "repeat", "swap"), range(60, 4_000))}
    names = [name for name in ways if name not in without]
    return {name: chance.choice(ways[name]) for name in chance.sample(names, chance.choice([0, 1, 1, 1, 2]))}
