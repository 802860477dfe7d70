"""Scenario `tune`: the gains of an axis for an aim in a word, by the one solver; what they give,
before and after.

The picture is a load of one unit of torque that comes at once, by the linear model with the present and with
the new gains, and Ms over the inertia that the axis may have.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from amp_studio.schema import unknown_name
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.model import assumptions, torque_unit
from amp_studio.sim.scenario import Scenario, ScenarioSettings, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Recommendation, Trace
from amp_studio.sim.tuning.advice import gain_recommendations, none_sound, why_not_sound
from amp_studio.sim.tuning.aims import AIMS, Aim
from amp_studio.sim.tuning.levels import Candidate, levels_of
from amp_studio.sim.tuning.linear import LinearModel
from amp_studio.sim.tuning.loops import Loops, with_inertia
from amp_studio.sim.tuning.solver import Solved, solve
from amp_studio.sim.tuning.trial import Trial

FOR = "tune.for"
_SETTINGS = {FOR: f"what the axis is tuned for: {', '.join(AIMS)}; default: normal"}
POINTS = 400
"""Rows of the picture."""
_INERTIAS = np.geomspace(0.4, 2.5, 23)
"""Shares of the inertia for which Ms is computed; the rows between are on a line."""
LATER = (
    "the limit for counts is not kept",
    "the inertia is taken as known",
    "the margins of a sound axis alone are kept",
)
"""What is no longer kept at each level behind the first (`solver.levels_of`)."""
NOTHING = "No other gains are more than 3 % stiffer: nothing to change."


def _run_tune(trial: Trial, settings: ScenarioSettings, others: Sequence[Trial]) -> Trace:
    """Return the gains for an aim; ``others`` are the axes that make contours with this one.

    Raises SimulationError for an axis without a closed position loop or a word that is no aim.
    """
    refuse_unknown(settings, _SETTINGS)
    aim = _aim(settings)
    axis = trial.axis
    if not Loops(axis).closed:
        raise SimulationError(f"The position loop of axis {axis.axis} is open: there is nothing to tune")
    slowest = min((_fastest(other, aim) for other in others), default=math.inf) if aim.equal else math.inf
    solved = solve(trial, aim, slowest=slowest)
    columns, units = _picture(solved)
    return Trace(
        scenario="tune",
        axis=axis.axis,
        model=axis.title,
        columns=columns,
        units=units,
        result=_figures(solved),
        recommendations=(*gain_recommendations(trial, solved), *_following(trial, solved)),
        assumptions=(*_notes(solved, slowest, others), *assumptions(axis)),
    )


def _aim(settings: ScenarioSettings) -> Aim:
    word = settings.get(FOR) or "normal"
    if word not in AIMS:
        raise SimulationError(unknown_name("aim", str(word), AIMS), FOR)
    return AIMS[str(word)]


def _fastest(trial: Trial, aim: Aim) -> float:
    """Return the position gain in 1/s that an axis alone would get."""
    return solve(trial, aim).after.axis.position_rate


def _following(trial: Trial, solved: Solved) -> list[Recommendation]:
    """Return what has to follow the gains: feed-forward and limits of the following error;
    nothing for an axis that runs away.
    """
    recommendations: list[Recommendation] = []
    if not (solved.after.loops.stable and solved.after.loops.inner_stable):
        return recommendations
    for each in solved.after.axis.follow(solved.after.axis):
        now = trial.value(each.parameter)
        if (
            now is None
            or now.unit != each.unit
            or not math.isclose(float(now.value), each.value, rel_tol=1e-9)
        ):
            recommendations.append(each)
    return recommendations


def _figures(solved: Solved) -> dict[str, Figure]:
    before, after = _loop_figures(solved.before.loops), _loop_figures(solved.after.loops)
    counts = {name: (100.0 * each.jolt, "%") for name, each in (("count_jolt", solved.after),)}
    return {**after, **counts, **{f"{name}_before": figure for name, figure in before.items()}}


def _loop_figures(loops: Loops) -> dict[str, Figure]:
    """Return the figures of an axis by name; none of an unstable one."""
    axis, inner, stable = loops.axis, loops.inner, loops.stable and loops.inner_stable
    unit = f"{axis.unit}/{torque_unit(axis)}"
    gives = loops.yields[0] if stable else None
    found: dict[str, Figure] = {
        "Ms": (loops.outer.sensitivity if stable else None, ""),
        "phase_margin": (loops.outer.margins.phase, "deg"),
        "gain_margin": (loops.outer.margins.gain, "dB"),
        "bandwidth": (loops.models.cut.bandwidth(forward=False) if stable else None, "Hz"),
        "stiffness": (gives if gives is not None and math.isfinite(gives) else None, unit),
        "damping_ratio": (loops.damping if stable else None, ""),
    }
    if inner is not None:
        found["velocity_loop_Ms"] = (inner.sensitivity if loops.inner_stable else None, "")
        found["velocity_loop_phase_margin"] = (inner.margins.phase, "deg")
        found["velocity_loop_gain_margin"] = (inner.margins.gain, "dB")
    return found


def _notes(solved: Solved, slowest: float, others: Sequence[Trial]) -> list[str]:
    sentences = [solved.aim.text()]
    levels = levels_of(solved.aim)
    if 0 < solved.level < len(levels):
        sentences.append(f"No gains keep all of it: {'; '.join(LATER[: solved.level])}.")
    if solved.level == len(levels):
        sentences.append(f"{why_not_sound(solved.after.loops)}. {none_sound(solved)}")
    elif not solved.to_change:
        sentences.append(NOTHING)
    if math.isfinite(slowest):
        names = ", ".join(other.axis.axis for other in others)
        sentences.append(f"The position gain is the one that all axes of the contour can have ({names}).")
    sentences.append(
        "Stiffness is the largest way of the load for one unit of torque that comes at once; a smaller figure"
        " is a stiffer axis."
    )
    return sentences


def _picture(solved: Solved) -> tuple[dict[str, Series], dict[str, str]]:
    """Return how far a torque of one unit moves the load, with the present gains and with the new ones."""
    axis = solved.after.axis
    models = [each.loops.models.whole for each in (solved.before, solved.after)]
    stable = [each.loops.stable for each in (solved.before, solved.after)]
    lasts = max((_lasts(model) for model, good in zip(models, stable, strict=True) if good), default=0.25)
    time = np.linspace(0.0, lasts, POINTS)
    columns: dict[str, Series] = {"time_s": time}
    for name, model, good in zip(("before", "after"), models, stable, strict=True):
        columns[f"load_way_{name}"] = _way(model, time) if good else np.full(POINTS, np.nan)
    columns["inertia_share"] = np.geomspace(_INERTIAS[0], _INERTIAS[-1], POINTS)
    for name, each in (("before", solved.before), ("after", solved.after)):
        columns[f"Ms_{name}"] = np.interp(columns["inertia_share"], _INERTIAS, _over_inertia(each))
    unit = f"{axis.unit}/{torque_unit(axis)}"
    ways = {"load_way_before": unit, "load_way_after": unit}
    return columns, {"time_s": "s", **ways, "inertia_share": "", "Ms_before": "", "Ms_after": ""}


def _over_inertia(tried: Candidate) -> Series:
    """Return Ms of the loop that has the larger one, for each share of the inertia; nan where one is not
    stable.
    """
    found = []
    for share in _INERTIAS.tolist():
        loops = Loops(with_inertia(tried.axis, share), tried.law, exact=False)
        found.append(loops.sensitivity if loops.stable and loops.inner_stable else math.nan)
    return np.array(found)


def _lasts(model: LinearModel) -> float:
    """Return 5 time constants of the slowest pole that still moves, at most 2 s."""
    sizes = np.abs(model.poles())
    moving = sizes[(sizes > 1e-6) & (sizes < 1.0 - 1e-9)]
    return min(2.0, -5.0 * model.period / math.log(float(moving.max()))) if moving.size else 0.25


def _way(model: LinearModel, time: Series) -> Series:
    steps = math.ceil(float(time[-1]) / model.period) + 1
    return np.asarray(np.interp(time, np.arange(steps) * model.period, model.pushed_way(steps)))


SCENARIO = Scenario(
    "tune",
    "Gains for an aim in a word: quiet, normal, stiff, contour; before and after",
    _SETTINGS,
    _run_tune,
    tried=True,
)
