"""Links over RFC 2217: a serial port of another computer, whose rate and parity are set from here.

The client's side of the standard over a TCP link, without a thread: what comes is read when it is asked for,
so that a flood waits in the network. (pyserial has a client too; its reader stores whatever comes, without
end, dies of some of it, and can be replaced through its private parts only.)
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

from .attempt import SLICE
from .endpoint import Endpoint
from .link import LinkError, keep_waiting
from .serial_line import FLOW_LIMIT, WRITE_LIMIT
from .serial_settings import SerialSettings
from .tcp import TcpLink, connect_tcp
from .telnet import DO, DONT, IAC, SB, SE, WILL, WONT, Negotiation, Option, TelnetData, TelnetReader

BINARY, ECHO, SUPPRESS_GO_AHEAD, COM_PORT = 0, 1, 3, 44
_WANTED = (SUPPRESS_GO_AHEAD, BINARY, COM_PORT)
"""Telnet options that are asked for on both sides; without the last one there is no port."""
_ANSWER = 100  # a server answers command n with n + 100
BAUD, DATA_BITS, PARITY, STOP_BITS, CONTROL, PURGE = 1, 2, 3, 4, 5, 12
_PARITIES = {"none": 1, "odd": 2, "even": 3, "mark": 4, "space": 5}
_STOPS = {1: 1, 2: 2, 1.5: 3}
_FLOWS = {"none": 1, "xonxoff": 2, "rtscts": 3}
_DTR_ON, _RTS_ON = 8, 11
_RECEIVED, _LEAVING = 1, 2  # which bytes a purge is of

_NO_SERVER = "what answers there is no RFC 2217 server"
_NOT_SET = "the server does not set the port like this; another program may have it"
CLOSED = "the server has closed the connection"


def connect_rfc2217(
    endpoint: Endpoint, timeout: float, look: Callable[[], None] = keep_waiting, *, own_flow: bool = False
) -> Rfc2217Link:
    """Open and set a port within ``timeout`` seconds; raises LinkError, and what ``look`` raises.

    ``own_flow``: Xon and Xoff are left to the reader.
    """
    end = time.monotonic() + timeout
    link = Rfc2217Link(endpoint, connect_tcp(endpoint, timeout, look), look)
    try:
        link.agree(end)
        link.set_port(end, own_flow=own_flow)
    except BaseException:
        link.close()
        raise
    return link


class Rfc2217Link:
    """One open port of a server."""

    def __init__(self, endpoint: Endpoint, line: TcpLink, look: Callable[[], None] = keep_waiting) -> None:
        self._settings: SerialSettings = endpoint.serial_settings()
        self.bytes_per_second: float | None = self._settings.bytes_per_second
        self._endpoint, self._line, self._poll = endpoint, line, look
        line.write_limit = WRITE_LIMIT if self._settings.flow == "none" else FLOW_LIMIT
        self._telnet = TelnetReader()
        self._sent: set[tuple[int, int]] = set()
        self._is_open, self._has_received, self._is_agreed = True, False, False
        self._answers: dict[int, bytes] = {}
        self._early = b""
        """Data that came right behind the answer that was waited for."""

    def read(self, timeout: float) -> bytes:
        end = time.monotonic() + timeout
        while True:
            early, self._early = self._early, b""
            data = early or b"".join(self._received(max(0.0, end - time.monotonic())))
            if data or time.monotonic() >= end:
                return data

    def write(self, data: bytes) -> None:
        self._write(data.replace(bytes([IAC]), bytes([IAC, IAC])))

    def close(self) -> None:
        self._is_open = False
        self._line.close()

    # -- opening -----------------------------------------------------------------------------------

    def agree(self, end: float) -> None:
        """Agree with the server that this is a port; raises LinkError."""
        for option in _WANTED:
            self._negotiate(WILL, option)
            self._negotiate(DO, option)
        self._await(
            lambda: self._is_agreed, end, lambda: _NO_SERVER if self._has_received else "no answer in time"
        )

    def set_port(self, end: float, *, own_flow: bool) -> None:
        """Set the line as the endpoint asks for and forget what came before; raises LinkError."""
        settings = self._settings
        flow = "none" if own_flow and settings.flow == "xonxoff" else settings.flow
        wanted = {
            BAUD: settings.baud.to_bytes(4, "big"),
            DATA_BITS: bytes([settings.bits]),
            PARITY: bytes([_PARITIES[settings.parity]]),
            STOP_BITS: bytes([_STOPS[settings.stop]]),
            CONTROL: bytes([_FLOWS[flow]]),
        }
        for command, value in wanted.items():
            self._set(command, value)
        self._await(lambda: self._answers.keys() >= wanted.keys(), end, lambda: _NOT_SET)
        if any(self._answers[command] != value for command, value in wanted.items()):
            raise LinkError(self._endpoint, _NOT_SET)
        # A port may be without DTR and RTS, and its server then answers nothing.
        self._set(CONTROL, bytes([_DTR_ON]))
        if flow != "rtscts":
            self._set(CONTROL, bytes([_RTS_ON]))
        for which in (_LEAVING, _RECEIVED):
            self._early = b""
            self._answers.pop(PURGE, None)
            self._set(PURGE, bytes([which]))
            self._await(lambda: PURGE in self._answers, end, lambda: _NOT_SET)

    def _await(self, is_there: Callable[[], bool], end: float, why_not: Callable[[], str]) -> None:
        """Read until something is there; data that comes before it is of an earlier use of the port."""
        while not is_there():
            self._poll()
            left = end - time.monotonic()
            if left <= 0:
                raise LinkError(self._endpoint, why_not())
            for content in self._received(min(left, SLICE)):
                self._has_received = True
                self._early += content if is_there() else b""

    # -- the telnet line ---------------------------------------------------------------------------

    def _received(self, timeout: float) -> Iterator[bytes]:
        """Yield the data that comes, and obey the rest; raises LinkError."""
        try:
            came = self._line.read(timeout)
        except LinkError:
            raise LinkError(self._endpoint, CLOSED if self._is_open else "the port is closed") from None
        for each in self._telnet.feed(came):
            if isinstance(each, TelnetData):
                yield each.content
            elif isinstance(each, Negotiation):
                self._answer(each)
            else:
                self._remember(each)

    def _answer(self, asked: Negotiation) -> None:
        """Agree to what is needed, refuse anything else; what was sent once is not sent again."""
        self._has_received = True
        if asked.option == COM_PORT and asked.command in (DO, DONT):
            self._is_agreed = asked.command == DO
            if not self._is_agreed:
                raise LinkError(self._endpoint, _NO_SERVER)
        if asked.command == WILL:
            self._negotiate(DO if asked.option in (*_WANTED, ECHO) else DONT, asked.option)
        elif asked.command == DO:
            self._negotiate(WILL if asked.option in _WANTED else WONT, asked.option)

    def _remember(self, option: Option) -> None:
        """Remember what the server answers to a setting."""
        kind, command, value = option.content[:1], option.content[1:2], option.content[2:]
        if kind == bytes([COM_PORT]) and command and command[0] >= _ANSWER:
            self._answers.setdefault(command[0] - _ANSWER, value)

    def _negotiate(self, command: int, option: int) -> None:
        if (command, option) not in self._sent:
            self._sent.add((command, option))
            self._write(bytes([IAC, command, option]))

    def _set(self, command: int, value: bytes) -> None:
        doubled = value.replace(bytes([IAC]), bytes([IAC, IAC]))
        self._write(bytes([IAC, SB, COM_PORT, command]) + doubled + bytes([IAC, SE]))

    def _write(self, data: bytes) -> None:
        try:
            self._line.write(data)
        except LinkError as error:
            what = error.what if "takes nothing" in error.what else CLOSED
            raise LinkError(self._endpoint, what if self._is_open else "the port is closed") from None
