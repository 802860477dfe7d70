"""Which parameters a picture is drawn from: their roles in it. No drawing knows a family;
it knows these roles.
"""

from collections.abc import Iterator
from typing import Literal

from .record import Key, Model, Page, ParameterId


class Direction(Model):
    """Which way an axis goes: a choice, or one bit an axis of a word."""

    param: ParameterId
    plus: tuple[Key, ...] = ()
    """Choices that mean the plus direction."""
    minus: tuple[Key, ...] = ()
    bits: Literal["", "plus", "minus"] = ""
    """What a set bit means; the bit of an axis is its place among the axes."""

    def __post_init__(self) -> None:
        if bool(self.bits) == bool(self.plus and self.minus):
            raise ValueError("a direction has 'plus' and 'minus' choices, or 'bits'")


class SpanRole(Model):
    """Two ends of travel on an axis."""

    name: str
    low: ParameterId
    high: ParameterId
    page: Page
    none: tuple[float, float] | None = None
    """The values, as entered, with which there is no limit."""


class ReachRole(Model):
    """A length from the home switch to the other end of travel."""

    name: str
    length: ParameterId
    page: Page


class ForbiddenSide(Model):
    """A choice of the forbidden side of a zone."""

    param: ParameterId
    inside: tuple[Key, ...]
    outside: tuple[Key, ...]


class ZoneRole(SpanRole):
    """Room that is forbidden while a program has the zone switched on."""

    forbidden: Literal["inside", "outside", "either"] | None = None
    """``either``: an axis that is outside may not enter, one that is inside may not leave."""
    forbidden_by: ForbiddenSide | None = None
    group: ParameterId | None = None
    """Axes with the same choice bound one body; a direction whose axis is not among them reaches over the
    whole travel."""
    group_none: Key | None = None

    def __post_init__(self) -> None:
        if (self.forbidden is None) == (self.forbidden_by is None):
            raise ValueError("a zone has 'forbidden' or 'forbidden_by'")


class HomePlace(Model):
    """Where an axis is home, and how it gets there."""

    page: Page
    position: ParameterId | None = None
    """The coordinate of the home position."""
    switch: ParameterId | None = None
    """The coordinate of the switch, if that is set and not found."""
    marker: ParameterId | None = None
    """From the marker to the home position."""
    pull_off: ParameterId | None = None
    """From the switch to the home position."""
    towards: Direction | None = None
    """To the switch."""
    off: Direction | None = None
    """Off the switch."""
    speed: ParameterId | None = None
    """Off the switch."""


class TravelRoles(Model):
    """Travel and zones of two axes."""

    spans: tuple[SpanRole, ...] = ()
    reach: ReachRole | None = None
    zones: tuple[ZoneRole, ...] = ()
    home: HomePlace | None = None


class TimeOf(Model):
    """A time that is the product of numbers."""

    params: tuple[ParameterId, ...]
    """The first one is the one to drag; those behind it count as 1 where they are not set."""
    needed: tuple[ParameterId, ...] = ()
    """Of those, the ones without which there is no time."""
    unit: Literal["ms", "s"] = "ms"


class Scans(Model):
    """Within how many scans a ramp of acceleration has to be over;
    what is longer or shorter the control does not do.
    """

    least: float
    most: float
    scan: TimeOf


class RampKind(Model):
    """One kind of ramp."""

    kind: Literal["linear", "exponential", "s-curve", "sine-squared"]
    name: str
    page: Page
    acceleration: ParameterId | None = None
    deceleration: ParameterId | None = None
    """Without one, and where it is 0, it is the acceleration."""
    jerk: ParameterId | None = None
    jerk_scans: Scans | None = None
    step: ParameterId | None = None
    """A change of speed that needs no ramp."""
    time: TimeOf | None = None
    """Time constant of an exponential ramp, least time of a sine-squared one."""
    rise: tuple[ParameterId, ...] = ()
    """The time in ms in which a ramp reaches the feedrate, the first one that is set;
    in place of an acceleration."""
    modes: tuple[str, ...] = ()
    """Values of the ``mode`` with which moves have this ramp: keys of the choice, 0 or 1 of the bit."""
    note: str = ""
    """What is assumed, a sentence with its page."""


class RampRoles(Model):
    """Speed over time in a move."""

    feedrate: ParameterId
    limits: tuple[ParameterId, ...] = ()
    """Other speeds to compare with."""
    mode: ParameterId | None = None
    """What chooses the kind."""
    mode_bit: int | None = None
    """The bit of it that does."""
    kinds: tuple[RampKind, ...]


