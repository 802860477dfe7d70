"""A process apart that makes parts of a sweep.

It runs nothing of the program that asks. A process of multiprocessing runs the script of a library's caller
once more, with whatever that script does at a control.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

from amp_studio.sim.tuning.sampled import Matrix

from .job import SweepJob, figures_of

_CHILD = (
    "import sys; sys.path.insert(0, sys.argv.pop()); from amp_studio.sim.variations.worker import serve;"
    " serve()"
)


class WorkerEndedError(Exception):
    """A process apart was ended from outside: what it had is not made."""


class SweepWorker:
    """One process apart, which has its job before the first part."""

    def __init__(self, job: SweepJob) -> None:
        command = [sys.executable, "-P", "-c", _CHILD, str(Path(__file__).parents[3])]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._before = pickle.dumps(job)

    def figures(self, points: Matrix) -> Matrix:
        """Return ``figures_of`` the job; raises WorkerEndedError, and what ``figures_of`` raises."""
        asked: Any = self._process.stdin
        try:
            asked.write(self._before + pickle.dumps(points))
            asked.flush()
            self._before = b""
            answer = pickle.load(self._process.stdout)  # type: ignore[arg-type]  # noqa: S301  # the program itself has written it
        except (OSError, EOFError, ValueError, pickle.UnpicklingError):
            raise WorkerEndedError from None
        if isinstance(answer, Exception):
            raise answer
        figures: Matrix = answer
        return figures

    def end(self) -> None:
        """End the process, whatever it is doing."""
        self._process.kill()
        self._process.communicate()


def serve() -> None:
    """Make parts until nobody asks, in the process apart."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the process that waits for this one ends it
    gc.freeze()
    # What a library prints goes to the errors: the output is for the figures alone.
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    job = pickle.load(sys.stdin.buffer)  # noqa: S301  # the program itself has written it
    while True:
        try:
            points = pickle.load(sys.stdin.buffer)  # noqa: S301  # the same
        except EOFError:
            return
        try:
            answer: Matrix | Exception = figures_of(job, points)
        except Exception as error:  # it is raised where the part was asked for
            answer = error
        pickle.dump(answer, out)
        out.flush()
