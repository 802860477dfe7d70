"""What a parameter is: numbers, values, ranges, states, storage."""

from collections.abc import Collection
from functools import partial
from typing import Annotated, Any, Literal

from amp_studio.schema.units import UNITS

from .record import First, Instances, Key, Model, Page, ParameterId, Scope, Then, Unit

ValueType = Literal["integer", "real", "choice", "boolean", "bits", "text", "format"]
ParameterState = Literal["in-force", "ignored", "unusable", "hidden"]
Quantity = Literal[
    "",
    "length",
    "angle",
    "velocity",
    "acceleration",
    "acceleration-per-minute",
    "jerk",
    "time",
    "percent",
    "voltage",
    "current",
    "frequency",
    "rotation",
    "counts",
    "counts-per-length",
    "power",
    "register",
]


class BoundRef(Model):
    """A bound that is the value of another parameter of the same instance."""

    param: ParameterId


Bound = float | BoundRef | None
Range = tuple[Bound, Bound]
Ranges = Annotated[dict[Unit, Range], Then(dict, propertyNames={"enum": list(UNITS)})]


class RangeVariant(Model):
    """Ranges that apply instead of the plain ones while a condition is true."""

    when: str
    ranges: Ranges


class Choice(Model):
    """One of the fixed values of a choice or a yes/no parameter."""

    key: Key
    label: str
    code: str | None = None
    """The letter the manual prints before the choice; the order of the letters is not that of the codes."""
    raw: int | None = None
    """What the control stores; None where no code is printed."""
    note: str | None = None


def _choice_list(given: object, family: object) -> object:
    return _named_list(given, "choice", getattr(family, "choice_lists", {}))


def _bit_list(given: object, family: object) -> object:
    return _named_list(given, "bit", getattr(family, "bit_lists", {}))


def _named_list(given: object, kind: str, lists: dict[str, Any]) -> object:
    """Return the list of the family that a name means."""
    if not isinstance(given, str):
        return given
    if given not in lists:
        raise ValueError(f"there is no {kind} list '{given}'")
    return lists[given]


Choices = Annotated[tuple[Choice, ...], First(_choice_list, also=Key)]
"""Choices, or the name of one of the ``choice_lists`` of the family."""


class Bit(Model):
    """One bit, or a field of several bits, of a packed word."""

    bit: int
    width: int = 1
    label: str
    choices: Choices | None = None
    signed: bool = False
    """A field of several bits with a signed number (two's complement)."""
    unknown: bool = False
    """The manual's figure is lost: the bit is kept and shown raw."""
    was: str = ""
    """The label with which it was published: files and controls out there have the signature of that."""
    needs: str = ""
    """The builds that have it, where the plain one does not: it may be above the width of the plain word."""


Bits = Annotated[tuple[Bit, ...], First(_bit_list, also=Key)]
"""Bits, or the name of one of the ``bit_lists`` of the family."""


class Storage(Model):
    """How the value is stored in the control."""

    unit: Unit | None = None
    decimals: int | None = None
    scale: float = 1.0
    """Stored number per unit of ``unit`` (65.536 for counts/s in a 1.25 ms scan)."""
    bits: int | None = None
    signed: bool = True
    notation: Literal["decimal", "hex", "binary", "ascii"] = "decimal"
    words: int = 1
    word_order: Literal["high-first", "low-first"] = "high-first"
    single: bool = False
    """A number is kept as a 32-bit float, and shown with ``decimals``: the control has more than it shows."""
    code: int | None = None
    """The control's own code of the type of word, which its files name (NUM: 6 for 32 bits in
    hexadecimal)."""
    command: str | None = None
    """The command that sets it: ``{i}`` is the instance, ``{k}`` its place from 0, ``{n}`` its number,
    ``{v}`` the value,
    ``{other.id}`` that of another.

    A command of several values is the same at each of them: ``NOTCH {i}({notch.frequency}, {notch.width})``.
    """


