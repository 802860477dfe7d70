"""The words the parameter database is written in.

Every YAML file under ``parameter_db`` is read into these models, and into
nothing else: what a family can say is exactly what stands here. A model
forbids unknown keys, so a typing error in a fact cannot hide.

``docs/schema.md`` explains the same words to somebody who writes YAML.
"""

from __future__ import annotations

import re
from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    field_validator,
    model_validator,
)

from .units import UNITS

ParameterId = Annotated[str, Field(pattern=r"^[a-z0-9_]+(\.[a-z0-9_]+)+$")]
Key = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_.+-]*$")]
Page = Annotated[str, Field(pattern=r"^[0-9A-Z]+(-[0-9]+)?(\.[0-9]+)*([a-z])?$")]


def _known_unit(unit: str) -> str:
    if unit not in UNITS:
        raise ValueError(f"'{unit}' is no unit: {', '.join(u for u in UNITS if u)}")
    return unit


Unit = Annotated[str, AfterValidator(_known_unit)]


def _counted_out(instances: object) -> object:
    """Write out the spans of a list of instances: ``["1..400"]`` are 400 of them, ``["X.0..9"]`` ten parts of X."""
    if not isinstance(instances, list):
        return instances
    found: list[object] = []
    for name in instances:
        span = re.fullmatch(r"(.+\.)?(\d+)\.\.(\d+)", name) if isinstance(name, str) else None
        if span:
            found += [f"{span[1] or ''}{n}" for n in range(int(span[2]), int(span[3]) + 1)]
        else:
            found.append(name)
    return found


Instances = Annotated[tuple[str, ...], BeforeValidator(_counted_out)]

Scope = Literal["global", "axis", "spindle", "process", "group", "word", "register"]
ValueType = Literal["integer", "real", "choice", "boolean", "bits", "text", "format"]
State = Literal["in-force", "ignored", "unusable", "hidden"]
Severity = Literal["error", "warning", "advice"]
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


