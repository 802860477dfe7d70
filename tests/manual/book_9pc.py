"""The printed 9/PC manual beside the database: which parameter a printed fact speaks of, and how both are compared."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from manual_facts import PrintedNumber, Section, StoredRow, read
from pydantic import TypeAdapter
from ruamel.yaml import YAML

from amp_studio.schema import Parameter, Schema, unit_named

FACTS = Path(__file__).with_name("9pc.yaml")
EXEMPTIONS = Path(__file__).with_name("exceptions_9pc.yaml")
PATCH_PAGE = "37-3"


@dataclass(frozen=True)
class Disagreement:
    """One place where manual and database say different things."""

    check: str
    line: int
    """Line of the manual's text; 0 where the database says something that is printed nowhere."""
    about: str
    """A parameter's number or id."""
    section: str
    manual: str
    database: str

    def __str__(self) -> str:
        where = f"line {self.line}, {self.section}" if self.line else self.section
        return f"{self.check}: {self.about} ({where}): manual {self.manual}; database {self.database}"


@dataclass(frozen=True)
class Claim:
    """An instance of a parameter that claims a number, on these machine types."""

    parameter: str
    instance: str
    machines: frozenset[str]


@dataclass(frozen=True)
class Home:
    """A parameter in the section that describes it, with the names of the rows its numbers stand in."""

    parameter: Parameter
    rows: tuple[str, ...]
    numbers: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Book:
    """The facts of the manual and the database they are held against."""

    schema: Schema
    sections: tuple[Section, ...]

    @property
    def claims(self) -> dict[str, tuple[Claim, ...]]:
        """Number -> the instances that claim it."""
        return claims_of(self.schema)

    @cached_property
    def described_in(self) -> dict[str, str]:
        """Number -> the kind of place that describes it: a table where there is one, else a screen, else a mention."""
        kinds = ("mention", "screen", "table")
        numbers = [n for section in self.sections for n in section.numbers]
        return {n.number: n.place for n in sorted(numbers, key=lambda n: kinds.index(n.place))}

    @cached_property
    def stored(self) -> tuple[StoredRow, ...]:
        """The rows of the Patch AMP table."""
        return tuple(row for section in self.sections for row in section.stored)

    def name(self, claim: Claim) -> str:
        return self.schema.parameters[claim.parameter].name

    def page(self, claim: Claim) -> str:
        return self.schema.page((claim.parameter, claim.instance))

    def at_home(self, section: Section, number: PrintedNumber) -> tuple[Claim, ...]:
        """Return the claims that a printed number belongs to: those of this page, else those of this name."""
        claims = [c for c in self.claims.get(number.number, ()) if fits(number, c)]
        here = [c for c in claims if self.page(c) in pages(section)]
        named = (
            c for c in claims if same_name(self.name(c), *headings(section), number.name, instance=c.instance)
        )
        return tuple(here or named)

    def homes(self, section: Section) -> tuple[Home, ...]:
        """Return the parameters a section describes."""
        found: dict[str, list[PrintedNumber]] = {}
        for number in section.numbers:
            claims = {"table": self.at_home(section, number), "screen": self.claims.get(number.number, ())}
            for claim in claims.get(number.place, ()):
                found.setdefault(claim.parameter, []).append(number)
        if not section.numbers:
            for parameter in self.schema.parameters.values():
                if parameter.page == section.page and same_name(parameter.name, section.heading):
                    found[parameter.id] = []
        return tuple(
            Home(
                self.schema.parameters[key],
                tuple(dict.fromkeys(number.name for number in numbers)),
                tuple(dict.fromkeys(number.number for number in numbers)),
            )
            for key, numbers in found.items()
        )

    def explained(
        self, parameter: Parameter, page: str, said: Iterable[str], held: Iterable[object] = ()
    ) -> bool:
        """Tell whether an erratum names all that is printed on a page, and takes what is held, not that."""
        said, held = tuple(said), tuple(map(str, held))
        return bool(said) and any(
            all(mentions(reading.says, one) for one in said)
            and all(mentions(erratum.taken, one) for one in held)
            and not (held and all(mentions(erratum.taken, one) for one in said))
            for erratum in (self.schema.errata[key] for key in parameter.errata)
            for reading in erratum.readings
            if page in re.findall(r"\w+(?:[-.]\d+)*", reading.page)
        )


@cache
def printed() -> tuple[Section, ...]:
    """Return the facts of the manual."""
    return read(FACTS)


@cache
def claims_of(schema: Schema) -> dict[str, tuple[Claim, ...]]:
    """Return number -> the instances that claim it, and on which machine types."""
    found: dict[str, dict[tuple[str, str], set[str]]] = {}
    for machine in schema.family.machines:
        for parameter in schema.parameters.values():
            for instance, number in schema.numbers(parameter, machine.key).items():
                found.setdefault(number, {}).setdefault((parameter.id, instance), set()).add(machine.key)
    return {
        number: tuple(Claim(*address, frozenset(machines)) for address, machines in claims.items())
        for number, claims in found.items()
    }


def headings(section: Section) -> tuple[str, ...]:
    """Return the headings a section stands under."""
    return (section.heading, section.within) if section.within else (section.heading,)


def pages(section: Section) -> tuple[str, ...]:
    """Return the pages its headings are on."""
    return (section.page, section.within_page) if section.within else (section.page,)


# -- names ------------------------------------------------------------------------------------------------

