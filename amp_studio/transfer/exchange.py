"""What goes along with one exchange with a control: who watches it, who may stop it,
where it is kept and recorded.
"""

from __future__ import annotations

import hashlib
import threading
from dataclasses import dataclass
from pathlib import Path

from amp_studio.files import Notify

from .progress import Progress, quiet


@dataclass(frozen=True)
class Exchange:
    """One exchange, as those see it who have asked for it; by default nothing is shown, kept or recorded.

    ``progress``  is called for steps and silences
    ``cancel``    breaks off what waits; may be set from another thread
    ``keep``      where a copy of what is replaced is kept: its folder takes the copies, its stem begins their
                  names
    ``record``    the file in whose folder the exchange is recorded
    ``notify``    is called with what does not end the exchange: that it could not be recorded
    """

    progress: Progress = quiet
    cancel: threading.Event | None = None
    keep: Path | None = None
    record: Path | None = None
    notify: Notify = lambda _: None

    @property
    def is_stopped(self) -> bool:
        """Whether a stop was asked for."""
        return self.cancel is not None and self.cancel.is_set()


QUIET = Exchange()


@dataclass(frozen=True)
class Replacement:
    """One download as a driver takes it: ``content`` instead of ``current``, which the control contains.

    ``signature``  of the schema under which the content was made; "" for an unknown one
    """

    content: bytes
    current: bytes
    signature: str = ""

    @property
    def current_digest(self) -> bytes:
        """The SHA-256 of what may be replaced, and of nothing else."""
        return hashlib.sha256(self.current).digest()
