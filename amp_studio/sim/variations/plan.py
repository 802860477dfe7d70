"""What is varied, between which values, and the points that this makes: a grid, or samples of a seed.

    servo.initial_gain@X=0.5:2:21            21 values, even steps
    servo.initial_gain@X=0.25:4:21:log       even factors
    model.inertia_ratio=0.5:2                between two values, for samples
    model.coulomb_friction=4.1+-0.3          a normal distribution, for samples

Samples are stratified (M. McKay, R. Beckman, W. Conover, Technometrics 21, 1979): of N samples one is in each
N-th part of every distribution, so that percentiles need fewer of them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, UnknownParameterError, Value, read_number, resolve_address
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.tuning.sampled import Matrix

MAX_VARIATIONS = 1_000_000
"""Variations of one sweep at most."""
SETTINGS = ("model", "move")
"""First words of what is varied and is no parameter."""
_FORM = "NAME=FROM:TO:STEPS, or NAME=MEAN+-SIGMA with samples"
_SIGMAS = 4.0
"""A normal distribution is cut there."""


@dataclass(frozen=True)
class Varied:
    """One thing that is varied."""

    name: str
    """As it was asked for: a setting, or a parameter."""
    low: float
    """Or the mean of a normal distribution."""
    high: float
    """Or its standard deviation."""
    steps: int | None = None
    geometric: bool = False
    normal: bool = False
    address: Address | None = None
    """Of a parameter."""
    unit: str = ""

    def grid(self) -> list[float]:
        """Return its values in a grid; raises SimulationError where their number is not given."""
        if self.steps is None:
            raise SimulationError(f"{self.name} has no number of steps: write {_FORM}", self.name)
        if self.geometric:
            return [float(each) for each in np.geomspace(self.low, self.high, self.steps)]
        return [float(each) for each in np.linspace(self.low, self.high, self.steps)]

    def at(self, share: float) -> float:
        """Return the value that this share of its distribution is below."""
        if self.normal:
            # The distribution has no value at 0 and at 1.
            far = NormalDist().inv_cdf(min(max(share, 1e-9), 1.0 - 1e-9))
            return self.low + self.high * min(max(far, -_SIGMAS), _SIGMAS)
        if self.geometric:
            return float(self.low * (self.high / self.low) ** share)
        return self.low + (self.high - self.low) * share


def read_varied(file: ParameterFile, axis: str, text: str) -> Varied:
    """Read what is varied; raises SimulationError with one sentence."""
    name, sign, rest = (part.strip() for part in text.partition("="))
    if not sign or not name or not rest:
        raise SimulationError(f"'{text[:60]}' does not say what is varied: {_FORM}")
    normal = re.split(r"\s*(?:\+-|±)\s*", rest)
    parts = normal if len(normal) == 2 else rest.split(":")
    geometric = len(parts) == 4 and parts[3].strip() == "log"
    if len(parts) not in (2, 3) and not geometric:
        raise SimulationError(f"'{rest[:60]}' is no range of {name}: {_FORM}", name)
    low, high = _number(name, parts[0]), _number(name, parts[1])
    steps = None if len(parts) == 2 else _steps(name, parts[2])
    if len(normal) == 2:
        if high < 0.0:
            raise SimulationError(f"The standard deviation of {name} is below 0", name)
        return _placed(file, axis, Varied(name, low, high, normal=True))
    if not low < high:
        raise SimulationError(
            f"{name} is varied from {parts[0]} to {parts[1]}: the first one must be the smaller", name
        )
    if geometric and low <= 0.0:
        raise SimulationError(f"{name} is varied in factors: it must be above 0", name)
    return _placed(file, axis, Varied(name, low, high, steps, geometric))


def _number(name: str, text: str) -> float:
    """Return a number without a unit; raises SimulationError."""
    try:
        number, rest = read_number(text.strip())
    except ValueError as error:
        raise SimulationError(f"{name}: {error}", name) from None
    if rest.strip() or not math.isfinite(number):
        raise SimulationError(
            f"{name}: '{text.strip()[:40]}' is no number; it is in the unit that the value has", name
        )
    return number


def _steps(name: str, text: str) -> int:
    steps = _number(name, text)
    if not (steps.is_integer() and 2 <= steps <= MAX_VARIATIONS):
        raise SimulationError(
            f"{name} has '{text.strip()[:40]}' steps; it must be a whole number from 2 on", name
        )
    return int(steps)


def _placed(file: ParameterFile, axis: str, varied: Varied) -> Varied:
    """Return it with the address and unit of a parameter; raises SimulationError for one that is none,
    or has no number.
    """
    if varied.name.partition(".")[0] in SETTINGS:
        return varied
    address = swept_address(file, varied.name, axis)
    value = file.get(address)
    if value is None or isinstance(value.value, (bool, str)):
        raise SimulationError(
            f"{varied.name} has no number that could be varied: set a value first", address[0]
        )
    return Varied(
        varied.name,
        varied.low,
        varied.high,
        varied.steps,
        varied.geometric,
        varied.normal,
        address,
        value.unit,
    )


def swept_address(file: ParameterFile, name: str, axis: str) -> Address:
    """Return the address of a parameter; one of an axis without its axis is that of the swept one.
    Raises SimulationError.
    """
    found = file.schema.parameters.get(name)
    if found is not None and axis in file.machine_schema.instances(found):
        return name, axis
    try:
        return resolve_address(file.evaluation, name).address
    except UnknownParameterError as error:
        raise SimulationError(str(error), name) from None


def _sampled(varied: Sequence[Varied], samples: int, seed: int) -> Matrix:
    """Return a Latin hypercube: each of ``samples`` equal parts of the range of each figure has one point
    (McKay, Beckman and Conover, Technometrics 21, 1979). Raises SimulationError for more than MAX_VARIATIONS.
    """
    if not 1 <= samples <= MAX_VARIATIONS:
        raise SimulationError(f"{samples} samples: it must be 1 to {MAX_VARIATIONS}")
    dice = np.random.default_rng(seed)
    shares = [(dice.permutation(samples) + dice.random(samples)) / samples for _ in varied]
    columns = [[each.at(float(share)) for share in own] for each, own in zip(varied, shares, strict=True)]
    return np.array(columns).T.reshape(samples, len(varied))


def points_of(varied: Sequence[Varied], samples: int | None, seed: int) -> Matrix:
    """Return the points (variations, what is varied), a grid in the order of an odometer or ``samples``.

    Raises SimulationError for more than MAX_VARIATIONS, or a distribution without ``samples``.
    """
    if samples is not None:
        return _sampled(varied, samples, seed)
    for each in varied:
        if each.normal:
            raise SimulationError(f"{each.name} has a distribution: say how many samples", "samples")
    grids = [each.grid() for each in varied]
    if math.prod(len(grid) for grid in grids) > MAX_VARIATIONS:
        raise SimulationError(f"The steps make more than {MAX_VARIATIONS} variations: give fewer of them")
    return np.stack(np.meshgrid(*grids, indexing="ij"), axis=-1).reshape(-1, len(varied))


def typed(varied: Varied, file: ParameterFile, number: float) -> Value:
    """Return the value of a parameter for a number: whole where it is whole,
    with the decimals that the control keeps.
    """
    assert varied.address is not None
    old = file.get(varied.address)
    assert old is not None
    if isinstance(old.value, int):
        return Value(round(number), old.unit)
    storage = file.schema.parameters[varied.address[0]].storage
    decimals = storage.decimals if storage else None
    return Value(number if decimals is None else round(number, decimals), old.unit)