class Model(BaseModel):
    """A frozen record that refuses keys it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class BoundRef(Model):
    """A bound that is the value of another parameter of the same instance."""

    param: ParameterId


Bound = float | BoundRef | None
Range = tuple[Bound, Bound]


class RangeVariant(Model):
    """Ranges that hold instead of the plain ones while a condition is true."""

    when: str
    ranges: dict[Unit, Range]


class Choice(Model):
    """One of the fixed values of a choice or a yes/no parameter."""

    key: Key
    label: str
    code: str | None = None
    """The letter the manual prints before the choice; the order of the letters is not that of the codes."""
    raw: int | None = None
    """What the control stores; None where no code is printed."""
    note: str | None = None


class Bit(Model):
    """One bit, or a field of several bits, of a packed word."""

    bit: int
    width: int = 1
    label: str
    choices: tuple[Choice, ...] | None = None
    signed: bool = False
    """A field of several bits that holds a number with its sign (two's complement)."""
    unknown: bool = False
    """The manual's figure is lost: the bit is kept and shown raw."""


class Storage(Model):
    """How the control itself holds the value."""

    unit: Unit | None = None
    decimals: int | None = None
    scale: float = 1.0
    """Stored number per unit of ``unit`` (65.536 for counts/s in a 1.25 ms scan)."""
    bits: int | None = None
    signed: bool = True
    notation: Literal["decimal", "hex", "binary", "ascii"] = "decimal"
    words: int = 1
    word_order: Literal["high-first", "low-first"] = "high-first"
    code: int | None = None
    """The control's own code of the type of word, which its files name (NUM: 6 for 32 bits in hexadecimal)."""
    command: str | None = None
    """The command that sets it: ``{i}`` is the instance, ``{n}`` its place from 0, ``{v}`` the value, ``{other.id}`` that of another.

    A command of several values stands the same at each of them: ``NOTCH {i}({notch.frequency}, {notch.width})``.
    """


class Numbers(Model):
    """By which numbers people and controls address the instances of a parameter.

    Instance number k (counting from 0) has number ``start + k * step`` written
    through ``format``; ``listed`` names instances one by one instead, and ``starts``
    gives the first number of each array of parts.
    """

    start: int | None = None
    step: int = 0
    format: str = "{n}"
    """``{n}`` is the number, ``{i}`` the instance (``P21N{i}``, ``Pr{n}``, ``R{n}``)."""
    listed: dict[str, str] | None = None
    starts: dict[str, int] | None = None
    """What stands before the point of an instance -> number of its part 0; the parts follow ``step`` by ``step``."""
    disputed: bool = False
    """The manual prints this number for another parameter too, and that other one is right."""

    @model_validator(mode="after")
    def _one_way(self) -> Numbers:
        ways = [self.start, self.listed, self.starts]
        if ways.count(None) == len(ways) and "{n}" in self.format:
            raise ValueError("numbers need 'start', 'listed', 'starts' or a format without {n}")
        try:
            self.format.format(n=0, i="")
        except (LookupError, ValueError):
            raise ValueError(
                f"the format {self.format!r} may hold {{n}} and {{i}} and nothing else in braces"
            ) from None
        return self


class Layout(Model):
    """Scope, instances and numbers of a parameter on some machine types (mill against lathe)."""

    machines: tuple[str, ...] | None = None
    scope: Scope
    instances: Instances | None = None
    """Only where they differ from those of the scope in the family (``("0", …, "31")`` for 32 words)."""
    numbers: Numbers | None = None
    """None for a field that has no number at all."""


class StateRule(Model):
    """Puts a parameter out of force while a named condition of the family holds."""

    state: Literal["ignored", "unusable", "hidden"]
    when: str | None = None
    unless: str | None = None
    page: Page | None = None

    @model_validator(mode="after")
    def _one_condition(self) -> StateRule:
        if (self.when is None) == (self.unless is None):
            raise ValueError("a state takes either 'when' or 'unless'")
        return self


class Effect(Model):
    """When a change takes effect."""

    level: Literal["at-once", "reset", "restart", "command", "unknown"]
    """``unknown`` where the manual does not say."""
    command: str | None = None
    """The command that makes the device read the value (level ``command``)."""


class Help(Model):
    """The parameter in our own words; ``find`` and ``wrong`` may be empty for a plain choice."""

    what: str
    find: str = ""
    wrong: str = ""
    related: tuple[ParameterId, ...] = ()


class Default(Model):
    """A printed default, and where it stands."""

    value: float | bool | str
    """A number in ``unit``, a choice key, or a text."""
    unit: Unit = ""
    page: Page
    instances: dict[str, float | bool | str] | None = None
    """Instances whose default differs from ``value``."""


class Need(Model):
    """An option, a piece of hardware or a software release without which a parameter does nothing."""

    what: str
    page: Page


class Parameter(Model):
    """Everything the database says about one parameter."""

    id: ParameterId
    name: str
    scope: Scope = "global"
    numbers: Numbers | None = None
    instances: Instances | None = None
    """Only where they differ from those of the scope; ``1.3`` is a part of instance 1 (spindle 1, gear 3)."""
    each: str | None = None
    """What one instance is called where that is not the scope's own label: ``Macro call {i}``, ``Gear {j}``.

    ``{i}`` is the instance, or what stands before its point, ``{j}`` what stands behind it.
    """
    layouts: tuple[Layout, ...] | None = None
    """Instead of scope, numbers and instances where they depend on the machine type."""
    type: ValueType
    quantity: Quantity = ""
    unit: Unit | None = None
    """Fixes the unit where the quantity alone leaves it open (``ms``, ``s``; ``counts``)."""
    decimals: int | None = None
    ranges: dict[Unit, Range] | None = None
    range_variants: tuple[RangeVariant, ...] = ()
    choices: tuple[Choice, ...] | None = None
    more_codes: bool = False
    """The control has codes that the manual does not print: any code may stand, as ``raw:<code>``."""
    bits: tuple[Bit, ...] | None = None
    default: Default | None = None
    storage: Storage | None = None
    states: tuple[StateRule, ...] = ()
    effect: Effect | None = None
    access: Literal["read-write", "read"] = "read-write"
    """``read``: the control writes it and a person can only look at it; no value of a file."""
    tunable: bool = False
    """Can be changed on line, at the running machine."""
    patchable: bool = False
    """Stands in the table of values that can be keyed in at the control."""
    optional: bool = False
    """A file is complete without it: a table an operator fills as he goes (tool offsets), a filter that is not used."""
    secret: bool = False
    """A password or the like: shown, printed, compared and exported in clear only where a person asks for it."""
    needs: tuple[Need, ...] = ()
    formulas: tuple[str, ...] = ()
    """Names of the family's published formulas that give its value or use it."""
    help: Help
    page: Page
    pages: dict[str, Page] = {}
    """Instance, or what stands before its point -> its page, where the manual has another section for it."""
    errata: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _whole(self) -> Parameter:
        if self.secret and self.type not in ("integer", "real", "text"):
            raise ValueError("a secret is a number or a text")  # what shows choices and bits masks nothing
        if self.type == "choice" and not self.choices:
            raise ValueError("a choice parameter needs choices")
        if self.type == "boolean" and (not self.choices or len(self.choices) != 2):
            raise ValueError("a yes/no parameter needs its two choices, with keys 'yes' and 'no'")
        if self.choices:
            for field in ("key", "label", "code"):
                said = [str(getattr(c, field)) for c in self.choices if getattr(c, field) is not None]
                seen = [
                    " ".join(word.casefold().split()) for word in said
                ]  # as read_value compares a person's word
                if len(set(seen)) != len(seen):
                    raise ValueError(f"two choices share a {field}")
        if self.type == "boolean" and {c.key for c in self.choices or ()} != {"yes", "no"}:
            raise ValueError("the choices of a yes/no parameter have the keys 'yes' and 'no'")
        if isinstance(self.default, Default) and self.choices:
            keys = {c.key for c in self.choices}
            for value in (self.default.value, *(self.default.instances or {}).values()):
                if value not in keys:
                    raise ValueError(f"default {value!r} is none of its choices")
        return self


class Group(Model):
    """One file of ``groups/``: the parameters of a group in the manual's order."""

    key: Key
    name: str
    section: str = ""
    """The part of a long group that stands in this file (``Position Loop Parameters``)."""
    chapter: str
    parameters: tuple[Parameter, ...]


class Condition(Model):
    """A named condition on the values of one machine, in CEL."""

    reads: dict[str, str] = {}
    when: str
    why: str
    """What a person is told when the condition puts a parameter out of force."""
    page: Page | None = None


class ScopeInfo(Model):
    """The instances a scope has in this family."""

    instances: Instances
    label: str
    """``Axis {i}``."""
    of: Scope | None = None
    """The scope whose instances these are parts of: register ``X.3`` belongs to axis ``X``, and reads what is its."""


class Machine(Model):
    """A machine type the family can be told to be."""

    key: Key
    name: str


class AxisProfile(Model):
    """Which parameters the axis operations of the files room act on."""

    name: ParameterId
    type: ParameterId
    unfitted: Key | None = None
    """Type of an axis that is not there; None where no type says so, and ``fitted_by`` does."""
    fitted_by: ParameterId | None = None
    """A number that is 0 for an axis that is not there (its port), where that is no matter of the type."""
    usual_type: Key
    """Type of an axis that is only named."""
    types: dict[str, Key] = {}
    """Types that go with a name (``S`` with spindle)."""
    hardware: ParameterId | None = None
    loop: ParameterId | None = None

    @model_validator(mode="after")
    def _one_way(self) -> AxisProfile:
        if (self.unfitted is None) == (self.fitted_by is None):
            raise ValueError(
                "an axis is left out either by its type ('unfitted') or by a number ('fitted_by')"
            )
        return self


class Family(Model):
    """``family.yaml``: identity, scopes, units and the order of the groups."""

    family: Key
    name: str
    document: str
    title: str
    applications: tuple[str, ...] = ()
    machines: tuple[Machine, ...]
    default_machine: Key
    machine_parameter: ParameterId | None = None
    """The parameter whose choice keys are the machine types, where there is one."""
    revisions: tuple[str, ...] = ()
    scopes: dict[Scope, ScopeInfo]
    units: dict[str, dict[str, Unit]]
    """Per unit system (``metric``, ``inch``) the unit of each quantity."""
    unit_parameter: ParameterId | None = None
    """The parameter whose choice keys are the unit systems, where the control keeps bare figures in the chosen one."""
    angular_when: str | None = None
    """Condition under which length-like quantities of an axis are entered in degrees."""
    axes: AxisProfile | None = None
    effect: Effect
    groups: tuple[str, ...]
    conditions: dict[str, Condition] = {}


class Assignment(Model):
    """A value for one of the parameters that a rule reads, as a CEL expression over the rule's names."""

    set: str
    """The name, out of ``reads``, of the parameter."""
    value: str


class Fix(Assignment):
    """A repair: the parameter's new value."""

    safe: bool = False
    """Cannot change motion."""


class Rule(Model):
    """A constraint between parameters, in CEL.

    ``reads`` binds short names to parameters of the instance at hand:
    ``id`` the same instance, ``id@*`` the list over all instances, ``id@<`` and
    ``id@>`` those before and after, ``id@.`` the parts of the same instance (the gears
    of its spindle), ``id@3`` one of them, and a plain ``id`` of global scope wherever
    it stands. Numbers arrive in the quantity's canonical unit.
    """

    id: Annotated[str, Field(pattern=r"^[a-z0-9]+(\.[a-z0-9-]+)+$")]
    title: str
    severity: Severity
    reads: dict[str, str]
    optional: tuple[str, ...] = ()
    """Names that may be unset or out of force: they arrive as null then."""
    any_state: tuple[str, ...] = ()
    """Names whose value counts even where the parameter is ignored or unusable."""
    when: str = "true"
    check: str
    message: str
    """With ``{name}`` for the value of a read parameter, ``{instance}`` for the instance."""
    values: dict[str, str] = {}
    """Further names for the message, as CEL expressions."""
    units: dict[str, str] = {}
    """Unit of each of ``values`` that has one, in canonical units."""
    fix: tuple[Fix, ...] = ()
    effective: tuple[Assignment, ...] = ()
    """What the control really uses while the rule is broken: it corrects, clamps or forces the value silently."""
    blames: dict[str, str] = {}
    """Names of what is wrong, worst first, each with the condition in CEL under which it is; a list of names for always.

    Left out: what ``effective`` replaces, else the first of ``reads``. ``it`` is the value at hand, ``at`` its position in a list.
    """
    compares: dict[str, str] = {}
    """The same for what it is compared with. All other single values it speaks of follow, unless ``blames`` names them."""
    page: Page

    @property
    def cited(self) -> str:
        """Where it stands, as a sentence says it."""
        return f"page {self.page}"

    @field_validator("blames", "compares", mode="before")
    @classmethod
    def _each_name(cls, names: object) -> object:
        if isinstance(names, (list, tuple)) and all(isinstance(name, str) for name in names):
            return dict.fromkeys(names, "true")
        if isinstance(names, dict):
            return {name: text for several, text in names.items() for name in str(several).split(", ")}
        return names

    @field_validator("reads")
    @classmethod
    def _names(cls, reads: dict[str, str]) -> dict[str, str]:
        for name in reads:
            if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
                raise ValueError(f"{name!r} is not a name")
        return reads


class Rules(Model):
    """A file of ``rules/``."""

    rules: tuple[Rule, ...]


class BuilderRule(Rule):
    """A rule of a machine builder: no page of a manual stands behind it."""

    family: str = ""
    """The control family it is for, where files of several lie side by side."""
    page: str = ""
    """Where it is written, in the builder's own words."""

    @property
    def cited(self) -> str:
        """Where it stands, as a sentence says it; empty where the builder does not say."""
        return self.page


class Suppression(Model):
    """Findings that a builder has looked at and leaves as they are."""

    rule: str
    params: tuple[str, ...] = ()
    """The parameters that the finding is about, by number or id; an id without instance is any, none at all whatever."""
    reason: Annotated[str, Field(min_length=1)]
    by: Annotated[str, Field(min_length=1)]


class Table(Model):
    """A printed table, in the order of the page: a head, and rows of texts and numbers below it."""

    id: str
    """As the manual numbers it (``7.B``), or a name of ours where it has no number."""
    title: str
    page: Page
    head: tuple[str, ...]
    units: tuple[str, ...] = ()
    """Unit of each column as printed, empty where it has none; left out where no column has one."""
    rows: tuple[tuple[str | float, ...], ...]
    params: tuple[ParameterId, ...] = ()
    """Parameters for whose values it is looked up."""
    note: str = ""

    @model_validator(mode="after")
    def _square(self) -> Table:
        if self.units and len(self.units) != len(self.head):
            raise ValueError(f"{len(self.head)} columns and {len(self.units)} units")
        for n, row in enumerate(self.rows, 1):
            if len(row) != len(self.head):
                raise ValueError(f"row {n} has {len(row)} cells below {len(self.head)} columns")
        return self

    def column(self, name: str) -> tuple[str | float, ...] | None:
        """Return the cells below a name; a head may hold several of them (``B410G, B410J``)."""
        for n, head in enumerate(self.head):
            if name in head.split(", "):
                return tuple(row[n] for row in self.rows)
        return None


class Tables(Model):
    """A file of ``tables/``."""

    tables: tuple[Table, ...]


class GuideStep(Model):
    """One step of a guide: what to set, in this order."""

    title: str
    what: str = ""
    params: tuple[ParameterId, ...]
    page: Page


class Guide(Model):
    """A path through the parameters in the order in which a machine is fitted."""

    id: Key
    title: str
    page: Page
    steps: tuple[GuideStep, ...]


class Guides(Model):
    """A file of ``guides/``."""

    guides: tuple[Guide, ...]


class Reading(Model):
    """What one place of the manual says."""

    page: str
    says: str


class Erratum(Model):
    """Where the manual contradicts itself, and what was decided."""

    id: Key
    params: tuple[ParameterId, ...]
    readings: tuple[Reading, ...]
    taken: str
    why: str


class Errata(Model):
    """A file of ``errata/``."""

    errata: tuple[Erratum, ...]
