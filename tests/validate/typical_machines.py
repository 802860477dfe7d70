"""Typical machines of every family, drawn from what is built: bench mills, machining centres, lathes,
routers, gantries, tables; inch and metric, slow and fast. A second generator beside ``plausible_machines``,
written without knowing it: travels, screws, encoders and speeds of a machine first, then the manual's
procedures.

Nothing may be found in them but a recommendation in one of forty.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import ceil, cos, floor, log10, pi
from random import Random

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder

Settings = dict[str, "float | int | str | None"]
"""id@instance -> value with its unit, None for none."""

EXAMPLES = {
    "57c422b": "LABEL_PRESS",
    "9pc": "MILL_1394",
    "acromill": "ROUTER",
    "grblhal": "GRBL_ROUTER",
    "linuxcnc": "MILL",
    "num": "MILL_1060",
    "syntec": "SYNTEC_MILL",
}


@dataclass(frozen=True)
class Kind:
    """A kind of machine: ranges of its travels (mm), rapid (mm/min), ramp (mm/s2), and its screws (mm)."""

    travels: tuple[tuple[float, float], ...]
    rapid: tuple[float, float]
    ramp: tuple[float, float]
    screws: tuple[float, ...]
    spindle: tuple[float, float] = (3000, 12000)


KINDS = {
    "bench mill": Kind(((200, 450), (130, 250), (200, 350)), (1500, 5000), (100, 500), (2, 2.5, 4, 5)),
    "knee mill": Kind(((600, 900), (300, 450), (120, 400)), (4000, 10000), (300, 1000), (5, 5.08, 6)),
    "centre": Kind(((500, 1200), (400, 600), (400, 600)), (12000, 36000), (1500, 6000), (10, 12, 16, 20)),
    "large mill": Kind(((1500, 4000), (700, 1500), (600, 1000)), (8000, 20000), (500, 2000), (10, 16, 20)),
    "router": Kind(
        ((600, 2500), (400, 1500), (80, 200)), (6000, 20000), (300, 2500), (10, 20), (8000, 24000)
    ),
    "gantry": Kind(
        ((3000, 6000), (1500, 2500), (200, 500)), (20000, 50000), (500, 3000), (20, 40), (8000, 24000)
    ),
}
"""The two first axes of a kind have one screw and one speed, the third is a little slower on the lighter
ones."""


@dataclass(frozen=True)
class Axis:
    """One axis, its lengths in mm, and whether home is at its plus end."""

    travel: float
    screw: float
    rapid: float
    ramp: float
    lines: int
    home_plus: bool

    @property
    def counts(self) -> float:
        """Counts of a mm, four of a line."""
        return 4 * self.lines / self.screw


@dataclass(frozen=True)
class Typical:
    """A machine before it is written in the way of a family."""

    kind: str
    axes: tuple[Axis, ...]
    spindle: float
    inch: bool


def nice(
    number: float, steps: tuple[float, ...] = (1, 1.2, 1.5, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9, 10)
) -> float:
    """Return the nearest number that a person would choose."""
    power = 10.0 ** floor(log10(number))
    return float(f"{min(steps, key=lambda step: abs(step * power - number)) * power:.9g}")


def draw(random: Random, low: float, high: float) -> float:
    """Return a number that a person would choose, as often small as large."""
    return nice(low * (high / low) ** random.random())


def typical(random: Random) -> Typical:
    """Return the next machine."""
    name = random.choice(tuple(KINDS))
    kind = KINDS[name]
    screw = random.choice(kind.screws)
    lines = random.choice(
        [n for n in (500, 1000, 1024, 1250, 2000, 2500, 5000, 10000) if 4 * n / screw >= 400]
    )
    rapid, ramp = draw(random, *kind.rapid), draw(random, *kind.ramp)
    axes = []
    for at, travel in enumerate(kind.travels):
        slower = at == 2 and random.random() < 0.6
        lead = random.choice((screw, max(2, screw / 2))) if at == 2 else screw
        length, steep = draw(random, *travel), nice(ramp * random.choice((0.5, 0.6, 0.8))) if slower else ramp
        pace = min(rapid, nice(60 * (0.3 * length * steep) ** 0.5), nice(4000 * lead))
        axes.append(
            Axis(
                travel=length,
                screw=lead,
                rapid=nice(pace * random.choice((0.5, 0.6, 0.8))) if slower else pace,
                ramp=steep,
                lines=lines,
                home_plus=at == 2 or random.random() < 0.3,
            )
        )
    return Typical(name, tuple(axes), draw(random, *kind.spindle), random.random() < 0.4)


def machine(family: str, random: Random) -> ParameterFile:
    """Return the next typical machine of a family: its example with other axes."""
    file = open_file(_example(EXAMPLES[family])).file
    for name, value in WRITERS[family](typical(random), random).items():
        address = file.find(name)
        file.set(address, None if value is None else file.read(address, str(value)))
    return file


@cache
def _example(name: str):
    return next(path for path in examples_folder().glob("*/*.amp") if path.stem == name)


def grblhal(made: Typical, random: Random) -> Settings:
    """Steps by motor and screw; homing slow enough to stop within the switch; ramps and rates at 70 %."""
    out: Settings = {}
    pulse = random.choice((2.5, 3, 5))
    finest = max(axis.rapid / 60 * 200 / axis.screw for axis in made.axes)  # steps/s without microsteps
    microsteps = random.choice([n for n in (1, 2, 4, 8, 16, 32) if n * finest <= 90000] or [1])
    for letter, axis in zip("XYZ", made.axes, strict=True):
        out[f"axis.steps@{letter}"] = f"{200 * microsteps / axis.screw:.6g} steps/mm"
        out[f"axis.max_rate@{letter}"] = f"{axis.rapid} mm/min"
        out[f"axis.acceleration@{letter}"] = f"{axis.ramp} mm/s2"
        out[f"axis.max_travel@{letter}"] = f"{axis.travel} mm"
    out["spindle.max_speed"] = f"{made.spindle} rpm"
    least = random.choice((0, 0.1, 0.25))
    out["spindle.min_speed"] = f"{made.spindle * least} rpm"
    out["spindle.pwm_min"] = f"{100 * least} %"
    out["spindle.on_delay"] = f"{random.choice((2, 3, 4))} s"
    seek = min(axis.rapid for axis in made.axes) * random.choice((0.2, 0.3, 0.5))
    out["homing.seek_rate"] = f"{nice(min(seek, 4000))} mm/min"
    out["homing.locate_rate"] = f"{random.choice((25, 50, 100))} mm/min"
    out["homing.pull_off"] = f"{random.choice((1, 2, 3, 5))} mm"
    out["homing.invert_direction"] = sum(1 << n for n, a in enumerate(made.axes) if not a.home_plus)
    out["general.junction_deviation"] = f"{random.choice((0.01, 0.02, 0.05))} mm"
    out["stepper.pulse_time"] = f"{pulse} us"
    return out


def linuxcnc(made: Typical, random: Random) -> Settings:
    """Limits at the stops, homing at an end, following errors as the wizards write them; mm or inch."""
    out: Settings = {}
    unit, per = ("in", 25.4) if made.inch else ("mm", 1.0)
    out["traj.linear_units"] = "inch" if made.inch else "mm"

    def length(mm: float) -> str:
        return f"{float(f'{mm / per:.4g}')} {unit}"

    def each(name: str, text: str, n: int) -> None:
        out[f"joint.{name}@{n}"] = text
        if name in ("min_limit", "max_limit", "max_velocity", "max_acceleration"):
            out[f"axis.{name}@{'XYZ'[n]}"] = text

    search = draw(random, 8, 40)
    for n, axis in enumerate(made.axes):
        speed, ramp = axis.rapid / 60, axis.ramp
        beyond = random.choice((2.0, 5.0, 10.0))
        low, high = (-axis.travel, beyond) if axis.home_plus else (-beyond, axis.travel)
        each("min_limit", length(low), n)
        each("max_limit", length(high), n)
        each("max_velocity", length(speed) + "/s", n)
        each("max_acceleration", length(ramp) + "/s2", n)
        each("ferror", length(25.4 * 0.05 if made.inch else 1), n)
        each("min_ferror", length(25.4 * 0.01 if made.inch else random.choice((0.1, 0.25))), n)
        each("backlash", length(0), n)
        home = length(beyond / 2 if axis.home_plus else -beyond / 2) if random.random() < 0.3 else length(0)
        each("home", home, n)
        each("home_offset", home, n)
        sign = 1 if axis.home_plus else -1
        pace = min(search, speed / 2)
        each("home_search_velocity", length(sign * pace) + "/s", n)
        each("home_latch_velocity", length(-sign * pace / 10) + "/s", n)
        each("home_final_velocity", length(pace / 2) + "/s", n)
        each("deadband", length(1.5 / axis.counts), n)
        out[f"joint.encoder_scale@{n}"] = f"{axis.counts * per:.7g}"
        out[f"joint.output_scale@{n}"] = f"{nice(speed * 1.2 / 10) / per:.4g}"
        gain = random.choice((20, 30, 50, 80))
        out[f"joint.pid_p@{n}"] = out.get("joint.pid_p@0", gain)
    fastest = max(axis.rapid for axis in made.axes) / 60
    out["traj.max_velocity"] = length(fastest * random.choice((1, 1.4))) + "/s"
    out["traj.default_velocity"] = length(fastest / random.choice((5, 10))) + "/s"
    ramp = max(axis.ramp for axis in made.axes)
    out["traj.max_acceleration"] = length(ramp) + "/s2"
    out["traj.default_acceleration"] = length(ramp) + "/s2"
    out["display.jog_default"] = length(fastest / 10) + "/s"
    out["display.jog_greatest"] = length(fastest / random.choice((1, 2))) + "/s"
    for name in ("max_forward", "max_reverse"):
        out[f"spindle.{name}@0"] = f"{made.spindle} rpm"
    for name in ("min_forward", "min_reverse"):
        out[f"spindle.{name}@0"] = f"{nice(made.spindle / random.choice((20, 60, 100)))} rpm"
    out["rs274ngc.startup_code"] = (
        f"G17 {'G20' if made.inch else 'G21'} G40 G49 G54 G64 P0.001 G80 G90 G94 G97"
    )
    out["display.increments"] = ".1 in, .01 in, .001 in" if made.inch else "10 mm, 1 mm, .1 mm, .01 mm"
    return out


def acromill(made: Typical, random: Random) -> Settings:
    """Pulses by encoder and screw, limits from home, speeds and ramps; gains of the guide's lists."""
    out: Settings = {}
    unit, per = ("in", 25.4) if made.inch else ("mm", 1.0)

    def length(mm: float, digits: int = 4) -> str:
        return f"{float(f'{mm / per:.{digits}g}')} {unit}"

    out["control.default_units"] = "Inch" if made.inch else "Metric"
    out["display.control_mode"] = "Inches" if made.inch else "Metric"
    gain = random.choice((0.005, 0.01, 0.02, 0.05, 0.08))
    rapid = min(axis.rapid for axis in made.axes)
    ramp = min(axis.ramp for axis in made.axes)
    home = nice(min(rapid * 0.3, 3000))
    plus = random.random() < 0.7
    for letter, axis in zip("XYZ", made.axes, strict=True):
        near = random.choice((2, 2.5, 5))
        low, high = (-axis.travel, near) if plus else (-near, axis.travel)
        out[f"axes.soft_limit_plus@{letter}"] = length(high)
        out[f"axes.soft_limit_minus@{letter}"] = length(low)
        out[f"home.direction@{letter}"] = "Pos" if plus else "Neg"
        out[f"axes.pulses_per_unit@{letter}"] = f"{axis.counts * per:.7g} counts/{unit}"
        out[f"axes.inposition_band@{letter}"] = length(0.0254 if made.inch else 0.02)
        out[f"axes.excess_error_band@{letter}"] = length(6.35 if made.inch else 5)
        out[f"axes.handwheel_ratio@{letter}"] = length(0.127 if made.inch else 0.1)
        out[f"servo.p_gain@{letter}"] = f"{gain} V/count"
        out[f"servo.i_gain@{letter}"] = (
            f"{random.choice((0, 1, 2)) if letter == 'X' else out['servo.i_gain@X']}"
        )
        out[f"servo.d_gain@{letter}"] = f"{gain / random.choice((300, 400)):.3g} Vs/count"
        out[f"home.fast_speed@{letter}"] = length(home) + "/min"
        out[f"home.slow_speed@{letter}"] = length(home / 5) + "/min"
        out[f"home.marker_speed@{letter}"] = length(home / 8) + "/min"
        for name in ("acceleration", "deceleration", "stop"):
            out[f"home.{name}@{letter}"] = length(nice(ramp)) + "/s2"
            out[f"jog.{name}@{letter}"] = length(nice(ramp)) + "/s2"
        out[f"jog.feedrate@{letter}"] = length(nice(rapid / 10)) + "/min"
        out[f"jog.rapid@{letter}"] = length(rapid) + "/min"
        out[f"backlash.amount@{letter}"] = length(random.choice((0, 0.01, 0.02)))
        least = next(n for n in (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2) if n * axis.counts * per >= 1)
        for n in range(1, 6):
            out[f"jog.increment_{n}@{letter}"] = length(least * per * 10 ** (5 - n))
        for n in (1, 2, 3, 4):
            place = 0.0 if letter == "Z" or n == 1 else axis.travel * random.choice((0.0, 0.5, 0.95))
            out[f"reference.point_{n}@{letter}"] = length(-place if plus else place)
        out[f"work.system_1@{letter}"] = length((-1 if plus else 1) * nice(axis.travel * 0.6))
    for letter in "XYZ":
        out[f"servo.d_gain@{letter}"] = out["servo.d_gain@X"]
    for n, axis in zip("xyz", made.axes, strict=True):
        out[f"control.cutting_size_{n}"] = length(nice(axis.travel * 0.9))
    out["control.lead_in_radius"] = length(6.35 if made.inch else 6)
    out["control.g83_distance"] = length(1.27 if made.inch else 1)
    out["control.compensation_epsilon"] = length(0.0508 if made.inch else 0.05)
    out["probe.feedrate"] = length(min(127.0, rapid / 10)) + "/min"
    out["speeds.max_machine"] = length(rapid * random.choice((1, 1.2))) + "/min"
    out["speeds.rapid"] = length(rapid) + "/min"
    out["speeds.trial"] = length(rapid * random.choice((0.5, 1))) + "/min"
    out["speeds.cut"] = length(nice(rapid / random.choice((4, 10)))) + "/min"
    out["speeds.min_corner"] = length(nice(rapid / 25)) + "/min"
    out["speeds.rapid_acc_dec"] = length(nice(ramp)) + "/s2"
    out["speeds.feed_acc_dec"] = length(nice(ramp)) + "/s2"
    out["spindle.scaling"] = f"{10 / made.spindle:.4g} V/rpm"
    return out