class Numbers(Model):
    """By which numbers people and controls address the instances of a parameter.

    Instance number k (counting from 0) has number ``start + k * step`` written through ``format``; ``listed``
    names instances one by one instead, and ``starts`` gives the first number of each array of parts.
    """

    start: int | None = None
    step: int = 0
    format: str = "{n}"
    """``{n}`` is the number, ``{i}`` the instance (``P21N{i}``, ``Pr{n}``, ``R{n}``)."""
    listed: dict[str, str] | None = None
    starts: dict[str, int] | None = None
    """What is before the point of an instance -> number of its part 0; the parts follow ``step`` by
    ``step``."""
    disputed: bool = False
    """The manual prints this number for another parameter too, and that other one is right."""

    def __post_init__(self) -> None:
        ways = [self.start, self.listed, self.starts]
        if ways.count(None) == len(ways) and "{n}" in self.format:
            raise ValueError("numbers need 'start', 'listed', 'starts' or a format without {n}")
        try:
            self.format.format(n=0, i="")
        except (LookupError, ValueError):
            raise ValueError(
                f"the format {self.format!r} may contain {{n}} and {{i}} and nothing else in braces"
            ) from None


class Layout(Model):
    """Scope, instances and numbers of a parameter on some machine types (mill against lathe)."""

    machines: tuple[str, ...] | None = None
    scope: Scope
    instances: Instances | None = None
    """Only where they differ from those of the scope in the family (``("0", …, "31")`` for 32 words)."""
    numbers: Numbers | None = None
    """None for a field that has no number at all."""


class StateRule(Model):
    """Makes a parameter inactive while a named condition of the family is true."""

    state: Literal["ignored", "unusable", "hidden"]
    when: str | None = None
    unless: str | None = None
    page: Page | None = None

    def __post_init__(self) -> None:
        if (self.when is None) == (self.unless is None):
            raise ValueError("a state takes either 'when' or 'unless'")


class Effect(Model):
    """When a change takes effect."""

    level: Literal["at-once", "reset", "restart", "online", "command", "unknown"]
    """``online``: at once where it is changed with a function of the control (``command``), on restart where
    it is sent; ``unknown`` where the manual gives none."""
    command: str | None = None
    """The command that makes the device read the value (level ``command``),
    or the function of the control (level ``online``)."""

    def __post_init__(self) -> None:
        if (self.command is None) == (self.level in ("command", "online")):
            raise ValueError("'command' belongs to the levels 'command' and 'online', and they need it")


class HelpNote(Model):
    """What the manual warns of or asks for, in our own words, and where it does."""

    says: str
    page: Page
    brief: str = ""
    """Of a danger: three to five words for a column beside the value."""


class Help(Model):
    """The parameter in our own words; ``find`` and ``wrong`` are empty only
    for what the control writes itself.
    """

    what: str
    find: str = ""
    wrong: str = ""
    danger: tuple[HelpNote, ...] = ()
    """Where a wrong value can move the machine unexpectedly or hurt a person."""
    warning: tuple[HelpNote, ...] = ()
    """Where a wrong value can damage something or cost accuracy."""
    note: tuple[HelpNote, ...] = ()
    """An effect to know, such as a value that the control replaces."""
    related: tuple[ParameterId, ...] = ()


class Default(Model):
    """A printed default, and its page."""

    value: float | bool | str
    """A number in ``unit``, a choice key, or a text."""
    unit: Unit = ""
    page: Page
    instances: dict[str, float | bool | str] | None = None
    """Instances whose default differs from ``value``."""

    def check_choices(self, keys: Collection[str]) -> None:
        """Raise ValueError where a default is not one of these choices."""
        for value in (self.value, *(self.instances or {}).values()):
            if value not in keys:
                raise ValueError(f"default {value!r} is not one of its choices")


class Need(Model):
    """An option, a piece of hardware or a software release without which a parameter does nothing."""

    what: str
    page: Page


def _is_shared(choices: tuple[Choice, ...], field: str) -> bool:
    """Return whether two choices have the same key, label or code, as ``read_value`` compares them."""
    words = [str(getattr(c, field)) for c in choices if getattr(c, field) is not None]
    return len({" ".join(word.casefold().split()) for word in words}) != len(words)


