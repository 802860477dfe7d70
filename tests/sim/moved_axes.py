"""Axes for the identification, of another make than those of `hidden_plants.py`; nothing here is of the
simulator.

One ``solve_ivp`` goes over the whole record: loops and drive are continuous, and dry friction is that of P.
Dahl (A Solid Friction Model, 1968), which yields before it slides. An axis is one mass, or a motor and its
load on a belt with its friction at the load, at the motor or at both; it makes S-curves, ramps without a
limit of the jerk, or a sum of sines, and is recorded at 0.5 to 4 ms.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MAKES = ("one mass", "load", "motor", "both")
"""One mass, or where the friction of two is."""
MOTIONS = ("s-curves", "ramps", "sines")
GRID = 0.25e-3
"""s between two values of the command."""
TURN = 10.0
"""mm for a turn of the motor."""
RATE, LAG = 0.25, 300.0
"""Position gain by that of the speed loop; Hz of the drive's torque."""


@dataclass(frozen=True)
class MovedAxis:
    """The figures of one axis: mm, s, and % of torque."""

    size: float
    """mm/s² for 1 %."""
    viscous: float
    ahead: float
    """Dry friction in % forwards, and ``back`` backwards."""
    back: float
    static: float
    stribeck: float
    yields: float
    """mm before dry friction slides."""
    gravity: float
    make: str
    ratio: float
    resonance: float
    damping: float
    motion: str
    top: float
    push: float
    """% with which it is accelerated."""
    period: float
    channel: str
    noise: float
    step: float
    """% of the recorded torque."""
    shift: float
    seed: int

    @property
    def share(self) -> float:
        """The share of the friction that is at the motor."""
        own = 1.0 / (1.0 + self.ratio)
        return {"one mass": 1.0, "load": 0.0, "motor": 1.0, "both": own}[self.make]

    def rubs(self, speed: float, bent: float) -> float:
        """Return the friction in % where dry friction is bent by a share of what makes it slide."""
        dry = self.ahead if bent > 0.0 else self.back
        dry += self.static * math.exp(-((speed / self.stribeck) ** 2))
        return self.viscous * speed + dry * bent


def moved_axis(seed: int) -> MovedAxis:
    """Return an axis whose figures are drawn."""
    dice = np.random.default_rng(52000 + seed)
    make = MAKES[seed % 4]
    size = float(np.exp(dice.uniform(math.log(15.0), math.log(200.0))))
    top, dry = float(size * dice.uniform(1.5, 5.0)), dice.uniform(1.0, 7.0)
    apart = dice.choice([0.0, dice.uniform(-0.3, 0.3)])
    return MovedAxis(
        size=size,
        viscous=dice.uniform(1.5, 8.0) / top,
        ahead=dry * (1.0 + apart),
        back=dry * (1.0 - apart),
        static=dice.choice([0.0, 0.0, dry * dice.uniform(0.2, 0.5)]),
        stribeck=top * dice.uniform(0.015, 0.05),
        yields=float(np.exp(dice.uniform(math.log(2e-3), math.log(2e-2)))),
        gravity=dice.choice([0.0, dice.uniform(-8.0, 8.0)]),
        make=make,
        ratio=0.0 if make == MAKES[0] else dice.uniform(0.4, 2.5),
        resonance=dice.uniform(40.0, 150.0),
        damping=dice.uniform(0.01, 0.1),
        motion=MOTIONS[seed % 3],
        top=top,
        push=dice.uniform(10.0, 30.0),
        period=float(dice.choice([0.5e-3, 1e-3, 2e-3, 4e-3])),
        channel=str(dice.choice(["velocity", "position", "rpm"])),
        noise=float(dice.choice([0.0, 0.002, 0.005])),
        step=float(dice.choice([0.01, 0.1])),
        shift=dice.choice([0.0, dice.uniform(-4e-3, 4e-3)]),
        seed=seed,
    )


def _speeds(axis: MovedAxis, dice: np.random.Generator) -> np.ndarray:
    """Return the commanded speed over ten to fifteen seconds, there and back."""
    if axis.motion == "sines":
        time = np.arange(0.0, 12.0, GRID)
        parts = [(axis.top * each, rate) for each, rate in ((0.5, 0.31), (0.3, 0.83), (0.2, 1.7))]
        speed = sum(
            size * np.sin(2.0 * math.pi * rate * time + dice.uniform(0.0, 6.0)) for size, rate in parts
        )
        return np.asarray(speed * np.minimum(1.0, time) * np.minimum(1.0, time[-1] - time))
    rise, parts = axis.size * axis.push * GRID, [np.zeros(1200)]
    for share in (0.1, 0.35, 0.7, 1.0, 0.04):
        up = np.arange(0.0, share * axis.top, rise * dice.uniform(0.6, 1.2))
        move = np.concatenate([up, np.full(int(dice.uniform(0.2, 0.6) / GRID), share * axis.top), up[::-1]])
        parts += [move, np.zeros(1000), -move, np.zeros(1000)]
    width = round((0.04 if axis.motion == "s-curves" else 0.002) / GRID)
    return np.convolve(np.concatenate(parts), np.full(width, 1.0 / width), "same")


