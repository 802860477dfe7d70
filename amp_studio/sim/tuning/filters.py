"""Filters of a control inside of its loops, as unknowns of the solver beside the gains.

A low-pass gives phase away and takes a resonance or the noise of counts down; a notch is set at the resonance
of the machine. Neither the sizes nor the number of useful values is large, so a setting of all filters is one
of few, and the solver goes from the present one to a better one, filter by filter.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.law import AxisLaw, LoopFilter
from amp_studio.sim.rounding import rounded

from .linear import LawMatrices
from .tried import Tried

_CUTOFFS = (1.0, 0.3, 0.1, 0.06, 0.04, 0.025, 0.016, 0.01, 0.006, 0.004)
"""Shares of the highest cutoff of a low-pass that are tried."""
_NEAR = (1.25, 0.8)
"""Factors to the neighbours of a present value."""
_BESIDE = (1.0, 0.9, 1.12)
"""Middle of a notch as a share of the resonance: off it, the notch gives less phase away below."""
_WIDTHS = (0.9, 0.6, 0.3)
"""Width of a notch as a share of its middle."""
_NARROWEST = 1.0
"""Hz: the width with which a notch takes next to nothing out."""
_DIGITS = 3

FilterSetting = tuple[tuple[str, float | None], ...]
"""Parameter -> value of each filter in the loops, in Hz; None where it is not set."""


@dataclass(frozen=True)
class FilterUnknown:
    """One filter that is sought with the gains."""

    filter: LoopFilter
    frequency: str
    """Its parameter."""
    width: str
    low: float
    high: float
    whole: bool

    def nearest(self, value: float) -> float:
        """Return the frequency that the control can have."""
        near = min(max(value, self.low), self.high)
        return float(round(near)) if self.whole else rounded(near, _DIGITS)

    def others(self, setting: Mapping[str, float | None], resonance: float | None) -> Iterator[FilterSetting]:
        """Yield other settings of this filter alone; a notch is set at a resonance that is known."""
        now = setting[self.frequency]
        if not self.width:
            yield from self._other_cutoffs(now)
            return
        middles = [share * resonance for share in _BESIDE] if resonance else []
        pairs = [(self.nearest(middle), share * middle) for middle in middles for share in _WIDTHS]
        if now is not None:
            pairs.append((now, _NARROWEST))
        for middle, width in pairs:
            narrow = min(middle, max(_NARROWEST, rounded(width, _DIGITS)))
            if (middle, narrow) != (now, setting[self.width]) and middle > _NARROWEST:
                yield ((self.frequency, middle), (self.width, narrow))

    def _other_cutoffs(self, now: float | None) -> Iterator[FilterSetting]:
        """Yield other cutoffs of a low-pass; never none, as the highest one takes as little out."""
        tried = [share * self.filter.highest for share in _CUTOFFS]
        tried += [now * factor for factor in _NEAR if now is not None]
        for value in dict.fromkeys(self.nearest(each) for each in tried):
            if value != now:
                yield ((self.frequency, value),)


class Filters:
    """The filters of one axis that have a part in its loops."""

    def __init__(self, trial: Tried) -> None:
        axis = trial.axis
        self._resonance = axis.machine.resonance or None
        self.unknowns = [each for each in _unknowns(trial) if _moves(trial, each)]
        self.present: FilterSetting = tuple(
            (name, None if (value := trial.value(name)) is None else float(value.value))
            for each in self.unknowns
            for name in (each.frequency, each.width)
            if name
        )

    @property
    def is_resonance_known(self) -> bool:
        """Whether the user named the resonance of the machine, or a record showed it."""
        return self._resonance is not None

    def others(self, setting: FilterSetting) -> list[FilterSetting]:
        """Return the settings in which one filter is another one."""
        now = dict(setting)
        return [
            tuple((now | dict(changed)).items())
            for each in self.unknowns
            for changed in each.others(now, self._resonance)
        ]


def _unknowns(trial: Tried) -> Iterator[FilterUnknown]:
    """Yield the filters of an axis that a parameter sets, each with what the control takes."""
    axis: AxisLaw = trial.axis
    for each in axis.filters:
        source, width = axis.sources.get(each.frequency), axis.sources.get(each.width)
        if source is None:
            continue
        low, high = trial.range_of(source.parameter)
        yield FilterUnknown(
            each,
            source.parameter,
            width.parameter if width else "",
            max(low or 0.0, each.lowest),
            min(each.highest, each.highest if high is None else high),
            source.whole,
        )


def _moves(trial: Tried, unknown: FilterUnknown) -> bool:
    """Return whether a filter has a part in the loops of this axis: another drive has none."""
    values = {unknown.frequency: unknown.nearest(0.1 * unknown.high)}
    if unknown.width:
        values[unknown.width] = max(_NARROWEST, 0.5 * values[unknown.frequency])
    other = trial.bound(values)
    if other is None:
        return False
    now, then = LawMatrices.of(trial.axis), LawMatrices.of(other)
    if now.velocity is None or then.velocity is None:
        return not np.array_equal(now.position, then.position)
    return not (np.array_equal(now.position, then.position) and np.array_equal(now.velocity, then.velocity))
