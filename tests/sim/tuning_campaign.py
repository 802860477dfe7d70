"""Random machines for the solver of gains, and a grid search that knows nothing of it: ``make tunings``.

Each machine is the axis of an example with other figures of its mechanics, drive and gains. Of all of them is
asked: is none left unsound where the grid finds sound gains, is none made worse, is none softer than the
grid's best, has a second run nothing to add,
and do the gains keep what they promise with twice the friction too?
"""

from __future__ import annotations

import itertools
import math
import random
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import law_of
from amp_studio.sim.tuning.aims import AIMS
from amp_studio.sim.tuning.filters import Filters, FilterSetting
from amp_studio.sim.tuning.gains import Gain, gains_of
from amp_studio.sim.tuning.levels import Candidate, levels_of
from amp_studio.sim.tuning.loops import SOUND, Loops
from amp_studio.sim.tuning.solver import Search, Solved, solve
from amp_studio.sim.tuning.trial import Trial, address_of

EXAMPLES = Path(__file__).parents[2] / "examples"
AXES = (
    ("57c422b-label-press/LABEL_PRESS.amp", "X"),
    ("acromill-router/ROUTER.amp", "X"),
    ("lathe-ls176/LATHE_LS176.amp", "1"),
    ("mill-1394/MILL_1394.amp", "1"),
    ("num-1060-mill/MILL_1060.amp", "0"),
    ("syntec-mill/SYNTEC_MILL.amp", "1"),
)
STEPS = {1: 40, 2: 12, 3: 7}
"""Values of each gain in the grid, by the number of gains."""
COARSE_STEPS = {1: 30, 2: 10, 3: 5}
"""The same for each of several settings of the filters."""
MIN_OF_GRID, MAX_OF_GRID = 1e-7, 1e5
SOFTER = 1.05
"""The grid may be stiffer by this factor: it and the solver both stop somewhere."""

OTHER_FILTER = 1.25
"""By this factor with other filters: those are changed where they are worth more than a tenth."""


@dataclass(frozen=True)
class Plant:
    """An axis of an example with other mechanics and other gains."""

    number: int
    example: str
    axis: str
    settings: Mapping[str, float]
    shares: Mapping[str, float] = field(default_factory=dict)
    """Figure of a gain -> share of the example's value."""
    gains: Mapping[str, float] = field(default_factory=dict)
    """Parameter -> value."""

    def __str__(self) -> str:
        return f"{self.number}-{self.example.partition('/')[0]}"

    def with_gains(self, gains: Mapping[str, float]) -> Plant:
        """Return the axis with other gains."""
        return replace(self, gains=gains, shares={})


def random_plants(count: int, seed: int) -> list[Plant]:
    """Return so many axes, the families in turn."""
    dice = random.Random(seed)
    return [_random(dice, number, *AXES[number % len(AXES)]) for number in range(count)]


def _random(dice: random.Random, number: int, example: str, axis: str) -> Plant:
    def log(low: float, high: float) -> float:
        return math.exp(dice.uniform(math.log(low), math.log(high)))

    now = bind_axis(open_file(EXAMPLES / example).file, law_of(_family(example)), axis)
    machine = now.machine
    settings = {
        "model.acceleration_per_output": machine.acceleration_per_output * log(0.3, 3.0),
        "model.delay": 1e3 * max(machine.delay, 0.2 * now.servo_period) * log(0.5, 2.5),
        "model.viscous_friction": dice.choice(
            (0.0, machine.viscous_friction * 1000.0 / 60.0 * log(0.3, 3.0))
        ),
    }
    if dice.random() < 0.4:
        settings |= {
            "model.resonance": log(40.0, 300.0),
            "model.damping": log(0.02, 0.2),
            "model.inertia_ratio": log(0.3, 3.0),
        }
    if machine.velocity_per_output > 0.0:
        settings["model.velocity_bandwidth"] = machine.velocity_bandwidth * log(0.3, 2.0)
    shares = {name: log(0.1, 10.0) for name in now.gains}
    return Plant(number, example, axis, settings, shares)


def _family(example: str) -> str:
    return open_file(EXAMPLES / example).file.schema.family.family


def tried(plant: Plant) -> Trial:
    """Return a plant whose gains can be tried."""
    file = open_file(EXAMPLES / plant.example).file
    law = law_of(file.schema.family.family)
    present = bind_axis(file, law, plant.axis)
    wanted = dict(plant.gains)
    trial = Trial(file, lambda other: bind_axis(other, law, plant.axis))
    for name, share in plant.shares.items():
        source = present.sources[name]
        old, (low, high) = trial.value(source.parameter), trial.range_of(source.parameter)
        number = float(old.value) * share
        number = float(f"{0.99 * min(max(number, low or 0.0), high or number, source.largest):.3g}")
        wanted[source.parameter] = number
    for parameter, number in wanted.items():
        address = address_of(file, parameter, plant.axis)
        old = file.get(address)
        whole = old is not None and isinstance(old.value, int)
        file.set(address, Value(int(number) if whole else number, trial.unit(parameter)))
    return Trial(file, lambda other: bind_axis(other, law, plant.axis, plant.settings))


@dataclass(frozen=True)
class Grid:
    """What a grid search found."""

    sound: bool
    """Whether any gains are sound."""
    best: float
    """The least way that the load gives, with gains that keep all of the aim; infinite for none."""


