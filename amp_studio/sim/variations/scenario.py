"""Scenario `sweep`: many variations of one axis: maps of two values, percentiles of many, the best one,
and what is safe.

Without a word about what is varied it is the map of the two gains that decide an axis, a quarter to four
times the present ones, with the region in which both loops are sound and the present point.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from amp_studio.files import content_of
from amp_studio.schema import Value, unknown_name
from amp_studio.sim.axis.moves import MOVE_SETTINGS as MOVE
from amp_studio.sim.axis.moves import move_of
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import assumptions, model_settings, present_setting, torque_unit
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, number, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace
from amp_studio.sim.tuning.aims import NORMAL
from amp_studio.sim.tuning.gains import gains_of
from amp_studio.sim.tuning.loops import SOUND
from amp_studio.sim.tuning.sampled import Matrix
from amp_studio.sim.tuning.solver import solve
from amp_studio.sim.tuning.trial import Trial, address_of

from .batch import FIGURES
from .job import LOOP_FIGURES, SweepJob, bound_at_present
from .plan import Varied, points_of, read_varied
from .refused import refuse_if_none, refused_in_words
from .running import SweepProgress, run_job
from .text import MORE_IS_BETTER

OVER, SAMPLES, FIGURE, SEED = "sweep.over", "sweep.samples", "sweep.figure", "sweep.seed"
_SETTINGS = {
    OVER: (
        "what is varied, NAME=FROM:TO:STEPS, several with a semicolon between; default: two gains of the axis"
    ),
    SAMPLES: "how many samples instead of all steps; a default seed gives the same ones each time",
    FIGURE: f"what is drawn and sought the best of: {', '.join((*FIGURES[1:], *LOOP_FIGURES[:-1]))}",
    SEED: "seed of the samples; default: 1",
    **{name: text for name, text in MOVE.items() if name != "move.emergency_time"},
}
SIDE, ALONE = 15, 41
"""Steps of each of two gains, and of one, by default."""
_FURTHEST = 4.0
"""Times the present gain, and its part, between which is swept then."""
_MAX_LOOPS = 2500
"""Variations of which the loops are computed too, where they are not asked for: each takes some
milliseconds."""
_PERCENTILES = (5, 25, 50, 75, 95)


@dataclass(frozen=True)
class SweepWay:
    """How a sweep is run: what `running.run_job` takes beside the job."""

    scheduler: str | None = None
    cores: int | None = None
    progress: SweepProgress = lambda _stage, _done, _total: None
    output: Path | None = None


def _run_sweep(
    trial: Trial, settings: ScenarioSettings, _others: Sequence[Trial] = (), way: SweepWay = SweepWay()
) -> Trace:
    """Return the figures of all variations; raises SimulationError for impossible settings."""
    refuse_unknown(settings, _SETTINGS)
    samples, seed, figure = _whole(settings, SAMPLES), _whole(settings, SEED), _figure(settings)
    move = {name: value for name, value in settings.items() if name.startswith("move.")}
    if not settings.get(OVER):
        return _gain_map(trial, move, figure or "stiffness", way)
    varied = _varied(trial, str(settings[OVER]))
    points = points_of(varied, samples, 1 if seed is None else seed)
    motion = figure not in LOOP_FIGURES
    loops = not motion or (figure is None and len(points) <= _MAX_LOOPS)
    job = _job(trial, varied, move, motion=motion, loops=loops)
    refuse_if_none(job, points)
    found = _run(job, points, way)
    return _trace(job, trial, points, found, figure or ("stiffness" if loops else "settle_time"))


def _gain_map(trial: Trial, move: ScenarioSettings, figure: str, way: SweepWay) -> Trace:
    """Return the map of two gains; where none of it is safe, with the other gains as the solver has them."""
    motion = figure not in LOOP_FIGURES
    varied = _two_gains(trial, {})
    points = points_of(varied, None, 1)
    job = _job(trial, varied, move, motion=motion, loops=True)
    trace = _trace(job, trial, points, _run(job, points, way), figure)
    if trace.columns["safe"].any():
        return trace
    solved = solve(trial, NORMAL)
    named = {each.address[0] for each in varied if each.address}
    others = {name: number for name, number in solved.to_change.items() if name not in named}
    if not solved.sound or not solved.to_change:
        return trace
    varied = _two_gains(trial, solved.numbers)
    points = points_of(varied, None, 1)
    job = _job(trial, varied, move, motion=motion, loops=True, others=others)
    trace = _trace(job, trial, points, _run(job, points, way), figure)
    return replace(trace, assumptions=(*_other_gains_in_words(others), *trace.assumptions))


def _other_gains_in_words(others: Mapping[str, float]) -> Iterator[str]:
    """Yield which gains beside those of the map are not the present ones, if any."""
    if others:
        words = ", ".join(f"{name} is {value_text(number)}" for name, number in others.items())
        yield f"With the other gains as they are none is safe: here {words}, as tune recommends."


def _job(
    trial: Trial,
    varied: tuple[Varied, ...],
    move: ScenarioSettings,
    *,
    motion: bool,
    loops: bool,
    others: Mapping[str, float] | None = None,
) -> SweepJob:
    """Return the job of a sweep, with ``others`` as values of parameters that are not varied;
    its move is one for all variations.
    """
    file = trial.file.copy()
    for parameter, figure in (others or {}).items():
        address = address_of(file, parameter, trial.axis.axis)
        if address:
            old = file.get(address)
            whole = old is not None and isinstance(old.value, int)
            file.set(address, Value(int(figure) if whole else figure, trial.unit(parameter)))
    job = SweepJob(
        content_of(file),
        trial.axis.axis,
        tuple(trial.settings.items()),
        tuple(move.items()),
        varied,
        motion,
        loops,
    )
    if not motion:
        return job
    moved = move_of(bound_at_present(job), move)
    own = {"move.distance": moved.distance, "move.feedrate": moved.feedrate * 60.0}
    return replace(
        job, move=(*own.items(), *((name, value) for name, value in move.items() if name not in own))
    )


def _run(job: SweepJob, points: Matrix, way: SweepWay) -> Matrix:
    return run_job(
        job, points, scheduler=way.scheduler, cores=way.cores, progress=way.progress, output=way.output
    )


def _whole(settings: ScenarioSettings, name: str) -> int | None:
    given = number(settings, name)
    if given is not None and not (given.is_integer() and given >= 0.0):
        raise SimulationError(f"{name} is {value_text(given)}; it must be a whole number", name)
    return None if given is None else int(given)


def _figure(settings: ScenarioSettings) -> str | None:
    figure = settings.get(FIGURE)
    known = (*FIGURES[1:], *LOOP_FIGURES[:-1])
    if figure is not None and figure not in known:
        raise SimulationError(unknown_name("figure", str(figure), known), FIGURE)
    return None if figure is None else str(figure)


def _varied(trial: Trial, text: str) -> tuple[Varied, ...]:
    """Return what a text varies, each name once; raises SimulationError for an unknown one."""
    wanted = [part for part in text.split(";") if part.strip()]
    found = tuple(read_varied(trial.file, trial.axis.axis, part) for part in wanted)
    names = [each.name for each in found]
    for each in found:
        if names.count(each.name) > 1:
            raise SimulationError(f"{each.name} is varied twice", each.name)
        known = {"model": model_settings(), "move": MOVE}.get(each.name.partition(".")[0])
        if known is not None and each.name not in known:
            raise SimulationError(unknown_name("setting", each.name, known), each.name)
    return found


def _two_gains(trial: Trial, also: Mapping[str, float]) -> tuple[Varied, ...]:
    """Return the innermost gain and the position gain around their present values,
    and around those of ``also`` by parameter.
    """
    gains = [gain for gain in gains_of(trial) if gain.present]
    wanted = [gain for gain in gains if gain.name == "position_gain"] or gains[-1:]
    wanted = [*wanted, *(gain for gain in gains[:1] if gain not in wanted)]
    if not wanted:
        raise SimulationError(
            "The axis has no gain that could be varied: say what is, NAME=FROM:TO:STEPS", OVER
        )
    steps = SIDE if len(wanted) > 1 else ALONE
    found = []
    for gain in wanted:
        around = [abs(gain.present), abs(also.get(gain.parameter, gain.present)) or abs(gain.present)]
        ends = (gain.nearest(min(around) / _FURTHEST), gain.nearest(max(around) * _FURTHEST))
        low, high = sorted(gain.sign * end for end in ends)
        found.append(
            read_varied(
                trial.file,
                trial.axis.axis,
                f"{gain.parameter}={low!r}:{high!r}:{steps}{':log' if low > 0.0 else ''}",
            )
        )
    return tuple(found)


def _trace(job: SweepJob, trial: Trial, points: Matrix, matrix: Matrix, figure: str) -> Trace:
    """Return the computed variations as a trace: a row for each, with the varied values and the figures."""
    axis = bound_at_present(job)
    columns: dict[str, Series] = {each.name: points[:, n] for n, each in enumerate(job.varied)}
    columns |= {name: matrix[:, n] for n, name in enumerate(job.columns)}
    columns["safe"] = _safe(job, columns)
    units = {each.name: each.unit or _setting_unit(axis, each.name) for each in job.varied}
    units |= {name: unit for name, unit in _units(axis).items() if name in columns} | {"safe": ""}
    present = {each.name: _present(axis, job, trial, each) for each in job.varied}
    return Trace(
        scenario="sweep",
        axis=axis.axis,
        model=axis.title,
        columns=columns,
        units=units,
        result=_figures(columns, units, figure),
        assumptions=(_note(job), *assumptions(axis)),
        doubts=tuple(refused_in_words(job, points, matrix)),
        limits={name: (value, units[name]) for name, value in present.items()},
        move={name: value for name, value in job.move if isinstance(value, float)},
        over=tuple(each.name for each in job.varied),
        called={each.name: trial.called(each.address[0]) for each in job.varied if each.address},
        figure=figure,
    )


def _safe(job: SweepJob, columns: dict[str, Series]) -> Series:
    """Return 1 where an axis is safe: its loops are sound where they were computed,
    and its motion ends and stays in position.
    """
    safe = np.ones(len(next(iter(columns.values()))), dtype=bool)
    if job.loops:
        safe &= columns["sound"] == 1.0
    if job.motion:
        safe &= (columns["stop"] == 0.0) & np.isfinite(columns["settle_time"])
    return safe.astype(np.float64)


def _note(job: SweepJob) -> str:
    parts = [f"both loops keep {SOUND.text()}"] if job.loops else []
    parts += ["the move ends without an alarm and stays in position"] if job.motion else []
    return f"Safe is a variation where {' and '.join(parts)}."


def _units(axis: AxisLaw) -> dict[str, str]:
    """Return the unit of each figure of a sweep."""
    u, torque = axis.unit, torque_unit(axis)
    return {
        "stop": "",
        "peak_following_error": u,
        "overshoot": u,
        "settle_time": "s",
        "in_position_time": "s",
        "peak_torque": torque,
        "rms_torque": torque,
        "peak_output": axis.output_unit,
        "rest_error": u,
        "Ms": "",
        "phase_margin": "deg",
        "gain_margin": "dB",
        "stiffness": f"{u}/{torque}",
        "damping_ratio": "",
        "velocity_loop_Ms": "",
        "sound": "",
    }


def _setting_unit(axis: AxisLaw, name: str) -> str:
    """Return the unit of a setting that is varied."""
    if name.startswith("model."):
        return present_setting(axis, name)[1]
    return {"move.distance": axis.unit, "move.feedrate": f"{axis.unit}/min", "move.duration": "s"}.get(
        name, ""
    )


def _present(axis: AxisLaw, job: SweepJob, trial: Trial, varied: Varied) -> float | None:
    if varied.address is not None:
        value = trial.file.get(varied.address)
        return None if value is None else float(value.value)
    if varied.name.startswith("model."):
        return present_setting(axis, varied.name)[0]
    given = dict(job.move).get(varied.name)
    return float(given) if isinstance(given, float) else None


def _figures(columns: dict[str, Series], units: dict[str, str], figure: str) -> dict[str, Figure]:
    """Return counts, percentiles and the best of a figure over all variations."""
    count, safe = len(columns["safe"]), columns["safe"] == 1.0
    known = np.isfinite(next(columns[name] for name in columns if name in ("stop", "sound")))
    result: dict[str, Figure] = {
        "count": (float(count), ""),
        "not_possible": (float(count - int(known.sum())), ""),
        "safe": (100.0 * float(safe.mean()), "%"),
    }
    safe_ones = np.where(safe, columns[figure], math.nan)
    best = np.nanmax if figure in MORE_IS_BETTER else np.nanmin
    result["best"] = (float(best(safe_ones)) if np.isfinite(safe_ones).any() else None, units[figure])
    for name in (*FIGURES[1:], *LOOP_FIGURES[:-1]):
        values = columns.get(name)
        if values is None:
            continue
        there = values[np.isfinite(values)]
        for part in _PERCENTILES:
            value = float(np.percentile(there, part)) if there.size else None
            result[f"{name}_p{part}"] = value, units[name]
    return result


SCENARIO = Scenario(
    "sweep",
    "Many variations: a map of two gains with its safe region, percentiles of an uncertain machine",
    _SETTINGS,
    _run_sweep,
    tried=True,
)