class JogRoles(Model):
    """Speeds and distances of jogs, the lowest first."""

    page: Page
    speeds: tuple[ParameterId, ...] = ()
    increments: tuple[ParameterId, ...] = ()
    limits: tuple[ParameterId, ...] = ()
    """Speeds that are no jog speeds but bound them (rapid)."""


class GearRoles(Model):
    """Gears of a spindle on a line of speed."""

    page: Page
    low: ParameterId | None = None
    high: ParameterId | None = None
    limit: ParameterId | None = None
    """A speed within the gear that is not passed."""
    count: ParameterId | None = None
    """How many gears are used."""
    output: ParameterId | None = None
    """What the control puts out at the highest speed."""
    output_low: ParameterId | None = None
    """At the lowest speed; without it the output is proportional to the speed."""
    scaling: ParameterId | None = None
    """Output for a unit of speed, in place of gears."""
    full: float | None = None
    """The output at the highest speed, where no parameter sets it."""
    unit: str = "V"


class ErrorRoles(Model):
    """Gain of the position loop over the following error, and the limits of that."""

    page: Page
    gain: ParameterId
    break_at: ParameterId | None = None
    ratio: ParameterId | None = None
    """Share of the gain beyond the break."""
    limits: tuple[ParameterId, ...] = ()


class TableRoles(Model):
    """A compensation over the position, all of it in one text; the family's ``curve`` reads and writes it."""

    name: str
    param: ParameterId
    page: Page
    unit_from: ParameterId
    """A length of the axis, in whose unit position and compensation are."""


class LoopBlock(Model):
    """A block of a diagram of loops: what acts there."""

    name: str
    params: tuple[ParameterId, ...] = ()
    place: Literal["command", "ahead", "chain", "back"] = "chain"
    """Where it is: the command itself, added ahead of the loop, in the loop in this order, or on the way
    back."""
    into: str = ""
    """Name of the block of the chain to which it is added; the first one without."""
    signal: str = ""
    """The steady signal behind it, as the simulation names it."""


class LoopRoles(Model):
    """The loops of an axis as a diagram."""

    page: Page
    blocks: tuple[LoopBlock, ...]
    note: str
    """Where the drawing of the manual is; if our copy has lost it, from what it is drawn."""

    def __post_init__(self) -> None:
        places = [block.place for block in self.blocks]
        if places.count("command") != 1 or "chain" not in places:
            raise ValueError("a diagram of loops has one command and a chain")
        chain = {block.name for block in self.blocks if block.place == "chain"}
        for block in self.blocks:
            if block.into and block.into not in chain:
                raise ValueError(f"'{block.name}' goes into '{block.into}', which is not in the chain")


class CamRoles(Model):
    """The cam of an axis: drawn where it has points."""

    page: Page
    points: ParameterId
    """How many points it has."""


class PictureRoles(Model):
    """A file ``pictures.yaml``: what each picture of the family is drawn from."""

    travel: TravelRoles | None = None
    ramps: RampRoles | None = None
    jog: JogRoles | None = None
    gears: GearRoles | None = None
    error: ErrorRoles | None = None
    tables: tuple[TableRoles, ...] = ()
    loop: LoopRoles | None = None
    cam: CamRoles | None = None

    @property
    def params(self) -> tuple[ParameterId, ...]:
        """Every parameter that has a role."""
        return tuple(dict.fromkeys(named for _, named in parameters_named(self)))


_NO_PARAMETERS = {
    "name",
    "page",
    "note",
    "kind",
    "unit",
    "forbidden",
    "bits",
    "plus",
    "minus",
    "inside",
    "outside",
    "group_none",
    "modes",
    "place",
    "into",
    "signal",
}
"""Fields with texts that name no parameter."""


def parameters_named(
    model: Model, place: tuple[str | int, ...] = ()
) -> Iterator[tuple[tuple[str | int, ...], ParameterId]]:
    """Yield the parameters that a record names, each with its place in the file."""
    for name, value in model.items():
        several = isinstance(value, tuple)
        for n, entry in enumerate(value if several else (value,)):
            here = (*place, name, n) if several else (*place, name)
            if isinstance(entry, Model):
                yield from parameters_named(entry, here)
            elif isinstance(entry, str) and name not in _NO_PARAMETERS:
                yield here, entry
