"""What is plausible in a family, which no manual prints: how like axes, usual figures and smooth tables
look.
"""

from .record import Model, ParameterId, Unit


class Usual(Model):
    """The values that a parameter usually has; another one may be right, and is asked about."""

    between: dict[Unit, tuple[float, float]] = {}
    """Unit -> the least and the greatest usual value; of each dimension one is enough."""
    among: tuple[float, ...] = ()
    """The usual values, where there are but a few."""
    also: tuple[float, ...] = ()
    """Values beside these that mean something else, as 0 for off."""

    def __post_init__(self) -> None:
        if bool(self.between) == bool(self.among):
            raise ValueError("what is usual is 'between' bounds in a unit, or 'among' a few values")
        if any(low >= high for low, high in self.between.values()):
            raise ValueError("the least usual value is below the greatest")


class TravelSpan(Model):
    """Positions that are within the travel of their axis, unless a slip was made."""

    low: ParameterId
    """The end of travel in the negative direction."""
    high: ParameterId
    """The end in the positive direction."""
    inside: tuple[ParameterId, ...]
    """Positions of the same axis."""


class Plausible(Model):
    """``plausible.yaml``: facts of experience, ours and not the manual's;
    what contradicts them is a recommendation.
    """

    unlike: tuple[str, ...] = ()
    """Parameters that differ among axes which are otherwise alike (names, ports, travels): ids,
    or ``zone.*``."""
    may_differ: tuple[str, ...] = ()
    """Of the others those that like axes have in common as a rule only (screws, gains):
    asked about where a slip explains it."""
    smooth: tuple[ParameterId, ...] = ()
    """Tables, part after part, whose values run without a single one that jumps out."""
    axis_words: tuple[ParameterId, ...] = ()
    """Words with a bit for each axis, in their order, that mean nothing for an axis that is not there."""
    within: tuple[TravelSpan, ...] = ()
    """Travels, and what is within each."""
    usual: dict[ParameterId, Usual] = {}
    """Parameter -> its usual values."""
