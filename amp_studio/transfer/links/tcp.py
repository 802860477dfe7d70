"""Links over TCP."""

from __future__ import annotations

import contextlib
import errno
import select
import socket
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeVar

from .attempt import SLICE, in_time
from .endpoint import Endpoint
from .link import LinkError, keep_waiting

WRITE_LIMIT = 3.0  # seconds the other end may take to make room before the line counts as gone
_BACKLOG = 64  # callers that the system lets wait: a few that say nothing must not keep others out
READ_SIZE = 65_536
_LAST_READS = 16  # how much of what will not be read is taken off a line that is closed

# What a listening socket may report of one caller, or for the moment: it goes on listening.
_PASSING = {
    errno.ECONNABORTED,
    errno.ECONNRESET,
    errno.EMFILE,
    errno.ENFILE,
    errno.ENOBUFS,
    errno.ENOMEM,
    errno.EPROTO,
}

Wrapped = TypeVar("Wrapped")


class TcpLink:
    """One TCP connection, without Nagle's delay: a frame goes out when it is written."""

    bytes_per_second: float | None = None
    write_limit = WRITE_LIMIT

    def __init__(
        self, endpoint: Endpoint, connection: socket.socket, look: Callable[[], None] = keep_waiting
    ) -> None:
        self._endpoint = endpoint
        self._socket = connection
        self._poll = look
        connection.setblocking(False)
        with contextlib.suppress(OSError):  # a connection that is gone already is met at the first read
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @property
    def peer(self) -> Endpoint:
        """Who is at the other end."""
        return self._endpoint

    def wrap(self, wrap: Callable[[socket.socket], Wrapped]) -> Wrapped:
        """Put TLS around the connection."""
        return wrap(self._socket)

    def read(self, timeout: float) -> bytes:
        try:
            if not select.select([self._socket], [], [], max(0.0, timeout))[0]:
                return b""
            data = self._socket.recv(READ_SIZE)
        except BlockingIOError:
            return b""
        except (OSError, ValueError) as error:
            raise LinkError(self._endpoint, tcp_message(error)) from None
        if not data:
            raise LinkError(self._endpoint, "the other end has closed the connection")
        return data

    def write(self, data: bytes) -> None:
        rest = memoryview(data)
        end = time.monotonic() + self.write_limit
        while rest:
            try:
                if select.select([], [self._socket], [], SLICE)[1]:
                    rest = rest[self._socket.send(rest) :]
                    continue
            except BlockingIOError:
                continue
            except (OSError, ValueError) as error:
                raise LinkError(self._endpoint, tcp_message(error)) from None
            self._poll()
            if time.monotonic() >= end:
                raise LinkError(self._endpoint, "the other end takes nothing more")

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)
            # What came and was not read would make the system break the connection off, last answer and all.
            for _ in range(_LAST_READS):
                if not self._socket.recv(READ_SIZE):
                    break
        with contextlib.suppress(OSError):
            self._socket.close()


class TcpListener:
    """Waits at one host and port; port 0 takes a free one, which ``endpoint`` then names."""

    def __init__(self, endpoint: Endpoint) -> None:
        try:
            family, kind, proto, _, where = socket.getaddrinfo(
                endpoint.host, endpoint.port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
            )[0]
            self._socket = socket.socket(family, kind, proto)
        except OSError as error:
            raise LinkError(endpoint, tcp_message(error)) from None
        try:
            _reuse(self._socket)
            self._socket.bind(where)
            self._socket.listen(_BACKLOG)
        except OSError as error:
            self._socket.close()
            raise LinkError(endpoint, tcp_message(error)) from None
        self.endpoint = replace(endpoint, port=self._socket.getsockname()[1])

    def accept(self, timeout: float) -> TcpLink | None:
        try:
            if not select.select([self._socket], [], [], max(0.0, timeout))[0]:
                return None
            connection, peer = self._socket.accept()
        except (OSError, ValueError) as error:
            if isinstance(error, OSError) and error.errno in _PASSING:
                time.sleep(min(timeout, SLICE))
                return None
            raise LinkError(self.endpoint, tcp_message(error)) from None
        return TcpLink(Endpoint("tcp", host=peer[0], port=peer[1]), connection)

    def close(self) -> None:
        self._socket.close()


def connect_tcp(endpoint: Endpoint, timeout: float, look: Callable[[], None] = keep_waiting) -> TcpLink:
    """Connect to a listening control within ``timeout`` seconds; raises LinkError, and what ``look``
    raises.
    """
    # Nothing ends the search for a host's address before its time.
    made = in_time(
        partial(_connected, endpoint, timeout),
        socket.socket.close,
        timeout,
        look,
        lambda error: LinkError(endpoint, tcp_message(error)),
    )
    return TcpLink(endpoint, made, look)


def _connected(endpoint: Endpoint, timeout: float) -> socket.socket:
    return socket.create_connection((endpoint.host, endpoint.port), timeout=timeout)


def _reuse(listening: socket.socket) -> None:
    """Let a control that was killed listen at its port again at once.

    On Windows SO_REUSEADDR would let a second control share the port; there the port is free at once anyway.
    """
    exclusive = getattr(socket, "SO_EXCLUSIVEADDRUSE", None)
    if exclusive is not None:
        listening.setsockopt(socket.SOL_SOCKET, exclusive, 1)
    else:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)


def tcp_message(error: Exception) -> str:
    """Return an error of a socket in words."""
    if isinstance(error, TimeoutError):
        return "no answer in time"
    if isinstance(error, ConnectionRefusedError):
        return "nothing listens there"
    if isinstance(error, socket.gaierror):
        return "the host is not known"
    if isinstance(error, ConnectionResetError | BrokenPipeError):
        return "the other end has broken off the connection"
    if isinstance(error, UnicodeError):
        return "this cannot be the name of a host"
    if isinstance(error, ValueError):
        return "the connection is closed"
    return getattr(error, "strerror", None) or str(error)
