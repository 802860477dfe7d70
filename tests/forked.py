"""The program in a process that is copied from this one, where that can be: what a new interpreter loads
in half a second is there at once.
"""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NoReturn, TextIO

from amp_studio import cli
from amp_studio.cli import program
from amp_studio.files import new_file
from amp_studio.schema.registration import load_part
from amp_studio.transfer.emulated.family_control import emulators_of
from amp_studio.transfer.image import decode_image, encode_image


class Forked:
    """A copy of this process that is another program; of `subprocess.Popen` it has what tests use."""

    def __init__(self, main: Callable[[list[str]], int], words: list[str]) -> None:
        (takes, gives), (reads, writes) = os.pipe(), os.pipe()
        sys.stdout.flush()
        sys.stderr.flush()
        self.pid = os.fork()
        if self.pid == 0:
            self._be(main, words, takes, writes)
        os.close(takes)
        os.close(writes)
        self.stdin: TextIO = os.fdopen(gives, "w", encoding="utf-8")
        self.stdout: TextIO = os.fdopen(reads, encoding="utf-8")
        self.returncode: int | None = None

    @staticmethod
    def _be(main: Callable[[list[str]], int], words: list[str], takes: int, writes: int) -> None:
        """Become the program: nothing of the tests is flushed, closed or reported when it ends."""
        code = 70
        try:
            os.dup2(takes, 0)
            os.dup2(writes, 1)
            os.closerange(3, 1_024)  # lines and files of other tests
            sys.stdin = os.fdopen(0, encoding="utf-8")
            sys.stdout = os.fdopen(1, "w", encoding="utf-8")
            sys.stderr = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w", encoding="utf-8")
            signal.signal(signal.SIGINT, signal.default_int_handler)
            code = main(words)
            sys.stdout.flush()
        finally:
            os._exit(code)

    def poll(self) -> int | None:
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self.returncode = os.waitstatus_to_exitcode(status)
        return self.returncode

    def wait(self, timeout: float = 60.0) -> int:
        end = time.monotonic() + timeout
        while (code := self.poll()) is None:
            if time.monotonic() > end:
                raise subprocess.TimeoutExpired(str(self.pid), timeout)
            time.sleep(0.002)
        return code

    def send_signal(self, number: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, number)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)

    def communicate(self) -> tuple[str, str]:
        if not self.stdin.closed:
            self.stdin.close()
        printed = ""
        if not self.stdout.closed:
            with self.stdout:
                printed = self.stdout.read()
        self.wait()
        return printed, ""


@cache
def _work_out(family: str) -> None:
    """Work out, before a copy is made, what every emulated control of a family needs at its start."""
    for part in emulators_of(family).values():
        load_part(part)
    decode_image(encode_image(new_file(family)))


Program = Any
"""A `Forked`, or a `subprocess.Popen` where processes cannot be copied."""


def start_program(*words: object, script: ModuleType | None = None) -> Program:
    """Start the program, or the ``main`` of a script, with the words of a command line;
    its standard output and input are texts.
    """
    arguments = [str(word) for word in words]
    if hasattr(os, "fork") and threading.current_thread() is threading.main_thread():
        if words[0] == "emulate":
            _work_out(arguments[1])
        return Forked(cli.run if script is None else lambda words: script.main(*words), arguments)
    main = ["-m", "amp_studio.cli"] if script is None else [str(script.__file__)]
    command = [sys.executable, *main, *arguments]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ended(*words: object, closed: Collection[int] = (), **streams: int) -> tuple[int, str]:
    """Run the program to its end, as ``start`` does. Returns its exit code, and what it has printed on
    standard error unless ``stderr`` is given. Handles in ``closed`` are those that a shell has closed.
    """
    arguments = [str(word) for word in words]
    with tempfile.TemporaryFile() as printed, Path(os.devnull).open("r+b") as nothing:
        handles = (
            nothing.fileno(),
            streams.get("stdout", nothing.fileno()),
            streams.get("stderr", printed.fileno()),
        )
        pid = os.fork()
        if pid == 0:
            _be_started(arguments, handles, closed)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        printed.seek(0)
        return code, printed.read().decode()


def _be_started(words: list[str], handles: Sequence[int], closed: Collection[int]) -> NoReturn:
    """Become the program on these handles, with the streams that Python makes of them at its start."""
    code: object = 70
    try:
        for number, handle in enumerate([os.dup(handle) for handle in handles]):
            os.dup2(handle, number)
        for number in closed:
            os.close(number)
        sys.stdin, sys.stdout, sys.stderr = (
            None if number in closed else os.fdopen(number, mode, encoding="utf-8")
            for number, mode in enumerate("rww")
        )
        program.start(words)
    except SystemExit as end:
        code = end.code
    finally:
        os._exit(code if isinstance(code, int) else 70)


@contextmanager
def emulated(family: str, state: Path, *options: str) -> Iterator[tuple[Program, str]]:
    """Start an emulated control on a free port; gives it and where it listens, and ends it."""
    control = start_program("emulate", family, "--listen", "tcp://127.0.0.1:0", "--state", state, *options)
    try:
        yield control, control.stdout.readline().removeprefix("listening on ").strip()
    finally:
        control.kill()
        control.communicate()
