"""Damaged bytes on the line and damaged messages in whole frames, the same for the same seed."""

import dataclasses
import random
from collections.abc import Iterator
from unittest import mock

from amp_studio.transfer.house.frame import MAX_ENCODED, MAX_PAYLOAD, Frame, FrameDecoder, encode_frame
from amp_studio.transfer.house.message import LAYOUTS, MESSAGES, Message, RefusalError, pack, unpack
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.password import Gate, prove
from amp_studio.transfer.links.telnet import LONGEST_OPTION, TelnetData, TelnetReader
from amp_studio.transfer.plain.line import ByteLine, PlainFileError
from amp_studio.transfer.plain.raw import Tape, read_tape
from amp_studio.transfer.plain.sender import BlockSender
from amp_studio.transfer.plain.ymodem import PlainFile, receive_batch, send_batch
from tests.transfer.plain.ends import Wild

from .texts import violations

_LAST = Frame(0xFE, 0xFFFF, b"the last one")
_JUNK = (
    b"\x00",
    b"\xff",
    b"\x01",
    b"\x11",
    b"\x13",
    b"\x00\x00\x00",
    b"\xff" * 300,
    b"\x01" * 5000,
    b"\x7f" * 20_000,
)


def random_message(chance: random.Random) -> Message:
    """Return any message with any content that its fields can hold."""
    kind = MESSAGES[chance.choice(list(MESSAGES))]
    types = {
        "flag": lambda: chance.random() < 0.5,
        "text": lambda: "é\x1b[2J" * chance.choice((0, 1, 40)),
        "rest": lambda: chance.randbytes(chance.choice((0, 1, 254, 255, 4096))),
    }
    fields = {}
    for name, wire in LAYOUTS[kind.TYPE]:
        if wire in types:
            fields[name] = types[wire]()
        elif wire.startswith("bytes"):
            fields[name] = chance.randbytes(int(wire[5:]))
        else:
            fields[name] = chance.choice((0, 1, (1 << int(wire[1:])) - 1, chance.getrandbits(int(wire[1:]))))
    return kind(**fields)


def damaged(data: bytes, chance: random.Random) -> bytes:
    """Return bytes with one piece changed, lost, added or doubled."""
    at, length = chance.randint(0, len(data)), chance.choice((0, 1, 1, 2, 30, 300))
    junk = chance.choice((*_JUNK, chance.randbytes(length), data[at : at + length] * 2, b""))
    if chance.random() < 0.3 and at < len(data):
        junk = bytes((data[at] ^ 1 << chance.randrange(8),))
        length = 1
    return data[:at] + junk + data[at + length :]


def _streams(seed: int, count: int) -> Iterator[tuple[random.Random, set[bytes], bytes]]:
    """Yield what was sent, frame by frame, and the stream after damage."""
    chance = random.Random(seed)
    for _ in range(count):
        sent = [
            pack(random_message(chance), chance.randrange(65_536)) for _ in range(chance.choice((1, 2, 4)))
        ]
        pieces = [encode_frame(frame) for frame in sent]
        stream = b"".join(pieces)
        for _ in range(chance.choice((1, 1, 2, 4))):
            stream = damaged(stream, chance)
        yield chance, {piece[:-1] for piece in pieces}, stream


def _decode(case: tuple[random.Random, set[bytes], bytes]) -> None:
    """A damaged frame is dropped and counted; nothing is kept beyond the longest one,
    and what comes after it is read.
    """
    chance, sent, stream = case
    decoder, found, at = FrameDecoder(), list[Frame](), 0
    while at < len(stream):
        size = chance.choice((1, 7, 300, 10_000))
        found += decoder.feed(stream[at : at + size])
        assert len(decoder._buffer) <= MAX_ENCODED, f"{len(decoder._buffer)} bytes are kept"
        at += size
    for frame in found:
        assert len(frame.payload) <= MAX_PAYLOAD
        assert encode_frame(frame)[:-1] in sent, "a frame that nobody sent"
    after = decoder.feed(b"\x00" + encode_frame(_LAST))
    assert after[-1:] == [_LAST], "the frame after the damage is lost"


def fuzz_frames(seed: int, count: int) -> list[str]:
    """Decode damaged streams of frames, in pieces of any size."""
    return violations(_streams(seed, count), _decode, ())


def _frames(seed: int, count: int) -> Iterator[Frame]:
    chance = random.Random(seed)
    for _ in range(count):
        frame = pack(random_message(chance), 7)
        for _ in range(chance.choice((1, 1, 2, 4))):
            payload = damaged(frame.payload, chance)[:MAX_PAYLOAD]
            number = frame.type if chance.random() < 0.8 else chance.randrange(256)
            frame = dataclasses.replace(frame, type=number, payload=payload)
        yield frame


