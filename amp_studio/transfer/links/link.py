"""Byte links: what carries the bytes of an exchange, whatever it is made of.

A link moves bytes and knows nothing of frames. It may lose, change or cut
off what it carries; the layers above live with that.
"""

from __future__ import annotations

from typing import Protocol

from amp_studio.errors import AmpStudioError
from amp_studio.schema import visible

from .endpoint import Endpoint

_LONGEST_SHOWN = 200
"""Characters of an endpoint in a message; the name of a port by its maker and number has about 70."""


class LinkError(AmpStudioError, OSError):
    """A link that cannot be made or is gone: ``endpoint`` names it, ``what`` what happened."""

    def __init__(self, endpoint: Endpoint | str, what: str) -> None:
        super().__init__(f"{visible(str(endpoint)[:_LONGEST_SHOWN])}: {what}")
        self.endpoint = endpoint
        self.what = what


class Link(Protocol):
    """One open line to the other end."""

    @property
    def bytes_per_second(self) -> float | None:
        """What the line can carry each way; None if that is not known or does not matter."""

    def read(self, timeout: float) -> bytes:
        """Return what has come, at the latest after ``timeout`` seconds (then b""); raises LinkError."""

    def write(self, data: bytes) -> None:
        """Hand over all bytes; raises LinkError when the line is gone or takes nothing more, and what the
        link was asked to call while it waits raises.
        """

    def close(self) -> None:
        """Give the line up. Closing twice is no fault."""


class Listener(Protocol):
    """Where a control waits for a client."""

    @property
    def endpoint(self) -> Endpoint:
        """The endpoint a client connects to, with the real port or device."""

    def accept(self, timeout: float) -> Link | None:
        """Return the next line, or None after ``timeout`` seconds; raises LinkError."""

    def close(self) -> None:
        """Wait no longer."""


def keep_waiting() -> None:
    """Be called by a link that waits, when nothing speaks against it."""
