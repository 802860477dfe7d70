"""Axes that scipy's ``solve_ivp`` moves, for the identification: nothing here is of the simulator.

A motor and its load on a spring with a gap, dry friction with a Stribeck curve, a weight and a delay of the
torque, under a separate sampled position and velocity loop; the record has noise, counts, another clock for
each channel and, with some, the speed in rpm.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SAMPLE = 1e-3
"""s: of the loops and of the records."""
SMOOTH = 0.03
"""mm/s over which dry friction turns its sign."""
REST = 0.3
"""s between two moves."""
TURN = 10.0
"""mm for a turn of the motor."""


@dataclass(frozen=True)
class HiddenPlant:
    """The figures of one axis: mm, s, and % of torque."""

    size: float
    """mm/s² for 1 %."""
    viscous: float = 0.0
    """% for 1 mm/s."""
    coulomb: float = 0.0
    static: float = 0.0
    """%, above the Coulomb friction."""
    stribeck: float = 5.0
    """mm/s."""
    gravity: float = 0.0
    ratio: float = 0.0
    """Inertia of the load by that of the motor; 0 for one mass."""
    resonance: float = 120.0
    damping: float = 0.03
    backlash: float = 0.0
    delay: float = 0.0
    shift: float = 0.0
    """s by which the motion is later than the torque in the record."""
    count: float = 1e-4
    """mm: a step of the recorded position; the speed has a thousand steps for its top."""
    noise: float = 0.0
    """Share of the largest torque and of the top speed."""
    channel: str = "velocity"
    """velocity, position or rpm."""
    top: float = 150.0
    push: float = 15.0
    """% with which moves are accelerated."""
    seed: int = 0

    def dry(self, speed: np.ndarray | float) -> np.ndarray | float:
        """Return the dry friction in %."""
        curve = self.coulomb + self.static * np.exp(-((speed / self.stribeck) ** 2))
        return curve * np.tanh(speed / SMOOTH)

    def slopes(self, state: np.ndarray, torque: float) -> list[float]:
        """Return how position and speed of motor and load change."""
        at, speed, load_at, load_speed = state
        if not self.ratio:
            whole = torque - self.gravity - self.viscous * speed - self.dry(speed)
            return [speed, self.size * whole, speed, self.size * whole]
        motor, load = self.size * (1.0 + self.ratio), self.size * (1.0 + self.ratio) / self.ratio
        rate = 2.0 * math.pi * self.resonance
        stiff, slip = rate**2 / (motor + load), 2.0 * self.damping * rate / (motor + load)
        wound = at - load_at
        gap = wound - min(max(wound, -0.5 * self.backlash), 0.5 * self.backlash)
        between = stiff * gap + (slip * (speed - load_speed) if gap or not self.backlash else 0.0)
        share = 1.0 / (1.0 + self.ratio)
        on_motor = share * (self.viscous * speed + self.dry(speed))
        on_load = (1.0 - share) * (self.viscous * load_speed + self.dry(load_speed)) + self.gravity
        return [speed, motor * (torque - between - on_motor), load_speed, load * (between - on_load)]


def hidden_plants() -> Iterator[HiddenPlant]:
    """Yield twenty axes, each figure drawn, every fourth one mass alone."""
    for seed in range(20):
        dice = np.random.default_rng(1000 + seed)
        size = float(np.exp(dice.uniform(math.log(20.0), math.log(150.0))))
        top = size * dice.uniform(2.0, 5.0)
        yield HiddenPlant(
            size=size,
            viscous=dice.uniform(2.0, 8.0) / top,
            coulomb=dice.uniform(1.0, 6.0),
            static=dice.choice([0.0, dice.uniform(0.5, 2.5)]),
            stribeck=top * dice.uniform(0.015, 0.05),
            gravity=dice.choice([0.0, dice.uniform(-6.0, 6.0)]),
            ratio=0.0 if seed % 4 == 0 else dice.uniform(0.4, 2.5),
            resonance=dice.uniform(45.0, 140.0),
            damping=dice.uniform(0.01, 0.08),
            backlash=dice.uniform(0.005, 0.06) if seed % 4 == 3 else 0.0,
            delay=dice.choice([0.0, dice.uniform(0.5e-3, 4e-3)]),
            shift=dice.choice([0.0, dice.uniform(-4e-3, 4e-3)]),
            noise=dice.choice([0.0, 0.003]),
            channel=str(dice.choice(["velocity", "position", "rpm"])),
            top=float(top),
            push=dice.uniform(10.0, 30.0),
            seed=seed,
        )


def commanded(plant: HiddenPlant) -> tuple[np.ndarray, np.ndarray]:
    """Return time and speed of moves at four speeds, there and back."""
    speed, rate = [np.zeros(int(REST / SAMPLE))], plant.size * plant.push * SAMPLE
    for share in (0.15, 0.4, 1.0, 0.04):
        up = np.arange(0.0, share * plant.top, rate)
        move = np.concatenate([up, np.full(int(0.5 / SAMPLE), share * plant.top), up[::-1]])
        for sign in (1.0, -1.0):
            speed += [sign * move, np.zeros(int(REST / SAMPLE))]
    joined = np.convolve(np.concatenate(speed), np.full(20, 0.05), "same")  # 20 ms without a jerk
    return SAMPLE * np.arange(len(joined)), joined


def moved(plant: HiddenPlant) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return time, states (rows of motor and load) and torque of the axis under its own loops."""
    time, speed = commanded(plant)
    wanted = np.cumsum(speed) * SAMPLE
    inner = 2.0 * math.pi * (6.0 if plant.ratio else 15.0)
    state, states, torques, summed = np.zeros(4), [], [0.0] * 8, 0.0
    for n in range(len(time)):
        error = 0.25 * inner * (wanted[n] - state[0]) + speed[n] - state[1]
        summed += 0.25 * inner * error * SAMPLE
        torques.append(float(np.clip(inner / plant.size * (error + summed), -100.0, 100.0)))
        states.append(state)
        state = _later(plant, state, torques, SAMPLE)
    return time, np.array(states), np.array(torques[8:])


