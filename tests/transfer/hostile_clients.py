"""Clients that want to hurt an emulated control or keep it from others, by seed, beside one that means well.

``clients_beside_hostile_ones`` lets them all talk to one emulated control in a simulated time, with nothing
that waits; it returns what was wrong, so that a campaign can run many seeds.
"""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.emulator import Emulator
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.frame import encode_frame
from amp_studio.transfer.house.message import (
    Abort,
    Commit,
    Data,
    Hello,
    Message,
    OpenDownload,
    OpenUpload,
    Read,
    pack,
)
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.link import LinkError

from .null_modem import VirtualClock

OLD, NEW = b"1 old\n" * 40, b"2 new!\n" * 50
SIGNATURE = "s1"
TURN = 0.05  # seconds a turn of the control takes
LONGEST = 60.0  # seconds after which a client that means well must have got through


class Wire:
    """One line between a client and the emulated control."""

    def __init__(self) -> None:
        self.to_control: deque[bytes] = deque()
        self.to_client: deque[bytes] = deque()
        self.is_cut = False


class ControlEnd:
    """The control's end; ``takes_nothing`` for a client that never reads."""

    bytes_per_second = None

    def __init__(self, wire: Wire, *, takes_nothing: bool = False) -> None:
        self._wire = wire
        self._takes_nothing = takes_nothing

    def read(self, timeout: float) -> bytes:
        if self._wire.to_control:
            return self._wire.to_control.popleft()
        if self._wire.is_cut:
            raise LinkError("wire", "the other end has closed the connection")
        return b""

    def write(self, data: bytes) -> None:
        if self._takes_nothing or self._wire.is_cut:
            raise LinkError("wire", "the other end takes nothing more")
        self._wire.to_client.append(data)

    def close(self) -> None:
        self._wire.is_cut = True


class Room:
    """The emulated control with everybody who calls it; each turn of the control is a moment of time."""

    address = Endpoint("tcp", host="room", port=1)

    def __init__(self, folder: Path, hostile: list[Iterator[None]], **options: Any) -> None:
        self.clock = VirtualClock()
        self.said: list[str] = []
        self._calling: deque[ControlEnd] = deque()
        self._hostile = hostile
        self.control = Control(folder, Identity("9pc", SIGNATURE, "CNC_1", "3.05"), OLD, **options)
        self.emulator = Emulator(
            self.control, self, patch=_patch, say=self.said.append, clock=self.clock, sleep=lambda _: None
        )

    def accept(self, timeout: float) -> ControlEnd | None:
        return self._calling.popleft() if self._calling else None

    def close(self) -> None:
        self.control.close()

    def call(self, *, takes_nothing: bool = False) -> Wire:
        """Open a line to the control."""
        wire = Wire()
        self._calling.append(ControlEnd(wire, takes_nothing=takes_nothing))
        return wire

    def turn(self) -> None:
        """Let everybody hostile do something, then the control."""
        for client in list(self._hostile):
            if next(client, "over") == "over":
                self._hostile.remove(client)
        self.emulator.turn()
        self.clock.sleep(TURN)

    def add(self, client: Callable[[Room, random.Random], Iterator[None]], chance: random.Random) -> None:
        self._hostile.append(client(self, chance))

    def open_link(self, look: Callable[[], None]) -> GoodEnd:
        look()
        return GoodEnd(self)


class GoodEnd:
    """The end of a client that means well: while it waits, the others have their turn."""

    bytes_per_second = None

    def __init__(self, room: Room) -> None:
        self._room = room
        self._wire = room.call()

    def read(self, timeout: float) -> bytes:
        end = self._room.clock.now + timeout
        while not self._wire.to_client:
            if self._wire.is_cut:
                raise LinkError("wire", "the other end has closed the connection")
            self._room.turn()
            if self._room.clock.now >= end:
                break
        return self._wire.to_client.popleft() if self._wire.to_client else b""

    def write(self, data: bytes) -> None:
        if self._wire.is_cut:
            raise LinkError("wire", "the other end has closed the connection")
        self._wire.to_control.append(data)

    def close(self) -> None:
        self._wire.is_cut = True


def _patch(image: bytes, key: str, value: str) -> bytes:
    if not value.isdigit():
        raise OverflowError("cannot convert float infinity to integer")
    return image + f"{key} {value}\n".encode()


# -- who is hostile: each yields after every step --------------------------------------------------


def trickler(room: Room, chance: random.Random) -> Iterator[None]:
    """A greeting, then a byte of garbage a second, for good."""
    wire = room.call()
    wire.to_control.append(b"\x00" + _frame(Hello(1, b"abcd", "trickler")))
    while not wire.is_cut:
        for _ in range(int(1 / TURN)):
            yield
        wire.to_control.append(b"\x99")


