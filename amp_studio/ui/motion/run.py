"""One run of the motion page, in a separate thread: what is asked, and what it brought."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.schema import cache_folder
from amp_studio.sim import (
    SignalRecord,
    SimulationError,
    SimulationListing,
    SweepWay,
    Trace,
    Trigger,
    laid_over,
    law_of,
    listing,
    simulate,
    sweep,
)
from amp_studio.ui.base.task import TaskProgress


@dataclass(frozen=True, eq=False)
class AskedMotion:
    """A scenario on an axis with the values of a file, and those it is compared with."""

    scenario: str
    axis: str | None
    settings: Mapping[str, float | str]
    file: ParameterFile
    file_before: ParameterFile | None
    before: Trace | None
    """The trace of ``file_before``, where the last run made it with the same settings."""
    record: SignalRecord | None = None
    """The record of the machine that is laid over."""
    trigger: Trigger | None = None


@dataclass(frozen=True, eq=False)
class SimulatedMotion:
    """What a run brought: the trace, the values that it was made of,
    those it is compared with and their trace of the same move.
    """

    trace: Trace
    file: ParameterFile
    file_before: ParameterFile | None
    before: Trace | None
    record_error: str = ""
    """Why the record does not lie over the trace."""


def run_motion(asked: AskedMotion, progress: TaskProgress, cancelled: threading.Event) -> SimulatedMotion:
    """Simulate; a sweep shows how far it is, and once stopped the next one goes on with what it has.

    Raises:
        SimulationError: The values cannot make the move, or the sweep was stopped.
    """

    def step(stage: str, done: int, total: int) -> None:
        if cancelled.is_set():
            raise SimulationError("Stopped; the same sweep goes on from here")
        progress(stage, done, total)

    # On disk, so that a stopped sweep goes on where it was, also after the program was left.
    way = SweepWay(progress=step, output=cache_folder() / "sweep")
    if asked.scenario == "sweep":
        trace = sweep(asked.file, asked.axis, asked.settings, way=way)
    else:
        trace = simulate(asked.file, asked.scenario, asked.axis, asked.settings)
    why = ""
    try:
        # A record that does not fit is a message: the simulation itself is good.
        trace = laid_over(trace, asked.record, asked.trigger) if asked.record else trace
    except SimulationError as error:
        why = str(error)
    return SimulatedMotion(trace, asked.file, asked.file_before, _same_move(asked, trace, way), why)


def _same_move(asked: AskedMotion, trace: Trace, way: SweepWay) -> Trace | None:
    """Return the trace of the values before with the move of ``trace``; None where they cannot make it."""
    before = asked.before
    # The saved file changes seldom: its trace is simulated once for each move.
    if asked.file_before is None or (before is not None and before.move == trace.move):
        return before
    try:
        if asked.scenario == "sweep":
            return sweep(asked.file_before, asked.axis, asked.settings, way=way)
        return simulate(asked.file_before, trace.scenario, trace.axis, asked.settings, like=trace)
    except SimulationError:
        return None


def simulated_by(file: ParameterFile) -> tuple[SimulationListing, SimulationError | None]:
    """Return what can be simulated with a file, and why nothing can, if so."""
    try:
        found = listing(file)
    except SimulationError as error:
        return SimulationListing((), (), (), {}), error
    return found, None if found.axes else SimulationError(
        law_of(file.schema.family.family).motion.without_axes
    )
