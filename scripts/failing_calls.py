"""Makes the n-th system call of an act fail, for every n: after each failure a caller looks at what is left.

What fails is one call alone or every call from it on, with an error of the system or with Ctrl-C. The calls
of Python's own machinery (imports) are made before, by running the act once.
"""

import contextlib
import errno
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any

CALLS = (
    "open",
    "fdopen",
    "read",
    "write",
    "lseek",
    "fsync",
    "close",
    "replace",
    "rename",
    "link",
    "unlink",
    "stat",
    "lstat",
    "fstat",
    "chmod",
    "fchmod",
    "fchown",
    "listxattr",
    "getxattr",
    "setxattr",
    "readlink",
)
FAILURES = ("ENOSPC", "EIO", "EACCES", "interrupt")
MAX_CALLS = 2_000
"""Calls an act may make before something must be wrong."""


@dataclass(frozen=True)
class Ended:
    """How an act ended of which a call failed."""

    at: int
    """Which call failed, counted from 1; in the last of all none did."""
    call: str
    """Its name; empty where none failed."""
    failure: str
    for_ever: bool
    error: BaseException | None
    """What came out of the act."""


class _Calls:
    """Counts the calls and lets some of them fail."""

    def __init__(self, at: int, failure: str, *, for_ever: bool) -> None:
        self._at, self._failure, self._for_ever = at, failure, for_ever
        self.made: list[str] = []

    @contextlib.contextmanager
    def patched(self) -> Iterator[None]:
        """Take the place of the system's calls."""
        originals: list[tuple[ModuleType, str, Any]] = [
            (os, name, getattr(os, name)) for name in CALLS if hasattr(os, name)
        ]
        if sys.platform != "win32":
            import fcntl

            originals.append((fcntl, "flock", fcntl.flock))
        try:
            for module, name, original in originals:
                setattr(module, name, self._failing(name, original))
            yield
        finally:
            for module, name, original in originals:
                setattr(module, name, original)

    def _failing(self, name: str, original: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **options: Any) -> Any:
            self.made.append(name)
            n = len(self.made)
            if n != self._at and not (self._for_ever and n > self._at):
                return original(*arguments, **options)
            if name == "close":
                original(*arguments, **options)  # a close that fails has closed anyway
            if self._failure == "interrupt":
                raise KeyboardInterrupt
            number = getattr(errno, self._failure)
            raise OSError(number, os.strerror(number))

        return call


def each_failure(
    prepare: Callable[[], object],
    act: Callable[[], object],
    *,
    failures: Sequence[str] = FAILURES,
    lasting: Sequence[bool] = (False, True),
    which: Callable[[int], bool] = lambda _at: True,
) -> Iterator[Ended]:
    """Yield how an act ends for each call that fails and each way to fail,
    and last of each how it ends untouched.

    ``prepare`` brings the disk back to where the act begins; ``which`` takes a sample of the calls (seeded,
    say) where all of them take too long. Ctrl-C comes once: a person stops a program once.
    """
    prepare()
    act()
    for failure in failures:
        for for_ever in lasting if failure != "interrupt" else (False,):
            for at in filter(which, range(1, MAX_CALLS)):
                prepare()
                calls, error = _Calls(at, failure, for_ever=for_ever), None
                try:
                    with calls.patched():
                        act()
                except (Exception, KeyboardInterrupt) as raised:
                    error = raised
                failed = at <= len(calls.made)
                yield Ended(at, calls.made[at - 1] if failed else "", failure, for_ever, error)
                if not failed:
                    break
            else:
                raise AssertionError(f"more than {MAX_CALLS} calls: it never passed")
