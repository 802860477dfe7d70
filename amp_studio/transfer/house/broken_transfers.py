"""Downloads that an earlier run of the program began and that a control may still have staged."""

from __future__ import annotations

import contextlib
import hashlib
import re
import time
from pathlib import Path

_SUFFIX = ".transfer"
LASTING = 7 * 24 * 3600.0  # seconds after which a download is not taken up again
MAX_KEPT = 32  # kept at most, the newest


class BrokenTransfers:
    """The transfer ids of begun downloads in a folder, a file each;
    a folder that cannot be written keeps none.

    An id is forgotten before its commit is asked for, so that an id taken up again was never committed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def find(self, what: bytes) -> bytes | None:
        """Return the id under which exactly this was begun, or None; ``what`` names image,
        control and all it depends on.
        """
        path = self._path(what)
        try:
            if time.time() - path.stat().st_mtime > LASTING:
                return None
            with path.open("rb") as stream:
                text = stream.read(64)
        except OSError:
            return None
        return bytes.fromhex(text.decode()) if re.fullmatch(rb"[0-9a-f]{32}", text) else None

    def keep(self, what: bytes, transfer: bytes) -> None:
        """Write down that this is begun."""
        with contextlib.suppress(OSError):
            self._folder.mkdir(parents=True, exist_ok=True)
            self._path(what).write_text(transfer.hex(), encoding="ascii")
            newest = sorted(self._folder.glob(f"*{_SUFFIX}"), key=lambda path: -path.stat().st_mtime)
            for path in newest[MAX_KEPT:]:
                path.unlink()

    def forget(self, what: bytes) -> None:
        """It is committed, or cancelled."""
        with contextlib.suppress(OSError):
            self._path(what).unlink()

    def _path(self, what: bytes) -> Path:
        return self._folder / f"{hashlib.sha256(what).hexdigest()[:32]}{_SUFFIX}"


class NoBrokenTransfers(BrokenTransfers):
    """Nothing is taken up again in another run."""

    def __init__(self) -> None:
        super().__init__(Path())

    def find(self, what: bytes) -> bytes | None:  # noqa: ARG002  # there is none
        """Return None."""
        return None

    def keep(self, what: bytes, transfer: bytes) -> None:
        """Keep nothing."""

    def forget(self, what: bytes) -> None:
        """Nothing was kept."""
