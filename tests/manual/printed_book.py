"""A printed manual beside the database: who claims a printed number,
and whether a text names what is printed.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

from manual_facts import Section

from amp_studio.schema import Parameter, Schema


@dataclass(frozen=True)
class Claim:
    """An instance of a parameter that claims a number, on these machine types."""

    parameter: str
    instance: str
    machines: frozenset[str]


@dataclass(frozen=True, eq=False)
class Book:
    """The facts of a manual and the database they are compared with."""

    schema: Schema
    sections: tuple[Section, ...]

    @property
    def claims(self) -> dict[str, tuple[Claim, ...]]:
        """Number -> the instances that claim it."""
        return claims_of(self.schema)

    def explained(
        self, parameter: Parameter, page: str, message: Iterable[str], content: Iterable[object] = ()
    ) -> bool:
        """Return whether an erratum names all that is printed on a page,
        and takes what is in the database instead.
        """
        message, content = tuple(message), tuple(map(str, content))
        return bool(message) and any(
            all(mentions(reading.says, one) for one in message)
            and all(mentions(erratum.taken, one) for one in content)
            and not (content and all(mentions(erratum.taken, one) for one in message))
            for erratum in (self.schema.errata[key] for key in parameter.errata)
            for reading in erratum.readings
            if page in re.findall(r"\w+(?:[-.]\d+)*", reading.page)
        )


@cache
def claims_of(schema: Schema) -> dict[str, tuple[Claim, ...]]:
    """Return number -> the instances that claim it, and on which machine types."""
    found: dict[str, dict[tuple[str, str], set[str]]] = {}
    for machine in schema.family.machines:
        for parameter in schema.parameters.values():
            for instance, number in schema.on(machine.key).numbers(parameter).items():
                found.setdefault(number, {}).setdefault((parameter.id, instance), set()).add(machine.key)
    return {
        number: tuple(Claim(*address, frozenset(machines)) for address, machines in claims.items())
        for number, claims in found.items()
    }


# -- texts ------------------------------------------------------------------------------------------------


@cache
def squashed(text: str) -> str:
    """Return letters, digits and signs only: a scan loses blanks and adds them."""
    return re.sub(r"[^a-z0-9.<>$+%#]|(?<!\d)\.|\.(?!\d)", "", text.lower())


def figures(text: str) -> set[float]:
    """Return the numbers in a text."""
    return {float(n.replace(",", "")) for n in re.findall(r"(?<![\d.])-?\d[\d,]*(?:\.\d+)?", text)}


def mentions(text: str, message: str) -> bool:
    """Return whether a text names a printed figure, or else the printed words one after the other."""
    try:
        return float(message) in figures(text)
    except ValueError:
        words = map(re.escape, re.findall(r"[a-z0-9]+", message.lower()))
        return re.search(rf"(?<![a-z0-9]){'[^a-z0-9]*'.join(words)}(?![a-z0-9])", text.lower()) is not None