WORDS = {"max": "maximum", "min": "minimum", "acc": "acceleration", "dev": "deviation", "dir": "direction",
         "one": "1", "two": "2", "three": "3", "four": "4", "five": "5", "six": "6", "seven": "7", "eight": "8"}  # fmt: skip
COUNTING = re.compile(
    r"(?:\d+|st|nd|rd|th|to|and|or|for|gears?|spindles?|spn|skip|set|mill|only|that|g|p|#)*"
)
"""What a heading or a row says beyond the name when one parameter has many instances."""


def squashed(text: str) -> str:
    """Return letters, digits and signs only: a scan loses blanks and adds them."""
    return re.sub(r"[^a-z0-9.<>$+%#]|(?<!\d)\.|\.(?!\d)", "", text.lower())


def spelled(text: str) -> str:
    """Return a name with its usual short forms spelled out, squashed."""
    words = re.findall(r"[a-z]+|[^a-z]+", text.lower())
    return squashed("".join(WORDS.get(word, word) for word in words))


def same_name(name: str, *labels: str, instance: str = "") -> bool:
    """Tell whether a name is one of the labels; a label may count instances, or say which one it is."""
    own, uncounted = spelled(name), spelled(re.sub(r"\d+ ?(?:-|to) ?\d+", "", name))
    for label in filter(None, labels):
        said = spelled(label)
        if said == own or (own and said.startswith(own) and COUNTING.fullmatch(said[len(own) :])):
            return True
        if (
            instance
            and spelled(re.sub(rf"\b0*{re.escape(last(instance))}\b", "", label, count=1)) == uncounted
        ):
            return True
    return False


def last(instance: str) -> str:
    """Return what tells an instance from its sisters: the gear of ``1.3``."""
    return instance.rpartition(".")[2]


def words_of(text: str) -> set[str]:
    """Return the words and the numbers of a label, a number that is written as a word too."""
    words = (WORDS.get(word, word) for word in re.findall(r"[a-z]+|\d+", text.lower()))
    return {str(int(word)) if word.isdigit() else word for word in words}


def fits(number: PrintedNumber, claim: Claim) -> bool:
    """Tell whether the row and the column of a number are those of an instance."""
    if number.machine and number.machine not in claim.machines:
        return False
    whole, _, part = claim.instance.partition(".")
    if number.process.startswith("process"):
        return claim.instance == number.process[-1] and not number.axis.isdigit()
    if part:
        said = [number.axis or number.spindle, *re.findall(r"\d+", number.name)]
        return said[-1] == part and {*said[:-1]} <= {"", whole}
    if number.axis.isdigit() or number.spindle:
        return whole == (number.axis or number.spindle)
    if number.pair:
        return not claim.instance or whole in words_of(number.pair)
    if number.name and claim.instance:
        return whole.lower() in words_of(number.name)
    return not (number.axis == "All" and claim.instance)


# -- figures ----------------------------------------------------------------------------------------------

UNITS = {
    "volts dc": "V",
    "threads": "",
    "thread leads": "",
    "gears": "",
    "teeth": "",
    "RPM": "rpm",
    "mm/m": "mm/min",
}


def unit_of(said: str) -> str:
    """Return the schema's unit for a printed one."""
    return UNITS[said] if said in UNITS else unit_named(said)


def figures(text: str) -> set[float]:
    """Return the numbers in a text."""
    return {float(n.replace(",", "")) for n in re.findall(r"(?<![\d.])-?\d[\d,]*(?:\.\d+)?", text)}


def mentions(text: str, said: str) -> bool:
    """Tell whether a text names a printed figure, or else the printed words one after the other."""
    try:
        return float(said) in figures(text)
    except ValueError:
        words = map(re.escape, re.findall(r"[a-z0-9]+", said.lower()))
        return re.search(rf"(?<![a-z0-9]){'[^a-z0-9]*'.join(words)}(?![a-z0-9])", text.lower()) is not None


# -- exceptions -------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Exempt:
    """A place of the manual that no rule can judge, and why; it must be needed on every line of its span."""

    check: str
    lines: str
    """``1754``, or ``1754-1761``; ``0`` where the database says something that is printed nowhere."""
    about: tuple[str, ...] = ()
    """What it is about, where the lines alone do not tell it."""
    why: str

    @property
    def span(self) -> range:
        first, _, last = self.lines.partition("-")
        return range(int(first), int(last or first) + 1)

    def needed_for(self) -> Iterator[tuple[int, str]]:
        """Yield every line and subject that must have a disagreement."""
        yield from ((line, about) for line in self.span for about in self.about or ("",))

    def covers(self, found: Disagreement) -> bool:
        """Tell whether a disagreement is excused."""
        return (
            found.check == self.check
            and found.line in self.span
            and (not self.about or found.about in self.about)
        )


def exemptions(path: Path = EXEMPTIONS) -> tuple[Exempt, ...]:
    """Return the hand-kept list."""
    return TypeAdapter(tuple[Exempt, ...]).validate_python(
        YAML(typ="safe").load(path.read_text("utf-8")) or ()
    )


def unsettled(check: str, found: Iterable[Disagreement], exempt: Iterable[Exempt]) -> list[str]:
    """Return the disagreements no exception covers, and the exceptions that are not needed any more."""
    found, exempt = list(found), [e for e in exempt if e.check == check]
    open_ones = [str(one) for one in found if not any(e.covers(one) for e in exempt)]
    return open_ones + [
        f"{check}: the exception for line {line} {about}".rstrip() + " is not needed any more"
        for e in exempt
        for line, about in e.needed_for()
        if not any(e.covers(one) and one.line == line and about in {"", one.about} for one in found)
    ]