def module_57c422b(made: Typical, random: Random) -> Settings:
    """A linear or a rotary axis; half a turn of position error; gains as the tuning leaves them; a time cam
    on one.
    """
    out: Settings = {}
    still, damping = random.randint(5, 60), 0.002 * 5 ** random.random()
    for letter, axis in zip("XY", made.axes, strict=False):
        counts = 4 * axis.lines
        speed = min(nice(axis.rapid / 60 * axis.counts), 900000)  # page 2-6: 250 kHz a channel
        ramp = nice(axis.ramp * axis.counts)
        stiff = random.randint(6000, 24000)
        out[f"gain.proportional@{letter}"] = stiff
        out[f"gain.integral@{letter}"] = random.choice((0, round(stiff * 0.02 * 10 ** random.random())))
        out[f"gain.velocity@{letter}"] = round(stiff * damping * (1 + random.random()))
        out[f"gain.feedforward@{letter}"] = random.randint(8000, 8500)
        out[f"gain.deadband@{letter}"] = round(still * (0.7 + 0.6 * random.random()))
        out[f"setup.max_position_error@{letter}"] = f"{counts // 2} counts"
        out[f"setup.max_velocity_error@{letter}"] = (
            f"{max(1, round(speed * random.choice((0.05, 0.1, 0.2)) / 800)) * 800} counts/s"
        )
        out[f"setup.in_position_tolerance@{letter}"] = f"{max(2, round(nice(counts / 400)))} counts"
        out[f"command.velocity@{letter}"] = f"{speed} counts/s"
        out[f"command.acceleration@{letter}"] = f"{ramp} counts/s2"
        out[f"command.deceleration@{letter}"] = f"{ramp} counts/s2"
        out[f"command.home_speed_low@{letter}"] = f"{nice(speed / random.choice((20, 50, 100)))} counts/s"
    turn = 4 * made.axes[0].lines
    out["output.feedback_unwind@X"] = f"{turn} counts"
    out["output.gearing_unwind@X"] = f"{turn} counts"
    out["command.position@X"] = f"{turn * random.randint(1, 40)} counts"
    slide = made.axes[1]
    far = round(slide.travel * slide.counts)
    out["setup.overtravel_positive@Y"] = f"{far} counts"
    out["setup.overtravel_negative@Y"] = f"{-round(5 * slide.counts)} counts"
    out["command.position@Y"] = f"{random.choice((0, far // 2, far // 4))} counts"
    out.update(_cam(random, slide))
    return out


