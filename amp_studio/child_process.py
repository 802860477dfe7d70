"""How a process apart is begun: for what keeps memory, cannot be interrupted, or may end its process; and how
the command line uses a second processor.

A process apart runs one function of the program and nothing of the program that asks: a process of
multiprocessing runs the script of a library's caller once more, with whatever that script does at a control.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NoReturn, TypeVar, overload

_T = TypeVar("_T")
_own: list[bool] = []
_copies: list[int] = []
"""The copies of this process that are at work."""


def declare_command_line() -> None:
    """Say that this process is the command line from its start to its end: ``beside`` may copy it."""
    _own.append(True)


class Awaited(Sequence[_T]):
    """What is made beside, or here when it is asked for: a sequence that waits for it at the first look."""

    def __init__(self, made: Iterable[_T]) -> None:
        self._made: Iterable[_T] | None = made
        self._found: tuple[_T, ...] = ()

    def _all(self) -> tuple[_T, ...]:
        if self._made is not None:
            self._found, self._made = tuple(self._made), None
        return self._found

    @overload
    def __getitem__(self, at: int) -> _T: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[_T, ...]: ...
    def __getitem__(self, at: int | slice) -> _T | tuple[_T, ...]:
        return self._all()[at]

    def __len__(self) -> int:
        return len(self._all())

    def __iter__(self) -> Iterator[_T]:
        return iter(self._all())

    def __reduce__(self) -> tuple[type[tuple[_T, ...]], tuple[tuple[_T, ...]]]:
        return tuple, (self._all(),)


def beside(make: Callable[[], Iterable[_T]]) -> Iterator[_T]:
    """Yield what ``make`` returns; where another processor has nothing to do, it is made there from now on.

    That is a copy of this process, which has all that was read already. A library's caller may have threads,
    which no copy has, and a copy is not safe on every system: there, and where no process can be begun or one
    ended early, it is made here when it is asked for.
    """
    # One more than there are processors would only take time from a copy that is waited for.
    if sys.platform != "linux" or not _own or len(os.sched_getaffinity(0)) < 2 + len(_copies):
        return _here(make)
    answer, out = os.pipe()
    try:
        copy = os.fork()
    except OSError:
        os.close(answer)
        os.close(out)
        return _here(make)
    if not copy:
        _answer(make, out)
    os.close(out)
    _copies.append(copy)
    return _of_copy(make, copy, answer)


def _here(make: Callable[[], Iterable[_T]]) -> Iterator[_T]:
    yield from make()


def _of_copy(make: Callable[[], Iterable[_T]], copy: int, answer: int) -> Iterator[_T]:
    """Yield what a copy has made, read from its pipe; made here where the copy ended in an error."""
    import pickle

    # Before it is waited for: a copy with more than fits into the pipe ends only when it is read.
    with open(answer, "rb") as file:
        content = file.read()
    _, status = os.waitpid(copy, 0)
    _copies.remove(copy)
    # An error of the work is met here again, and raised to the caller.
    yield from make() if status else pickle.loads(content)  # noqa: S301  # the program itself has written it


def _answer(make: Callable[[], Iterable[_T]], out: int) -> NoReturn:
    """Be the copy: write what was made, and end with nothing of this process done twice."""
    code = 1
    try:
        import pickle
        import signal

        # Ctrl-C comes to both: the copy ends in silence, and the program itself gives the message.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream in range(3):  # a reader of the results shall not wait for the copy
            os.dup2(nothing, stream)
        content = pickle.dumps(tuple(make()), pickle.HIGHEST_PROTOCOL)
        with open(out, "wb") as file:
            file.write(content)
        code = 0
    finally:
        os._exit(code)


def child_command(module: str, function: str) -> list[str]:
    """Return the command line of a process that calls ``function(asked, out)`` of a module with its input and
    its output, as bytes.

    The process finds the program where this one did, and nothing else that lies in its folder (``-P``).
    """
    # The folder is an argument, as in the text of the script it would have to be quoted.
    call = f"from {module} import {function}; {function}(sys.stdin.buffer, sys.stdout.buffer)"
    script = f"import sys; sys.path.insert(0, sys.argv.pop()); {call}"
    return [sys.executable, "-P", "-c", script, str(Path(__file__).parents[1])]
