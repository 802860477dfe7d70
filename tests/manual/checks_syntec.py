"""Numbers and values of the Syntec database against those its slides print."""

import re
from collections.abc import Iterator
from functools import cached_property

from disagreements import Disagreement, at_line, nowhere
from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow
from printed_book import Book, Claim, figures, squashed

from amp_studio.schema import Parameter


def spanned(printed: str) -> range:
    """Return the numbers of ``21~40`` or of ``2542``."""
    first, _, last = printed.partition("~")
    return range(int(first), int(last or first) + 1)


class Slides(Book):
    """The facts of the slides and the database they are compared with."""

    @cached_property
    def held(self) -> dict[int, tuple[Claim, ...]]:
        """Number -> those that claim it."""
        return {int(text.removeprefix("Pr")): claims for text, claims in self.claims.items()}

    @cached_property
    def own(self) -> dict[str, frozenset[int]]:
        """Parameter -> its numbers."""
        found: dict[str, set[int]] = {}
        for number, claims in self.held.items():
            for claim in claims:
                found.setdefault(claim.parameter, set()).add(number)
        return {name: frozenset(numbers) for name, numbers in found.items()}

    def owners(self, printed: str) -> list[Parameter]:
        """Return the parameters that claim any of the numbers."""
        names = dict.fromkeys(c.parameter for n in spanned(printed) for c in self.held.get(n, ()))
        return [self.schema.parameters[name] for name in names]

    def errata_say(self, parameter: Parameter, message: str) -> bool:
        """Return whether an erratum of the parameter takes what is in the database."""
        return any(message in self.schema.errata[key].taken for key in parameter.errata)


# -- numbers ----------------------------------------------------------------------------------------------


def check_numbers(book: Slides) -> Iterator[Disagreement]:
    """Every printed number belongs to the parameters that claim it,
    and every claim is printed in a separate place.
    """
    described: set[int] = set()
    places: dict[int, set[tuple[str, range]]] = {}
    for section in book.sections:
        for fact in section.numbers:
            yield from number_of(book, section, fact)
            if fact.place == "table":
                described |= set(spanned(fact.number))
            for number in spanned(fact.number):
                places.setdefault(number, set()).add((section.page, spanned(fact.number)))
    for name, numbers in book.own.items():
        parameter = book.schema.parameters[name]
        if unprinted := sorted(numbers - set(places)):
            yield nowhere("numbers", name, f"has Pr{unprinted[0]}")
        elif not numbers & described:
            here = [span for number in numbers for page, span in places[number] if page == parameter.page]
            if not any(numbers <= set(span) for span in here):
                yield nowhere(
                    "numbers",
                    name,
                    f"has {len(numbers)} numbers from Pr{min(numbers)}, page {parameter.page}",
                )


def number_of(book: Slides, section: Section, fact: PrintedNumber) -> Iterator[Disagreement]:
    """Yield what is wrong with those who claim a printed number."""

    def differs(manual: str, database: str) -> Disagreement:
        return at_line("numbers", section, fact.line, fact.number, manual, database)

    span = spanned(fact.number)
    for number in span:
        claims = book.held.get(number, ())
        if len(claims) != 1:
            yield differs(f"prints Pr{number}", f"is claimed by {len(claims)}")
    for parameter in book.owners(fact.number):
        beyond = book.own[parameter.id] - set(span)
        message = (fact.number, f"Pr{fact.number}")
        if (
            len(span) > 1
            and beyond
            and not any(book.explained(parameter, section.page, [one]) for one in message)
        ):
            yield differs(f"prints {fact.number}", f"{parameter.id} has Pr{max(beyond)}")
        if fact.place != "table":
            continue
        if beyond:
            yield differs(f"describes {fact.number}", f"{parameter.id} has Pr{max(beyond)}")
        if parameter.page != section.page:
            yield differs(f"is on page {section.page}", f"{parameter.id} has page {parameter.page}")
        if fact.name and not alike(fact.name, parameter.name):
            yield differs(f"is named {fact.name!r}", f"is named {parameter.name!r}")


def words(text: str) -> set[str]:
    return set(re.findall(r"[a-z0-9]+", re.sub(r"(?<=\d) (?=st|nd|rd|th)", "", text.lower())))


def alike(printed: str, held: str) -> bool:
    """Return whether two names are one: one of them may say more, or name both of a pair."""
    return words(printed) <= words(held) or words(held) <= words(printed)


# -- values -----------------------------------------------------------------------------------------------


