"""Links over a serial port of this computer, for one program alone."""

from __future__ import annotations

import contextlib
import errno
import os
import select
import stat
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .endpoint import Endpoint
from .link import LinkError, keep_waiting
from .serial_settings import Flow, Parity

_SLICE = (
    0.05  # seconds a single read may block; setting another limit each time costs a system call on Windows
)
WRITE_LIMIT = 2.0  # seconds a tenth of a second's worth of bytes may take
FLOW_LIMIT = 60.0  # seconds the other end may hold the line by flow control
MOMENT = 0.02  # seconds between two looks at what has not left yet
_STANDSTILL = 0.2  # seconds in which a line that is not stopped moves at least a byte
LOOK = 0.1  # seconds between two looks while the line takes nothing
PIECE = 256  # bytes for which a port that reports room has some
_PSEUDO_TERMINALS = range(136, 144)  # their device numbers on Linux
_NO_PORT = "this is no serial port"
_GONE = "the port is gone: its adapter was unplugged or switched off"
_TAKEN = "another program has this port open"

_PARITY_LETTER: dict[Parity, str] = {"none": "N", "even": "E", "odd": "O", "mark": "M", "space": "S"}
"""As pyserial names them."""


class SerialLink:
    """One open port of pyserial."""

    def __init__(self, endpoint: Endpoint, port: Any, look: Callable[[], None] = keep_waiting) -> None:
        settings = endpoint.serial_settings()
        self._endpoint = endpoint
        self._port = port
        self._poll = look
        self._flow_limit = WRITE_LIMIT if settings.flow == "none" else FLOW_LIMIT
        self._piece = max(1, min(settings.baud // 100, PIECE))
        self.bytes_per_second: float | None = settings.bytes_per_second
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
            raise self._lost(error) from None

    def write(self, data: bytes) -> None:
        for start in range(0, len(data), self._piece):
            self._await_room()
            try:
                self._port.write(data[start : start + self._piece])
            except (OSError, TypeError, AttributeError) as error:
                raise self._lost(error) from None
            self._poll()

    def drain(self) -> None:
        """Wait until everything that was written has left;
        raises LinkError where the other end takes nothing.
        """
        waiting, end = -1, 0.0
        while (left := self._leaving()) > 0:
            self._poll()
            if left != waiting:
                waiting, end = left, time.monotonic() + self._flow_limit
            if time.monotonic() >= end:
                raise LinkError(self._endpoint, f"the other end has taken nothing for {self._flow_limit:g} s")
            time.sleep(MOMENT)

    def close(self) -> None:
        """Give the line up; what the other end stops by flow control is lost,
        or the system would wait for it.
        """
        with contextlib.suppress(OSError, TypeError, AttributeError):
            waiting, end = -1, 0.0
            while self.is_open and self._flow_limit == FLOW_LIMIT and (left := self._port.out_waiting) > 0:
                if left != waiting:
                    waiting, end = left, time.monotonic() + _STANDSTILL
                if time.monotonic() >= end:
                    self._port.reset_output_buffer()
                    break
                time.sleep(MOMENT)
        self.is_open = False
        with contextlib.suppress(OSError, TypeError, AttributeError):
            self._port.close()

    def _leaving(self) -> int:
        """Return how many bytes have been written and not left yet; 0 if unknown."""
        try:
            return int(getattr(self._port, "out_waiting", 0))
        except (OSError, TypeError) as error:
            raise self._lost(error) from None

    def _await_room(self) -> None:
        """Wait until the port takes a piece; pyserial's own waiting cannot be broken off."""
        end = time.monotonic() + self._flow_limit
        while not self._has_room():
            self._poll()
            if time.monotonic() >= end:
                raise LinkError(self._endpoint, f"the other end has taken nothing for {self._flow_limit:g} s")

    def _has_room(self) -> bool:
        """Wait for room a moment, where the system can be asked for it."""
        if os.name != "posix":
            return True
        try:
            return bool(select.select([], [self._port.fileno()], [], LOOK)[1])
        except (OSError, TypeError, AttributeError, ValueError) as error:
            raise self._lost(error) from None

    def _lost(self, error: Exception) -> LinkError:
        # pyserial meets a port that was closed with any of these, and one that was pulled out with an
        # OSError.
        if not self.is_open or isinstance(error, TypeError | AttributeError | ValueError):
            return LinkError(self._endpoint, "the port is closed")
        if "rite timeout" in str(error):
            return LinkError(self._endpoint, "the other end takes nothing more")
        if "closed the connection" in str(error):
            return LinkError(self._endpoint, "the server has closed the connection")
        return LinkError(self._endpoint, _GONE)


def _port_settings(endpoint: Endpoint, own_flow: bool) -> dict[str, Any]:
    """Return the settings of a line as pyserial takes them; ``own_flow`` leaves Xon and Xoff to the
    reader.
    """
    settings = endpoint.serial_settings()
    flow: Flow = "none" if own_flow and settings.flow == "xonxoff" else settings.flow
    return {
        "baudrate": settings.baud,
        "bytesize": settings.bits,
        "parity": _PARITY_LETTER[settings.parity],
        "stopbits": settings.stop,
        "xonxoff": flow == "xonxoff",
        "rtscts": flow == "rtscts",
    }


def open_port(
    endpoint: Endpoint, look: Callable[[], None] = keep_waiting, *, own_flow: bool = False
) -> SerialLink:
    """Open a serial port for this program alone; raises LinkError when it is missing or taken.

    ``own_flow``: the bytes Xon and Xoff are read like any other, and are not obeyed here.
    """
    import serial

    _need_port(endpoint)
    try:
        port = serial.Serial(
            endpoint.device,
            timeout=_SLICE,
            write_timeout=WRITE_LIMIT,
            exclusive=True,
            **_port_settings(endpoint, own_flow),
        )
        _claim(port)
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
        raise LinkError(endpoint, _NO_PORT)


def _claim(port: Any) -> None:
    """Keep programs out that do not ask for the lock pyserial takes.

    Not from a pseudo terminal: its other end keeps it open,
    and would keep the mark of a program that was killed.
    """
    if sys.platform == "win32" or os.major(os.fstat(port.fileno()).st_rdev) in _PSEUDO_TERMINALS:
        return
    import fcntl
    import termios

    with contextlib.suppress(OSError):
        fcntl.ioctl(port.fileno(), termios.TIOCEXCL)


class PortListener:
    """The control's side of a serial port: the line is there or not, without connections."""

    def __init__(self, endpoint: Endpoint) -> None:
        self.endpoint = endpoint
        self._link: SerialLink | None = open_port(endpoint)
        self._was_returned = False

    def accept(self, timeout: float) -> SerialLink | None:
        """Return the line once; after it was closed or lost, open it again when the port is there again."""
        if self._link is not None and not self._was_returned:
            self._was_returned = True
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
    for numbers, part, message in _MESSAGES:
        if number in numbers or (part and part in text):
            return message
    return os.strerror(number) if number else text or "the port cannot be opened"


# pyserial raises its own exception for most faults, on Windows without a number: then a part of its text is
# all that distinguishes them.
_MESSAGES: tuple[tuple[set[int], str, str], ...] = (
    ({errno.ENOTTY}, f"({errno.ENOTTY},", _NO_PORT),
    (set(), "Could not configure port", f"{_NO_PORT}, or one that cannot be set like this"),
    ({errno.ENOENT}, "FileNotFoundError", "there is no such port"),
    (
        {errno.EACCES},
        "PermissionError",
        "this port may not be opened (no permission, or another program has it)",
    ),
    ({errno.EAGAIN, errno.EBUSY}, "exclusively lock", _TAKEN),
    ({errno.EIO, errno.ENXIO, errno.ENODEV}, "", "nothing is connected to this port"),
)
"""Numbers of a fault, a part of its text, and what is shown for it; the first that fits."""
