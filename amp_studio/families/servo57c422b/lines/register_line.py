"""A line to the registers of a rack: one request, one answer,
each with its number and a checksum (docs/protocols/registers.md).
"""

from __future__ import annotations

import binascii
import re

from amp_studio.transfer import (
    ControlSilentError,
    NoConnectionError,
    OpenLink,
    ProtocolMismatchError,
    Waiting,
)
from amp_studio.transfer.links import Link, LinkError

MAX_REGISTERS = 32  # registers of one answer
_LONGEST = 320  # bytes of a line
_TRIES = 6  # of one request
LINES = 3  # times a line that is cut is made again for one request
_ANSWER_WAIT = 1.0  # seconds
PAUSE = 0.3
_NUMBERS = 1_000

_ANSWER = re.compile(rb"([0-9]{1,3}) ([!-~][ -~]*)\*([0-9A-F]{4})")


def framed(number: int, text: str) -> bytes:
    """Return a line: number, text, checksum (CRC-16, polynomial 1021, start FFFF)."""
    body = f"{number} {text}".encode("ascii")
    return body + b"*%04X\r\n" % binascii.crc_hqx(body, 0xFFFF)


def unframed(line: bytes) -> tuple[int, str] | None:
    """Return number and text of a line that is whole, else None."""
    match = _ANSWER.fullmatch(line)
    if match is None or int(match[3], 16) != binascii.crc_hqx(line[: -len(match[3]) - 1], 0xFFFF):
        return None
    return int(match[1]), match[2].decode("ascii")


class RegisterLine:
    """Reads and writes registers; a request that is not answered goes out again,
    for its repetition changes nothing.
    """

    def __init__(self, open_link: OpenLink, waiting: Waiting) -> None:
        self._open_link = open_link
        self._waiting = waiting
        self._link: Link | None = None
        self._number = 0
        self._buffer = b""

    def close(self) -> None:
        """Close the line."""
        if self._link is not None:
            self._link.close()
            self._link = None
        self._buffer = b""

    def name(self) -> str:
        """Return what the rack calls itself."""
        return self._ask("ID", "ID ")

    def read(self, first: int, count: int) -> tuple[int, ...]:
        """Return so many registers from one on, 0 to 65535 each; raises TransferError."""
        words = self._ask(f"R {first} {count}", f"R {first} ").split(" ")
        if len(words) != count or not all(
            re.fullmatch("[0-9]{1,5}", word) and int(word) <= 0xFFFF for word in words
        ):
            raise ProtocolMismatchError(
                f"the rack answers for register {first} with something else than {count} numbers"
            )
        return tuple(map(int, words))

    def write(self, register: int, word: int) -> None:
        """Write a register; raises TransferError."""
        text = self._ask(f"W {register} {word}", f"W {register} ")
        if not re.fullmatch("[0-9]{1,5}", text) or int(text) > 0xFFFF:
            raise ProtocolMismatchError(f"the rack answers the writing of register {register} with no number")

    def _ask(self, request: str, head: str) -> str:
        """Return what follows ``head`` in the answer."""
        fault: LinkError | None = None
        cuts = 0
        for _ in range(_TRIES):
            self._waiting.look()
            try:
                answer = self._tried(request)
            except LinkError as error:
                self.close()
                fault, cuts = error, cuts + 1
                if cuts > LINES:
                    break
                self._waiting.sleep(PAUSE)
                continue
            if answer is None:
                continue
            if not answer.startswith(head):
                raise ProtocolMismatchError(f"the rack answers '{request}' with '{answer[:60]}'")
            self._waiting.note_answer()
            return answer.removeprefix(head)
        if fault is not None:
            raise NoConnectionError(f"no connection to the rack ({fault})")
        raise ControlSilentError(f"the rack does not answer '{request}'")

    def _tried(self, request: str) -> str | None:
        """Send a request once; returns the text of its answer, None where none came in time."""
        link = self._link
        if link is None:
            link = self._link = self._open_link(self._waiting.look)
            link.write(b"\r\n")  # ends half a line that was left
        self._number = (self._number + 1) % _NUMBERS
        link.write(framed(self._number, request))
        end = self._waiting.now() + _ANSWER_WAIT
        while (left := end - self._waiting.now()) > 0:
            *lines, self._buffer = (self._buffer + self._waiting.read(link, left)).split(b"\r\n")
            # Noise without a line end must not fill the memory.
            self._buffer = self._buffer[-_LONGEST:]
            for line in lines:
                found = unframed(line)
                # The answer to an earlier try, which came too late, has another number and must not be
                # taken for this one.
                if found is not None and found[0] == self._number:
                    return found[1]
        return None