def _cam(random: Random, slide: Axis) -> Settings:
    """A stroke and back along a cosine (pages 4-49 to 4-54) that speed and ramp allow, or no cam."""
    out: Settings = {f"cam.time_points@Y.{n}": None for n in range(32)}
    if random.random() < 0.4:
        return out | {"cam.points@Y": 0, "cam.mode@Y": "0x0000", "cam.loop_back@Y": None}
    points = random.choice((20, 24, 32, 40, 64))
    scans = random.choice((4, 8, 10, 16))
    duration = points * scans * 1.25e-3
    speed, ramp = slide.rapid / 60 * slide.counts, slide.ramp * slide.counts
    stroke = min(
        0.5 * speed * duration / pi,
        0.5 * ramp * (duration / 2 / pi) ** 2 * 2,
        0.8 * slide.travel * slide.counts,
    )
    stroke = max(points * 4, round(stroke))
    places = [round(stroke / 2 * (1 - cos(2 * pi * n / points))) for n in range(points + 1)]
    for n, (here, there) in enumerate(pairwise(places)):
        out[f"cam.time_points@Y.{n}"] = f"{there - here} counts"
    return out | {"cam.points@Y": points, "cam.time@Y": f"{scans * 1.25} ms"}


def syntec(made: Typical, random: Random) -> Settings:
    """Pulses a turn, gears and screw; rapid below what the interpolator sends (page 1.4.2); a rotary
    table.
    """
    out: Settings = {}
    first = random.choice((2000, 3000, 5000))
    rapids = []
    for n, axis in enumerate(made.axes, 1):
        gear = 1
        out[f"resolution.screw_teeth@{n}"] = gear
        out[f"resolution.pitch@{n}"] = f"{round(axis.screw * 1000)} BLU"
        lines = next(n for n in (500, 1000, 2500, 5000, 10000) if 4 * n / axis.screw >= 1000)
        out[f"resolution.encoder@{n}"] = lines
        pulses = 4 * lines * gear / axis.screw  # of a mm
        rapid = min(axis.rapid, nice(0.7 * 2047 / 1.966e-3 * 60 / pulses))
        rapids.append(rapid)
        out[f"feed.rapid@{n}"] = f"{round(rapid)} mm/min"
        out[f"limit.first_positive@{n}"] = f"{round(axis.travel * 1000)} BLU"
        out[f"limit.third_positive@{n}"] = f"{round(axis.travel * 1000 * (0.5 if n == 1 else 1))} BLU"
        for name, high, low in (("second", 25000, 10000),):
            out[f"limit.{name}_positive@{n}"] = f"{high} BLU"
            out[f"limit.{name}_negative@{n}"] = f"{low} BLU"
        out[f"servo.loop_gain@{n}"] = out.get("servo.loop_gain@1", random.choice((30, 40, 50)))
    least = min(rapids)
    for n, axis in enumerate(made.axes, 1):
        home = min(first, least / 2)
        out[f"home.first_speed@{n}"] = f"{round(nice(home))} mm/min"
        out[f"home.second_speed@{n}"] = f"{round(nice(min(home / 10, 50 * axis.screw)))} mm/min"
        out[f"jog.feedrate@{n}"] = f"{round(nice(min(3000, least / 2)))} mm/min"
    out["mpg.feedrate"] = f"{round(nice(min(2000, least / 3)))} mm/min"
    ramp = random.choice((100, 150, 200))
    out["motion.acceleration_time"] = ramp
    for n in (1, 2, 3, 4):
        out[f"motion.axis_acceleration@{n}"] = ramp
    return out


