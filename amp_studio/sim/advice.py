"""Recommendations from the damping and the margins of the loops: one parameter, its value, the reason and the price.

Every value is tried before it is given: the axis is bound with it, and its linear model has to be sound. The limits are those of
K. J. Åström, T. Hägglund, PID Controllers: Theory, Design, and Tuning (1995): 6 dB and 45 deg; a damping ratio of 0.6 overshoots by
a tenth.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property

from .law import AxisLaw, Source
from .linear import Margins, axis_model, linear_model
from .rounding import rounded_down, rounded_up, shown
from .trace import Recommendation
from .trial import Trial

LEAST = (45.0, 6.0, 0.6)
"""deg, dB, damping ratio of a sound loop."""
INNER = (30.0, 6.0)
"""deg, dB of a sound velocity loop with an integral part."""
LESS = ((30.0, 6.0, 0.3), (15.0, 4.0, 0.15))
"""What is sought where no value makes the loop sound."""
AMPLE = (75.0, 14.0)
"""deg, dB of a loop with a reserve."""
KEPT = (60.0, 10.0, 0.7)
"""deg, dB, damping ratio that a loop keeps when its reserve is used."""
WORTH = 1.25
"""A reserve below this factor is not worth a change."""
POINTS = 160
"""Points of the grid for a value that is tried."""
FURTHEST, HALVINGS = 5, 5
"""Doublings of a value that are tried, and halvings of the last of them."""

INERTIAS = (1.0 / 16.0, 16.0)
"""Shares of the total inertia within which an axis is tried."""
STEPS = 8
"""Steps to each of them."""

CHATTER = (
    "Inside of its backlash the motor moves without its load, and this loop is too fast for the motor alone: it is not stable there,"
    " and chatters to and fro in the gap."
)
POSITION = ("position_gain",)
VELOCITY = (
    "velocity_rate",
    "velocity_gain",
    "velocity_proportional_gain",
    "derivative_gain",
    "integral_rate",
    "integral_gain",
    "velocity_integral_gain",
)
"""Figures in `AxisLaw.sources`: gains of the position loop, of the velocity loop or of a damping term."""


class Loops:
    """How an axis is damped: its loops, each computed when it is asked for."""

    def __init__(self, axis: AxisLaw, points: int = POINTS) -> None:
        self._models, self._points = axis_model(axis), points

    @cached_property
    def stable(self) -> bool:
        """Whether the axis is stable."""
        return self._models.whole.is_stable()

    @cached_property
    def inner_stable(self) -> bool:
        """Whether the velocity loop alone is stable."""
        return self._models.inner is None or self._models.inner.is_stable(drift=True)

    @cached_property
    def inner(self) -> Margins | None:
        """Margins of the velocity loop; None without one."""
        return self._models.inner.margins(self._points) if self._models.inner else None

    @cached_property
    def outer(self) -> Margins:
        """Margins of the position loop."""
        return self._models.cut.margins(self._points)

    @cached_property
    def damping(self) -> float:
        """Damping ratio of the position loop."""
        return self._models.damping(self.outer.phase_frequency)

    def inner_sound(self, phase: float = INNER[0], gain: float = INNER[1]) -> bool:
        """Return whether the velocity loop is stable with these margins."""
        return self.inner_stable and (self.inner is None or _keeps(self.inner, phase, gain))

    def sound(self, phase: float = LEAST[0], gain: float = LEAST[1], damping: float = LEAST[2]) -> bool:
        """Return whether the axis is stable with these margins and this damping ratio."""
        if not (self.stable and self.inner_sound(min(phase, INNER[0]), min(gain, INNER[1]))):
            return False
        return _keeps(self.outer, phase, gain) and self.damping >= damping


def _keeps(margins: Margins, phase: float, gain: float) -> bool:
    return (margins.phase is None or margins.phase >= phase) and (
        margins.gain is None or margins.gain >= gain
    )


def recommend(trial: Trial, scenario: str) -> tuple[Recommendation, ...]:
    """Return the recommendations for an axis: the least change of one gain, or of several in the same proportion, that makes
    it sound; after a sweep the gain that uses a reserve.

    While figures of the machine are assumed no gain is raised: a wrong guess would cost a machine.
    """
    loops = Loops(trial.axis)
    if not loops.sound():
        return tuple(_sounder(trial, loops))
    ample = _keeps(loops.outer, *AMPLE) and loops.outer.gain is not None
    if scenario == "frequency" and ample and not trial.axis.assumed:
        return tuple(_faster(trial, loops))
    return ()


def _sounder(trial: Trial, loops: Loops) -> Iterator[Recommendation]:
    """Yield the least change that makes the axis sound; where none does, the least that gives it some margin."""
    tried = _TriedValue(trial)
    for aim in (LEAST, *LESS):
        if loops.inner_sound(min(aim[0], INNER[0]), min(aim[1], INNER[1])) and loops.sound(*aim):
            return
        inside = not loops.inner_sound(min(aim[0], INNER[0]), min(aim[1], INNER[1]))
        names = [
            name for name in (VELOCITY if inside else (*POSITION, *VELOCITY)) if name in trial.axis.sources
        ]
        groups = [(name,) for name in names] + ([tuple(names)] if len(names) > 1 else [])

        def good(found: Loops, inside: bool = inside, aim: tuple[float, float, float] = aim) -> bool:
            return (
                found.inner_sound(min(aim[0], INNER[0]), min(aim[1], INNER[1]))
                if inside
                else found.sound(*aim)
            )

        shares = [(share, group) for group in groups if (share := _boundary(tried, group, good))]
        if shares:
            share, group = min(shares, key=lambda found: abs(math.log(found[0])) * len(found[1]))
            yield from _changed(trial, loops, group, share, _why(loops, trial.axis))
            return


def _faster(trial: Trial, loops: Loops) -> Iterator[Recommendation]:
    """Yield the highest position gain that keeps ample margins."""
    for share in (8.0, 4.0, 2.0, math.sqrt(2.0), WORTH):
        axis = _with(trial, POSITION, share)
        if axis is not None and Loops(axis).sound(*KEPT):
            why = f"The position loop has a reserve: {_margins(loops.outer)}"
            yield from _changed(trial, loops, POSITION, share, why)
            return


class _TriedValue:
    """The loops of an axis with a share of some of its gains, each computed once."""

    def __init__(self, trial: Trial) -> None:
        self._trial, self._known = trial, dict[tuple[Sequence[str], float], Loops | None]()
        self.bases = (0.5,) if trial.axis.assumed else (0.5, 2.0)
        """Ways to change a gain: down, up; up on a machine that is known alone."""

    def loops(self, names: Sequence[str], share: float) -> Loops | None:
        """Return the loops; None where a gain has no value or would be out of range."""
        if (names, share) not in self._known:
            axis = _with(self._trial, names, share)
            self._known[names, share] = None if axis is None else Loops(axis)
        return self._known[names, share]


def _boundary(tried: _TriedValue, names: Sequence[str], good: Callable[[Loops], bool]) -> float | None:
    """Return the factor nearest to 1 that makes the gains good, found by doubling and halving; None for none."""
    best: list[float] = []
    for base in tried.bases:
        for n in range(1, FURTHEST + 1):
            found = tried.loops(names, base**n)
            if found is None:
                break
            if good(found):
                best.append(_nearest(tried, names, good, base, n))
                break
    return min(best, key=lambda share: abs(math.log(share))) if best else None


def _nearest(
    tried: _TriedValue, names: Sequence[str], good: Callable[[Loops], bool], base: float, n: int
) -> float:
    far, near = float(n), float(n - 1)
    for _ in range(HALVINGS):
        middle = 0.5 * (far + near)
        found = tried.loops(names, base**middle)
        if found is not None and good(found):
            far = middle
        else:
            near = middle
    return float(base**far)


def _with(trial: Trial, names: Sequence[str], share: float) -> AxisLaw | None:
    """Return the axis with a share of its gains; None if one of them has none or would be out of range."""
    numbers: dict[str, float] = {}
    for name in names:
        source = trial.axis.sources.get(name)
        number = _number(trial, source, share) if source else None
        if source is None or number is None:
            return None
        numbers[source.parameter] = number
    return trial.bound(numbers)


def _number(trial: Trial, source: Source, share: float) -> float | None:
    """Return a share of the value of a parameter, with three digits, away from the old value; None without a value."""
    old = trial.value(source.parameter)
    if old is None or not float(old.value):
        return None
    number = float(old.value) * share
    number = rounded_up(number) if share > 1.0 else rounded_down(number)
    if source.whole or isinstance(old.value, int):
        number = float(math.ceil(number) if share > 1.0 else math.floor(number))
    return number


def _changed(
    trial: Trial, loops: Loops, names: Sequence[str], share: float, why: str
) -> Iterator[Recommendation]:
    """Yield the values with the loops that they give, and the price."""
    axis = _with(trial, names, share)
    if axis is None:
        return
    after = Loops(axis)
    inner = not loops.inner_sound() and after.inner is not None
    gives = _margins(after.inner if inner and after.inner else after.outer)
    assumed = ", on the assumed machine" if trial.axis.assumed else ""
    price = _price(trial.axis, axis, names, share)
    for name in names:
        source = trial.axis.sources[name]
        number, old = _number(trial, source, share), trial.value(source.parameter)
        if number is None or old is None:
            continue
        page = f" (page {source.page})" if source.page else ""
        others = [trial.axis.sources[other].parameter for other in names if other != name]
        together = f" together with {' and '.join(others)}" if others else ""
        with_it = f"with {shown(number, digits=6)}{together} it has {gives}, damping ratio {shown(after.damping, digits=2)}"
        yield Recommendation(source.parameter, number, old.unit, f"{why}; {with_it}{assumed}{page}.", price)


def stable_inertias(axis: AxisLaw) -> tuple[float, float] | None:
    """Return between which shares of its total inertia a stable axis stays stable, within INERTIAS; None where it does not
    matter: a drive with a velocity loop is taken to fit its load.
    """
    if axis.machine.velocity_per_output > 0.0:
        return None
    return _stable_to(axis, INERTIAS[0]), _stable_to(axis, INERTIAS[1])


def _stable_to(axis: AxisLaw, furthest: float) -> float:
    """Return the last share of the inertia on the way to ``furthest`` with which an axis is stable."""
    good, bad = 0.0, 0.0
    for n in range(1, STEPS + 1):
        if not _is_stable(axis, furthest ** (n / STEPS)):
            bad = n / STEPS
            break
        good = n / STEPS
    for _ in range(HALVINGS if bad else 0):
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if _is_stable(axis, furthest**middle) else (good, middle)
    return float(furthest**good)


def _is_stable(axis: AxisLaw, inertia: float) -> bool:
    machine = replace(axis.machine, acceleration_per_output=axis.machine.acceleration_per_output / inertia)
    return linear_model(replace(axis, machine=machine)).is_stable()


def _why(loops: Loops, axis: AxisLaw) -> str:
    if not loops.inner_sound() and loops.inner is not None:
        state = "has too little margin" if loops.inner_stable else "is not stable"
        ratio = axis.machine.inertia_ratio
        load = f" with a load of {shown(ratio, digits=3)} times the inertia of the motor" if ratio else ""
        return f"The velocity loop {state}{load}: {_margins(loops.inner)}"
    if not loops.stable:
        return f"The position loop is not stable: {_margins(loops.outer)}"
    if not _keeps(loops.outer, LEAST[0], LEAST[1]):
        return f"The position loop has too little margin: {_margins(loops.outer)}"
    return f"The position loop overshoots: its damping ratio is {shown(loops.damping, digits=2)}"


def _margins(margins: Margins) -> str:
    parts = [
        f"{shown(value, unit, 3)} {name} margin"
        for value, unit, name in ((margins.phase, "deg", "phase"), (margins.gain, "dB", "gain"))
        if value is not None
    ]
    return " and ".join(parts) or "no limit"


def _price(before: AxisLaw, after: AxisLaw, names: Sequence[str], share: float) -> str:
    """Return what a change costs, in a sentence."""
    name = names[0]
    if name in POSITION and share < 1.0 and before.feedrate:
        errors = [_following_error(axis, before.feedrate) for axis in (before, after)]
        if None not in errors and (errors[1] or 0.0) > 1.01 * (errors[0] or 0.0):
            worse = " to ".join(shown(error or 0.0, before.unit, 3) for error in errors)
            return f"The following error at the rapid feedrate grows from {worse}."
    if name in POSITION and share < 1.0:
        return f"The axis answers {shown(1.0 / share, digits=2)} times more slowly."
    if name in POSITION:
        return "Less margin for a heavier load, friction and wear."
    if "integral" in name and share < 1.0:
        return f"A lasting load is corrected {shown(1.0 / share, digits=2)} times more slowly."
    if share > 1.0:
        return f"Every count of the feedback moves the output {shown(share, digits=2)} times as much."
    slower = linear_model(before).bandwidth(), linear_model(after).bandwidth()
    if None not in slower:
        return f"Less stiffness; bandwidth {' to '.join(shown(f or 0.0, 'Hz', 3) for f in slower)}."
    return f"The axis resists a load {shown(1.0 / share, digits=2)} times less."


def _following_error(axis: AxisLaw, feedrate: float) -> float | None:
    found = axis.predict(feedrate).get("steady_following_error")
    return found.value if found else feedrate / axis.position_rate


def recommendations(
    trial: Trial, scenario: str, own: Sequence[Recommendation] = ()
) -> tuple[tuple[Recommendation, ...], tuple[str, ...]]:
    """Return the recommendations of the family and of the loops, one for a parameter, and a note where none mends a loop.

    The family's goes before.
    """
    chatter = (CHATTER,) if chatters_in_gap(trial.axis) else ()
    if _mends(trial, own):  # lower gains besides would work against it
        return tuple(own), chatter
    named = {each.parameter for each in own}
    found, loops = recommend(trial, scenario), Loops(trial.axis)
    if found or loops.sound():
        return (*own, *(each for each in found if each.parameter not in named)), chatter
    raised = (
        " without raising a gain, which is not recommended on an assumed machine"
        if trial.axis.assumed
        else ""
    )
    why = f"{_why(loops, trial.axis)}. No change of the gains alone gives it enough{raised}."
    return tuple(own), (why, *chatter)


def _mends(trial: Trial, own: Sequence[Recommendation]) -> bool:
    """Return whether the family's own recommendations make an axis sound that is not."""
    values = {
        each.parameter: each.value
        for each in own
        if (old := trial.value(each.parameter)) and old.unit == each.unit
    }
    if not values or Loops(trial.axis).stable:
        return False
    axis = trial.bound(values)
    return axis is not None and Loops(axis).sound()


def chatters_in_gap(axis: AxisLaw) -> bool:
    """Return whether a motor without its load, as it is inside of the backlash, is in a loop that is not stable."""
    machine = axis.machine
    if machine.backlash == 0.0 or machine.velocity_per_output > 0.0:
        return False
    light = machine.acceleration_per_output * (1.0 + machine.coupling[2])
    alone = replace(machine, acceleration_per_output=light, backlash=0.0, resonance=0.0, load_sensor=False)
    loops = Loops(replace(axis, machine=alone))
    return not (loops.inner_stable and loops.stable)