class Parameter(Model):
    """All facts of the database about one parameter."""

    id: ParameterId
    name: str
    scope: Scope = "global"
    numbers: Numbers | None = None
    instances: Instances | None = None
    """Only where they differ from those of the scope; ``1.3`` is a part of instance 1 (spindle 1, gear 3)."""
    each: str | None = None
    """What one instance is called if that is not the scope's own label: ``Macro call {i}``, ``Gear {j}``.

    ``{i}`` is the instance, or the text before its point, ``{j}`` the text behind it.
    """
    layouts: tuple[Layout, ...] | None = None
    """Instead of scope, numbers and instances where they depend on the machine type."""
    type: ValueType
    quantity: Quantity = ""
    unit: Unit | None = None
    """Fixes the unit where the quantity alone leaves it open (``ms``, ``s``; ``counts``)."""
    bare: str | None = None
    """What a number without a unit is: ``teeth``, ``blocks``, ``a ratio``;
    or that the manual prints no unit for it."""
    decimals: int | None = None
    ranges: Ranges | None = None
    range_variants: tuple[RangeVariant, ...] = ()
    choices: Choices | None = None
    more_codes: bool = False
    """The control has codes that the manual does not print: any code may be given, as ``raw:<code>``."""
    bits: Bits | None = None
    first_axis: int | None = None
    """Of a word by axes: the place of the axis that bit 0 is of (0 for the first), and so on;
    None for any other word.

    A file speaks only for the bits of the axes that it has: those of others stay as the control has them.
    """
    default: Default | None = None
    storage: Storage | None = None
    program: tuple[str, ...] = ()
    """Commands by which programs of the control set it too, in the form of ``storage.command``;
    all of them with the same value.

    They are read from a program and changed in it, and never sent.
    """
    angular_when: str | None = None
    """Instead of the family's: the condition under which its length is
    in degrees (a lead is one on a spindle too)."""
    states: tuple[StateRule, ...] = ()
    effect: Effect | None = None
    access: Literal["read-write", "read"] = "read-write"
    """``read``: the control writes it and a person can only look at it; no value of a file."""
    tunable: bool = False
    """Can be changed on line, at the running machine."""
    patchable: bool = False
    """Is in the table of values that can be keyed in at the control."""
    optional: bool = False
    """A file is complete without it: a table an operator fills as he goes (tool offsets),
    a filter that is not used."""
    in_signature: bool = True
    """False for what was added when files and controls out there had the family's signature already:
    it stays as it is."""
    secret: bool = False
    """A password or the like: shown, printed, compared and exported in clear only where a person asks for
    it."""
    needs: tuple[Need, ...] = ()
    formulas: tuple[str, ...] = ()
    """Names of the family's published formulas that give its value or use it."""
    help: Help
    page: Page
    pages: dict[str, Page] = {}
    """Instance, or the text before its point -> its page, where the manual has another section for it."""
    errata: tuple[str, ...] = ()

    @property
    def word_width(self) -> int | None:
        """Bits of a word in the build that has most of them; None where the width is not known."""
        width = self.storage.bits if self.storage else None
        # A build with more outputs has a wider word, under the same number.
        return width and max(width, *(b.bit + b.width for b in self.bits or () if b.needs), 0)

    @property
    def scopes(self) -> tuple[Scope, ...]:
        """Every scope it has on some machine type."""
        return (self.scope,) if self.layouts is None else tuple(layout.scope for layout in self.layouts)

    def __post_init__(self) -> None:
        # What shows choices and bits masks nothing.
        if self.secret and self.type not in ("integer", "real", "text"):
            raise ValueError("a secret is a number or a text")
        if self.first_axis is not None and self.type != "bits":
            raise ValueError("first_axis belongs to a word of bits")
        self._check_choices(self.choices or ())

    def _check_choices(self, choices: tuple[Choice, ...]) -> None:
        """Raise ValueError for missing or ambiguous choices, and for a default that is no choice."""
        keys = {choice.key for choice in choices}
        if self.type == "choice" and not choices:
            raise ValueError("a choice parameter needs choices")
        if self.type == "boolean":
            if len(choices) != 2:
                raise ValueError("a yes/no parameter needs its two choices, with keys 'yes' and 'no'")
            if keys != {"yes", "no"}:
                raise ValueError("the choices of a yes/no parameter have the keys 'yes' and 'no'")
        if shared := next(filter(partial(_is_shared, choices), ("key", "label", "code")), ""):
            raise ValueError(f"two choices share a {shared}")
        if isinstance(self.default, Default) and choices:
            self.default.check_choices(keys)
