"""Byte links: what carries the bytes of an exchange, whatever it is made of.

A link moves bytes and knows nothing of frames. It may lose, change or cut
off what it carries; the layers above live with that.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from .address import Address


class LinkError(OSError):
    """A link that cannot be made or is gone: ``address`` says which, ``what`` what happened."""

    def __init__(self, address: Address | str, what: str) -> None:
        super().__init__(f"{address}: {what}")
        self.address = address
        self.what = what


class Link(Protocol):
    """One open line to the other end."""

    @property
    def bytes_per_second(self) -> float | None:
        """What the line can carry each way; None where that is not known or does not matter."""

    def read(self, timeout: float) -> bytes:
        """Return what has come, at the latest after ``timeout`` seconds (then b""); raises LinkError."""

    def write(self, data: bytes) -> None:
        """Hand over all bytes; raises LinkError when the line is gone or takes nothing more, and what the
        link was told to call while it waits raises.
        """

    def close(self) -> None:
        """Give the line up. Closing twice is no fault."""


class Listener(Protocol):
    """Where a control waits for a client."""

    @property
    def address(self) -> Address:
        """The address a client connects to, with the real port or device."""

    def accept(self, timeout: float) -> Link | None:
        """Return the next line, or None after ``timeout`` seconds; raises LinkError."""

    def close(self) -> None:
        """Wait no longer."""


def keep_waiting() -> None:
    """Be called by a link that waits, when nothing speaks against it."""


def connect(address: Address, timeout: float = 3.0, look: Callable[[], None] = keep_waiting) -> Link:
    """Open the line to a control, within ``timeout`` seconds; raises LinkError.

    ``look`` is called at least every 0.1 s while opening and writing wait, and may raise to break off.
    """
    if address.kind == "tcp":
        from .tcp import connect_tcp

        return connect_tcp(address, timeout, look)
    if address.kind == "serial":
        from .serial_line import open_port

        return open_port(address, look)
    raise LinkError(
        address, "a pseudo terminal can only be listened on; connect to the serial: name it was given"
    )


def listen(address: Address) -> Listener:
    """Open the control's side of a line; raises LinkError when the place is taken or does not exist."""
    if address.kind == "tcp":
        from .tcp import TcpListener

        return TcpListener(address)
    if address.kind == "serial":
        from .serial_line import PortListener

        return PortListener(address)
    from .pseudo_terminal import PtyListener

    return PtyListener()