def num(made: Typical, random: Random) -> Settings:
    """The sums of chapters 5 to 7: MULTI over DIVI, KVAR (6-14), EMAX (6-22), approach speed (6-36)."""
    out: Settings = {}
    constant = random.choice((40, 50, 60))
    out["servo.group_time_constant@1"] = f"{constant} ms"
    speeds = []
    for n, axis in enumerate(made.axes):
        lines = next(n for n in (1000, 1250, 2500, 5000, 10000) if 4 * n / axis.screw >= 1000)
        multi, divi = _fraction(round(axis.screw * 1000), 4 * lines)
        out[f"measure.multi@{n}"], out[f"measure.divi@{n}"] = multi, divi
        speed = round(axis.rapid)
        speeds.append(speed)
        out[f"servo.max_speed@{n}"] = f"{speed} mm/min"
        out[f"servo.loop_gain@{n}"] = round(29491 / (speed / 60 * constant / 1000))
        out[f"servo.max_following_error@{n}"] = f"{round(speed / 60 * constant * 1.1)} iu"
        ramp = round(axis.ramp)
        out[f"servo.acceleration_work@{n}"] = f"{ramp} mm/s2"
        out[f"servo.acceleration_fast@{n}"] = f"{ramp} mm/s2"
        out[f"servo.approach_speed@{n}"] = f"{min(speed, round(ramp * constant * 60 / 1000))} mm/min"
        far = round(axis.travel * 1000)
        out[f"travel.limit_min@{n}"] = f"{-far if n == 2 else -1000} iu"
        out[f"travel.limit_max@{n}"] = f"{1000 if n == 2 else far} iu"
        out[f"travel.backlash@{n}"] = f"{random.choice((0, 0, 5, 10))} iu"
        out[f"measure.sensor@{n}"] = "0x00000000"
        out[f"measure.graduation@{n}"] = None if n == 2 else 1
        out[f"measure.graduations@{n}"] = None if n == 2 else 1
    del out["measure.graduation@0"], out["measure.graduations@0"]
    del out["measure.graduation@1"], out["measure.graduations@1"]
    table, slowest = min(*speeds, 500 * constant * 60 / 1000), min(speeds)
    out["servo.approach_speed@3"] = f"{round(table)} deg/min"
    out["servo.loop_gain@3"] = round(29491 / (slowest / 60 * constant / 1000) / 10)
    out["servo.max_following_error@3"] = f"{round(slowest / 60 * constant * 1.1 * 10)} iu"
    out["servo.max_speed@3"] = f"{slowest} deg/min"
    out["spindle.position_anticipation@1"] = round(1e6 * constant / 5000)
    for name, unit in (("linear", "mm"), ("rotary", "deg")):
        out[f"servo.reduced_speed_{name}"] = f"{round(nice(slowest / 5))} {unit}/min"
    out["servo.jog_fast"] = f"{slowest} mm/min"
    out["servo.jog_normal"] = f"{round(nice(slowest / 5))} mm/min"
    out["servo.jog_slow"] = f"{round(nice(slowest / 30))} mm/min"
    top = round(made.spindle)
    out["spindle.range_max@1.42"] = f"{top} rpm"
    out["spindle.range_min@1.42"] = f"{round(top / 5)} rpm"
    out["spindle.range_max@1.41"] = f"{round(top / 4)} rpm"
    out["spindle.range_min@1.41"] = f"{round(top / 25)} rpm"
    out["spindle.range_max@1.40"] = f"{round(top / 20)} rpm"
    out["spindle.range_min@1.40"] = f"{round(top / 200)} rpm"
    return out


