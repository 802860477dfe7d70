"""The download an emulated control has begun to take, in a separate file, so that it can be resumed."""

from __future__ import annotations

import contextlib
import hashlib
from dataclasses import asdict, dataclass

from .memory import LARGEST, Memory
from .record import StateError, load_json, to_json

_PREFIX = "staged-"


@dataclass(frozen=True)
class PendingDownload:
    """What a download is to become: ``size`` bytes with this digest, in the place of ``expected``."""

    transfer: bytes
    size: int
    sha256: bytes
    expected: bytes

    @property
    def part(self) -> str:
        """The file its bytes are collected in."""
        return f"{_PREFIX}{self.transfer.hex()}.part"

    @property
    def is_sound(self) -> bool:
        """Whether the fields are what the wire can carry."""
        lengths = len(self.transfer), len(self.sha256), len(self.expected)
        return lengths == (16, 32, 32) and type(self.size) is int and 0 <= self.size <= LARGEST

    @property
    def record_name(self) -> str:
        """The file it is written down in."""
        return f"{_PREFIX}{self.transfer.hex()}.json"


class Staging:
    """At most one download, taken up again after a restart. ``size`` is how many of its bytes have come.

    Raises StateError, OSError for what cannot be read, and has written nothing then;
    ``tidy`` removes the rest.
    """

    def __init__(self, memory: Memory) -> None:
        self._memory = memory
        self.pending: PendingDownload | None = None
        self.size = 0
        for name in memory.names():
            if self.pending is None and name.startswith(_PREFIX) and name.endswith(".json"):
                self.pending = self._load(name)
        if self.pending is not None:
            self.size = memory.size(self.pending.part)

    def begin(self, pending: PendingDownload) -> None:
        """Throw away what was begun before and begin this; raises OSError."""
        self.drop()
        record = {
            name: value.hex() if isinstance(value, bytes) else value
            for name, value in asdict(pending).items()
        }
        # The record first: bytes without one belong to no download, and are removed at the next start.
        self._memory.replace(pending.record_name, to_json(record))
        self._memory.append(pending.part, b"")
        self.pending, self.size = pending, 0

    def add(self, pending: PendingDownload, content: bytes) -> None:
        """Add bytes to the end; raises OSError, and then nothing was added."""
        self._memory.append(pending.part, content)
        self.size += len(content)

    def content(self, pending: PendingDownload) -> bytes | None:
        """Return what has come if it has the digest it was to have, else None."""
        content = self._memory.read(pending.part)
        if (
            content is None
            or len(content) != pending.size
            or hashlib.sha256(content).digest() != pending.sha256
        ):
            return None
        return content

    def drop(self) -> None:
        """Throw away what was begun. What cannot be removed now is removed at the next start."""
        pending, self.pending, self.size = self.pending, None, 0
        if pending is not None:
            for name in (pending.part, pending.record_name):
                with contextlib.suppress(OSError):
                    self._memory.remove(name)

    def _load(self, name: str) -> PendingDownload:
        found = load_json(self._memory, name) or {}
        pending: PendingDownload | None
        try:
            pending = PendingDownload(
                bytes.fromhex(found["transfer"]),
                found["size"],
                bytes.fromhex(found["sha256"]),
                bytes.fromhex(found["expected"]),
            )
        except (KeyError, TypeError, ValueError):
            pending = None
        if pending is None or not pending.is_sound or pending.record_name != name:
            raise StateError(f"{self._memory.folder / name} is damaged")
        return pending

    def tidy(self) -> None:
        """Remove what belongs to no download, and one of which more has come than there is."""
        if self.pending is not None and self.size > self.pending.size:
            self.drop()
        wanted = {self.pending.record_name, self.pending.part} if self.pending is not None else set()
        for name in self._memory.names():
            if name.startswith(_PREFIX) and name not in wanted:
                self._memory.remove(name)
