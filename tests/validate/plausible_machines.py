"""Plausible machines of every family: the examples at other sizes and speeds, axis by axis,
with other screws and options.

Each is made as the manuals' procedures make one: speeds, ramps and the error limits that follow from them by
the printed formulas are proportional to the speed of an axis, positions to its travel, counts and steps to
its screw. Only a machine in which the rules of the manuals find nothing is kept,
so what is found in it is found by experience alone.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from random import Random

from slips import examples

from amp_studio.files import ParameterFile, fitted_axes, open_file
from amp_studio.schema import Address, Value
from amp_studio.schema.units import dimension
from amp_studio.validate import Finding, Validator

SPEEDS = ("velocity", "acceleration", "jerk", "count rate", "count acceleration")
FACTORS = (0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.8, 1, 1, 1.2, 1.25, 1.5, 2, 2.5)


@dataclass(frozen=True)
class Recipe:
    """What is made otherwise in the machines of a family; patterns of ids."""

    travel: tuple[str, ...]
    """Positions: proportional to the travel of their axis."""
    errors: tuple[str, ...] = ()
    """Error limits: proportional to the speed of their axis."""
    screw: tuple[str, ...] = ()
    """Counts or steps of a length."""
    same: tuple[str, ...] = ()
    """What stays, though it is a speed."""
    together: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """What changes in proportion when one of ``free`` is chosen."""
    table: tuple[str, str, str] | None = None
    """Length, screw and speed of X and Y: no table is more than ten times as long as it is wide (one for
    profiles is), and equal motors with other screws have other speeds."""
    free: tuple[tuple[str, tuple[float | str | bool, ...]], ...] = ()
    """What everybody chooses as he likes, each axis by itself."""


RECIPES = {
    "9pc": Recipe(
        ("zone.limit*", "zone.overtravel_*", "home.position", "home.g30_position"),
        ("servo.excess_error", "servo.gain_break_point"),
        same=(
            "home.speed_off_switch",
            "accdec.velocity_step",
            "feedrate.external_decel*",
            "patch.*",
            "*.rapid_override*",
        ),
        free=(
            ("servo.reversal_error", (0.0, 0.002, 0.005, 0.012)),
            ("servo.torque_offset", (0, 2, 5)),
            ("tool.max_wear_change", (0.2, 0.5, 1.0)),
            ("tool.pocket_count", (12, 16, 20, 24, 30, 40)),
            ("probing.probe_length", (40.0, 60.0, 120.0)),
            ("probing.probe_radius", (1.0, 2.0, 2.5, 3.0)),
            ("comp.min_feed_reduction", (50, 70, 80)),
            ("cycle.peck_retract", (0.5, 1.0, 2.0)),
            ("feedrate.circular_tolerance", (0.005, 0.01, 0.02)),
            ("spindle.orient_speed", (30.0, 60.0, 100.0, 200.0)),
        ),
    ),
    "num": Recipe(
        ("travel.limit_*",),
        ("servo.max_following_error", "servo.movement_tolerance"),
        free=(
            ("travel.backlash", (0, 3, 8, 15)),
            ("servo.circle_error", (20, 50, 100)),
            ("spindle.indexing_speed", (50, 100, 300)),
            ("misc.backup_blocks", (10, 20, 50)),
            ("comm.file_timeout", (20, 30, 60, 120)),
            ("servo.jog_slow", (100, 200, 500)),
        ),
    ),
    "syntec": Recipe(
        ("limit.*",),
        table=("limit.first_positive", "resolution.pitch", "feed.rapid"),
        free=(
            ("home.offset", (0, 500, 1200)),
            ("home.direction", ("positive", "negative")),
            ("servo.loop_gain", (20, 30, 50)),
            ("mpg.acceleration_time", (60, 100, 200)),
            ("mpg.resolution", (25, 100)),
        ),
    ),
    "57c422b": Recipe(
        ("setup.overtravel_*",),
        ("setup.max_velocity_error",),
        free=(
            ("gain.deadband", (0, 20, 45)),
            ("gain.velocity", (60, 95, 180)),
            ("setup.in_position_tolerance", (5, 10, 20, 50)),
            ("setup.max_position_error", (500, 1500, 4000)),
        ),
    ),
    "acromill": Recipe(
        ("axes.soft_limit_minus", "reference.*", "work.*"),
        same=("tuning.*",),
        screw=("axes.pulses_per_unit",),
        free=(
            ("backlash.amount", (0.0, 0.0002, 0.0005, 0.001)),
            ("home.direction", ("pos", "neg")),
            ("control.lead_in_radius", (0.1, 0.25, 0.5)),
            ("probe.delay", (5.0, 10.0, 20.0)),
            ("fov.increment_percent", (2.0, 5.0, 10.0)),
            ("comm.baud_rate", (9600, 19200, 38400)),
            ("comm.stop_bits", (1, 2)),
        ),
    ),
    "grblhal": Recipe(
        ("axis.max_travel",),
        together={"spindle.max_speed": ("spindle.min_speed",)},  # the inverter's output goes with the share
        table=("axis.max_travel", "axis.steps", "axis.max_rate"),
        screw=("axis.steps",),
        same=("tool_change.*",),
        free=(
            ("general.junction_deviation", (0.01, 0.02, 0.05)),
            ("homing.pull_off", (1.0, 2.0, 3.0, 5.0)),
            ("homing.debounce", (25, 100, 250)),
            ("spindle.max_speed", (12000.0, 18000.0, 24000.0)),
            ("spindle.off_delay", (0.0, 5.0, 10.0)),
            ("stepper.pulse_time", (4.0, 5.0, 10.0)),
            ("axis.max_travel", (200.0, 300.0, 600.0, 1200.0)),
        ),
    ),
    "linuxcnc": Recipe(
        (),
        free=(
            ("joint.ferror", (1.0, 2.0, 5.0)),
            ("joint.min_ferror", (0.05, 0.1, 0.2)),
            ("joint.backlash", (0.0, 0.005, 0.02)),
        ),
    ),
}


def plausible_machines(family: str, count: int, seed: int = 1) -> Iterator[ParameterFile]:
    """Yield so many machines of a family, the same ones for a seed; each is sound by the rules of the
    manual.
    """
    bases = [
        file for file in (open_file(path).file for path in examples()) if file.schema.family.family == family
    ]
    made, number = 0, 0
    while made < count:
        number += 1
        assert number < 200 * count, f"{family}: {made} sound machines of {number}"
        random = Random(f"{family} {seed} {number}")
        file = random.choice(bases).copy()
        remake(file, random)
        table = RECIPES[family].table
        if table and not is_table(file, *table):
            continue
        if family == "57c422b" and slide_of(file) < CAM:
            continue
        if all(is_of_experience(finding) for finding in Validator(file).run()):
            made += 1
            yield file


def is_table(file: ParameterFile, length: str, screw: str, speed: str) -> bool:
    """Return whether X and Y belong to one machine."""
    (a, b), screws, speeds = (
        [v for _, v in sorted((a[1], v.value) for a, v in file.values.items() if a[0] == name)][:2]
        for name in (length, screw, speed)
    )
    is_one = max(a, b) <= 10 * min(a, b)
    return is_one and (speeds[0] != speeds[1] or screws[0] == screws[1])


CAM = 16000
"""Counts that the cam of the label press moves its slide there and back."""


def slide_of(file: ParameterFile) -> float:
    """Return the travel of the slide, in counts: no machine has one that is shorter than its cam."""
    return sum(abs(file.values[f"setup.overtravel_{end}", "Y"].value) for end in ("positive", "negative"))


def is_of_experience(finding: Finding) -> bool:
    """Return whether no manual and no rule is behind a finding."""
    return finding.rule.startswith("plausible.")


def remake(file: ParameterFile, random: Random) -> None:
    """Make another machine of a file: other speeds, travels and screws, for all axes or each by itself."""
    recipe = RECIPES[file.schema.family.family]
    axes = fitted_axes(file)
    some = [FACTORS[n] for n in sorted(random.sample(range(len(FACTORS)), 6))]
    alike = random.random() < 0.4
    first = (max(0.25, random.choice(some)), random.choice(some), random.choice((0.5, 1, 2, 2.5)))
    factors = {
        axis: (
            first if alike else (random.choice(some), random.choice(some), random.choice((0.5, 1, 1, 2, 2.5)))
        )
        for axis in axes
    }
    slowest = max(0.25, min((speed for speed, _, _ in factors.values()), default=1))
    wanted: dict[Address, Value | None] = {}
    for address, value in file.values.items():
        speed, travel, screw = factors.get(address[1].partition(".")[0], (slowest, 1, 1))
        factor = 1.0
        if _is_named(address, recipe.travel):
            factor = travel
        elif _is_named(address, recipe.screw):
            factor = screw
        elif _is_named(address, recipe.errors) or (
            dimension(value.unit).removeprefix("angular ") in SPEEDS and not _is_named(address, recipe.same)
        ):
            factor = speed
        if factor != 1 and not isinstance(value.value, bool | str):
            number = float(f"{value.value * factor:.7g}")
            wanted[address] = Value(round(number) if isinstance(value.value, int) else number, value.unit)
        for pattern, choices in recipe.free:
            if address[0] == pattern and random.random() < 0.5:
                wanted[address] = chosen = Value(random.choice(choices), value.unit)
                for other in recipe.together.get(pattern, ()):
                    old = file.values[other, address[1]]
                    number = old.value * chosen.value / value.value
                    wanted[other, address[1]] = Value(number, old.unit)
    file.set_checked(wanted, force="a plausible machine")
    file.forced.clear()


def _is_named(address: Address, patterns: tuple[str, ...]) -> bool:
    return any(fnmatchcase(address[0], pattern) for pattern in patterns)


def false_findings(count: int, seed: int = 1) -> list[str]:
    """Return every recommendation of experience in so many plausible machines a family, as a sentence."""
    return [
        f"{family} {n}: {finding.message}"
        for family in RECIPES
        for n, file in enumerate(plausible_machines(family, count, seed))
        for finding in Validator(file).run()
    ]


if __name__ == "__main__":
    print(*false_findings(40), sep="\n")
