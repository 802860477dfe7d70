"""How the code of a control family is found: one record a family,
whose parts are loaded when they are asked for.

Facts are data and need no record. What a family does differently is code in ``amp_studio/families`` or in
another package, which imports the rooms below it; they find it by name alone
(``amp_studio/family_places.py``), so that no room names a family and a start loads nothing of one that is not
used. ``register`` adds one more to this process: that of a test.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.family_places import installed_places, own_places

if TYPE_CHECKING:
    from .model import Family

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Registration:
    """What one family brings in code. Parts are named ``module:NAME``; each may be missing.

    ``formulas``  a mapping of names to functions: the published formulas, for rules and calculators
    ``formats``   the text formats (``TextFormat``) the family alone has, in the order in which they are tried
                  on a text
    ``drivers``   protocol name -> a ``DriverFactory``: ways to speak to a control, the usual one first
    ``contents``  first line of what a control contains -> the ``ContentKind`` class that reads it
    ``emulators`` protocol name -> an ``Emulate``: an emulated control that speaks it
    ``recognised``  a ``Recognised`` (transfer/driver.py): how its controls are known where their family
                    is not named
    ``law``       the servo law (``Law``) of its axes, for the simulator
    ``sheet``     how values are keyed in at its controls (``Keying``); without it the plain way
    ``curve``     how a compensation table that is one text is read and written (``CurveText`` of the room
                  pictures)
    ``compensation``  what it has against the errors of an axis, and what is tuned at the machine
                      (``Compensation``)
    ``describe``  description of a control -> its schema (``described``), for a family whose controls describe
                  themselves
    ``migrate``   a machine description and answers -> what a control of the family gets (``WrittenMachine``
                  of the room meaning)
    ``facts``     the folder of its facts; None where it is ``parameter_db/<family>``
    """

    family: str
    formulas: str = ""
    formats: tuple[str, ...] = ()
    drivers: Mapping[str, str] = field(default_factory=dict)
    contents: Mapping[str, str] = field(default_factory=dict)
    emulators: Mapping[str, str] = field(default_factory=dict)
    recognised: str = ""
    law: str = ""
    sheet: str = ""
    curve: str = ""
    compensation: str = ""
    describe: str = ""
    migrate: str = ""
    facts: Path | None = None


_added: dict[str, Registration] = {}


def register(registration: Registration) -> None:
    """Make one more family known, or put another record in the place of the one there is."""
    _added[registration.family] = registration


def unregister(family: str) -> None:
    """Forget a family that ``register`` has made known; what was loaded of it stays loaded."""
    _added.pop(family, None)


def registered_families() -> tuple[str, ...]:
    """Return the families that have a record, those of the program first."""
    return tuple(dict.fromkeys((*own_places(), *_installed(), *_added)))


def registration_of(family: str) -> Registration:
    """Return a family's record; one without parts for a family that is facts alone."""
    # Of this process first: a test may put its own record in the place of the program's.
    if family in _added:
        return _added[family]
    if place := own_places().get(family):
        found = load_part(place)
        assert isinstance(found, Registration)
        return found
    return _installed().get(family, Registration(family))


@cache
def _installed() -> dict[str, Registration]:
    """Return the records of other packages. One that cannot be loaded is reported and left out,
    so the others work.
    """
    records = {}
    for family, place in installed_places().items():
        try:
            found = load_part(place)
            if not isinstance(found, Registration) or found.family != family:
                raise TypeError(f"{place} is no Registration of {family}")
        except Exception as error:  # code of another package raises what it will
            _log.warning("The family %s of another package cannot be used: %s", family, error)
            continue
        records[family] = found
    return records


def why_not_simulated(family: Family) -> str:
    """Return why no axis of a family can be simulated, and what there is instead; "" where axes can."""
    if registration_of(family.family).law:
        return ""
    return f"{family.name} has no simulation: {family.without_motion or 'no law of its servo axes is known'}."


def added_facts() -> dict[str, Path]:
    """Return family -> folder of facts, of those that have theirs elsewhere than in ``parameter_db``."""
    records = {**_installed(), **_added}
    return {family: record.facts for family, record in records.items() if record.facts is not None}


@cache
def load_part(place: str) -> Any:
    """Return the object ``module:NAME``; raises ImportError, AttributeError for a place that is none."""
    module, _, name = place.partition(":")
    return attrgetter(name)(import_module(module))
