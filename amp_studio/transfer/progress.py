"""What a waiting user reads, and how the wait is stopped."""

from __future__ import annotations

import threading
from collections.abc import Callable

# (stage, done, total); the stages of a download are keep, download, commit, restart and verify. Between them
# comes SILENT with the seconds for which nothing that was waited for has come and those after which the
# control is cancelled; done is 0 when it has come. CUT comes when the line has broken and is made again.
Progress = Callable[[str, int, int], None]

SILENT = "silent"
CUT = "cut"


def quiet(stage: str, done: int, total: int) -> None:
    """Show nothing."""


class Stop(threading.Event):
    """A cancel event that can be set twice: a person who does so does not want to wait for a commit
    either.
    """

    def __init__(self) -> None:
        super().__init__()
        self.is_urgent = False

    def set(self) -> None:
        """Ask for the end; asked again, without seeing anything through."""
        self.is_urgent = self.is_set()
        super().set()
