"""Controls that want to hurt the program that calls them, by seed: any answer may be absurd, late, missing,
or noise.

``exchange_with_hostile_control`` is one such exchange in a simulated time; it returns what was wrong with how
the client took it, so that a campaign can run many seeds.
"""

from __future__ import annotations

import dataclasses
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.errors import CancelledError, TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.frame import FrameDecoder, encode_frame
from amp_studio.transfer.house.message import (
    LAYOUTS,
    Ack,
    Code,
    Commit,
    Data,
    Message,
    Refused,
    UploadReady,
    pack,
    unpack,
)
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.links.link import LinkError

from .null_modem import VirtualClock

OLD = b"".join(b"%d\told.value.%d\t%d mm\n" % (n, n, n * 7) for n in range(120))
NEW = b"".join(b"%d\tnew.value.%d\t%d mm\n" % (n, n, n * 9) for n in range(140))
SIGNATURE = "s1"
LONGEST = 1_800  # seconds an exchange with a control may take that moves just enough not to be cancelled

ABSURD = {
    "u8": [0, 1, 2, 127, 255],
    "u16": [0, 1, 2, 4_096, 4_097, 65_535],
    "u32": [0, 1, 1 << 16, (1 << 22) + 1, 1 << 26, (1 << 31) - 1, (1 << 32) - 1],
    "text": ["", "\x1b[2J\x1b]0;owned\x07", "x" * 255, "\u202egpj.exe", "9pc\n", "\x00" * 200],
    "flag": [False, True],
}
TRICKS = [
    "fields",
    "fields",
    "fields",
    "silent",
    "noise",
    "half",
    "flood",
    "busy",
    "refuse",
    "late",
    "twice",
    "cut",
    "number",
    "acks",
    "trickle",
]
LIES = {"fields", "refuse", "number"}  # after these a control may have sent what is not true


class HostileControl:
    """Gives lines to a control that mostly answers as it should, and otherwise as ``chance`` will have it."""

    def __init__(self, folder: Path, clock: VirtualClock, chance: random.Random) -> None:
        self.control = Control(folder, Identity("9pc", SIGNATURE, "CNC_1", "3.05"), OLD)
        self.clock = clock
        self.chance = chance
        self.tricks = chance.sample(TRICKS, chance.randint(1, 4))
        self.one_in = chance.choice([1, 2, 3, 5, 20])
        self.spared = chance.choice([0, 0, 1, 3, 6, 12, 40])  # requests that are answered well at first
        self.victims = chance.choice(
            [(), (), ("Commit",), ("Data",), ("Read",), ("Hello",), ("OpenDownload",)]
        )
        self.window, self.chunk = chance.choice([(16, 512), (1, 1), (255, 4_096), (255, 1), (4, 7)])
        self.received_commit = False
        self.answers: set[bytes] = set()
        self.answered_at = 0.0

    def open_link(self, look: Callable[[], None]) -> HostileLink:
        look()
        self.clock.sleep(0.001)
        return HostileLink(self)


