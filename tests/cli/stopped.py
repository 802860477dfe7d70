"""Stops the program at moments that chance chooses, and compares its exit code with the disk."""

import contextlib
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from amp_studio.files import EditLock

LONGEST = 0.8
"""Seconds after the start within which it is stopped; a verb takes about as long."""


PROGRAM = """
import _signal, os, sys
_signal.signal(_signal.SIGINT, _signal.SIG_DFL)
os.close(int(sys.argv.pop(1)))
from amp_studio.cli import main
main()
"""
"""The program from its first statement on: what Python prints about a Ctrl-C while it starts itself is not
the program's."""


@contextlib.contextmanager
def started(*arguments: object, shell: str = "") -> Iterator[subprocess.Popen[str]]:
    """Start the program and give it as soon as its first statement has run, however busy the machine is.

    It shows this by closing a pipe. ``shell`` is a script that becomes the program with its ``exec "$@"``.
    """
    reading, writing = os.pipe()
    command: Sequence[str] = [sys.executable, "-c", PROGRAM, str(writing), *map(str, arguments)]
    if shell:
        command = ["bash", "-c", shell, "bash", *command]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, pass_fds=[writing]
    ) as program:
        os.close(writing)
        with os.fdopen(reading, "rb") as pipe:
            pipe.read()
        yield program


def set_while_stopped(path: Path, *, seed: int, rounds: int) -> list[str]:
    """Change a value again and again and stop each change; return what was not true of it."""
    chance = random.Random(seed)
    faults = []
    for number in range(rounds):
        before, delay = path.read_bytes(), chance.uniform(0, LONGEST)
        again = chance.random() < 0.3
        code, message = _stopped(path, f"1300={number + 1}.125", delay, again)
        changed = path.read_bytes() != before
        # By the signal itself (-2) where it comes before anything is loaded.
        fits = {0: changed, 2: not changed, 3: changed, -signal.SIGINT: not changed}.get(code, False)
        if (
            not fits
            or "Traceback" in message
            or "ignored" in message
            or (code == 3) != ("has been changed" in message)
        ):
            faults.append(f"seed {seed}, round {number}, after {delay:.3f} s: {code}, {changed}, {message!r}")
        # A signal between the system's call and what remembers its result leaves a lock file that is free,
        # as a killed program does: the next one takes it and removes it.
        with EditLock(path):
            pass
        if left := [p.name for p in path.parent.iterdir() if p.suffix in (".tmp", ".lock", ".holder")]:
            faults.append(f"seed {seed}, round {number}, after {delay:.3f} s: left {left}")
    return faults


def _stopped(path: Path, assignment: str, delay: float, again: bool) -> tuple[int, str]:
    with started("set", path, assignment) as program:
        time.sleep(delay)
        program.send_signal(signal.SIGINT)
        if again:
            time.sleep(0.01)
            program.send_signal(signal.SIGINT)
        _, message = program.communicate(timeout=120)
    return program.returncode, message
