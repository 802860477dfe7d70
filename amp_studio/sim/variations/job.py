"""The part of a sweep that can be done anywhere: plain data in, an array of figures out.

A `SweepJob` is pickled once for every process or cluster that takes part; `figures_of` binds the axis for
each point, as the file would be with it, and computes what is asked for. Where no parameter is varied the law
is bound once and the machine alone is another each time.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from amp_studio.files import RangeError, read_content
from amp_studio.sim.axis.motion import with_leader
from amp_studio.sim.axis.moves import Move, move_of, until_of
from amp_studio.sim.axis_parameters import AxisParameters, ParameterValue
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, law_of
from amp_studio.sim.model import with_model
from amp_studio.sim.scenario import ScenarioSettings
from amp_studio.sim.tuning.linear import LawMatrices
from amp_studio.sim.tuning.loops import Loops
from amp_studio.sim.tuning.sampled import Matrix

from .batch import FIGURES, run_batch
from .composed import ComposedAxes, agrees
from .plan import Varied, typed

LOOP_FIGURES = (
    "Ms",
    "phase_margin",
    "gain_margin",
    "stiffness",
    "damping_ratio",
    "velocity_loop_Ms",
    "sound",
)
"""Figures of the linear loops; ``sound`` is 1 or 0, all others nan for a loop that is not stable."""
AT_ONCE = 250
"""Variations in one batch."""
_MIN_BENEFIT = 6
"""Variations for each value of a grid from which axes are put together: three are bound for each.
Samples have as many values as points."""


@dataclass(frozen=True)
class SweepJob:
    """What is computed for each point."""

    content: bytes
    """The parameter file."""
    axis: str
    model: tuple[tuple[str, ParameterValue], ...]
    """Settings of the machine that are the same in all."""
    move: tuple[tuple[str, ParameterValue], ...]
    varied: tuple[Varied, ...]
    motion: bool
    loops: bool

    @property
    def columns(self) -> tuple[str, ...]:
        """The figures, in the order of their columns."""
        return (*(FIGURES if self.motion else ()), *(LOOP_FIGURES if self.loops else ()))

    def digest(self, points: Matrix) -> str:
        """Return what the job and its points are known by."""
        plain = repr((self.axis, self.model, self.move, self.varied, self.motion, self.loops))
        return hashlib.sha256(self.content + plain.encode() + points.tobytes()).hexdigest()


def figures_of(job: SweepJob, points: Matrix) -> Matrix:
    """Return the figures (points, columns) of a job; nan in all of them where an axis cannot be so."""
    parts = [_chunk(job, points[n : n + AT_ONCE]) for n in range(0, len(points), AT_ONCE)]
    return np.concatenate(parts) if parts else np.empty((0, len(job.columns)))


def _chunk(job: SweepJob, points: Matrix) -> Matrix:
    """Return the figures of some points, (points, columns); NaN for a machine that cannot be."""
    found = np.full((len(points), len(job.columns)), np.nan)
    bound = [(n, *each) for n, each in enumerate(axes_of(job).all(points.tolist())) if each is not None]
    if job.motion:
        runs, moves = [], _Moves()
        for _, axis, own, _ in bound:
            moved = moves.of(axis, own)
            until = until_of(axis, moved, _duration(own))
            led = with_leader(axis, moved.profile, until, share_rate=moved.share_rate)
            runs.append((led, moved.profile, until, moved.distance, moved.share_rate))
        if runs:
            found[[n for n, *_ in bound], : len(FIGURES)] = run_batch(runs)
    if job.loops:
        for n, axis, _, law in bound:
            found[n, -len(LOOP_FIGURES) :] = _loops(axis, law)
    return found


class _Moves:
    """The moves of axes, each made once: most variations have the same."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], Move] = {}

    def of(self, axis: AxisLaw, settings: ScenarioSettings) -> Move:
        """Return the move of an axis."""
        ramps, count = tuple(axis.ramps.items()), axis.machine.position_count
        key = (*settings.items(), axis.feedrate, axis.position_rate, axis.servo_period, count, *ramps)
        if key not in self._known:
            self._known[key] = move_of(axis, settings)
        return self._known[key]


def _duration(settings: Mapping[str, ParameterValue]) -> float | None:
    given = settings.get("move.duration")
    return float(given) if isinstance(given, float) else None


def _loops(axis: AxisLaw, law: LawMatrices | None) -> list[float]:
    # A sweep has thousands of loops: within half a percent is enough for each.
    loops = Loops(axis, law, exact=False)
    if not (loops.closed and loops.stable and loops.inner_stable):
        return [math.nan] * (len(LOOP_FIGURES) - 1) + [0.0]
    margins, inner = loops.outer.margins, loops.inner
    figures = (loops.outer.sensitivity, margins.phase, margins.gain, loops.yields[0], loops.damping)
    known = [math.nan if each is None or math.isinf(each) else each for each in figures]
    return [*known, inner.sensitivity if inner else math.nan, float(loops.sound())]


