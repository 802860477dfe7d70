"""The page that specifies the protocol is true, and enough to write the other end from."""

import hashlib
import json
import math
import re
import socket
import struct
import zlib
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import RESTART_WAIT
from amp_studio.transfer.emulated import emulator
from amp_studio.transfer.emulated.responder import CHUNK, WINDOW, Responder
from amp_studio.transfer.house import connection, download_transfer, streaming, transaction, upload_transfer
from amp_studio.transfer.house.frame import (
    MAX_ENCODED,
    MAX_PAYLOAD,
    FrameDecoder,
    cobs_decode,
    cobs_encode,
    encode_frame,
)
from amp_studio.transfer.house.message import LAYOUTS, MAX_CHUNK, MESSAGES, Code, Flags, Message, pack, unpack
from amp_studio.transfer.house.retry_timer import RetryPolicy
from amp_studio.transfer.house.session import Session


@pytest.fixture(scope="module")
def page() -> str:
    folder = Path(__file__).parents[3] / "docs" / "protocols"
    return "\n".join((folder / name).read_text("utf-8") for name in ("exchange.md", "exchange-client.md"))


def table(page: str, head: str) -> Iterator[list[str]]:
    """Yield the rows of the table whose head line begins with ``head``."""
    lines = iter(page.splitlines())
    for text in lines:
        if text.startswith(head):
            next(lines)
            break
    for text in lines:
        if not text.startswith("|"):
            return
        yield [cell.strip() for cell in text.strip("|").split("|")]


def span(text: str) -> bytes:
    """Return the bytes a cell writes: `0a 1f`, or `01` to `fe`."""
    out, last = b"", None
    for hexes, to in re.findall(r"`([0-9a-f ]+)`|(\bto\b)", text):
        if to:
            last = out[-1]
        elif last is not None:
            out += bytes(range(last + 1, int(hexes, 16) + 1))
            last = None
        else:
            out += bytes.fromhex(hexes)
    return out


@dataclass(frozen=True)
class Example:
    """One frame the page shows."""

    sender: str
    message: str
    number: int
    fields: dict[str, Any]
    line: bytes