def moved(axis: MovedAxis) -> tuple[np.ndarray, np.ndarray]:
    """Return time and states (motor, its speed, load, its speed, torque) of the axis under its loops."""
    from scipy.integrate import solve_ivp

    speeds = _speeds(axis, np.random.default_rng(53000 + axis.seed))
    ways, last = np.cumsum(speeds) * GRID, len(speeds) - 2
    inner = 2.0 * math.pi * (5.0 if axis.ratio else 15.0)
    ratio = axis.ratio or 1.0
    motor, load = axis.size * (1.0 + ratio), axis.size * (1.0 + ratio) / ratio
    rate = 2.0 * math.pi * axis.resonance
    stiff, slip = rate**2 / (motor + load), 2.0 * axis.damping * rate / (motor + load)
    share, lag, one = axis.share, 2.0 * math.pi * LAG, axis.ratio == 0.0

    def slopes(t: float, state: np.ndarray) -> list[float]:
        at, speed, load_at, load_speed, torque, error_sum, bent, load_bent = state.tolist()
        n = min(int(t / GRID), last)
        part = t / GRID - n
        wanted_speed = speeds[n] + part * (speeds[n + 1] - speeds[n])
        wanted = ways[n] + part * (ways[n + 1] - ways[n])
        error = RATE * inner * (wanted - at) + wanted_speed - speed
        asked = inner / axis.size * (error + error_sum)
        rubs = share * axis.rubs(speed, bent)
        bends = speed / axis.yields * (1.0 - math.copysign(1.0, speed) * bent)
        lags, sums = lag * (asked - torque), RATE * inner * error
        if one:
            pushed = axis.size * (torque - axis.gravity - rubs)
            return [speed, pushed, speed, pushed, lags, sums, bends, 0.0]
        between = stiff * (at - load_at) + slip * (speed - load_speed)
        on_load = (1.0 - share) * axis.rubs(load_speed, load_bent)
        load_bends = load_speed / axis.yields * (1.0 - math.copysign(1.0, load_speed) * load_bent)
        driven, pulled = motor * (torque - between - rubs), load * (between - on_load - axis.gravity)
        return [speed, driven, load_speed, pulled, lags, sums, bends, load_bends]

    start = np.zeros(8)
    start[4], start[5] = axis.gravity, axis.gravity * axis.size / inner
    start[2] = 0.0 if one else -axis.gravity / stiff
    time = np.arange(0.0, GRID * last, axis.period)
    found = solve_ivp(
        slopes,
        (0.0, GRID * last),
        start,
        "LSODA",
        np.unique(np.concatenate([time, [GRID * last]])),
        rtol=1e-6,
        atol=1e-8,
        max_step=5e-3,
    )
    return time, found.y[:5, : len(time)].T


def record(axis: MovedAxis, path: Path) -> None:
    """Write the record of an axis."""
    time, states = moved(axis)
    dice = np.random.default_rng(54000 + axis.seed)
    at, speed = (np.interp(time - axis.shift, time, states[:, n]) for n in (0, 1))
    loud = speed + axis.noise * axis.top * dice.standard_normal(len(time))
    torque = states[:, 4] + axis.noise * np.abs(states[:, 4]).max() * dice.standard_normal(len(time))
    head, motion = {
        "velocity": ("velocity (mm/s)", np.round(loud / axis.top * 2000.0) * axis.top / 2000.0),
        "rpm": ("speed (rpm)", np.round(60.0 * loud / TURN / 0.1) * 0.1),
        "position": ("position (mm)", np.round(at / 2e-4) * 2e-4),
    }[axis.channel]
    columns = time, motion, np.round(torque / axis.step) * axis.step
    rows = zip(*(each.tolist() for each in columns), strict=True)
    path.write_text(
        "\n".join([f"time (s),{head},torque (%)", *(",".join(map(repr, row)) for row in rows)]) + "\n"
    )


def figures_of(axis: MovedAxis) -> dict[str, float]:
    """Return what a record of moves may show, in the units of the settings."""
    coulomb = 0.5 * (axis.ahead + axis.back)
    return {
        "acceleration_per_output": axis.size,
        "viscous_friction": axis.viscous * 1000.0 / 60.0,
        "coulomb_friction": coulomb,
        "gravity": axis.gravity + 0.5 * (axis.ahead - axis.back),
        "time_shift": 1e3 * axis.shift,
        "static_friction": coulomb + axis.static,
    }