def check_choices(book: Slides) -> Iterator[Disagreement]:
    """Every printed value is a choice with that label, and every coded choice is printed."""
    codes: dict[str, set[str]] = {}
    for section in book.sections:
        for fact in section.choices:
            yield from choice_of(book, section, fact)
            for parameter in book.owners(fact.number):
                codes.setdefault(parameter.id, set()).update(map(str, spanned(fact.letter)))
    for parameter in book.schema.parameters.values():
        for choice in parameter.choices or ():
            if choice.code is not None and choice.code not in codes.get(parameter.id, ()):
                yield nowhere("choices", parameter.id, f"{choice.code} {choice.label}")


def choice_of(book: Slides, section: Section, fact: PrintedChoice) -> Iterator[Disagreement]:
    """Yield the disagreements on one printed value."""
    if not book.owners(fact.number):
        yield at_line(
            "choices", section, fact.line, fact.number, f"{fact.letter} {fact.text}", "no parameter has it"
        )
    for parameter in book.owners(fact.number):
        for code in map(str, spanned(fact.letter)):
            choice = next((c for c in parameter.choices or () if c.code == code), None)
            if (
                choice is None
                or not words(fact.text) - {"by"} <= words(choice.label)
                or choice.raw != int(code)
            ):
                held = f"{choice.code} {choice.label} (raw {choice.raw})" if choice else f"has no {code}"
                yield at_line("choices", section, fact.line, parameter.id, f"{fact.letter} {fact.text}", held)


def check_ranges(book: Slides) -> Iterator[Disagreement]:
    """Every printed range is in the database, and no other."""
    printed: set[str] = set()
    for section in book.sections:
        for fact in section.ranges:
            yield from range_of(book, section, fact)
            printed |= {parameter.id for parameter in book.owners(fact.applies)}
    for parameter in book.schema.parameters.values():
        if parameter.ranges and parameter.id not in printed:
            yield nowhere("ranges", parameter.id, str(parameter.ranges))


def range_of(book: Slides, section: Section, fact: PrintedRange) -> Iterator[Disagreement]:
    """Yield the disagreements on one printed range."""
    if not book.owners(fact.applies):
        yield at_line(
            "ranges", section, fact.line, fact.applies, f"{fact.low} to {fact.high}", "no parameter has it"
        )
    for parameter in book.owners(fact.applies):
        held = (parameter.ranges or {}).get(fact.unit)
        pairs = zip((fact.low, fact.high), held or (), strict=False)
        if held is None or any(message and float(message) != bound for message, bound in pairs):
            manual = f"{fact.low} to {fact.high} {fact.unit}"
            yield at_line("ranges", section, fact.line, parameter.id, manual, str(parameter.ranges))


def unit_held(parameter: Parameter) -> str:
    return parameter.unit or (parameter.storage.unit if parameter.storage else None) or ""


def check_stored(book: Slides) -> Iterator[Disagreement]:
    """Every printed unit and default is in the database, or in the help where it has none;
    and no other is there.
    """
    rows = [(section, row) for section in book.sections for row in section.stored]
    units = {
        parameter.id: row.unit for _, row in rows if row.unit for parameter in book.owners(row.numbers[0])
    }
    for section, row in rows:
        yield from row_of(book, section, row)
    for parameter in book.schema.parameters.values():
        unit = unit_held(parameter)
        if unit and parameter.id not in units and not book.errata_say(parameter, unit):
            yield nowhere("stored", parameter.id, f"unit {unit}")
        if default := parameter.default:
            labels = [c.label for c in parameter.choices or () if c.key == default.value]
            message = figures(labels[0] if labels else str(default.value))
            here = [
                figures(row.default) for section, row in rows if section.page == default.page and row.default
            ]
            if message not in here:
                yield nowhere("stored", parameter.id, f"default {default.value} on page {default.page}")


def row_of(book: Slides, section: Section, row: StoredRow) -> Iterator[Disagreement]:
    """Yield the disagreements on a printed unit, default or list of settings."""
    owners = book.owners(row.numbers[0])
    defaults = [p.default.value for p in owners if p.default]
    for parameter in owners:
        text = f"{parameter.help.what} {parameter.help.find}"
        unit = unit_held(parameter)
        if row.unit and (squashed(row.unit) != squashed(unit) if unit else row.unit not in text):
            yield at_line("stored", section, row.line, parameter.id, f"unit {row.unit}", f"unit {unit!r}")
        for series, value in row.codes.items():
            if not re.search(rf"\b{value}\b", text) or not words(series) - {"series"} <= words(text):
                yield at_line(
                    "stored", section, row.line, parameter.id, f"{series}: {value}", "does not tell it"
                )
    if row.default and not any({value} == figures(row.default) for value in defaults):
        explained = not defaults and any(
            book.explained(p, section.page, map(str, figures(row.default))) for p in owners
        )
        if not explained:
            yield at_line(
                "stored", section, row.line, row.numbers[0], f"default {row.default}", f"{defaults}"
            )