def examples(page: str) -> list[Example]:
    found = []
    for block in re.findall(r"^```frame\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        head, fields, *lines = block.splitlines()
        sender, message, number = head.split()
        found.append(
            Example(sender, message, int(number), json.loads(fields), bytes.fromhex(" ".join(lines)))
        )
    return found


def test_every_message_is_in_the_table_with_its_fields(page: str) -> None:
    rows = {int(row[0], 16): row[1:] for row in table(page, "| type | message |")}
    assert rows.keys() == MESSAGES.keys()
    for number, (name, sender, fields) in rows.items():
        assert name == MESSAGES[number].__name__
        assert fields == ", ".join(" ".join(field) for field in LAYOUTS[number]), name
        assert sender == {True: "control", False: "client"}[number >= 0x80] or name == "Data"


def test_every_flag_and_code_is_in_its_table(page: str) -> None:
    assert {row[1]: int(row[0]) for row in table(page, "| value | flag |")} == {
        f.name: f.value for f in Flags
    }
    assert {row[1]: int(row[0]) for row in table(page, "| code | name |")} == {c.name: c.value for c in Code}


def test_every_request_has_its_row(page: str) -> None:
    requests = {kind.__name__ for number, kind in MESSAGES.items() if number < 0x80}
    assert {row[0] for row in table(page, "| request |")} == requests | {"any other"}


def test_the_cobs_table(page: str) -> None:
    rows = list(table(page, "| body | COBS(body) |"))
    assert len(rows) == 10
    for body, encoded in rows:
        assert cobs_encode(span(body)) == span(encoded), body
        assert cobs_decode(span(encoded)) == span(body), body


def test_the_check_value(page: str) -> None:
    check = zlib.crc32(b"123456789")
    assert f"{check:08X}" in page
    assert f"`{struct.pack('<I', check).hex(' ')}`" in page


def test_every_frame_on_the_page_is_the_message_it_shows(page: str) -> None:
    displayed = examples(page)
    assert len(displayed) > 10
    for example in displayed:
        (frame,) = FrameDecoder().feed(example.line)
        message = unpack(frame)
        fields = {name: v.hex() if isinstance(v, bytes) else v for name, v in asdict(message).items()}
        assert (type(message).__name__, frame.sequence, fields) == (
            example.message,
            example.number,
            example.fields,
        )
        assert encode_frame(frame) == example.line


def test_a_control_shows_to_the_page_s_client_what_the_page_shows(
    page: str, new_control: Callable[..., Any]
) -> None:
    """The last section, played: the client's bytes go in, the control's bytes come out."""
    _, *displayed, refused = examples(page)
    responder = Responder(new_control(initial=b"old\n"))
    for asked, answered in zip(displayed[::2], displayed[1::2], strict=True):
        assert (asked.sender, answered.sender) == ("client", "control")
        assert responder.receive(asked.line).hex(" ") == answered.line.hex(" "), asked.message
    assert responder.control.image == b"new\n"
    out_of_estop = Responder(new_control(initial=b"old\n", estop=False))
    opening = next(example for example in displayed if example.message == "OpenDownload")
    assert out_of_estop.receive(opening.line) == refused.line


def test_a_client_shows_to_the_page_s_control_what_the_page_shows(page: str) -> None:
    """The same from the other side, as far as it is laid down: every request has the bytes of the page."""
    for example in examples(page):
        if example.sender == "client":
            kind = MESSAGES[FrameDecoder().feed(example.line)[0].type]
            values = (
                bytes.fromhex(v) if wire.startswith(("bytes", "rest")) else v
                for v, (_, wire) in zip(example.fields.values(), LAYOUTS[kind.TYPE], strict=True)
            )
            assert encode_frame(pack(kind(*values), example.number)) == example.line


def test_the_numbers_of_the_page_are_those_of_the_program(page: str) -> None:
    policy = RetryPolicy()
    patience = Session(lambda: None)._line._patience
    seconds = [float(row[1]) for row in table(page, "| what | seconds |")]
    assert seconds == [
        policy.first,
        policy.least,
        policy.most,
        download_transfer.COMMIT_WAIT,
        download_transfer.ABORT_WAIT,
        patience,
        patience,
        connection.STOP_GRACE,
        download_transfer.COMMIT_WAIT * (2**download_transfer.COMMIT_TRIES - 1),
        math.ceil(connection.SILENT_AFTER),
        RESTART_WAIT,
        emulator.CLIENT_SILENCE,
    ]
    text = " ".join(page.split())
    assert f"After {policy.tries} timeouts" in text
    assert f"after {connection.PAUSE:g} s" in text
    assert f"up to {connection.LONGEST_PAUSE:g} s" in text
    assert f"0 to {MAX_PAYLOAD}" in text
    assert f"no more than {MAX_ENCODED} bytes" in text
    assert f"1 to {MAX_CHUNK}" in text
    assert f"{CHUNK} and {WINDOW} are good values" in text
    assert f"({download_transfer.COMMIT_TRIES} of a Commit)" in text
    assert (
        f"at most {upload_transfer.MAX_IMAGE >> 20} MiB, in at most {upload_transfer.MAX_PIECES:,} pieces"
        in text
    )
    assert f"{connection.STEP} bytes more" in text
    assert f"a {connection.STEPS}th of the image" in text
    assert f"at most {streaming.MAX_FLYING:,} bytes under way" in text
    assert f"no more than {emulator.LINES} lines open" in text
    assert transaction.UNASKED == 0
    assert Message.TYPE == 0


# -- the other end, from the page alone ------------------------------------------------------------


class PageClient:
    """A client written from the page, sharing no code with the program: one piece at a time."""

    def __init__(self, host: str, port: int) -> None:
        self.socket = socket.create_connection((host, port), timeout=60)
        self.socket.sendall(b"\x00")
        self.number = 0

    def ask(self, kind: int, payload: bytes = b"") -> tuple[int, bytes]:
        self.number += 1
        body = struct.pack("<BH", kind, self.number) + payload
        body += struct.pack("<I", zlib.crc32(body))
        groups = [b""]
        for run in (body + b"\x00").split(b"\x00")[:-1]:
            whole = len(run) // 254 * 254
            groups += [b"\xff" + run[at : at + 254] for at in range(0, whole, 254)]
            groups.append(bytes([len(run) - whole + 1]) + run[whole:])
        self.socket.sendall(b"".join(groups) + b"\x00")
        return self.answer()

    def answer(self) -> tuple[int, bytes]:
        encoded = b""
        while (byte := self.socket.recv(1)) != b"\x00":
            assert byte, "the control has hung up"
            encoded += byte
        body, at = b"", 0
        while at < len(encoded):
            code = encoded[at]
            body += encoded[at + 1 : at + code]
            at += code
            if code != 255 and at < len(encoded):
                body += b"\x00"
        assert struct.unpack("<I", body[-4:])[0] == zlib.crc32(body[:-4])
        kind, number = struct.unpack("<BH", body[:3])
        assert number == self.number
        return kind, body[3:-4]


def test_a_client_written_from_the_page_alone_downloads(emulate: Callable[..., Any], tmp_path: Path) -> None:
    old, new = b"old image\n", bytes(range(256)) * 7
    emulated = emulate(tmp_path, initial=old.decode())
    client = PageClient("127.0.0.1", int(emulated.address.rsplit(":", 1)[1]))

    kind, welcome = client.ask(0x01, b"\x01" + b"\x09\x08\x07\x06" + b"\x04page")
    assert (kind, welcome[:5]) == (0x81, b"\x01\x09\x08\x07\x06")
    texts, at = [], 5
    for _ in range(4):
        texts.append(welcome[at + 1 : at + 1 + welcome[at]].decode())
        at += 1 + welcome[at]
    flags, incarnation, size, digest, _, chunk = struct.unpack("<BII32sBH", welcome[at:])
    assert texts == ["9pc", "s1", "CNC_1", "3.05"]
    assert (flags, size, digest) == (1 + 2 + 8, len(old), hashlib.sha256(old).digest())

    assert client.ask(0x06) == (0x87, struct.pack("<I", len(old)) + digest)
    assert client.ask(0x07, struct.pack("<IH", 0, len(old))) == (0x04, struct.pack("<I", 0) + old)

    transfer, target = b"sixteen bytes id", hashlib.sha256(new).digest()
    opening = transfer + struct.pack("<I", len(new)) + target + digest + b"\x02s1"
    assert client.ask(0x03, opening) == (0x83, struct.pack("<I", 0))
    for start in range(0, len(new), chunk):
        kind, reached = client.ask(0x04, struct.pack("<I", start) + new[start : start + chunk])
        assert (kind, reached) == (0x84, struct.pack("<I", min(start + chunk, len(new))))
    kind, committed = client.ask(0x05, transfer + target)
    assert (kind, committed) == (0x86, transfer + target + struct.pack("<I?", incarnation, True))
    assert emulated.next_line() == "restarted 2"
    assert (tmp_path / "active.img").read_bytes() == new
    client.socket.close()
