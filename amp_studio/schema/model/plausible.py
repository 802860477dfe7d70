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
    choices: tuple[str, ...] = ()
    """The keys of the usual choices, ``yes`` and ``no`` of a yes/no."""
    bits: tuple[int, ...] = ()
    """The bits of a word that are ever set: no other one has a meaning that is printed or known."""
    also: tuple[float, ...] = ()
    """Values beside these that mean something else, as 0 for off."""

    def __post_init__(self) -> None:
        if sum(map(bool, (self.between, self.among, self.choices, self.bits))) != 1:
            raise ValueError(
                "what is usual is 'between' bounds in a unit, 'among' a few values, 'choices' or 'bits'"
            )
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
    beyond: float = 0
    """Part of the travel that a position may be outside, as a switch is."""
    strokes: tuple[ParameterId, ...] = ()
    """Tables of steps of the same axis, whose motion is not longer than the travel."""


class TextBegins(Model):
    """A text of the machine that begins in one way."""

    param: ParameterId
    begins: str


class SpeedLimit(Model):
    """Speeds that are not above another one of the same axis, or of every axis, unless a slip was made."""

    limit: ParameterId
    """The greatest speed, a rapid move as a rule."""
    are: tuple[ParameterId, ...]
    """Speeds of homing, jogging and probing."""


class Quotient(Model):
    """How many times another value of the same axis, or of any, a value is as a rule; without its sign."""

    of: ParameterId
    over: ParameterId
    between: tuple[float, float]
    """The least and greatest usual quotient in the canonical units: mm/min over mm/s2 is a sixtieth of
    a second."""


class AmongAxes(Model):
    """What the like axes of one machine have in one order of magnitude, each value or a quotient of two."""

    of: ParameterId
    over: ParameterId | None = None
    within: float
    """Times that one is at most away from its nearest like."""
    is_zero_odd: bool = False
    """Whether 0 is asked about where every other one has a value."""


class TravelEnds(Model):
    """The ends of travel of an axis, or its length where the other end is the home position."""

    high: ParameterId
    low: ParameterId | None = None
    unlimited: float | None = None
    """The number, without its sign, that means no end; an axis has both ends or none."""

    is_zone: bool = False
    """Whether these are ends of a zone within the travel, whose lengths are not compared."""

    side: float = 16
    """Times that one side of a table is longer than the other at most: one for profiles and tubes has 6 m by
    0.4 m."""


class Towards(Model):
    """A speed whose sign is the direction to a place at one end of the travel."""

    speed: ParameterId
    place: ParameterId
    low: ParameterId
    high: ParameterId


class Gears(Model):
    """The least and the greatest speed of each gear of a spindle, gear after gear."""

    low: ParameterId
    high: ParameterId


class Proportion(Model):
    """Two shares that belong together: the first of a pair is as large a part of the second in both."""

    part_of: tuple[ParameterId, ParameterId]
    as_of: tuple[ParameterId, ParameterId]
    within: float
    """Times that one share is at most the other."""


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
    curves: dict[ParameterId, str] = {}
    """Text with a smooth table in it -> the sign in each of its words behind which the figure is, as ``:`` of
    ``100:0.004``."""
    steps: tuple[ParameterId, ...] = ()
    """Tables, part after part, whose values are steps of one motion: as a rule it comes back to where it
    began, or never turns back."""
    equal_rows: dict[ParameterId, int] = {}
    """Table of the control -> after how many rows its values repeat; as a rule no single row differs."""
    same: tuple[tuple[ParameterId, ...], ...] = ()
    """Parameters that as a rule have one value on one axis, as an acceleration and its deceleration."""
    twins: tuple[tuple[ParameterId, ParameterId], ...] = ()
    """Two parameters, one an axis and one a joint, that as a rule have one value; in the order of both."""
    twins_where: TextBegins | None = None
    """The machines on which they have it; None is all."""
    ladders: tuple[tuple[ParameterId, ...], ...] = ()
    """Parameters that rise from one to the next, most often by one factor."""
    not_above: tuple[SpeedLimit, ...] = ()
    """Speeds, and what none of them is above."""
    quotients: tuple[Quotient, ...] = ()
    """Values against each other: speeds, the ramps to them, bands within bands."""
    among_axes: tuple[AmongAxes, ...] = ()
    """What like axes have in one order of magnitude."""
    table: dict[ParameterId, float] = {}
    """What X and Y of a table have alike: asked about where they differ in one of these, by so many times or
    by a slip's factor."""
    upright: dict[ParameterId, tuple[float, float]] = {}
    """Speeds and ramps -> the least and the greatest share of the greater one of X and Y that the upright
    axis Z has."""
    uniform: tuple[ParameterId, ...] = ()
    """What all axes that move alike have alike on most machines, a way of being driven or a direction."""
    counted: tuple[ParameterId, ...] = ()
    """Numbers of connectors, given out to the axes one after another; 0 is none."""
    signed: tuple[ParameterId, ...] = ()
    """Parameters whose sign is a direction, by which axes differ that are otherwise alike."""
    towards: tuple[Towards, ...] = ()
    """Speeds that go to the end of the travel that is near."""
    travels: tuple[TravelEnds, ...] = ()
    """Travels, compared among the axes."""
    gears: tuple[Gears, ...] = ()
    """Ranges of gears, compared among the gears of a spindle."""
    proportions: tuple[Proportion, ...] = ()
    """Shares that are equal as a rule."""
    seldom: tuple[ParameterId, ...] = ()
    """Parameters that keep their printed default on nearly every machine."""
    needs: dict[ParameterId, ParameterId] = {}
    """Parameter -> the one without whose value it does nothing, where that one is active."""
    axis_words: tuple[ParameterId, ...] = ()
    """Words with a bit for each axis, in their order, that mean nothing for an axis that is not there."""
    within: tuple[TravelSpan, ...] = ()
    """Travels, and what is within each."""
    usual: dict[ParameterId, Usual] = {}
    """Parameter -> its usual values."""
