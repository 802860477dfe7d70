"""Every scenario that a file allows, run at once: what is good, what is doubtful, what is bad,
with the control's own words.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Literal

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, axis_name

from .binding import bind_axis
from .errors import SimulationError
from .law import AxisLaw, Law, law_of
from .rounding import value_text
from .run import simulate
from .scenario import CheckPart, Scenario
from .scenarios import SCENARIOS
from .trace import Alarm, Figure, Trace
from .tuning.advice import SHOWN_BY, why_not_sound
from .tuning.loops import SOUND, Loops

Verdict = Literal["good", "doubtful", "bad", "not possible"]
NEAR_GRID = (20.0, 80.0)
"""% of a turn between switch and marker that is sure (Syntec 2.2)."""
_WORSE = ("not possible", "good", "doubtful", "bad")
_ONE_END = "Only one end of the travel has a limit"
_AHEAD_SHARE = 0.5
"""Share of its travel from which an axis has its switch ahead; near an end it is almost all or nothing."""
_ASKED = {"home": "homing", "jog": "jogging", "travel": "travel"}
"""Scenario -> the part of an axis that reads its parameters."""
_RATES = ("feedrate", "acceleration", "linear_acceleration")
LIMITS = ("torque_limit_positive", "torque_limit_negative")
_EVERY = "every"
"""Name of the one check of an axis that no scenario can move."""
_PROGRAMMED = "ASSUMED: {0}; the file does not give what a program does."


@dataclass(frozen=True)
class LimitUse:
    """How much of its limit a scenario takes."""

    share: float
    """1 at the limit; infinite for an axis that is not stable."""
    limit: str
    """What the limit is."""
    value: float | None = None
    most: float | None = None
    """The figure and its limit, where they are figures of the file."""
    unit: str = ""


@dataclass(frozen=True)
class MotionCheck:
    """One scenario of one axis."""

    scenario: str
    axis: str
    letter: str
    verdict: Verdict
    figures: dict[str, Figure] = field(default_factory=dict)
    alarms: tuple[Alarm, ...] = ()
    why: str = ""
    """What is not good, or not possible, in a sentence."""
    params: tuple[str, ...] = ()
    """Ids of the parameters to look at."""
    assumptions: tuple[str, ...] = ()
    part: CheckPart = "following"
    """What the scenario is about."""
    headline: str = ""
    """The figure that a list has room for."""
    use: LimitUse | None = None
    """None where nothing that is known limits it."""
    trace: Trace | None = field(default=None, compare=False, repr=False)
    """The run that decided; None where there was none."""


def check_motion(file: ParameterFile, axis: str | None = None) -> Iterator[MotionCheck]:
    """Yield the check of every scenario and axis that a file has; ``axis`` for one alone, named by itself.

    Raises SimulationError for a family without a law and for a file without axes.
    """
    law = law_of(file.schema.family.family)
    axes = tuple(law.axes(file))
    if not axes:
        raise SimulationError(law.motion.without_axes)
    made = [_unmade(file, law, each) or each for each in (axes if axis is None else (axis,))]
    yield from (each for each in made if isinstance(each, MotionCheck))
    chosen = [each for each in made if isinstance(each, str)]
    for scenario in filter(partial(_is_checked, law), {**SCENARIOS, **law.own()}.values()):
        if not (scenario.once and scenario.of_machine):
            for each in chosen[:1] if scenario.once else chosen:
                yield _checked(file, law, scenario, each)
        elif axis is None and (checked := _of_spindle(file, law, scenario)):
            yield checked


def check_again(
    file: ParameterFile, scenario: str, axis: str | None, settings: Mapping[str, float | str] | None = None
) -> MotionCheck:
    """Return the check of one scenario of one axis once more, with settings, and in its trace with what is
    recommended.
    """
    law = law_of(file.schema.family.family)
    known = {**SCENARIOS, **law.own()}[scenario]
    try:
        if known.opposite and not settings:
            runs = _ends(file, known, axis)
        else:
            runs = [(simulate(file, scenario, axis, {**known.programmed, **(settings or {})}), (), "")]
    except SimulationError as error:
        return _not_possible(file, law, scenario, axis, error)
    return _judged(file, law, known, axis, runs)


def _unmade(file: ParameterFile, law: Law, axis: str) -> MotionCheck | None:
    """Return the one check of an axis that no scenario can move, a spindle or one without its values; None
    for any other.
    """
    try:
        bind_axis(file, law, axis)
    except SimulationError as error:
        return _not_possible(file, law, _EVERY, axis, error)
    return None


def _not_possible(
    file: ParameterFile, law: Law, scenario: str, axis: str | None, error: SimulationError
) -> MotionCheck:
    named = (error.parameter,) if error.parameter in file.schema.parameters else ()
    read = named or (_asked(file, law, scenario, axis) if axis and scenario in _ASKED else ())
    known = {**SCENARIOS, **law.own()}.get(scenario)
    part: CheckPart = known.part if known else "following"
    return MotionCheck(
        scenario, axis or "", _letter_of(file, axis), "not possible", why=error.what, params=read, part=part
    )


def _is_checked(law: Law, scenario: Scenario) -> bool:
    return bool(scenario.checked) and scenario.name in (*law.motion.scenarios, *law.own())


def _of_spindle(file: ParameterFile, law: Law, scenario: Scenario) -> MotionCheck | None:
    """Return the check of the first spindle at its highest speed; None for a file without one."""
    checked = _checked(file, law, scenario, None)
    # Not possible without a parameter to blame means that the machine has no spindle: nothing to report.
    return None if checked.verdict == "not possible" and not checked.params else checked


def _letter_of(file: ParameterFile, axis: str | None) -> str:
    return "" if axis is None else axis_name(file.evaluation, axis) or axis


def _checked(file: ParameterFile, law: Law, scenario: Scenario, axis: str | None) -> MotionCheck:
    try:
        runs = _ends(file, scenario, axis)
    except SimulationError as error:
        return _not_possible(file, law, scenario.name, axis, error)
    return _judged(file, law, scenario, axis, runs)


_Run = tuple[Trace, tuple[str, ...], str]
"""A trace, what was taken for it, and what its figures are called after."""


def _judged(
    file: ParameterFile, law: Law, scenario: Scenario, axis: str | None, runs: Sequence[_Run]
) -> MotionCheck:
    """Return what the runs of a scenario show."""
    instance, letter = axis or "", _letter_of(file, axis)
    # The worse end of the travel decides.
    decided = max((trace for trace, _, _ in runs), key=lambda trace: _WORSE.index(_verdict(trace)[0]))
    stops_at = bind_axis(file, law, instance).stops_at if instance else ""
    loops = Loops(bind_axis(file, law, decided.axis)) if scenario.name in SHOWN_BY else None
    verdict, why = _decided_verdict(file, law, scenario, instance, decided, loops, ends=len(runs))
    figures = {
        name + end: trace.result[name]
        for trace, _, end in runs
        for name in scenario.checked
        if name in trace.result
    }
    alarms = dict.fromkeys(alarm for trace, _, _ in runs for alarm in trace.alarms)
    notes = dict.fromkeys(note for trace, assumed, _ in runs for note in (*assumed, *trace.assumptions))
    params = _parameters(file, law, decided) if verdict != "good" and instance else ()
    return MotionCheck(
        scenario.name,
        instance,
        letter,
        verdict,
        figures,
        tuple(alarms),
        why,
        params,
        tuple(notes),
        scenario.part,
        _headline(scenario, figures),
        _use_of_loops(loops, scenario.name) if loops else _use(decided, stops_at),
        decided,
    )


def _decided_verdict(
    file: ParameterFile,
    law: Law,
    scenario: Scenario,
    instance: str,
    trace: Trace,
    loops: Loops | None,
    *,
    ends: int,
) -> tuple[Verdict, str]:
    """Return the verdict on the run that decides, of so many ends of the travel, and why it is not good."""
    verdict, why = _verdict(trace)
    if verdict == "good":
        verdict, why = _seen_from_outside(file, law, scenario, instance, trace, loops)
    if verdict == "good" and scenario.opposite and ends == 1:
        verdict, why = "doubtful", _ONE_END
    if verdict == "bad" and scenario.programmed:
        verdict = "doubtful"  # the speed is the program's: another one may be good
    return verdict, why


def _seen_from_outside(
    file: ParameterFile, law: Law, scenario: Scenario, axis: str, trace: Trace, loops: Loops | None
) -> tuple[Verdict, str]:
    """Return what is wrong with a motion that is good by itself: in its loops, or in its direction."""
    verdict, why = _of_loops(loops, scenario.name) if loops is not None else ("good", "")
    if verdict == "good" and scenario.name == "home":
        return _of_direction(bind_axis(file, law, axis), trace)
    return verdict, why


def _headline(scenario: Scenario, figures: dict[str, Figure]) -> str:
    """Return the figure that a list shows: the worse one of both ends of the travel."""
    name = scenario.headline
    ends = [end for end in (name, f"{name}_minus") if figures.get(end, (None, ""))[0] is not None]
    found = max(ends, key=lambda end: abs(figures[end][0] or 0.0), default="")
    return found or next((each for each, (value, _) in figures.items() if value is not None), "")


def _use(trace: Trace, stops_at: str) -> LimitUse | None:
    """Return how much of its limit a run takes: of the safe part of a turn, of the following error."""
    grid = trace.result.get("home_grid", (None, ""))[0]
    if grid is not None:
        middle, half = 0.5 * (NEAR_GRID[1] + NEAR_GRID[0]), 0.5 * (NEAR_GRID[1] - NEAR_GRID[0])
        return LimitUse(abs(grid - middle) / half, "the safe part of a turn between switch and marker")
    peak, unit = trace.result.get("peak_following_error", (None, ""))
    most = trace.limits.get(stops_at, (None, ""))[0]
    return LimitUse(peak / most, stops_at, peak, most, unit) if peak is not None and most else None


def _use_of_loops(loops: Loops, scenario: str) -> LimitUse | None:
    """Return how much a loop takes of the margins that every sound axis keeps; None for one that controls no
    position.
    """
    if scenario == "velocity":
        lacks = loops.inner.lacks(SOUND.inner_phase, SOUND) if loops.inner else None
        lacks = lacks if loops.inner_stable else math.inf
    else:
        lacks = loops.lacks() if loops.closed else None
    return None if lacks is None else LimitUse(1.0 + lacks, SOUND.text())


def _ends(
    file: ParameterFile, scenario: Scenario, axis: str | None
) -> list[tuple[Trace, tuple[str, ...], str]]:
    """Return the traces of a scenario, what was taken for them, and what their figures are called after:
    "_minus" at the lower end of the travel. Raises SimulationError where neither end has one.
    """
    if not scenario.opposite:
        return [(*_run(file, scenario, axis), "")]
    found: list[tuple[Trace, tuple[str, ...], str]] = []
    error = SimulationError("")
    for settings, end in ((None, ""), (scenario.opposite, "_minus")):
        try:
            # Recommendations are a third of the time, and a check shows none.
            found.append((simulate(file, scenario.name, axis, settings, advise=False), (), end))
        except SimulationError as other:
            error = other
    if not found:
        raise error
    return found


def _run(file: ParameterFile, scenario: Scenario, axis: str | None) -> tuple[Trace, tuple[str, ...]]:
    """Return the trace of a scenario with what is in the file, or with what a program gives besides, and
    what was taken for it; raises SimulationError.
    """
    try:
        return simulate(file, scenario.name, axis, advise=False), ()
    except SimulationError as error:
        # Only what a program would give is filled in; a value that the file lacks must be reported.
        if error.parameter not in scenario.programmed:
            raise
    given = ", ".join(f"{name} {value}" for name, value in scenario.programmed.items())
    return simulate(file, scenario.name, axis, scenario.programmed, advise=False), (
        _PROGRAMMED.format(given),
    )


def _verdict(trace: Trace) -> tuple[Verdict, str]:
    """Return what a trace shows, and why it is not good."""
    alarms = trace.alarms
    if trace.scenario == "travel":  # the alarm of the limit is what the check asks for
        if trace.result.get("stop_position", (0.0, ""))[0] is None:
            return "bad", "The axis does not come to rest behind the limit"
        alarms = alarms[:-1]
    if alarms:
        return "bad", alarms[0].message
    figure = {name: value for name, (value, _) in trace.result.items() if value is not None}
    if figure.get("deviation_at_end"):
        return "doubtful", "The speed stays outside of the tolerance of its watch"
    if "gap_low" in figure:
        low, high = (value_text(figure[name]) for name in ("gap_low", "gap_high"))
        return "doubtful", f"No gear has the speeds from {low} to {high} rpm"
    if trace.scenario == "home" and trace.result.get("home_position", (0.0, ""))[0] is None:
        return "bad", "The axis does not reach its home position"
    if trace.scenario == "step" and trace.result.get("in_position_time", (0.0, ""))[0] is None:
        return "bad", "The axis does not get in position"
    if "home_grid" in figure and not NEAR_GRID[0] <= figure["home_grid"] <= NEAR_GRID[1]:
        return (
            "doubtful",
            (
                f"The marker is {figure['home_grid']:.0f} % of a turn from the switch: it may be another one"
                " each time"
            ),
        )
    return "good", ""


def _of_direction(axis: AxisLaw, trace: Trace) -> tuple[Verdict, str]:
    """Return whether a homing finds its switch from most of the travel: one in the wrong direction runs away
    from it. Only the switch of the course and both limits show that.
    """
    if axis.homing is None or axis.travel is None or trace.course is None or trace.course.switch is None:
        return "good", ""
    sign = math.copysign(1.0, axis.homing().approach)
    home, gone = (trace.result[name][0] for name in ("home_position", "home_from_start"))
    edges = axis.travel().limits.values()
    low, high = (least for least, _ in edges), (most for _, most in edges)
    begin, end = max(low, default=-math.inf), min(high, default=math.inf)
    if home is None or gone is None or not math.isfinite(end - begin) or begin >= end:
        return "good", ""
    switch = home - gone + trace.course.switch[0]
    share = (switch - begin if sign > 0.0 else end - switch) / (end - begin)
    if share >= _AHEAD_SHARE:
        return "good", ""
    place, first, last = (value_text(each, axis.unit) for each in (switch, begin, end))
    return "doubtful", (
        f"The axis has its switch at {place} ahead in {max(share, 0.0) * 100.0:.0f} % of its travel,"
        f" {first} to {last}: from the rest it goes away from it. Look at the direction of homing"
    )


def _of_loops(loops: Loops, scenario: str) -> tuple[Verdict, str]:
    """Return whether the loops that a scenario shows are sound: by the numbers of `tune`, so that a check
    does not call good what `frequency` changes.
    """
    is_of_velocity = scenario == "velocity"
    if loops.inner_sound() if is_of_velocity else not loops.closed or loops.sound():
        return "good", ""
    return "doubtful", why_not_sound(loops)


def _parameters(file: ParameterFile, law: Law, trace: Trace) -> tuple[str, ...]:
    """Return the parameters behind the figures of a scenario that is not good."""
    if trace.scenario == "home":
        return _asked(file, law, "home", trace.axis)
    bound = bind_axis(file, law, trace.axis)
    # An axis that does not stop has a loop that is not stable, or too little torque for its speed.
    wanted = (*bound.gains, *_RATES, *(LIMITS if trace.scenario == "travel" else ()))
    return tuple(dict.fromkeys(bound.sources[name].parameter for name in wanted if name in bound.sources))


def _asked(file: ParameterFile, law: Law, scenario: str, axis: str) -> tuple[str, ...]:
    """Return the parameters that homing, jog or travel of an axis are made of, as they are read."""
    read: list[Address] = []
    part = getattr(bind_axis(file, law, axis, on_read=read.append), _ASKED[scenario])
    read.clear()
    with suppress(SimulationError):
        if part is not None:
            part()
    return tuple(dict.fromkeys(parameter for parameter, _ in read))
