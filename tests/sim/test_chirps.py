"""Chirps on axes that scipy made: each figure is within three of its uncertainties. ``make campaign`` takes
all twenty."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from amp_studio.sim.identification.plant_fit import fit_plant
from amp_studio.sim.identification.response import response_of_record
from tests.campaigns import CAMPAIGN

SURE = ("acceleration_per_output", "viscous_friction", "delay", "resonance", "inertia_ratio")
"""Figures whose uncertainty is asked."""
FINER = 20
"""Steps of the plant in one of the record."""


@dataclass(frozen=True)
class Chirp:
    """An axis, in mm, s and % of torque, and the record of it."""

    size: float
    friction: float
    delay: float
    ratio: float
    resonance: float
    damping: float
    noise: float
    period: float
    length: float
    method: str
    seed: int

    @property
    def differences(self) -> int:
        """1 for a record of the velocity, 2 for one of the position."""
        return 1 + self.seed % 2

    def plant(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return A, B, C of motor and load on a spring, or of one mass."""
        a, b = np.array([[-self.size * self.friction]]), np.array([[self.size]])
        if self.ratio:
            motor, load = self.size * (1.0 + self.ratio), self.size * (1.0 + self.ratio) / self.ratio
            rate = 2.0 * math.pi * self.resonance
            stiff, slip = rate**2 / (motor + load), 2.0 * self.damping * rate / (motor + load)
            own, other = self.friction / (1.0 + self.ratio), self.friction * self.ratio / (1.0 + self.ratio)
            a = np.array(
                [
                    [-motor * (slip + own), motor * slip, -motor * stiff],
                    [load * slip, -load * (slip + other), load * stiff],
                    [1.0, -1.0, 0.0],
                ]
            )
            b = np.array([[motor], [0.0], [0.0]])
        c = np.eye(1, len(a))
        if self.differences == 1:
            return a, b, c
        grown = np.block([[a, np.zeros((len(a), 1))], [c, np.zeros((1, 1))]])
        return grown, np.vstack([b, [[0.0]]]), np.eye(1, len(grown), len(grown) - 1)

    def figures(self) -> dict[str, float]:
        """Return what is to be found; a torque that is kept for a sample comes half of it later."""
        found = {
            "acceleration_per_output": self.size,
            "viscous_friction": self.friction,
            "delay": self.delay + 0.5 * self.period,
        }
        if self.ratio:
            velocity = Chirp(**{**self.__dict__, "seed": 0}).plant()[0]
            swings = next(each for each in np.linalg.eigvals(velocity) if each.imag > 0.0)
            found |= {"resonance": abs(swings) / (2.0 * math.pi), "inertia_ratio": self.ratio}
        return found

    def record(self) -> tuple[np.ndarray, np.ndarray]:
        """Return torque and motion; motion has noise or, of a position, the steps of its counts."""
        from scipy import signal

        time = self.period * np.arange(round(self.length / self.period))
        top = min(300.0, 0.3 / self.period)
        torque = 20.0 * signal.chirp(time, 2.0, self.length, top, method=self.method)
        finer = self.period / FINER
        a, b, c = self.plant()
        sampled = signal.cont2discrete((a, b, c, np.zeros((1, 1))), finer)
        late = np.concatenate([np.zeros(round(self.delay / finer)), np.repeat(torque, FINER)])
        moved = signal.dlsim((*sampled[:4], finer), late[: FINER * len(time)])[1][::FINER, 0]
        most = np.abs(moved).max()
        if self.differences == 1:
            moved = moved + self.noise * most * np.random.default_rng(self.seed).standard_normal(len(time))
        step = most / 20000.0
        return torque, np.round(moved / step) * step


def chirp(seed: int) -> Chirp:
    """Return an axis whose figures are drawn; every fourth is one mass alone."""
    dice = np.random.default_rng(7000 + seed)
    size, period = math.exp(dice.uniform(math.log(20.0), math.log(150.0))), float(dice.choice([0.5e-3, 1e-3]))
    return Chirp(
        size=size,
        friction=dice.uniform(2.0, 6.0) / size,
        delay=round(dice.uniform(0.3e-3, 4e-3) / period * FINER) * period / FINER,
        ratio=0.0 if seed % 4 == 0 else dice.uniform(0.4, 2.5),
        resonance=dice.uniform(45.0, 140.0),
        damping=dice.uniform(0.01, 0.08),
        noise=float(dice.choice([0.0, 0.003, 0.006])),
        period=period,
        length=float(dice.choice([8.0, 15.0])),
        method=str(dice.choice(["logarithmic", "linear"])),
        seed=seed,
    )


def beyond(seed: int) -> list[str]:
    """Return the figures that are further off than three of their uncertainties."""
    axis = chirp(seed)
    torque, moved = axis.record()
    response = response_of_record(axis.period, torque, moved, axis.differences)
    found = fit_plant(response, ("velocity", "position")[axis.differences - 1]).figures
    away = {
        name: (found[name], value) for name, value in axis.figures().items() if name in SURE and name in found
    }
    return [
        f"{seed}: {name} is {there:.5g} ± {error:.2g}, and was {value:.5g}"
        for name, ((there, error), value) in away.items()
        if abs(there - value) > 3.0 * error
    ]


@pytest.mark.skipif(not CAMPAIGN, reason="twenty axes: make campaign")
def test_the_uncertainties_of_twenty_chirps_contain_the_truth() -> None:
    """Of 92 figures, by three standard deviations, and 95 % of the axes are all of theirs."""
    missed = [each for each in map(beyond, range(20)) if each]
    assert len(missed) <= 1, missed


@pytest.mark.parametrize("seed", [1, 2, 4])
def test_the_uncertainty_of_a_chirp_contains_the_truth(seed: int) -> None:
    """The delay was 0.5567 ± 0.001 ms where it was 0.55, the acceleration 77.1 ± 0.15 where it was 82.7, and
    the friction of the second axis, by the noise of the ends of its record, 4.5 ± 0.8 % too large.
    """
    assert beyond(seed) == []
