"""Spreads a job over the cores of this computer or an existing cluster; keeps what is done,
so that a stopped sweep goes on.

Locally this process works too, beside one process for each further core: the starting of those is not waited
for. It takes chunks from the end of the list while they begin at its start. With `--scheduler` the same
chunks go to a Dask cluster (the extra ``cluster``), whose workers have the same version of this program.
"""

from __future__ import annotations

import base64
import copy
import hashlib
import importlib
import json
import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import numpy as np

from amp_studio.errors import AmpStudioError
from amp_studio.schema import read_file
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.tuning.sampled import Matrix

from .job import AT_ONCE, SweepJob, figures_of
from .worker import SweepWorker, WorkerEndedError

SweepProgress = Callable[[str, int, int], None]
"""progress(stage, done, of all)."""
_STAGE = "sweep"
SMALL = 500
"""Variations for which no further process is worth its start;
of those with loops each counts as many times as below."""
_LOOPS_COUNT = 10
_SCHEMES = ("tcp://", "tls://")
CONNECT_S = 10.0
"""Seconds that a scheduler has for its answer."""
_SUFFIX = ".part"


@dataclass
class DoneChunks:
    """The chunks of a job that are done, in a file beside the result; each is written when it comes."""

    path: Path | None
    digest: str
    done: dict[int, Matrix] = field(default_factory=dict)

    @classmethod
    def beside(cls, output: Path | None, job: SweepJob, points: Matrix) -> DoneChunks:
        """Return what is kept beside an output of the same job; nothing of another one."""
        chunks = cls(None if output is None else output.with_name(output.name + _SUFFIX), job.digest(points))
        if chunks.path is not None:
            with suppress(OSError, ValueError, KeyError, TypeError):
                chunks._read(len(job.columns), len(points))
        return chunks

    def _read(self, width: int, count: int) -> None:
        assert self.path is not None
        head, *lines = read_file(self.path, follow=False).decode("ascii").splitlines()
        # Of another job or of other points: nothing of it is used.
        if json.loads(head) != {"sweep": self.digest}:
            return
        for line in lines:
            entry = json.loads(line)
            figures = base64.b64decode(entry["figures"], validate=True)
            if entry["sha256"] != _seal(entry["start"], figures):
                return  # cut off, or altered: what follows is computed again
            chunk = np.frombuffer(figures).reshape(-1, width)
            if isinstance(entry["start"], int) and 0 <= entry["start"] <= count - len(chunk):
                self.done[entry["start"]] = chunk

    def add(self, start: int, figures: Matrix) -> None:
        """Keep a chunk."""
        self.done[start] = figures
        if self.path is None:
            return
        head = "" if len(self.done) > 1 else json.dumps({"sweep": self.digest}) + "\n"
        content = np.ascontiguousarray(figures).tobytes()
        entry = {
            "start": start,
            "figures": base64.b64encode(content).decode(),
            "sha256": _seal(start, content),
        }
        try:
            with self.path.open("w" if head else "a", encoding="ascii") as file:
                file.write(head + json.dumps(entry) + "\n")
        except OSError:  # the result alone is promised
            self.path = None

    def end(self) -> None:
        """Remove the file: all is done."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def _seal(start: object, figures: bytes) -> str:
    return hashlib.sha256(repr(start).encode() + figures).hexdigest()


def run_job(
    job: SweepJob,
    points: Matrix,
    *,
    scheduler: str | None = None,
    cores: int | None = None,
    progress: SweepProgress = lambda _stage, _done, _total: None,
    output: Path | None = None,
) -> Matrix:
    """Return the figures (points, columns).

    ``progress`` is called with every part that is done, and may raise to stop; with ``output`` what is done
    is kept beside it and used by the next call. Raises SimulationError for a cluster that cannot be reached.
    """
    kept = DoneChunks.beside(output, job, points)
    starts = [start for start in range(0, len(points), AT_ONCE) if start not in kept.done]

    def report() -> None:
        progress(_STAGE, sum(len(each) for each in kept.done.values()), len(points))

    report()
    parts = _on_cluster if scheduler else _here
    for start, figures in parts(job, points, starts, scheduler or str(_cores(job, points, cores))):
        kept.add(start, figures)
        report()
    kept.end()
    return np.concatenate([kept.done[start] for start in sorted(kept.done)])


def _cores(job: SweepJob, points: Matrix, cores: int | None) -> int:
    if cores is not None:
        return cores
    work = len(points) * (_LOOPS_COUNT if job.loops else 1)
    return (os.cpu_count() or 1) if work > SMALL else 1


def _here(job: SweepJob, points: Matrix, starts: list[int], cores: str) -> Iterator[tuple[int, Matrix]]:
    """Yield the parts as this computer makes them, over so many cores."""
    if cores == "1":
        for start in starts:
            yield start, figures_of(job, points[start : start + AT_ONCE])
        return
    # Not copied: a copy of a process with threads (of numba, of the window) may wait for a lock for
    # ever.
    idle: SimpleQueue[SweepWorker] = SimpleQueue()
    workers = [SweepWorker(job) for _ in range(int(cores) - 1)]
    for worker in workers:
        idle.put(worker)

    def figures(part: Matrix) -> Matrix:
        worker = idle.get()
        try:
            return worker.figures(part)
        finally:
            idle.put(worker)

    pool = ThreadPoolExecutor(len(workers))
    try:
        yield from _beside(lambda part: pool.submit(figures, part), job, points, starts)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for worker in workers:
            worker.end()
        pool.shutdown(wait=True)


def _beside(
    submit: Callable[[Matrix], Future[Matrix]], job: SweepJob, points: Matrix, starts: list[int]
) -> Iterator[tuple[int, Matrix]]:
    """Yield the parts: this process takes the last one that has not begun, until none is left."""
    # All at once: the pool hands them out in this order, and whatever has not begun can still be taken
    # back.
    waiting = {start: submit(points[start : start + AT_ONCE]) for start in starts}
    for start in reversed(starts):
        # From the end, where the others come last; cancel answers False for a part that has begun.
        if waiting[start].cancel():
            del waiting[start]
            yield start, figures_of(job, points[start : start + AT_ONCE])
    for start, future in waiting.items():
        try:
            yield start, future.result()
        except WorkerEndedError:  # one of them was ended from outside: what it had is done here
            yield start, figures_of(job, points[start : start + AT_ONCE])


def _on_cluster(
    job: SweepJob, points: Matrix, starts: list[int], scheduler: str
) -> Iterator[tuple[int, Matrix]]:
    """Yield the parts as the workers of a cluster finish them; raises SimulationError where none answers."""
    if not scheduler.startswith(_SCHEMES):
        raise SimulationError(f"'{scheduler[:80]}' is no address of a scheduler: tcp://HOST:PORT")
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise SimulationError(
            "A cluster needs the extra 'cluster': pip install 'amp-studio[cluster]', here and on its workers"
        ) from None
    client = _client_of(distributed, scheduler)
    try:
        with client, client.as_current():
            if not client.scheduler_info()["workers"]:
                raise SimulationError(f"The cluster at {scheduler} has no workers")
            # The job goes to each worker once, not with each part; as a task, as data that was scattered is
            # lost with the worker that has it.
            shared = client.submit(copy.copy, job, pure=False)
            futures = {
                client.submit(figures_of, shared, points[start : start + AT_ONCE], pure=False): start
                for start in starts
            }
            for future in distributed.as_completed(futures):
                yield futures[future], future.result()
    except (AmpStudioError, GeneratorExit):
        raise
    except Exception as error:
        # Whatever a worker lacks (this program, its version, its memory) is raised here as it was there.
        raise SimulationError(
            f"The cluster at {scheduler} does not compute this: {_in_a_line(error)}"
        ) from None


def _client_of(distributed: Any, scheduler: str) -> Any:
    """Return a client of a cluster; raises SimulationError where no scheduler answers in time."""
    found: list[Any] = []

    def connect() -> None:
        try:
            found.append(distributed.Client(scheduler, timeout=f"{CONNECT_S} s", set_as_default=False))
        except (OSError, ValueError) as error:
            found.append(error)

    # Where something else listens no answer comes, and the time limit of a client ends at the connection.
    asking = threading.Thread(target=connect, daemon=True)
    asking.start()
    asking.join(2.0 * CONNECT_S)
    if not found:
        raise SimulationError(f"No scheduler answers at {scheduler}: something listens there that is none")
    if isinstance(found[0], Exception):
        raise SimulationError(f"No scheduler answers at {scheduler}: {_in_a_line(found[0])}") from None
    return found[0]


def _in_a_line(error: Exception) -> str:
    return " ".join(str(error).split())[:200] or type(error).__name__
