"""Links over RFC 2217: a serial port of another computer, whose rate and parity are set from here.

pyserial negotiates and sets. Its reader stores whatever comes, without end, and dies of some of it, so that part is
replaced by one that bounds both.
"""

from __future__ import annotations

import contextlib
import socket
import threading
import time
from collections.abc import Callable
from typing import Any

from serial import SerialException, rfc2217

from .attempt import in_time
from .endpoint import Endpoint
from .link import LinkError, keep_waiting
from .serial_line import SLICE, SerialLink, port_settings
from .telnet import Negotiation, TelnetData, TelnetReader

READ_SIZE = 1_024
STORED = 65_536  # bytes that wait to be read; beyond them the line rests, and TCP slows the other end down
FLOW_CONTROLS = (
    rfc2217.SET_CONTROL_USE_NO_FLOW_CONTROL,
    rfc2217.SET_CONTROL_USE_SW_FLOW_CONTROL,
    rfc2217.SET_CONTROL_USE_HW_FLOW_CONTROL,
)
CLOSING = 1.0  # seconds the reader may take to notice that the line was closed


def connect_rfc2217(
    endpoint: Endpoint, timeout: float, look: Callable[[], None] = keep_waiting, *, own_flow: bool = False
) -> SerialLink:
    """Open and set a port within ``timeout`` seconds; raises LinkError, and what ``look`` raises."""
    host = f"[{endpoint.host}]" if ":" in endpoint.host else endpoint.host
    port = _RemotePort(None, timeout=SLICE, **port_settings(endpoint, own_flow))
    port.port = f"rfc2217://{host}:{endpoint.port}"

    def error_of(error: Exception) -> LinkError:
        return LinkError(endpoint, _message(error))

    try:
        in_time(port.open, lambda _: port.close(), timeout, look, error_of)
    except BaseException:
        port.close()
        raise
    return SerialLink(endpoint, port, look)


class _RemotePort(rfc2217.Serial):  # type: ignore[misc]
    """pyserial's port with a separate reader."""

    _socket: Any
    _thread: Any

    def __init__(self, *args: Any, **settings: Any) -> None:
        self._stored = bytearray()
        self._changed = threading.Condition()
        self._has_ended = False
        self._is_given_up = False
        super().__init__(*args, **settings)

    def close(self) -> None:
        """Hang up at once, also while another thread opens it."""
        self.is_open, self._is_given_up = False, True
        connection, self._socket = self._socket, None
        if connection is not None:
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)
            connection.close()
            with self._changed:
                self._changed.notify_all()
        reader, self._thread = self._thread, None
        if reader is not None and reader.is_alive() and reader is not threading.current_thread():
            reader.join(CLOSING)  # one that has not been started yet finds the line closed

    def fileno(self) -> int:
        """Return the handle that shows whether something can be written."""
        return int(self._socket.fileno())

    @property
    def in_waiting(self) -> int:
        """How many bytes wait; the end of the line is reported by ``read``."""
        return len(self._stored)

    def read(self, size: int = 1) -> bytes:
        """Return what waits, up to ``size`` bytes, or b"" after the time-out; raises SerialException at the end of the line."""
        end = time.monotonic() + SLICE
        with self._changed:
            while not self._stored and size:
                if self._has_ended or not self.is_open:
                    raise SerialException("the server has closed the connection")
                left = end - time.monotonic()
                if left <= 0:
                    return b""
                self._changed.wait(left)
            data = bytes(self._stored[:size])
            del self._stored[:size]
            self._changed.notify_all()
        return data

    def rfc2217_set_control(self, value: bytes) -> None:
        """Set flow control and wait for the answer; a port may be without DTR and RTS, and its server then answers nothing."""
        if value in FLOW_CONTROLS:
            super().rfc2217_set_control(value)
        else:
            self._rfc2217_options["control"].set(value)

    def reset_input_buffer(self) -> None:
        """Forget what came before."""
        self.rfc2217_send_purge(rfc2217.PURGE_RECEIVE_BUFFER)
        with self._changed:
            self._stored.clear()
            self._changed.notify_all()

    def _telnet_read_loop(self) -> None:
        """Be the thread that reads the line (pyserial starts it)."""
        telnet = TelnetReader()
        if self._is_given_up:
            self.close()
        try:
            while self.is_open:
                with contextlib.suppress(TimeoutError):
                    data = self._socket.recv(READ_SIZE)
                    if not data:
                        return
                    for each in telnet.feed(data):
                        self._take(each)
        except (OSError, ValueError, TypeError, AttributeError):
            return  # closed meanwhile, or something that is no RFC 2217: either way the line is over
        finally:
            with self._changed:
                self._has_ended = True
                self._changed.notify_all()

    def _take(self, each: Any) -> None:
        if isinstance(each, TelnetData):
            with self._changed:
                while len(self._stored) >= STORED and self.is_open:
                    self._changed.wait()
                self._stored += each.content
                self._changed.notify_all()
        elif isinstance(each, Negotiation):
            self._telnet_negotiate_option(bytes([each.command]), bytes([each.option]))
        else:
            self._telnet_process_subnegotiation(each.content)


def _message(error: Exception) -> str:
    text = str(error)
    if isinstance(error, TimeoutError) or "timed out" in text:
        return "no answer in time"
    if "does not seem to support" in text:
        return "what answers there is no RFC 2217 server"
    if "does not accept" in text or "rejected value" in text or "waiting for option" in text:
        return "the server does not set the port like this; another program may have it"
    if "refused" in text:
        return "nothing listens there"
    if "Name or service" in text or "getaddrinfo" in text or "name resolution" in text:
        return "the host is not known"
    return text or "the port cannot be opened"