def flooder(room: Room, chance: random.Random) -> Iterator[None]:
    """Garbage as fast as it goes, without a zero byte or with nothing else."""
    wire = room.call()
    byte = chance.choice([b"\x00", b"\xff", b"\x07"])
    while not wire.is_cut:
        wire.to_control.append(byte * 65_536)
        yield


def slow_loris(room: Room, chance: random.Random) -> Iterator[None]:
    """Lines that are opened, say half a frame, and stay; ever more of them."""
    wires = []
    for _ in range(200):
        wires.append(room.call())
        wires[-1].to_control.append(_frame(Hello(1, b"abcd", "loris"))[: chance.randrange(12)])
        yield


def deserter(room: Room, chance: random.Random) -> Iterator[None]:
    """Greets, begins something, and is not heard of again, its line still open."""
    wire = room.call(takes_nothing=chance.random() < 0.5)
    for message in (Hello(1, b"abcd", "deserter"), chance.choice(_REQUESTS)(chance)):
        wire.to_control.append(b"\x00" + _frame(message))
        yield


def babbler(room: Room, chance: random.Random) -> Iterator[None]:
    """Whole frames of every kind with absurd contents, for a while."""
    wire = room.call()
    for _ in range(chance.randrange(200)):
        if wire.is_cut:
            wire = room.call()
        wire.to_control.append(
            b"".join(_frame(chance.choice(_REQUESTS)(chance)) for _ in range(chance.randrange(1, 30)))
        )
        wire.to_client.clear()
        yield


def operator(room: Room, chance: random.Random) -> Iterator[None]:
    """Somebody at the panel who keys in nonsense."""
    lines = [
        "patch 1300=1e999",
        "patch =",
        "patch x=nan",
        "x" * 1_000_000,
        "\x1b[2J",
        "estop maybe",
        "status now",
        "\x00",
    ]
    for _ in range(60):
        room.emulator.operate(chance.choice(lines))
        yield


HOSTILE = [trickler, flooder, slow_loris, deserter, babbler, operator]


def _u32(chance: random.Random) -> int:
    return chance.choice([0, 1, 31, 1 << 20, (1 << 20) + 1, 1 << 26, (1 << 32) - 1])


_REQUESTS: list[Callable[[random.Random], Message]] = [
    lambda _: OpenUpload(),
    lambda c: Hello(c.choice([0, 1, 255]), b"abcd", "\x1b[2J" * 30),
    lambda c: OpenDownload(
        bytes(16), _u32(c), c.randbytes(32), c.choice([bytes(32), c.randbytes(32)]), c.choice(["s1", "\x1b"])
    ),
    lambda c: Data(_u32(c), c.randbytes(c.choice([0, 1, 4_096]))),
    lambda c: Commit(bytes(16), c.randbytes(32)),
    lambda c: Read(_u32(c), c.choice([0, 512, 65_535])),
    lambda c: Abort(c.choice([bytes(16), c.randbytes(16)])),
]


def _frame(message: Message) -> bytes:
    return encode_frame(pack(message, 7))


def clients_beside_hostile_ones(seed: int, folder: Path) -> list[str]:
    """Let a client download while others are hostile, and return what was wrong."""
    chance = random.Random(seed)
    room = Room(folder, [])
    for client in chance.sample(HOSTILE, chance.randint(1, 4)):
        room.add(client, chance)
    for _ in range(chance.randrange(40)):
        room.turn()
    faults = []
    before = room.clock.now
    try:
        while room.clock.now - before < LONGEST:
            session = Session(
                room.open_link,
                clock=room.clock,
                sleep=_turns(room),
                random_bytes=chance.randbytes,
                patience=30,
            )
            try:
                outcome = download(
                    HouseDriver(session), WantedContent(NEW, SIGNATURE), lambda image: "kept.amp"
                )
            except TransferError:
                session.close()
                for _ in range(20):
                    room.turn()
                continue
            session.close()
            break
        else:
            faults.append(f"nobody else got through for {LONGEST:g} s")
            outcome = None
        if outcome is not None and not outcome.verified:
            faults.append(f"the download was disturbed: {outcome.text}")
    except Exception as error:  # whatever ends the control is what is looked for
        faults.append(f"{type(error).__name__}: {error}")
    finally:
        room.close()
    if room.control.image not in (OLD, NEW):
        faults.append("the image is neither old nor new")
    faults += [f"said {line[:80]!r}" for line in room.said if not line.isprintable() or len(line) > 600]
    return faults


def _turns(room: Room) -> Callable[[float], None]:
    def sleep(seconds: float) -> None:
        end = room.clock.now + seconds
        while room.clock.now < end:
            room.turn()

    return sleep
