"""From an open parameter file to a trace."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import Address, axis_name, load_part, registration_of, unknown_name

from .axis_parameters import AxisParameters, ParameterValue
from .binding import axis_values, bind_axis, parameter_names
from .errors import SimulationError
from .law import AxisLaw, BoundMachine, Law, law_of
from .listings import known_settings
from .machine_test import MachineTest
from .scenario import ScenarioSettings
from .scenarios import SCENARIOS
from .scenarios.circle import SECOND
from .settings import read_settings, refuse_other_unit
from .trace import Trace
from .tuning.advice import recommendations
from .tuning.trial import Trial
from .unit_system import axis_unit, in_unit, length_unit

if TYPE_CHECKING:
    from .variations.scenario import SweepWay

_V = TypeVar("_V")
POINTS = ("move.start", "move.to", "move.zone")
"""Settings that have a figure for each of several axes, or several figures."""


def simulate(
    file: ParameterFile,
    scenario: str,
    axis: str | None = None,
    settings: Mapping[str, float | str] | None = None,
    system: str | None = None,
    *,
    advise: bool = True,
    like: Trace | None = None,
    way: SweepWay | None = None,
) -> Trace:
    """Run a scenario with the present values of a file;
    ``axis`` None means the first axis that can be simulated.

    ``settings`` are settings of the scenario and of the model (``move.feedrate``): numbers in the units that
    `listing.py` names, or texts with a unit. ``system`` is the unit system of settings and trace, None for
    that of the file. Without ``advise`` the trace has neither recommendations nor doubts, which takes a third
    of the time. ``like`` is a trace whose move is made again, but for what is set. Raises SimulationError
    with the parameter that is missing or impossible.
    """
    law = law_of(file.schema.family.family)
    _refuse_unknown_scenario(file, law, scenario)
    length = length_unit(file, system)
    unit = axis_unit(file, axis or next(iter(law.axes(file)), ""), length)
    # A point has a figure for each axis: it is read by its scenario.
    names = axis or ""
    texts, rest = _parted(settings or {}, (POINTS if "," in names else ()).__contains__)
    given, written = read_settings(rest, known_settings(law, scenario), unit)
    model, own = _parted({**given, **texts}, lambda name: name.startswith("model."))
    if like:
        # What is set counts more than the move of the trace that is made again.
        own = {**like.move, **own}
    read: list[Address] = []
    whole = _whole_run(law, scenario, axis)
    if whole is not None:
        trace = whole(bound_machine(file, law, _listed(names), model, read.append), own)
        letter = _letters(file, trace.axis)
    else:
        bound = bind_axis(file, law, axis, model, read.append)
        # Not before it is bound: whether the axis turns is in the file.
        refuse_other_unit(written, bound.axis, bound.unit)
        letter = axis_name(file.evaluation, bound.axis)
        trace = _of_one_axis(scenario, file, law, bound, model, own, way, advise=advise)
    if advise or whole is not None or _always_doubts(law, scenario):
        from .doubts import doubts  # it takes the rules and the guide along, which a picture does not need

        trace = replace(trace, doubts=(*trace.doubts, *doubts(file, read, model)))
    return in_unit(_named(trace, letter), length)


def _parted(
    settings: Mapping[str, _V], is_first: Callable[[str], bool]
) -> tuple[dict[str, _V], dict[str, _V]]:
    """Return the settings whose names are of the first kind, and the others."""
    first = {name: value for name, value in settings.items() if is_first(name)}
    return first, {name: value for name, value in settings.items() if name not in first}


def _letters(file: ParameterFile, axes: str) -> str:
    return ",".join(axis_name(file.evaluation, each) or each for each in _listed(axes))


def _always_doubts(law: Law, scenario: str) -> bool:
    """Return whether a scenario names its doubts even without recommendations: one that the law
    brings, and one that tries gains.
    """
    return scenario in law.own() or SCENARIOS[scenario].tried


def _listed(axes: str) -> tuple[str, ...]:
    return tuple(each.strip() for each in axes.split(",") if each.strip())


def _refuse_unknown_scenario(file: ParameterFile, law: Law, scenario: str) -> None:
    known = (*SCENARIOS, *law.own())
    if scenario not in known:
        raise SimulationError(unknown_name("scenario", scenario, known))
    if scenario not in (*law.motion.scenarios, *law.own()):
        raise SimulationError(
            f"{file.schema.family.name} has no scenario '{scenario}':"
            f" {', '.join((*law.motion.scenarios, *law.own()))}"
        )


def _of_one_axis(
    scenario: str,
    file: ParameterFile,
    law: Law,
    bound: AxisLaw,
    model: Mapping[str, ParameterValue],
    own: ScenarioSettings,
    way: SweepWay | None,
    *,
    advise: bool,
) -> Trace:
    """Run a scenario of one axis, with what it and the law recommend."""
    if scenario in law.own():
        trace = law.own()[scenario].run(bound, own)
        return replace(trace, recommendations=(*trace.recommendations, *law.advise(bound, trace)))
    chosen = SCENARIOS[scenario]
    if chosen.tried:
        # Gains of axes that make contours together must give the same following error on all.
        others = _alike(file, law, bound, model)
        return chosen.run(_trial(file, law, bound.axis, model), own, others, *([way] if way else []))
    second = (_second(file, law, bound, own.get(SECOND), model),) if chosen.second else ()
    trace = chosen.run(bound, own, *second)
    if not advise:
        return trace
    found, notes = (*trace.recommendations, *law.advise(bound, trace)), tuple[str, ...]()
    if chosen.gains:
        found, notes = recommendations(_trial(file, law, bound.axis, model), scenario, found)
    return replace(trace, recommendations=found, assumptions=(*trace.assumptions, *notes))


def _whole_run(
    law: Law, scenario: str, axis: str | None
) -> Callable[[BoundMachine, ScenarioSettings], Trace] | None:
    """Return how a scenario is run that is not about one axis; None for one that is.
    Raises SimulationError for several axes of such a one.
    """
    chosen = law.own().get(scenario) or SCENARIOS.get(scenario)
    if chosen is not None and chosen.of_machine:
        return chosen.run
    if axis is None or "," not in axis:
        return None
    if chosen is None or chosen.several is None:
        raise SimulationError(f"{scenario} takes one axis, not {axis}")
    return chosen.several


def bound_machine(
    file: ParameterFile,
    law: Law,
    names: Sequence[str],
    model: Mapping[str, ParameterValue],
    on_read: Callable[[Address], None],
) -> BoundMachine:
    """Return the machine of a file; raises SimulationError for an axis that is not fitted."""
    fitted = tuple(law.axes(file))

    def letter(axis: str) -> str:
        return axis_name(file.evaluation, axis)

    def read(axis: str) -> AxisParameters:
        values, tables = axis_values(file, on_read), file.schema.tables
        return AxisParameters(
            values, axis, {}, tables, file.machine, file.header.application, parameter_names(file)
        )

    chosen = [
        name if name in fitted else next((each for each in fitted if letter(each) == name.upper()), name)
        for name in names
    ]
    for name in chosen:
        if name not in fitted:
            raise SimulationError(f"Axis {name} is not fitted. Fitted: {', '.join(fitted)}")
    if len(set(chosen)) < len(chosen):
        raise SimulationError(f"An axis is given twice: {', '.join(names)}")

    def bind(axis: str | None, further: Mapping[str, ParameterValue]) -> AxisLaw:
        return bind_axis(file, law, axis, {**model, **further}, on_read)

    return BoundMachine(law, tuple(chosen), fitted, bind, read, letter)


def sweep(
    file: ParameterFile,
    axis: str | None = None,
    settings: Mapping[str, float | str] | None = None,
    system: str | None = None,
    *,
    way: SweepWay,
) -> Trace:
    """Run the scenario `sweep` as `simulate` does, over the cores or the cluster that ``way`` names."""
    return simulate(file, "sweep", axis, settings, system, way=way)


def _trial(file: ParameterFile, law: Law, axis: str, model: Mapping[str, ParameterValue]) -> Trial:
    return Trial(file, lambda other: bind_axis(other, law, axis, model), model)


def _alike(file: ParameterFile, law: Law, first: AxisLaw, model: Mapping[str, ParameterValue]) -> list[Trial]:
    """Return the axes that make contours with one, itself too:
    those that can be simulated and move in the same unit.
    """
    found = []
    for name in law.axes(file):
        try:
            trial = _trial(file, law, name, model)
        except SimulationError:
            continue
        if trial.axis.unit == first.unit:
            found.append(trial)
    return found


def _named(trace: Trace, letter: str) -> Trace:
    """Return a trace with the letter of its axis, in its alarms too."""
    alarms = tuple(alarm.of_axis(letter or trace.axis) for alarm in trace.alarms)
    return replace(trace, letter=letter, alarms=alarms)


def _second(
    file: ParameterFile, law: Law, first: AxisLaw, name: ParameterValue, model: Mapping[str, ParameterValue]
) -> AxisLaw | None:
    """Return the second axis: the one of that name,
    else the next one that can be simulated and moves in the same unit.
    """
    if name is not None:
        second = bind_axis(file, law, f"{name:g}" if isinstance(name, float) else str(name), model)
        if second.axis == first.axis:
            raise SimulationError(f"Axis {first.axis} makes no circle with itself: give another axis", SECOND)
        return second
    axes = tuple(law.axes(file))
    place = axes.index(first.axis)
    # The next axis is the usual partner in a plane: Y to X; behind the last it goes on with the first.
    for other in (*axes[place + 1 :], *axes[:place]):
        try:
            second = bind_axis(file, law, other, model)
        except SimulationError:
            continue
        if second.unit == first.unit:
            return second
    return None


def machine_tests(file: ParameterFile, axis: str | None = None) -> tuple[MachineTest, ...]:
    """Return the programs and procedures that try an axis out, the first one by default.

    Raises SimulationError for a family that prints none, and where the axis cannot be made.
    """
    law = law_of(file.schema.family.family)
    if law.machine_tests is None:
        raise SimulationError(f"No test program is printed for {file.schema.family.name}")
    machine = bound_machine(file, law, (axis,) if axis else (), {}, lambda _address: None)
    return tuple(law.machine_tests(machine, machine.axis()))


def simulated_axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes of a file that can be simulated; empty for a family without a law."""
    place = registration_of(file.schema.family.family).law
    found = load_part(place) if place else None
    return tuple(found.axes(file)) if isinstance(found, Law) else fitted_axes(file)
