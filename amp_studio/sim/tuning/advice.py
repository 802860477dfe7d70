"""Recommendations: one parameter, its value, the reason and the price, from the one solver (`solver.py`).

A scenario that shows how an axis is damped recommends gains where it is not sound: those of `tune` for the
aim normal, so that two scenarios never name different ones. A gain that is raised while figures of the
machine are assumed is a person's choice, and its recommendation names it as one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from amp_studio.sim.law import AxisLaw
from amp_studio.sim.rounding import value_text
from amp_studio.sim.trace import Recommendation

from .aims import NORMAL
from .gains import Gain
from .linear import LawMatrices, LinearModel, Margins, linear_model
from .loops import Loops
from .solver import Solved, solve
from .tried import Tried

_INERTIAS = (1.0 / 16.0, 16.0)
"""Shares of the total inertia within which an axis is tried."""
STEPS = 8
"""Steps to each of them."""
_HALVINGS = 5
"""Of the last of them."""

SHOWN_BY = ("frequency", "velocity")
"""Scenarios that are about the loops: their results have the gains of the solver."""
_NO_MORE = 1e-3
"""Share of the present integral gain up to which a new one takes nothing up within a move."""
CHATTER = (
    "Inside of its backlash the motor moves without its load, and this loop is too fast for the motor alone:"
    " it is not stable there, and chatters to and fro in the gap."
)
_NONE_SOUND = "No gains within their bounds make it sound on this machine."
_NONE_OF_SIGN = (
    "No gains of these signs make it sound on this machine: {parameter} is below 0. Its sign is the wiring of"
    " the feedback, so the other one is not tried."
)
_ASK_TUNE = "The scenario tune finds gains."
_FILTER_WEAKER = "A resonance that the model does not have may ring on: your choice."
OTHER_SIGN = "None: an integral gain of the other sign pushes the axis away from its target."
_RAISED = "It raises a gain on a machine that is partly assumed: your choice."


def recommendations(
    trial: Tried, scenario: str, own: Sequence[Recommendation] = ()
) -> tuple[tuple[Recommendation, ...], tuple[str, ...]]:
    """Return the recommendations of the family and those of the solver, and notes about the loops."""
    chatter = (CHATTER,) if _chatters_in_gap(trial.axis) else ()
    loops = Loops(trial.axis)
    if not loops.closed or loops.sound():
        return tuple(own), chatter
    if loops.stable and loops.inner_stable and scenario not in SHOWN_BY:
        return tuple(own), (f"{why_not_sound(loops)}. {_ASK_TUNE}", *chatter)
    solved = solve(trial, NORMAL)
    found = gain_recommendations(trial, solved, f"{why_not_sound(loops)}; ")
    named = {each.parameter for each in found}
    notes = () if solved.sound else (f"{why_not_sound(loops)}. {none_sound(solved)}",)
    # One recommendation for a parameter: that of the solver, whose gains belong together.
    rest = (each for each in own if each.parameter not in named)
    return (*found, *rest), (*notes, *chatter)


def gain_recommendations(trial: Tried, solved: Solved, why: str = "") -> tuple[Recommendation, ...]:
    """Return the gains and filters that change, each with what all of them together give."""
    if not solved.to_change:
        return ()
    loops = solved.after.loops
    assumed = " on the assumed machine" if trial.axis.assumed else ""
    gives = (
        f"{'all gains together' if len(solved.to_change) > 1 else 'with it'} {_figures_text(loops)}{assumed}"
    )
    found: list[Recommendation] = []
    for gain in solved.gains:
        number = solved.to_change.get(gain.parameter)
        old = trial.value(gain.parameter)
        if number is None or old is None:
            continue
        page = trial.axis.sources[gain.name].page
        reason = _reason(trial, f"{why}{gives}", found, page, solved)
        found.append(Recommendation(gain.parameter, number, old.unit, reason, _cost(trial, solved, gain)))
    pages = {each.parameter: each.page for each in trial.axis.sources.values()}
    for parameter, before in solved.filters:
        number = solved.to_change.get(parameter)
        if number is not None:
            reason = _reason(trial, f"{why}{gives}", found, pages.get(parameter, ""), solved)
            price = _filter_cost(trial, before, number)
            found.append(Recommendation(parameter, number, trial.unit(parameter), reason, price))
    return tuple(found)


def _reason(trial: Tried, first: str, found: Sequence[Recommendation], page: str, solved: Solved) -> str:
    reason = first if not found else f"together with {trial.called(found[0].parameter)}"
    return f"{reason} ({f'page {page}, ' if page else ''}aim {solved.aim.name})."


def _filter_cost(trial: Tried, before: float | None, number: float) -> str:
    """Return what another filter costs, in a sentence."""
    if before is not None and number > before:
        choice = f" {_FILTER_WEAKER}" if trial.axis.assumed else ""
        return (
            f"What the filter took out above {value_text(before, digits=3)} Hz comes through again.{choice}"
        )
    return "The filter gives phase away below its frequency: the gains fit this filter and no other."


def _cost(trial: Tried, solved: Solved, gain: Gain) -> str:
    """Return what a change of one gain costs, in a sentence."""
    number = abs(solved.numbers[gain.parameter])
    if gain.present_size < 0.0:
        return OTHER_SIGN
    share = number / gain.present_size if gain.present else 0.0
    choice = f" {_RAISED}" if trial.axis.assumed else ""
    if share > 1.0 or not gain.present:
        if gain.name == "position_gain":
            return f"Less margin for a heavier load, friction and wear.{choice}"
        if "integral" in gain.name:
            return f"What the load leaves is taken up sooner, with less margin.{choice}"
        return f"Every count of the feedback moves the output {_times(share)} as much.{choice}"
    if gain.name == "position_gain":
        error = _following_errors(solved)
        return error or f"The axis answers {_times(1.0 / share)} more slowly."
    if "integral" in gain.name:
        slower = f"{_times(1.0 / share)} more slowly" if share > _NO_MORE else "no more"
        return f"A lasting load is corrected {slower}."
    return f"The axis resists a load {_times(1.0 / share)} less by this gain."


def _times(share: float) -> str:
    return f"{value_text(share, digits=2)} times"


def _following_errors(solved: Solved) -> str:
    axes = solved.before.axis, solved.after.axis
    feedrate = axes[0].feedrate
    if not feedrate:
        return ""
    errors = [axis.predict(feedrate).get("steady_following_error") for axis in axes]
    values = [
        feedrate / axis.position_rate if e is None else e.value for axis, e in zip(axes, errors, strict=True)
    ]
    if values[0] is None or values[1] is None or values[1] <= 1.01 * values[0]:
        return ""
    worse = " to ".join(value_text(each, axes[0].unit, 3) for each in values if each is not None)
    return f"The following error at the rapid feedrate grows from {worse}."


def none_sound(solved: Solved) -> str:
    """Return in a sentence that nothing sound was found; with a gain below 0, that its sign was kept."""
    below = next((gain.parameter for gain in solved.gains if gain.present_size > 0.0 > gain.present), None)
    return _NONE_SOUND if below is None else _NONE_OF_SIGN.format(parameter=below)


def why_not_sound(loops: Loops) -> str:
    """Return in a sentence, without its end, what a loop lacks."""
    if not loops.inner_sound() and loops.inner is not None:
        if not loops.inner_stable:
            return f"The velocity loop is not stable: {_margins_text(loops.inner.margins)}"
        ratio = loops.axis.machine.inertia_ratio
        load = (
            f" with a load of {value_text(ratio, digits=3)} times the inertia of the motor" if ratio else ""
        )
        return (
            f"The velocity loop has too little margin{load}:"
            f" {_with_ms(loops.inner.margins, loops.inner.sensitivity)}"
        )
    if not loops.stable:
        return f"The position loop is not stable: {_margins_text(loops.outer.margins)}"
    return (
        f"The position loop has too little margin: {_with_ms(loops.outer.margins, loops.outer.sensitivity)}"
    )


def _figures_text(loops: Loops) -> str:
    """Return Ms and margins of both loops in words."""
    if loops.inner is None:
        return _with_ms(loops.outer.margins, loops.outer.sensitivity)
    inner, outer = loops.inner, loops.outer
    return (
        f"the velocity loop has {_with_ms(inner.margins, inner.sensitivity)}, the position loop"
        f" {_with_ms(outer.margins, outer.sensitivity)}"
    )


def _with_ms(margins: Margins, sensitivity: float) -> str:
    return f"Ms {value_text(sensitivity, digits=3)}, {_margins_text(margins)}"


def _margins_text(margins: Margins) -> str:
    """Return margins in words."""
    parts = [
        f"{value_text(value, unit, 3)} {name} margin"
        for value, unit, name in ((margins.phase, "deg", "phase"), (margins.gain, "dB", "gain"))
        if value is not None
    ]
    return " and ".join(parts) or "no limit"


def stable_inertias(axis: AxisLaw) -> tuple[float, float] | None:
    """Return between which shares of its total inertia a stable axis stays stable, within _INERTIAS; None
    where it does not matter: a drive with a velocity loop is taken to fit its load.
    """
    if axis.machine.velocity_per_output > 0.0:
        return None
    law = LawMatrices.of(axis)  # the inertia has no part in it
    return _stable_to(axis, law, _INERTIAS[0]), _stable_to(axis, law, _INERTIAS[1])


def _stable_to(axis: AxisLaw, law: LawMatrices, furthest: float) -> float:
    """Return the last share of the inertia on the way to ``furthest`` with which an axis is stable."""
    good, bad = 0.0, 0.0
    # In equal ratios to the first share that is not stable: what may be stable beyond it is of no use.
    for n in range(1, STEPS + 1):
        if not _with_inertia(axis, law, furthest ** (n / STEPS)).is_stable():
            bad = n / STEPS
            break
        good = n / STEPS
    for _ in range(_HALVINGS if bad else 0):
        middle = 0.5 * (good + bad)
        good, bad = (
            (middle, bad) if _with_inertia(axis, law, furthest**middle).is_stable() else (good, middle)
        )
    return float(furthest**good)


def _with_inertia(axis: AxisLaw, law: LawMatrices, inertia: float) -> LinearModel:
    machine = replace(axis.machine, acceleration_per_output=axis.machine.acceleration_per_output / inertia)
    return linear_model(replace(axis, machine=machine), law)


def _chatters_in_gap(axis: AxisLaw) -> bool:
    """Return whether a motor without its load, as it is inside of the backlash,
    is in a loop that is not stable.
    """
    machine = axis.machine
    if machine.backlash == 0.0 or machine.velocity_per_output > 0.0:
        return False
    # Without its load the motor is faster by all the inertia that is gone.
    light = machine.acceleration_per_output * (1.0 + machine.coupling[2])
    alone = replace(machine, acceleration_per_output=light, backlash=0.0, resonance=0.0, load_sensor=False)
    loops = Loops(replace(axis, machine=alone))
    return not (loops.inner_stable and loops.stable)