def _unpack(frame: Frame) -> None:
    assert pack(unpack(frame), frame.sequence) == frame, "the message would be packed otherwise"


def fuzz_messages(seed: int, count: int) -> list[str]:
    """Unpack whole frames whose content is damaged; what is taken is packed as the same frame."""
    return violations(_frames(seed, count), _unpack, (RefusalError,))


_TELNET = (
    b"\xff\xfb\x2c",
    b"\xff\xfd\x00",
    b"\xff\xfa\x2c\x65\x00\x00\x25\x80\xff\xf0",
    b"data",
    b"\xff\xff",
    b"\xff\xf1",
    b"\xff\xf0",
    b"\xff\xfa" + b"x" * 2000,
    b"\xff\xfa\x2c\xff\xff\xff\xf0",
    b"\xff",
    b"\x13\x11",
)


def fuzz_telnet(seed: int, count: int) -> list[str]:
    """Read damaged telnet lines, however they are cut: the same comes out, bounded, and what follows is
    read.
    """
    chance = random.Random(seed)

    def read(stream: bytes, size: int) -> tuple[bytes, list[object]]:
        reader, data, others = TelnetReader(), b"", list[object]()
        for at in range(0, len(stream), size):
            for each in reader.feed(stream[at : at + size]):
                if isinstance(each, TelnetData):
                    data += each.content
                else:
                    others.append(each)
            assert len(reader._option or b"") <= 2 * LONGEST_OPTION + 1
        return data, others

    def look(stream: bytes) -> None:
        whole = stream + b"\xff\xf0\x00\xff\xf0\xff\xf0" + b"the last one"
        data, others = read(whole, len(whole))
        assert data.endswith(b"the last one")
        assert read(whole, chance.choice((1, 2, 7))) == (data, others)

    streams = (damaged(b"".join(chance.choices(_TELNET, k=6)), chance) for _ in range(count))
    return violations(streams, look, ())


def fuzz_plain_files(seed: int, count: int) -> list[str]:
    """Send to and receive from ends that say anything: each transfer ends, by a sentence where it fails,
    and takes no memory.
    """

    def look(number: int) -> None:
        wild = Wild(number)
        line = ByteLine(wild, clock=wild.clock)
        try:
            if number % 3 == 0:
                receive_batch(line)
            elif number % 3 == 1:
                send_batch(BlockSender(line, long_blocks=True), [PlainFile("x", bytes(2_000))])
            else:
                read_tape(line, Tape(percent=wild.chance.random() < 0.5), 1.0)
        finally:
            assert wild.now < 2_000, f"it took {wild.now:.0f} s"
            assert len(line._buffer) <= 70_000

    with (
        mock.patch("amp_studio.transfer.plain.receiver.LARGEST", 5_000),
        mock.patch("amp_studio.transfer.plain.raw.LARGEST", 90_000),
    ):
        return violations(iter(range(seed * count, (seed + 1) * count)), look, (PlainFileError,))


class _Said:
    """A link over which some text comes before it is cut."""

    bytes_per_second = None

    def __init__(self, said: bytes, chance: random.Random) -> None:
        self.said, self.chance = said, chance

    def read(self, timeout: float) -> bytes:
        if not self.said:
            raise LinkError("said", "cut")
        size = self.chance.choice((1, 40, 5_000))
        data, self.said = self.said[:size], self.said[size:]
        return data

    def write(self, data: bytes) -> None:
        assert b"secret word" not in data

    def close(self) -> None:
        self.said = b""


def fuzz_passwords(seed: int, count: int) -> list[str]:
    """Meet damaged challenges and proofs: nobody is let in without the password,
    and what fails does so in a sentence.
    """
    chance = random.Random(seed)
    with mock.patch("amp_studio.transfer.links.password.ROUNDS", 1):
        gate = Gate("secret word")
        lines = [
            gate.challenge(),
            b"PROOF " + b"0" * 64 + b" " + b"1" * 64 + b"\n",
            b"WELCOME " + b"2" * 64 + b"\n",
            b"LATER 5\n",
            b"WRONG\n",
        ]

        def look(said: bytes) -> None:
            answer, is_right = gate.answer("host", lines[0], said, bytes(32))
            assert not is_right
            assert answer.endswith(b"\n")
            prove(_Said(said, chance), "place", "secret word", bytes(32), 1.0, lambda: None)
            raise AssertionError("proven")

        cases = (damaged(b"".join(chance.choices(lines, k=2)), chance) for _ in range(count))
        return violations(cases, look, (LinkError,))
