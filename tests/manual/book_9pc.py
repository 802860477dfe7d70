"""The printed 9/PC manual beside the database: which parameter a printed fact is about."""

import re
from dataclasses import dataclass
from functools import cached_property

from manual_facts import PrintedNumber, Section, StoredRow
from printed_book import Book, Claim, squashed

from amp_studio.schema import Parameter, unit_named

PATCH_PAGE = "37-3"


@dataclass(frozen=True)
class Home:
    """A parameter in the section that describes it, with the names of the rows its numbers are in."""

    parameter: Parameter
    rows: tuple[str, ...]
    numbers: tuple[str, ...]


class Reference(Book):
    """The facts of the AMP reference manual and the database they are compared with."""

    @cached_property
    def described_in(self) -> dict[str, str]:
        """Number -> the kind of place that describes it: a table where there is one, else a screen,
        else a mention.
        """
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


def headings(section: Section) -> tuple[str, ...]:
    """Return the headings above a section."""
    return (section.heading, section.within) if section.within else (section.heading,)


def pages(section: Section) -> tuple[str, ...]:
    """Return the pages its headings are on."""
    return (section.page, section.within_page) if section.within else (section.page,)


# -- names ------------------------------------------------------------------------------------------------

WORDS = {
    "max": "maximum",
    "min": "minimum",
    "acc": "acceleration",
    "dev": "deviation",
    "dir": "direction",
    "one": "1",
    "two": "2",
    "three": "3",
    "four": "4",
    "five": "5",
    "six": "6",
    "seven": "7",
    "eight": "8",
}
COUNTING = re.compile(
    r"(?:\d+|st|nd|rd|th|to|and|or|for|gears?|spindles?|spn|skip|set|mill|only|that|g|p|#)*"
)
"""What a heading or a row has beyond the name when one parameter has many instances."""


def spelled(text: str) -> str:
    """Return a name with its usual short forms spelled out, squashed."""
    words = re.findall(r"[a-z]+|[^a-z]+", text.lower())
    return squashed("".join(WORDS.get(word, word) for word in words))


def same_name(name: str, *labels: str, instance: str = "") -> bool:
    """Return whether a name is one of the labels; a label may count instances, or say which one it is."""
    own, uncounted = spelled(name), spelled(re.sub(r"\d+ ?(?:-|to) ?\d+", "", name))
    for label in filter(None, labels):
        message = spelled(label)
        if message == own or (own and message.startswith(own) and COUNTING.fullmatch(message[len(own) :])):
            return True
        if (
            instance
            and spelled(re.sub(rf"\b0*{re.escape(last(instance))}\b", "", label, count=1)) == uncounted
        ):
            return True
    return False


def last(instance: str) -> str:
    """Return what distinguishes an instance from its sisters: the gear of ``1.3``."""
    return instance.rpartition(".")[2]


def words_of(text: str) -> set[str]:
    """Return the words and the numbers of a label, a number that is written as a word too."""
    words = (WORDS.get(word, word) for word in re.findall(r"[a-z]+|\d+", text.lower()))
    return {str(int(word)) if word.isdigit() else word for word in words}


def fits(number: PrintedNumber, claim: Claim) -> bool:
    """Return whether the row and the column of a number are those of an instance."""
    if number.machine and number.machine not in claim.machines:
        return False
    whole, _, part = claim.instance.partition(".")
    if number.process.startswith("process"):
        return claim.instance == number.process[-1] and not number.axis.isdigit()
    if part:
        message = [number.axis or number.spindle, *re.findall(r"\d+", number.name)]
        return message[-1] == part and {*message[:-1]} <= {"", whole}
    if number.axis.isdigit() or number.spindle:
        return whole == (number.axis or number.spindle)
    if number.pair:
        return not claim.instance or whole in words_of(number.pair)
    if number.name and claim.instance:
        return whole.lower() in words_of(number.name)
    return not (number.axis == "All" and claim.instance)


# -- units ------------------------------------------------------------------------------------------------

UNITS = {
    "volts dc": "V",
    "threads": "",
    "thread leads": "",
    "gears": "",
    "teeth": "",
    "RPM": "rpm",
    "mm/m": "mm/min",
}


def unit_of(message: str) -> str:
    """Return the schema's unit for a printed one."""
    return UNITS[message] if message in UNITS else unit_named(message)
