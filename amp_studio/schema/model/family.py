"""What a family is: identity, scopes, units, conditions and the order of its groups."""

import re
from fractions import Fraction
from typing import Annotated, Literal

from amp_studio.schema.units import UNITS, define_unit

from .parameter import Bit, Choice, Effect
from .record import Instances, Key, Model, Page, ParameterId, Scope, Then, Unit


class Condition(Model):
    """A named condition on the values of one machine, in CEL."""

    reads: dict[str, str] = {}
    when: str
    why: str
    """The reason shown when the condition makes a parameter inactive."""
    page: Page | None = None


class ScopeInfo(Model):
    """The instances a scope has in this family."""

    instances: Instances
    label: str
    """``Axis {i}``."""
    of: Scope | None = None
    """The scope whose instances these are parts of: register ``X.3`` belongs to axis ``X``,
    and reads what is its."""


class MachineType(Model):
    """A machine type that can be chosen for a file of the family."""

    key: Key
    name: str
    in_signature: bool = True
    """False for a type that was added when files and controls had the family's signature already."""


class AxisProfile(Model):
    """Which parameters the axis operations of the files room act on."""

    name: ParameterId
    type: ParameterId
    unfitted: Key | None = None
    """Type of an axis that is not there; None where no type means that, and ``fitted_by`` does."""
    fitted_by: ParameterId | None = None
    """A number that is 0 for an axis that is not there (its port), if that is no matter of the type."""
    usual_type: Key
    """Type of an axis that is only named."""
    types: dict[str, Key] = {}
    """Types that go with a name (``S`` with spindle)."""
    hardware: ParameterId | None = None
    loop: ParameterId | None = None

    def __post_init__(self) -> None:
        if (self.unfitted is None) == (self.fitted_by is None):
            raise ValueError(
                "an axis is left out either by its type ('unfitted') or by a number ('fitted_by')"
            )


class AxisField(Model):
    """A parameter of each axis, or a field of its packed word."""

    param: ParameterId
    bit: int | None = None
    """The first bit of the field; None for the parameter itself."""


class AxisDeclaration(Model):
    """How a file declares which axes there are, in a family whose axes have no types.

    Without ``flags``, ``count`` and ``letters`` the family always has all of them.
    """

    page: Page
    name: AxisField | None = None
    """Where the letter of an axis is stored; None where the instances are the letters."""
    group: AxisField | None = None
    """Where the group (channel) of an axis is stored."""
    group_count: ParameterId | None = None
    """How many groups there are."""
    absent_when: str | None = None
    """Condition under which an axis is not there."""
    other_uses: dict[str, str] = {}
    """Condition under which something else uses the input of an axis -> what that is (``spindle``)."""
    flags: tuple[ParameterId, ...] = ()
    """Words with a bit for each axis that is there."""
    count: ParameterId | None = None
    """The number of axes: the first ones are there."""
    letters: ParameterId | None = None
    """A text with the letters of the axes that a control has: the first ones, in order."""
    any_letters: bool = False
    """The letters may be any of the axes, in any order (``X Z``); ``count`` is then the number of motors,
    one more for each."""
    least: int = 1
    """The fewest axes there can be."""
    most: dict[Key, int] = {}
    """Machine type -> the most axes there can be, for one that has fewer than the family."""
    place: str = ""
    """What an instance is at the machine, for families where none can be inserted (``address
    of the encoder card``)."""

    @property
    def is_fixed(self) -> bool:
        """Whether a file cannot choose its axes."""
        return not (self.flags or self.count or self.letters)


class OwnUnit(Model):
    """A unit: what it measures, and how people write it."""

    measures: str
    """Its dimension; a name that no other unit has makes a separate dimension."""
    factor: str = "1"
    """To the unit of the dimension that has 1, exactly: a number in quotes or a fraction (``10/254``)."""
    shown: str = ""
    """How it is shown, if that is otherwise than it is written in a file (``mm/s²``)."""
    also: tuple[str, ...] = ()
    """Other ways in which people write it."""


class Units(Model):
    """The units that every family may use (``units.yaml``)."""

    units: dict[str, OwnUnit]


class UnitSize(Model):
    """What one of a unit is: another parameter sets it."""

    param: ParameterId
    sizes: dict[str, str] = {}
    """A choice or a number of it -> a length or an angle, as ``0.001 mm``; without any,
    its own value is the size."""
    otherwise: str | None = None
    """The size with any other value; without it there is none."""

    def __post_init__(self) -> None:
        for text in (*self.sizes.values(), *filter(None, [self.otherwise])):
            number, _, unit = text.partition(" ")
            if not re.fullmatch(r"\d+(\.\d+)?", number) or not float(number) or unit not in UNITS:
                raise ValueError(f"'{text}' is no size: write a number and a unit, as 0.001 mm")
        if self.otherwise is not None and not self.sizes:
            raise ValueError("'otherwise' is for values without an entry in 'sizes', which has none")