def _later(plant: HiddenPlant, state: np.ndarray, torques: list[float], period: float) -> np.ndarray:
    """Return the state a sample later; the torque that acts is that of ``delay`` ago, within a sample too."""
    from scipy.integrate import solve_ivp

    whole, part = divmod(plant.delay / period, 1.0)
    for torque, span in ((torques[-2 - int(whole)], part), (torques[-1 - int(whole)], 1.0 - part)):
        if span > 1e-9:
            found = solve_ivp(
                lambda _t, z, torque=torque: plant.slopes(z, torque),
                (0.0, span * period),
                state,
                rtol=1e-6,
                atol=1e-9,
            )
            state = found.y[:, -1]
    return state


def record(plant: HiddenPlant, path: Path, *, both_sides: bool = False) -> None:
    """Write the record of the moves of an axis."""
    time, states, torque = moved(plant)
    columns = {"time (s)": time, **_channels(plant, time, states, torque)}
    if both_sides:
        counted = [np.round(states[:, n] / plant.count) * plant.count for n in (0, 2)]
        columns |= {"motor position (mm)": counted[0], "load position (mm)": counted[1]}
    _write(path, columns)


def _channels(
    plant: HiddenPlant, time: np.ndarray, states: np.ndarray, torque: np.ndarray
) -> dict[str, np.ndarray]:
    """Return motion and torque as a recorder has them."""
    dice = np.random.default_rng(plant.seed)
    later = [np.interp(time - plant.shift, time, states[:, n]) for n in (0, 1)]
    speed = later[1] + plant.noise * plant.top * dice.standard_normal(len(time))
    step = plant.top / 1000.0
    loud = torque + plant.noise * np.abs(torque).max() * dice.standard_normal(len(time))
    motion = {
        "velocity": ("velocity (mm/s)", np.round(speed / step) * step),
        "rpm": ("speed (rpm)", np.round(60.0 * speed / TURN / 0.05) * 0.05),
        "position": ("position (mm)", np.round(later[0] / plant.count) * plant.count),
    }[plant.channel]
    return {motion[0]: motion[1], "torque (%)": np.round(loud / 0.01) * 0.01}


def _write(path: Path, columns: dict[str, np.ndarray]) -> None:
    rows = zip(*(each.tolist() for each in columns.values()), strict=True)
    path.write_text("\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows)]) + "\n")