_Bound = tuple[AxisLaw, Mapping[str, ParameterValue], LawMatrices | None]
"""An axis, the settings of its move, its law as matrices where it is that of all."""


class Axes:
    """Binds the axis of a job for one point after the other."""

    def __init__(self, job: SweepJob) -> None:
        self.job = job
        self.file = read_content(Path("sweep.amp"), job.content)
        self.law = law_of(self.file.schema.family.family)
        self.model, self.move = dict(job.model), dict(job.move)
        self._machine = self._machine_alone()
        self.composed: ComposedAxes | None = None
        steps = [each.steps for each in job.varied]
        if all(steps) and math.prod(filter(None, steps)) > _MIN_BENEFIT * sum(filter(None, steps)):
            self.composed = ComposedAxes(self.at, [each.grid() for each in job.varied])

    def all(self, points: Sequence[Sequence[float]]) -> list[_Bound | None]:
        """Return what each point makes of the axis; None where it cannot be."""
        if self.composed is None:
            return [self._possible(point) for point in points]
        law = None if self._machine is None else self._machine[1]
        found = zip(points, map(self.composed.axis, points), strict=True)
        return [None if axis is None else (axis, self._own(point), law) for point, axis in found]

    def _possible(self, point: Sequence[float]) -> _Bound | None:
        try:
            return self._one(point)
        except (RangeError, SimulationError):
            return None

    def at(self, point: Sequence[float]) -> AxisLaw | None:
        """Return the axis of a point; None where it cannot be."""
        bound = self._possible(point)
        return None if bound is None else bound[0]

    def _own(self, point: Sequence[float]) -> ScenarioSettings:
        """Return the settings of the move of a point."""
        numbers = {each.name: number for each, number in zip(self.job.varied, point, strict=True)}
        return self.move | {name: number for name, number in numbers.items() if name.startswith("move.")}

    def refusal(self, point: Sequence[float]) -> str | None:
        """Return why a point makes no axis; None where it makes one."""
        try:
            self._one(point)
        except (RangeError, SimulationError) as error:
            return str(error)
        return None

    def _one(self, point: Sequence[float]) -> _Bound:
        """Return the axis of one point, bound again with the values of the file that it varies."""
        varied, own = list(zip(self.job.varied, point, strict=True)), self._own(point)
        given = {each.name: number for each, number in varied if not each.address}
        model = self.model | {name: number for name, number in given.items() if name.startswith("model.")}
        if self._machine is not None:
            base, law = self._machine
            return with_model(base, AxisParameters(_nothing, base.axis, model)), own, law
        wanted = {each.address: typed(each, self.file, number) for each, number in varied if each.address}
        before = {address: self.file.get(address) for address in wanted}
        try:
            self.file.set_checked(wanted)
            return bind_axis(self.file, self.law, self.job.axis, model), own, None
        finally:
            for address, value in before.items():
                self.file.set(address, value)

    def _machine_alone(self) -> tuple[AxisLaw, LawMatrices] | None:
        """Return an axis whose machine alone is another at each point; None where something else is too.

        That is tried: at the ends and in the middle of what is varied, all numbers of the law are the same,
        and the machine is the one that settings make of this axis.
        """
        varied = [each for each in self.job.varied if not each.name.startswith("move.")]
        if any(each.address for each in varied):
            return None
        base: AxisLaw | None = None
        for share in (0.0, 0.37, 1.0):
            model = {**self.model, **{each.name: each.at(share) for each in varied}}
            try:
                axis = bind_axis(self.file, self.law, self.job.axis, model)
                base = base or axis
                alone = with_model(base, AxisParameters(_nothing, base.axis, model))
            except SimulationError:
                return None
            if not agrees(alone, axis):
                return None
        return None if base is None else (base, LawMatrices.of(base))


def _nothing(_parameter: str, _instance: str) -> ParameterValue:
    return None


# Kept from one batch to the next, so that a process reads the file of a job once.
@lru_cache(maxsize=2)
def axes_of(job: SweepJob) -> Axes:
    """Return what binds the axes of a job."""
    return Axes(job)


def bound_at_present(job: SweepJob) -> AxisLaw:
    """Return the axis as the file has it; raises SimulationError for a varied setting that it does not
    have.
    """
    axes = axes_of(job)
    return bind_axis(axes.file, axes.law, job.axis, axes.model)