def _fraction(over: int, under: int) -> tuple[int, int]:
    """Return a ratio in its smallest numbers."""
    from math import gcd

    common = gcd(over, under)
    return over // common, under // common


def ninepc(made: Typical, random: Random) -> Settings:
    """Errors and break point of pages 7-20 to 7-22, ramps of 10-2, jerks of 10-19 and 10-21, motor speed of
    7-74.
    """
    out: Settings = {}
    for n, axis in enumerate(made.axes, 1):
        screw = random.choice((12.7, 16, 20, 25)) if n == 1 else out["screw"]
        out["screw"] = screw
        rapid = min(max(axis.rapid, 3000), 10000)
        cutting = nice(rapid * random.choice((0.4, 0.5))) if n == 1 else min(out["cutting"], rapid)
        out["cutting"] = cutting
        gain = random.choice((0.8, 1, 1.5)) if n == 1 else out["servo.initial_gain@1"]
        out[f"servo.initial_gain@{n}"] = gain
        out[f"servo.lead_screw_pitch@{n}"] = f"{screw} mm"
        out[f"servo.velocity_proportional_gain@{n}"] = round((9000 if n == 3 else 6000) * gain)
        out[f"servo.velocity_integral_gain@{n}"] = round((900 if n == 3 else 600) * gain)
        error = 1.1 * rapid / (1000 * gain)
        out[f"servo.excess_error@{n}"] = f"{error:.6g} mm"
        out[f"servo.feedrate_suppression@{n}"] = f"{error:.6g} mm"
        out[f"servo.gain_break_point@{n}"] = f"{cutting * 0.001 / gain:.6g} mm"
        out[f"feedrate.rapid@{n}"] = f"{rapid} mm/min"
        out[f"feedrate.max_cutting@{n}"] = f"{cutting} mm/min"
        out[f"jog.speed_highest@{n}"] = f"{cutting} mm/min"
        out[f"jog.speed_fourth@{n}"] = f"{nice(cutting / 5)} mm/min"
        out[f"jog.speed_third@{n}"] = f"{nice(cutting / 20)} mm/min"
        out[f"jog.speed_second@{n}"] = f"{nice(cutting / 100)} mm/min"
        out[f"jog.speed_lowest@{n}"] = f"{nice(cutting / 500)} mm/min"
        out[f"jog.traverse_speed@{n}"] = f"{rapid} mm/min"
        out[f"home.g28_speed@{n}"] = f"{min(2500 * gain, nice(rapid / 4))} mm/min"
        ramp = float(f"{cutting / (120 / gain) / 60 * 1000:.4g}")
        for name in (
            "linear_acceleration",
            "linear_deceleration",
            "scurve_acceleration",
            "scurve_deceleration",
        ):
            out[f"accdec.{name}@{n}"] = f"{ramp} mm/s2"
        out[f"accdec.jerk@{n}"] = f"{round(ramp / 0.096)} mm/s3"
        out[f"accdec.min_jerk@{n}"] = f"{round(ramp / 0.72 + 0.5)} mm/s3"
        out[f"servo.max_motor_speed@{n}"] = f"{ceil(1.1 * rapid / screw)} rpm"
        out[f"zone.overtravel_negative@{n}"] = f"{-axis.travel} mm"
        out[f"home.position@{n}"] = "0 mm"
        out[f"zone.overtravel_positive@{n}"] = "2 mm"
        for name, high, low in (("limit2", -0.85, -0.95), ("limit3", -0.3, -0.5)):
            out[f"zone.{name}_max@{n}"] = f"{high * axis.travel:.6g} mm"
            out[f"zone.{name}_min@{n}"] = f"{low * axis.travel:.6g} mm"
        out[f"home.g30_position@{n}"] = f"{-axis.travel * (0.25 if n == 3 else 0.5)} mm"
    del out["screw"], out["cutting"]
    out["spindle.max_speed@1.1"] = f"{made.spindle} rpm"
    return out


WRITERS: dict[str, Callable[[Typical, Random], Settings]] = {
    "57c422b": module_57c422b,
    "9pc": ninepc,
    "acromill": acromill,
    "grblhal": grblhal,
    "linuxcnc": linuxcnc,
    "num": num,
    "syntec": syntec,
}
