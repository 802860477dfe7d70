"""What comes on a telnet line, taken apart: data, negotiations and options, each bounded (RFC 854, 855)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto

IAC, SB, SE = 0xFF, 0xFA, 0xF0
WILL, WONT, DO, DONT = NEGOTIATIONS = range(0xFB, 0xFF)
LONGEST_OPTION = 256  # bytes; the longest of RFC 2217 that means something here has 6


@dataclass(frozen=True)
class TelnetData:
    content: bytes


@dataclass(frozen=True)
class Negotiation:
    """``command`` is WILL, WONT, DO or DONT."""

    command: int
    option: int


@dataclass(frozen=True)
class Option:
    """What came between SB and SE."""

    content: bytes


class _State(Enum):
    PLAIN = auto()
    COMMAND = auto()
    NEGOTIATION = auto()


class TelnetReader:
    """Takes bytes as they come, cut anywhere. What is no telnet is left out; an option that is too long
    too.
    """

    def __init__(self) -> None:
        self._state = _State.PLAIN
        self._command = 0
        self._option: bytearray | None = None

    def feed(self, data: bytes) -> Iterator[TelnetData | Negotiation | Option]:
        """Yield what has become whole."""
        at = 0
        while at < len(data):
            if self._state is _State.PLAIN:
                end = data.find(IAC, at)
                end = len(data) if end < 0 else end
                yield from self._plain(data[at:end])
                at = end + 1
                if end < len(data):
                    self._state = _State.COMMAND
                continue
            byte = data[at]
            at += 1
            if self._state is _State.NEGOTIATION:
                self._state = _State.PLAIN
                yield Negotiation(self._command, byte)
            else:
                yield from self._commanded(byte)

    def _plain(self, content: bytes) -> Iterator[TelnetData]:
        if self._option is None:
            if content:
                yield TelnetData(content)
        elif len(self._option) <= LONGEST_OPTION:
            self._option += content[: LONGEST_OPTION + 1]

    def _commanded(self, byte: int) -> Iterator[TelnetData | Option]:
        """Obey the byte behind an IAC; doubled it is a byte of data."""
        self._state = _State.PLAIN
        if byte == IAC:
            yield from self._plain(b"\xff")
        elif byte in NEGOTIATIONS:
            self._command, self._state = byte, _State.NEGOTIATION
        elif byte == SB:
            self._option = bytearray()
        elif byte == SE and self._option is not None:
            option, self._option = self._option, None
            if len(option) <= LONGEST_OPTION:
                yield Option(bytes(option))
