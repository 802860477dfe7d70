"""Links over TCP."""

from __future__ import annotations

import contextlib
import select
import socket

from .address import Address
from .link import LinkError

WRITE_LIMIT = 10.0  # seconds the other end may take nothing before the line counts as gone
READ_SIZE = 65_536


class TcpLink:
    """One TCP connection, without Nagle's delay: a frame goes out when it is written."""

    bytes_per_second: float | None = None

    def __init__(self, address: Address, connection: socket.socket) -> None:
        self._address = address
        self._socket = connection
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def read(self, timeout: float) -> bytes:
        try:
            # A timeout of 0 would make the socket non-blocking, which select says more plainly.
            if not select.select([self._socket], [], [], max(0.0, timeout))[0]:
                return b""
            data = self._socket.recv(READ_SIZE)
        except (OSError, ValueError) as error:
            raise LinkError(self._address, _said(error)) from None
        if not data:
            raise LinkError(self._address, "the other end has closed the connection")
        return data

    def write(self, data: bytes) -> None:
        try:
            self._socket.settimeout(WRITE_LIMIT)
            self._socket.sendall(data)
        except OSError as error:
            raise LinkError(self._address, _said(error)) from None

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)
            # What came and was not read would make the system break the connection off, last answer and all.
            self._socket.setblocking(False)
            while self._socket.recv(READ_SIZE):
                pass
        self._socket.close()


class TcpListener:
    """Waits at one host and port; port 0 takes a free one, which ``address`` then names."""

    def __init__(self, address: Address) -> None:
        try:
            family, kind, proto, _, where = socket.getaddrinfo(
                address.host, address.port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
            )[0]
            self._socket = socket.socket(family, kind, proto)
        except OSError as error:
            raise LinkError(address, _said(error)) from None
        try:
            _reuse(self._socket)
            self._socket.bind(where)
            self._socket.listen(4)
        except OSError as error:
            self._socket.close()
            raise LinkError(address, _said(error)) from None
        self.address = Address("tcp", host=address.host, port=self._socket.getsockname()[1])

    def accept(self, timeout: float) -> TcpLink | None:
        try:
            if not select.select([self._socket], [], [], max(0.0, timeout))[0]:
                return None
            connection, peer = self._socket.accept()
        except (OSError, ValueError) as error:
            raise LinkError(self.address, _said(error)) from None
        return TcpLink(Address("tcp", host=peer[0], port=peer[1]), connection)

    def close(self) -> None:
        self._socket.close()


def connect_tcp(address: Address, timeout: float) -> TcpLink:
    """Connect to a listening control within ``timeout`` seconds; raises LinkError."""
    try:
        connection = socket.create_connection((address.host, address.port), timeout=timeout)
    except OSError as error:
        raise LinkError(address, _said(error)) from None
    return TcpLink(address, connection)


def _reuse(listening: socket.socket) -> None:
    """Let a control that was killed listen at its port again at once.

    On Windows SO_REUSEADDR would let a second control share the port; there the port is free at once anyway.
    """
    exclusive = getattr(socket, "SO_EXCLUSIVEADDRUSE", None)
    if exclusive is not None:
        listening.setsockopt(socket.SOL_SOCKET, exclusive, 1)
    else:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)


def _said(error: OSError | ValueError) -> str:
    if isinstance(error, TimeoutError):
        return "no answer in time"
    if isinstance(error, ConnectionRefusedError):
        return "nothing listens there"
    if isinstance(error, socket.gaierror):
        return "the host is not known"
    if isinstance(error, ConnectionResetError | BrokenPipeError):
        return "the other end has broken off the connection"
    if isinstance(error, ValueError):
        return "the connection is closed"
    return error.strerror or str(error)
