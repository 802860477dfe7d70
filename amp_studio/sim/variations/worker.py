"""A process apart that makes parts of a sweep."""

from __future__ import annotations

import gc
import os
import pickle
import signal
import subprocess
from typing import Any, BinaryIO

from amp_studio.child_process import child_command
from amp_studio.sim.tuning.sampled import Matrix

from .job import SweepJob, figures_of


class WorkerEndedError(Exception):
    """A process apart was ended from outside: what it had is not made."""


class SweepWorker:
    """One process apart, which has its job before the first part."""

    def __init__(self, job: SweepJob) -> None:
        command = child_command(__name__, "serve")
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


def serve(asked: BinaryIO, out: BinaryIO) -> None:
    """Make parts until the asking process ends, in the process apart."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the process that waits for this one ends it
    gc.freeze()
    # What a library prints goes to the errors: the output is for the figures alone.
    figures = os.fdopen(os.dup(out.fileno()), "wb")
    os.dup2(2, out.fileno())
    job = pickle.load(asked)  # noqa: S301  # the program itself has written it
    while True:
        try:
            points = pickle.load(asked)  # noqa: S301  # the same
        except EOFError:
            return
        try:
            answer: Matrix | Exception = figures_of(job, points)
        except Exception as error:  # it is raised where the part was asked for
            answer = error
        pickle.dump(answer, figures)
        figures.flush()
