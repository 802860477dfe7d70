"""Links over a serial port: 8 data bits, no parity, 1 stop bit, no flow control."""

from __future__ import annotations

import contextlib
import errno
import os
import stat
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .endpoint import Endpoint
from .link import LinkError, keep_waiting

SLICE = (
    0.05  # seconds a single read may block; setting another limit each time costs a system call on Windows
)
WRITE_LIMIT = 2.0  # seconds a tenth of a second's worth of bytes may take
NO_PORT = "this is no serial port"


class SerialLink:
    """One open serial port."""

    def __init__(self, endpoint: Endpoint, port: Any, look: Callable[[], None] = keep_waiting) -> None:
        self._endpoint = endpoint
        self._port = port
        self._look = look
        self.bytes_per_second: float | None = endpoint.baud / 10.0  # start, eight data bits, stop
        self.is_open = True

    def read(self, timeout: float) -> bytes:
        end = time.monotonic() + timeout
        try:
            while True:
                waiting = self._port.in_waiting
                if waiting:
                    return bytes(self._port.read(waiting))
                if time.monotonic() >= end:
                    return b""
                first = bytes(self._port.read(1))
                if first:
                    return first + bytes(self._port.read(self._port.in_waiting))
        except (OSError, TypeError, AttributeError) as error:
            # pyserial meets a port that was closed or pulled out with any of these three.
            raise LinkError(self._endpoint, _message(error)) from None

    def write(self, data: bytes) -> None:
        piece = max(1, self._endpoint.baud // 100)
        for start in range(0, len(data), piece):
            try:
                self._port.write(data[start : start + piece])
            except (OSError, TypeError, AttributeError) as error:
                raise LinkError(self._endpoint, _message(error)) from None
            self._look()

    def close(self) -> None:
        self.is_open = False
        with contextlib.suppress(OSError, TypeError, AttributeError):
            self._port.close()


def open_port(endpoint: Endpoint, look: Callable[[], None] = keep_waiting) -> SerialLink:
    """Open a serial port for this program alone; raises LinkError when it is missing or taken."""
    import serial

    _need_port(endpoint)
    try:
        port = serial.Serial(
            endpoint.device,
            baudrate=endpoint.baud,
            timeout=SLICE,
            write_timeout=WRITE_LIMIT,
            exclusive=True,
        )
        port.reset_input_buffer()
    except (OSError, ValueError) as error:
        raise LinkError(endpoint, _message(error)) from None
    return SerialLink(endpoint, port, look)


def _need_port(endpoint: Endpoint) -> None:
    """Refuse what is there and is no serial port, without opening it: a file, a folder, a pipe, a disk."""
    if os.name != "posix":
        return
    try:
        kind = Path(endpoint.device).stat()
    except (OSError, ValueError):
        return  # what is not there is reported when it is opened
    if not stat.S_ISCHR(kind.st_mode):
        raise LinkError(endpoint, NO_PORT)


class PortListener:
    """The control's side of a serial port: the line is there or not, nobody connects."""

    def __init__(self, endpoint: Endpoint) -> None:
        self.endpoint = endpoint
        self._link: SerialLink | None = open_port(endpoint)
        self._given = False

    def accept(self, timeout: float) -> SerialLink | None:
        """Return the line once; after it was closed or lost, open it anew when the port is there again."""
        if self._link is not None and not self._given:
            self._given = True
            return self._link
        if self._link is not None and self._link.is_open:
            return None
        try:
            self._link = open_port(self.endpoint)
        except LinkError:
            time.sleep(timeout)
            return None
        return self._link

    def close(self) -> None:
        if self._link is not None:
            self._link.close()


def _message(error: Exception) -> str:
    number = getattr(error, "errno", None)
    text = str(error)
    if number == errno.ENOTTY or f"({errno.ENOTTY}," in text:
        return NO_PORT
    if "Could not configure port" in text:
        return f"{NO_PORT}, or one that cannot be set to this rate"
    if number == 2 or "FileNotFoundError" in text:
        return "there is no such port"
    if number == 13 or "PermissionError" in text:
        return "this port may not be opened (no permission, or another program has it)"
    if number == 11 or "exclusively lock" in text:
        return "another program has this port open"
    if isinstance(error, TypeError | AttributeError):
        return "the port is closed"
    return os.strerror(number) if number else text or "the port is gone"
