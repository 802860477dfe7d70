"""The gains that are sought on an axis: which they are, between which values, and in which steps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.law import Source
from amp_studio.sim.rounding import rounded

from .linear import LawMatrices
from .tried import Tried

_DIGITS = 3
"""Digits of a gain that is no whole number."""
SMALLEST, LARGEST = 1e-8, 1e5
"""Gains between which is sought where the manual prints no bound."""


@dataclass(frozen=True)
class Gain:
    """One gain that is sought."""

    name: str
    """Its figure in `AxisLaw.sources`."""
    parameter: str
    present: float
    low: float
    """The smallest value above 0 that is tried."""
    high: float
    whole: bool
    sign: float
    decimals: int | None
    may_be_none: bool
    """Whether 0 is a value of it: an integral gain."""

    @property
    def present_size(self) -> float:
        """The present value without the sign that is right; below 0 where the present sign is the other."""
        return self.sign * self.present

    def nearest(self, value: float) -> float:
        """Return the value that the control can have, without its sign."""
        if value <= 0.0:
            return 0.0
        near = float(round(value)) if self.whole else rounded(value, _DIGITS)
        near = near if self.decimals is None else round(near, self.decimals)
        return min(max(near, self.low), self.high)


GainPoint = tuple[float, ...]
"""Values of the gains, without their signs."""


def gains_of(trial: Tried) -> list[Gain]:
    """Return the gains of an axis, from the inner loop outwards, that have a value and move its loops."""
    gains: list[Gain] = []
    for name in trial.axis.gains:
        source = trial.axis.sources.get(name)
        value = trial.value(source.parameter) if source else None
        if source is None or value is None:
            continue
        present = float(value.value)
        is_integral = "integral" in name
        # The sign of a gain is the wiring of a feedback: a search over both signs would try a loop that runs
        # away, so only the size is sought, on the side of zero where it is. An integral gain of the other
        # sign than the gain before it pushes away from the target: that one's sign is right for both.
        sign = gains[-1].sign if is_integral and gains else math.copysign(1.0, present or 1.0)
        least, most = _sizes(trial, source, sign)
        whole = source.whole or isinstance(value.value, int)
        decimals = trial.decimals(source.parameter)
        # A gain of 0 opens its loop: the least value above it that the control can have.
        smallest = 1.0 if whole else SMALLEST if decimals is None else 10.0**-decimals
        gain = Gain(
            name,
            source.parameter,
            present,
            max(least, smallest),
            most,
            whole,
            sign,
            decimals,
            is_integral and least == 0.0,
        )
        if _moves(trial, gain):
            gains.append(gain)
    return gains


def _sizes(trial: Tried, source: Source, sign: float) -> tuple[float, float]:
    """Return the least and the greatest size of a gain on its side of zero."""
    low, high = trial.range_of(source.parameter)
    if sign < 0.0:
        return 0.0, -(low or -LARGEST)
    return max(low or 0.0, 0.0), min(LARGEST if high is None else high, source.largest)


def _moves(trial: Tried, gain: Gain) -> bool:
    """Return whether the gain has a part in the loops: an integral gain that waits at rest has none."""
    tried = [trial.bound({gain.parameter: gain.sign * gain.nearest(each)}) for each in (gain.low, gain.high)]
    laws = [None if axis is None else LawMatrices.of(axis) for axis in tried]
    if laws[0] is None or laws[1] is None:
        return False
    same = np.array_equal(laws[0].position, laws[1].position)
    if laws[0].velocity is None or laws[1].velocity is None:
        return not same
    return not (same and np.array_equal(laws[0].velocity, laws[1].velocity))