class HostileLink:
    """One line to it. Nothing comes for nothing: each read takes a moment, so that a flood takes its time."""

    bytes_per_second = None

    def __init__(self, hostile: HostileControl) -> None:
        self._hostile = hostile
        self._responder = Responder(hostile.control, window=hostile.window, chunk=hostile.chunk)
        self._decoder = FrameDecoder()
        self._out: list[tuple[float, bytes]] = []
        self._flood = b""
        self._is_cut = False

    def write(self, data: bytes) -> None:
        if self._is_cut:
            raise LinkError("hostile", "cut")
        for frame in self._decoder.feed(data):
            request = unpack(frame)
            self._hostile.received_commit |= isinstance(request, Commit)
            self._out += self._answers(request, frame.sequence, self._responder.receive(encode_frame(frame)))

    def read(self, timeout: float) -> bytes:
        clock = self._hostile.clock
        if self._is_cut:
            raise LinkError("hostile", "cut")
        clock.sleep(0.001)
        if self._out and self._out[0][0] <= clock.now + timeout:
            at, data = self._out.pop(0)
            clock.now = max(at, clock.now)
            if data in self._hostile.answers:
                self._hostile.answered_at = clock.now
            return data
        if self._flood:
            clock.sleep(0.02)
            return self._flood
        clock.sleep(timeout)
        if self._responder.restart_due:
            self._hostile.control.restart()
            self._is_cut = True
        return b""

    def close(self) -> None:
        self._is_cut = True

    def _answers(self, request: Message, number: int, good: bytes) -> list[tuple[float, bytes]]:
        hostile, chance, now = self._hostile, self._hostile.chance, self._hostile.clock.now
        name = type(request).__name__
        hostile.answers.add(good)
        hostile.spared -= 1
        spared = hostile.spared >= 0 or (hostile.victims and name not in hostile.victims)
        if spared or not good or chance.randrange(hostile.one_in):
            return [(now, good)]
        answer = unpack(FrameDecoder().feed(good)[0])
        match chance.choice(hostile.tricks):
            case "fields":
                absurd = encode_frame(pack(self._absurd(answer), number))
                hostile.answers.add(absurd)
                return [(now, absurd)]
            case "silent":
                return []
            case "noise":
                return [(now, chance.randbytes(chance.choice([1, 100, 10_000]))), (now, b"\x00" + good)]
            case "half":
                return [(now, good[: len(good) // 2])]
            case "flood":
                self._flood = chance.choice(
                    [
                        b"\xff" * 5_000,
                        encode_frame(pack(UploadReady(2, bytes(32)), number)) * 50,
                        encode_frame(pack(Ack(0), number)),
                        b"\x00" * 999,
                    ]
                )
                return []
            case "busy":
                return [(now, encode_frame(pack(Refused(Code.BUSY, "\x1b[31mbusy"), 0)))]
            case "refuse":
                code = chance.choice([*Code, 0, 200])
                return [(now, encode_frame(pack(Refused(code, "\x1b[31mno\x07"), number)))]
            case "late":
                return [(now + chance.choice([1, 4, 19, 21, 300]), good)]
            case "twice":
                return [(now, good), (now + 0.5, good)]
            case "number":
                return [(now, encode_frame(pack(answer, (number + chance.choice([1, 65_534])) & 65_535)))]
            case "acks" if isinstance(request, Data):
                return [(now, encode_frame(pack(Ack(chance.choice([0, len(NEW), 1 << 31])), number)))]
            case "trickle":
                return [(now + 15, good)]
            case _:
                self._is_cut = True
                return []

    def _absurd(self, answer: Message) -> Message:
        """Change one field, or some, to what nobody expects."""
        chance = self._hostile.chance
        changed: dict[str, Any] = {}
        for name, kind in LAYOUTS[answer.TYPE]:
            if name == "nonce" or not chance.randrange(2):
                continue
            if kind in ABSURD:
                changed[name] = chance.choice(ABSURD[kind])
            elif kind.startswith("bytes"):
                changed[name] = chance.randbytes(int(kind.removeprefix("bytes")))
            else:
                changed[name] = chance.randbytes(chance.choice([0, 1, 512, 4_096]))
        return dataclasses.replace(answer, **changed)


def exchange_with_hostile_control(seed: int, folder: Path) -> list[str]:
    """Download an image to a hostile control and return what was wrong with how it ended."""
    chance = random.Random(seed)
    clock = VirtualClock()
    hostile = HostileControl(folder, clock, chance)
    kept: list[bytes] = []
    session = Session(
        hostile.open_link, family="9pc", clock=clock, sleep=clock.sleep, random_bytes=chance.randbytes
    )
    faults: list[str] = []
    told_at = longest = 0.0

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal told_at, longest
        # A line that has answered meanwhile was not silent for so long.
        longest, told_at = max(longest, clock.now - max(told_at, hostile.answered_at)), clock.now
        if not (0 <= done <= total or stage == "silent"):
            faults.append(f"progress says {stage} {done} of {total}")

    def keep(image: bytes) -> str:
        kept.append(image)
        return "kept.amp"

    try:
        at_control: str = download(
            HouseDriver(session), WantedContent(NEW, SIGNATURE), keep, Exchange(progress)
        ).at_control
        text = ""
    except CancelledError:
        at_control, text = "old", "nobody has cancelled"
        faults.append(text)
    except TransferError as error:
        at_control, text = error.at_control, str(error)
    except Exception as error:  # whatever else comes out is what is looked for
        at_control, text = "old", ""
        faults.append(f"{type(error).__name__}: {error}")
    finally:
        session.close()
        hostile.control.close()
    truth = {OLD: "old", NEW: "new"}[hostile.control.image]
    if LIES.isdisjoint(hostile.tricks) and at_control not in {truth, "unknown"}:
        faults.append(f"said {at_control}, and it is {truth}: {text}")
    if at_control == "unknown" and not hostile.received_commit:
        faults.append("said it is not known, and no commit was asked for")
    if not text.replace("\n", "").isprintable() or len(text) > 1_500:
        faults.append(f"control characters or too much text: {text[:200]!r}")
    if clock.now > LONGEST:
        faults.append(f"it took {clock.now:.0f} s")
    if longest > 2.3:
        faults.append(f"nothing was said for {longest:.1f} s")
    return faults