def settings_of(trial: Trial) -> list[FilterSetting]:
    """Return the filters as they are, and others: a low-pass at three places, a notch at the resonance."""
    present, resonance = dict(Filters(trial).present), trial.axis.machine.resonance
    found = [present]
    for each in Filters(trial).unknowns:
        if not each.width:
            found += [present | {each.frequency: share * each.high} for share in (1.0, 0.1, 0.02)]
        elif resonance:
            found.append(present | {each.frequency: resonance, each.width: 0.5 * resonance})
    return [tuple(each.items()) for each in found]


def grid(plant: Plant, filters: FilterSetting | None = None, steps: Mapping[int, int] = STEPS) -> Grid:
    """Search the gains of a plant on a grid over their bounds, with its own filters or with others."""
    trial = tried(plant)
    gains = gains_of(trial)
    search, level = Search(trial, gains, filters=filters or ()), levels_of(AIMS["normal"])[0]
    sound, best = False, math.inf
    for point in itertools.product(*(_values(gain, steps[len(gains)]) for gain in gains)):
        found = search.candidate(point)
        if found is None or not found.loops.stable:
            continue
        if level.keeps(found, 1.0):
            best = min(best, sum(found.loops.yields))
        sound = sound or found.loops.sound()
    return Grid(sound, best)


def _values(gain: Gain, count: int) -> list[float]:
    low, high = max(gain.low, MIN_OF_GRID), min(gain.high, MAX_OF_GRID)
    found = [gain.nearest(low * (high / low) ** (n / (count - 1))) for n in range(count)]
    return ([0.0] if gain.may_be_none else []) + found


def faults(plant: Plant) -> Iterator[str]:
    """Yield what the solver does wrong on a plant."""
    solved = solve(tried(plant), AIMS["normal"])
    by_grid = grid(plant.with_gains(solved.numbers))
    if by_grid.sound and not solved.sound:
        yield "left unsound where the grid finds sound gains"
    if solved.level == 0 and by_grid.best * SOFTER < sum(solved.after.loops.yields):
        yield f"softer than the grid by {sum(solved.after.loops.yields) / by_grid.best:.3f}"
    if solved.level and math.isfinite(by_grid.best):
        yield f"keeps level {solved.level} where the grid keeps all of the aim"
    yield from _worse(solved)
    if plant.settings.get("model.resonance") or solved.level:
        yield from _other_filters(plant, solved)
    again = solve(tried(plant.with_gains(solved.numbers)), AIMS["normal"])
    if again.to_change:
        yield f"a second run changes {dict(again.to_change)} after {dict(solved.numbers)}"
    if solved.level == 0:
        for inertia in (0.5, 0.7, 1.4, 2.0):
            missing = _other(solved.after, inertia, 2.0).lacks(SOUND)
            if missing > 0.01:
                yield (
                    f"misses {missing:.3f} of what is sound with {inertia} of the inertia and twice the"
                    " friction"
                )


def _other_filters(plant: Plant, solved: Solved) -> Iterator[str]:
    """Yield where a grid over the gains with other filters finds what the solver did not."""
    for setting in settings_of(tried(plant)):
        other = grid(plant, setting, COARSE_STEPS)
        if other.sound and not solved.sound:
            yield f"left unsound where the grid is sound with {dict(setting)}"
        if solved.level and math.isfinite(other.best):
            yield f"keeps level {solved.level} where the grid keeps all of the aim with {dict(setting)}"
        gives = sum(solved.after.loops.yields)
        if solved.level == 0 and other.best * OTHER_FILTER < gives:
            yield f"softer by {gives / other.best:.3f} than the grid with {dict(setting)}"


def _worse(solved: Solved) -> Iterator[str]:
    before, after = solved.before.loops, solved.after.loops
    if before.sound() and not after.sound():
        yield "a sound axis is made unsound"
    if not before.sound() and after.lacks() > max(before.lacks(), 0.0):
        yield "an unsound axis is made worse"


def _other(candidate: Candidate, inertia: float, friction: float) -> Loops:
    machine = candidate.axis.machine
    changes = {
        "acceleration_per_output": machine.acceleration_per_output / inertia,
        "viscous_friction": machine.viscous_friction * friction,
    }
    if machine.velocity_per_output > 0.0:
        changes["velocity_bandwidth"] = machine.velocity_bandwidth / inertia
    return Loops(replace(candidate.axis, machine=replace(machine, **changes)), candidate.law)


def main(count: int, seed: int) -> int:
    """Run the campaign; return how many machines have a fault."""
    bad = 0
    for plant in random_plants(count, seed):
        try:
            found = list(faults(plant))
        except SimulationError as error:
            found = [str(error)]
        bad += bool(found)
        for fault in found:
            print(f"{plant}: {fault}\n    {dict(plant.settings)} {dict(plant.shares)}", flush=True)
        if (plant.number + 1) % 10 == 0:
            print(f"{plant.number + 1} machines, {bad} with a fault", file=sys.stderr, flush=True)
    print(f"{count} machines, seed {seed}: {bad} with a fault")
    return bad


if __name__ == "__main__":
    sys.exit(1 if main(int(sys.argv[1]), int(sys.argv[2])) else 0)
