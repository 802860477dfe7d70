"""What a rule is: a constraint between parameters, its fix, and a builder's own rules and suppressions."""

import re
from typing import Annotated, Literal

from .record import First, Model, NotEmpty, Page, Pattern, Then

Severity = Literal["error", "warning", "advice"]


class Assignment(Model):
    """A value for one of the parameters that a rule reads, as a CEL expression over the rule's names."""

    set: str
    """The name, out of ``reads``, of the parameter."""
    value: str


class Fix(Assignment):
    """A suggested fix: the parameter's new value."""

    safe: bool = False
    """Cannot change motion."""


def _each_name(names: object, _family: object) -> object:
    if isinstance(names, (list, tuple)) and all(isinstance(name, str) for name in names):
        return dict.fromkeys(names, "true")
    if isinstance(names, dict):
        return {name: text for several, text in names.items() for name in str(several).split(", ")}
    return names


Blamed = Annotated[dict[str, str], First(_each_name, also=tuple[str, ...])]
"""Names, each with the condition in CEL under which it is one; a list of names for always."""


def _names(reads: dict[str, str]) -> dict[str, str]:
    for name in reads:
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
            raise ValueError(f"{name!r} is not a name")
    return reads


class Rule(Model):
    """A constraint between parameters, in CEL.

    ``reads`` binds short names to parameters of the instance at hand: ``id`` the same instance, ``id@*`` the
    list over all instances, ``id@<`` and ``id@>`` those before and after, ``id@.`` the parts of the same
    instance (the gears of its spindle), ``id@3`` one of them, and a plain ``id`` of global scope wherever it
    is used. Numbers arrive in the quantity's canonical unit.
    """

    id: Annotated[str, Pattern(r"^[a-z0-9]+(\.[a-z0-9-]+)+$")]
    title: str
    severity: Severity
    reads: Annotated[dict[str, str], Then(_names)]
    optional: tuple[str, ...] = ()
    """Names that may be not set or inactive: they arrive as null then."""
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
    """What the control really uses while the rule is broken: it corrects,
    clamps or forces the value silently."""
    blames: Blamed = {}
    """Names of what is wrong, worst first, each with the condition in CEL under which it is;
    a list of names for always.

    Left out: what ``effective`` replaces, else the first of ``reads``. ``it`` is the value at hand,
    ``at`` its position in a list.
    """
    compares: Blamed = {}
    """The same for what it is compared with. All other single values it names follow,
    unless ``blames`` names them."""
    page: Page | Literal[""] = ""
    """The page of the manual that states it."""
    reason: str = ""
    """Why it is so, of a rule that no manual states: each rule has either this or a page."""

    @property
    def source(self) -> str:
        """The page, or why a rule is so that no manual states."""
        return self.page or f"not from the manual: {self.reason.rstrip('.')}"

    @property
    def cited(self) -> str:
        """The source in words."""
        return f"page {self.page}" if self.page else self.source

    def __post_init__(self) -> None:
        if bool(self.page) == bool(self.reason):
            raise ValueError("a rule has either the page that states it or the reason why it is so")


class Rules(Model):
    """A file of ``rules/``."""

    rules: tuple[Rule, ...]


class BuilderRule(Rule):
    """A rule of a machine builder: it comes from no page of a manual."""

    family: str = ""
    """The control family it is for, where files of several lie side by side."""
    page: str = ""
    """Where it is written, in the builder's own words."""

    @property
    def source(self) -> str:
        """Where it is written, and why; empty where the builder gives neither."""
        return "; ".join(filter(None, (self.page, self.reason)))

    @property
    def cited(self) -> str:
        """The source in words; empty where the builder gives none."""
        return self.source

    def __post_init__(self) -> None:
        """A builder's rule needs no source."""


class Suppression(Model):
    """Findings that a builder has checked and leaves as they are."""

    rule: str
    params: tuple[str, ...] = ()
    """The parameters that the finding is about, by number or id; an id without instance is any,
    none at all whatever."""
    reason: Annotated[str, NotEmpty()]
    by: Annotated[str, NotEmpty()]
