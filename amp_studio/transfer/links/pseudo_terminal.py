"""The control's side of a pseudo terminal: a serial port without a cable, where the system has them."""

from __future__ import annotations

import contextlib
import os
import re
import select
import sys
import time

from .endpoint import Endpoint
from .link import LinkError

WRITE_LIMIT = 1.0  # seconds until bytes that are not read are lost, as on an unplugged cable
_READ_SIZE = 65_536
_LAST_READS = 16


class PtyLink:
    """One use of a pseudo terminal; closing it leaves the terminal and its name."""

    bytes_per_second: float | None = None

    def __init__(self, endpoint: Endpoint, master: int, slave: int) -> None:
        self._endpoint = endpoint
        self._master = master
        self._slave = slave
        self.is_open = True

    def read(self, timeout: float) -> bytes:
        if not self.is_open:
            raise LinkError(self._endpoint, "the port is closed")
        try:
            if not select.select([self._master], [], [], max(0.0, timeout))[0]:
                return b""
            return os.read(self._master, _READ_SIZE)
        except (OSError, ValueError) as error:
            raise LinkError(self._endpoint, str(error)) from None

    def write(self, data: bytes) -> None:
        if not self.is_open:
            raise LinkError(self._endpoint, "the port is closed")
        end = time.monotonic() + WRITE_LIMIT
        rest = memoryview(data)
        while rest:
            try:
                if not select.select([], [self._master], [], max(0.0, end - time.monotonic()))[1]:
                    return
                rest = rest[os.write(self._master, rest) :]
            except BlockingIOError:
                continue
            except (OSError, ValueError) as error:
                raise LinkError(self._endpoint, str(error)) from None

    def client_settings(self) -> tuple[int, int]:
        """Return the rate in bit/s and the stop bits that the client has set;
        a pseudo terminal knows no parity.
        """
        if sys.platform == "win32":  # PtyListener refuses this system
            raise NotImplementedError
        import termios

        set_to = termios.tcgetattr(self._slave)
        rates = {
            getattr(termios, name): int(name[1:]) for name in dir(termios) if re.fullmatch(r"B[1-9]\d*", name)
        }
        return rates.get(set_to[4], 0), 2 if set_to[2] & termios.CSTOPB else 1

    def close(self) -> None:
        self.is_open = False


class PtyListener:
    """A new pseudo terminal; ``endpoint`` names the port a client opens."""

    endpoint: Endpoint
    _master: int
    _slave: int

    def __init__(self) -> None:
        self._link: PtyLink | None = None
        if sys.platform == "win32":
            raise LinkError(
                "pty:", "this system has no pseudo terminals; use a pair of serial ports or tcp://"
            )
        import tty

        try:
            # The control keeps the client's side open too: the terminal then outlives each client.
            self._master, self._slave = os.openpty()
            tty.setraw(self._slave)
            os.set_blocking(self._master, False)
            self.endpoint = Endpoint("serial", device=os.ttyname(self._slave))
        except OSError as error:
            raise LinkError("pty:", str(error)) from None

    def accept(self, timeout: float) -> PtyLink | None:  # noqa: ARG002  # nothing here is waited for
        """Return the link; None while one is in use, as a serial port has no connections."""
        if self._link is not None and self._link.is_open:
            return None
        with contextlib.suppress(OSError):
            for _ in range(_LAST_READS):
                os.read(self._master, _READ_SIZE)  # what was sent while no control listened is lost
        self._link = PtyLink(self.endpoint, self._master, self._slave)
        return self._link

    def close(self) -> None:
        if self._link is not None:
            self._link.close()
        handles, self._master, self._slave = (self._master, self._slave), -1, -1
        for handle in handles:  # a handle that is closed twice may be another file's by then
            with contextlib.suppress(OSError):
                os.close(handle)