class UnitScale(Model):
    """A unit whose size another parameter sets."""

    length: UnitSize
    angle: UnitSize | None = None
    """On an axis that turns."""


def define_units(own: dict[str, OwnUnit]) -> dict[str, OwnUnit]:
    """Make the units known to whatever is read after them; raises ValueError."""
    for unit, meaning in own.items():
        if not re.fullmatch("[A-Za-z][A-Za-z0-9]*(/[A-Za-z0-9]+)*", unit):
            raise ValueError(f"'{unit}' is no name of a unit: letters and digits, as steps/mm")
        try:
            define_unit(unit, meaning.measures, Fraction(meaning.factor), meaning.shown, meaning.also)
        except ZeroDivisionError:
            raise ValueError(f"'{meaning.factor}' is no factor") from None
    return own


class WayToControl(Model):
    """One way in which parameters come into a control of the family, and out of it."""

    way: Literal["sheet", "line", "folder", "gateway"]
    """Keyed in by hand from a sheet; over a line to the control itself; as files in a folder that the control
    reads; through a program beside the control that speaks the exchange protocol of AMP Studio
    (docs/protocols/exchange.md)."""
    protocol: Key | None = None
    """The driver of a line or a folder, as its family registers it."""
    what: str
    """What it is, in a sentence without its full stop."""
    page: Page | None = None

    def __post_init__(self) -> None:
        if (self.way in ("line", "folder")) != (self.protocol is not None):
            raise ValueError(
                "'protocol' names the driver of a line or a folder: each has one, and no other way has"
            )


class Area(Model):
    """A head above groups that belong together; ours, no manual prints it."""

    name: str
    groups: tuple[Key, ...]


class Family(Model):
    """``family.yaml``: identity, scopes, units and the order of the groups."""

    own_units: Annotated[dict[str, OwnUnit], Then(define_units)] = {}
    """Units that the program does not know by itself. First, because all that follows may use them."""
    family: Key
    name: str
    short: str = ""
    """A name that a tab has room for; empty for the whole name."""
    what: str = ""
    """In a line what machines it is for."""
    without_motion: str = ""
    """Why its axes are not simulated and what there is instead; "" for a family that has a law."""
    document: str
    title: str
    applications: tuple[str, ...] = ()
    machines: tuple[MachineType, ...]
    default_machine: Key
    machine_parameter: ParameterId | None = None
    """The parameter whose choice keys are the machine types, where there is one."""
    scopes: dict[Scope, ScopeInfo]
    units: dict[str, dict[str, Unit]]
    """Per unit system (``metric``, ``inch``) the unit of each quantity."""
    scales: dict[Unit, UnitScale] = {}
    """Units whose size another parameter sets (internal units): what they are in mm or degrees."""
    unit_parameter: ParameterId | None = None
    """The parameter whose choice keys are the unit systems,
    where the control keeps bare figures in the chosen one."""
    angular_when: str | None = None
    """Condition under which length-like quantities of an axis are entered in degrees."""
    axes: AxisProfile | None = None
    declared_axes: AxisDeclaration | None = None
    effect: Effect
    groups: tuple[str, ...]
    areas: tuple[Area, ...] = ()
    """The same groups in the same order under heads, for a family with many; empty: a plain list."""
    choice_lists: dict[Key, tuple[Choice, ...]] = {}
    """Choices that several parameters have, by the name that is there under ``choices``."""
    bit_lists: dict[Key, tuple[Bit, ...]] = {}
    """Bits that several words have, by the name that is there under ``bits``."""
    conditions: dict[str, Condition] = {}
    ways: tuple[WayToControl, ...] = ()
    """The ways to a control, the usual first; without any it is keyed in by hand, and nothing is
    downloaded."""

    @property
    def has_line(self) -> bool:
        """Whether a way to speak to a control itself is published."""
        return any(each.protocol is not None for each in self.ways)

    @property
    def by_hand(self) -> str:
        """What is known of keying values in, in a sentence, where no way to speak to a control is published;
        else "".
        """
        sheets = (each.what for each in self.ways if each.way == "sheet")
        return "" if self.has_line else next(sheets, f"No way to a {self.name} but its own screens is known")

    def machine_name(self, key: str) -> str:
        """Return the name of a machine type; the key itself where the family has none of that key."""
        return next((machine.name for machine in self.machines if machine.key == key), key)

    @property
    def fits_axes(self) -> bool:
        """Whether a file declares which of the axes are there."""
        return self.axes is not None or (self.declared_axes is not None and not self.declared_axes.is_fixed)
