"""What somebody who waits is told."""

from __future__ import annotations

from collections.abc import Callable

# (stage, done, total); the stages of a download are keep, download, commit, restart and verify.
Progress = Callable[[str, int, int], None]


def quiet(stage: str, done: int, total: int) -> None:
    """Tell nobody."""
