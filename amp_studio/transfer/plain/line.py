"""A link as these protocols use it: so many bytes within so many seconds, and a person who may break off."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.links import Link, LinkError
from amp_studio.transfer.progress import SILENT, Progress, quiet

from .blocks import CAN, CANCEL

LOOK = 0.1  # seconds between two looks at the cancel event
_SERIAL_QUIET, _SERIAL_NOISE = 0.1, 0.3  # seconds, where no network delays what was sent
_STORED = 65_536  # bytes that are kept until they are read
SILENT_AFTER = 1.8  # seconds without a byte until the person who waits is notified
_SILENT_EVERY = 1.0  # seconds until he is notified again


class PlainFileError(TransferError):
    """A file that did not get through; ``what`` includes what is known of the other end."""

    def __str__(self) -> str:
        return self.what


@dataclass(frozen=True)
class Patience:
    """Limits in seconds. ``start`` until the other end begins, ``answer`` for an answer, ``ask`` between two
    requests to begin,
    ``gap`` between two bytes of a block, ``noise`` for an answer that was disturbed, ``quiet`` after which a
    disturbed line has come to rest, ``stall`` without progress until the transfer is cancelled.
    """

    start: float = 60.0
    answer: float = 10.0
    ask: float = 3.0
    gap: float = 1.0
    noise: float = 1.0
    quiet: float = 0.3
    stall: float = 60.0


class ByteLine:
    """Reads and writes bytes; every wait has an end.
    Raises PlainFileError when the line is gone or ``cancel`` is set.
    """

    def __init__(
        self,
        link: Link,
        patience: Patience | None = None,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.patience = patience or Patience()
        self.progress = progress
        self.now = clock
        self._link = link
        self._cancel = cancel
        self._buffer = bytearray()
        self._received_at = self._reported_at = clock()

    @property
    def quiet(self) -> float:
        """Seconds after which a disturbed line has come to rest;
        on a serial line a gap is a fault much sooner.
        """
        return min(self.patience.quiet, _SERIAL_QUIET) if self._link.bytes_per_second else self.patience.quiet

    @property
    def noise(self) -> float:
        """Seconds for which an answer is waited for again that was disturbed."""
        return min(self.patience.noise, _SERIAL_NOISE) if self._link.bytes_per_second else self.patience.noise

    def get(self, count: int, seconds: float) -> bytes:
        """Return ``count`` bytes, or fewer where no further one has come for so long."""
        end = self.now() + seconds
        while len(self._buffer) < count:
            self.look()
            left = end - self.now()
            if left <= 0:
                break
            came = self._read(min(left, LOOK))
            if came:
                self._buffer += came
                end = self.now() + seconds
        data = bytes(self._buffer[:count])
        del self._buffer[:count]
        return data

    def waiting(self) -> bytes:
        """Return what has come already."""
        data = bytes(self._buffer) or self._read(0)
        self._buffer.clear()
        return data

    def put_back(self, data: bytes) -> None:
        """Have bytes read again."""
        self._buffer[:0] = data

    def put(self, data: bytes) -> float:
        """Write, and return when the last byte has left this end: a slow line takes its time after that."""
        began = self.now()
        try:
            self._link.write(data)
        except LinkError as error:
            raise self._lost(error) from None
        self.look()
        rate = self._link.bytes_per_second
        gone = max(self.now(), began + (len(data) / rate if rate else 0.0))
        self._received_at = self._reported_at = gone  # the other end cannot answer before
        return gone

    def await_time(self, when: float) -> None:
        """Wait until a time."""
        while (left := when - self.now()) > 0:
            self._buffer += self._read(min(left, LOOK))
            del self._buffer[:-_STORED]
            self.look()

    def cancel_transfer(self) -> None:
        """Cancel the transfer at the other end, if that still hears."""
        with contextlib.suppress(OSError):
            self._link.write(CANCEL)

    def drop(self) -> bool:
        """Forget what has come; returns whether the other end gives up in it (two CAN)."""
        return bytes([CAN, CAN]) in self.waiting()

    def wait_until_quiet(self) -> None:
        """Forget what comes until the line is quiet, for some seconds at most."""
        end = self.now() + max(3.0, 10 * self.quiet)
        while self.now() < end and (self._buffer or self.get(1, self.quiet)):
            self._buffer.clear()

    def look(self) -> None:
        """Raise PlainFileError where one of both ends has broken off; notify of silences."""
        if self._cancel is not None and self._cancel.is_set():
            raise PlainFileError("stopped")
        now = self.now()
        silent = now - self._received_at
        if silent >= SILENT_AFTER and now - self._reported_at >= _SILENT_EVERY:
            self._reported_at = now
            self.progress(SILENT, round(silent), round(self.patience.stall))

    def _read(self, seconds: float) -> bytes:
        try:
            came = self._link.read(seconds)
        except LinkError as error:
            raise self._lost(error) from None
        if came:
            was_silent = self._reported_at > self._received_at
            self._received_at = self._reported_at = self.now()
            if was_silent:
                self.progress(SILENT, 0, round(self.patience.stall))
        return came

    def _lost(self, error: LinkError) -> PlainFileError:
        return PlainFileError(f"the line is cut ({error})")
