"""Numbers, ranges and choices of the 9/PC database against those its manual prints, section by section."""

import re
from collections.abc import Iterator
from dataclasses import replace
from string import ascii_lowercase

from book_9pc import PATCH_PAGE, Home, Reference, headings, pages, same_name, spelled, unit_of
from disagreements import NOWHERE, Disagreement, at_line
from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow
from printed_book import Claim, squashed

from amp_studio.schema import Choice, Parameter
from amp_studio.schema.model import Bound, BoundRef, Range

# -- numbers, names and pages -----------------------------------------------------------------------------


def check_numbers(book: Reference) -> Iterator[Disagreement]:
    """Every printed number belongs to the parameters that claim it, and every claim is printed."""
    for section in book.sections:
        yield from numbers_of(book, section)
    housed = {
        (number.number, claim)
        for section in book.sections
        for number in section.numbers
        if number.place == book.described_in[number.number]
        for claim in book.at_home(section, number)
    }
    stored = {number: row for row in book.stored for number in row.numbers}
    stored |= {
        f"{axis}{n[1:]}": row for n, row in stored.items() if len(row.numbers) > 1 for axis in range(4, 9)
    }
    for text, claims in book.claims.items():
        for claim in claims:
            if (text, claim) not in housed:
                yield from _printed_elsewhere(book, text, claim, stored.get(text))


def numbers_of(book: Reference, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the numbers of one section."""
    for number in section.numbers:
        if not book.claims.get(number.number):
            about, no_user = number.number, "no parameter has it"
            yield at_line("numbers", section, number.line, about, _row(number), no_user)
        elif number.place == book.described_in[number.number]:
            yield from _at_home(book, section, number, book.at_home(section, number))


def _at_home(
    book: Reference, section: Section, number: PrintedNumber, at_home: tuple[Claim, ...]
) -> Iterator[Disagreement]:
    """Yield what is wrong with the claims that a printed number belongs to."""

    def differs(manual: str, database: str) -> Disagreement:
        return at_line("numbers", section, number.line, number.number, manual, database)

    if not at_home:
        others = "; ".join(_claim(book, claim) for claim in book.claims[number.number])
        yield differs(_row(number), f"claimed elsewhere: {others}")
    machines = [machine for claim in at_home for machine in claim.machines]
    if len(set(machines)) < len(machines):
        yield differs(_row(number), "claimed twice: " + "; ".join(_claim(book, claim) for claim in at_home))
    for claim in at_home:
        if not same_name(book.name(claim), *headings(section), number.name, instance=claim.instance):
            yield differs(f"is named {number.name or section.heading!r}", f"is named {book.name(claim)!r}")
        if book.page(claim) not in pages(section):
            yield differs(f"is on page {section.page}", f"has page {book.page(claim)}")


def _printed_elsewhere(
    book: Reference, number: str, claim: Claim, row: StoredRow | None
) -> Iterator[Disagreement]:
    """Yield the disagreement on a claim that no section prints: it is in the Patch AMP table under its name,
    or is invented.
    """
    page, where = book.page(claim), _claim(book, claim)
    if row is None or number in book.described_in:
        yield Disagreement(
            "numbers", 0, number, where, "does not print it there", f"{claim.parameter} claims it"
        )
        return
    names = {section.heading: section.page for section in book.sections if not section.numbers} | {
        row.name: PATCH_PAGE
    }
    named = [name for name in names if same_name(book.name(claim), name, instance=claim.instance)]
    if not named:
        manual = f"is named {row.name!r} in the table"
        yield Disagreement("numbers", row.line, number, where, manual, f"is named {book.name(claim)!r}")
    elif page not in {names[name] for name in named}:
        manual = f"is on page {names[named[0]]}"
        yield Disagreement("numbers", row.line, number, where, manual, f"has page {page}")


def _row(number: PrintedNumber) -> str:
    message = [
        f"{key} {value!r}" for key, value in vars(number).items() if value and key not in {"line", "number"}
    ]
    return "prints it: " + ", ".join(message)


def _claim(book: Reference, claim: Claim) -> str:
    instance = f"@{claim.instance}" if claim.instance else ""
    return f"{claim.parameter}{instance} (page {book.page(claim)})"


# -- ranges -----------------------------------------------------------------------------------------------


def check_ranges(book: Reference) -> Iterator[Disagreement]:
    """Every printed range is what the database contains in that unit, and it contains no other."""
    for section in book.sections:
        yield from ranges_of(book, section)


def ranges_of(book: Reference, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the ranges of one section."""
    homes = book.homes(section)
    for fact in section.ranges:
        if not any(applies(fact, home) for home in homes):
            yield at_line("ranges", section, fact.line, section.heading, range_text(fact), "has no parameter")
    for home in homes:
        facts = [fact for fact in section.ranges if applies(fact, home)]
        yield from _ranges(book, section, home.parameter, facts)


def _ranges(
    book: Reference, section: Section, parameter: Parameter, facts: list[PrintedRange]
) -> Iterator[Disagreement]:
    content = held_ranges(parameter)
    exact = [one for one in content if any(range_is(book, fact, one) for fact in facts)]
    odd: list[PrintedRange] = []
    for fact in facts:
        agreed = any(
            range_is(book, fact, one)
            or (one not in exact and range_explained(book, section, parameter, fact, one))
            for one in content
        )
        if is_worded(fact):
            agreed = agreed and neighbour_units(book, content) <= {unit for unit, _ in content}
        if not agreed and not (parameter.choices and choices_span(book, section, parameter, fact)):
            odd.append(fact)
            database = ", ".join(held_text(*one) for one in content) or "has no range"
            yield at_line("ranges", section, fact.line, parameter.id, range_text(fact), database)
    for one in content:
        agreed = one in exact or any(range_explained(book, section, parameter, fact, one) for fact in facts)
        if not agreed and not any(unit_agrees(fact, one[0]) for fact in odd):
            about = f"{parameter.id} [{one[0]}]"
            yield at_line("ranges", section, 0, about, NOWHERE, held_text(*one))


def neighbour_units(book: Reference, content: list[tuple[str, Range]]) -> set[str]:
    """Return the units of the parameters that are bounds:
    a range printed in words is valid only in all of them.
    """
    bounds = [bound.param for _, both in content for bound in both if isinstance(bound, BoundRef)]
    return {unit for name in bounds for unit, _ in held_ranges(book.schema.parameters[name])}


def range_is(book: Reference, fact: PrintedRange, content: tuple[str, Range]) -> bool:
    """Return whether a range is in the database as printed."""
    return unit_agrees(fact, content[0]) and not list(wrong_bounds(book, fact, content[1]))


def range_explained(
    book: Reference, section: Section, parameter: Parameter, fact: PrintedRange, content: tuple[str, Range]
) -> bool:
    """Return whether an erratum names both readings of all bounds that differ."""
    wrong = list(wrong_bounds(book, fact, content[1]))
    instead = [
        book.schema.parameters[bound.param].name if isinstance(bound, BoundRef) else bound
        for _, bound in wrong
        if bound is not None
    ]
    message = [message for message, _ in wrong]
    return unit_agrees(fact, content[0]) and book.explained(parameter, section.page, message, instead)


def wrong_bounds(book: Reference, fact: PrintedRange, bounds: Range) -> Iterator[tuple[str, Bound]]:
    """Yield both readings of the bounds that differ."""
    for message, bound in zip((fact.low, fact.high), bounds, strict=True):
        if not bound_agrees(book, message, bound):
            yield message, bound


def held_ranges(parameter: Parameter) -> list[tuple[str, Range]]:
    """Return unit and bounds of every range of a parameter, those that hold under a condition too."""
    sets = [parameter.ranges or {}, *(variant.ranges for variant in parameter.range_variants)]
    return [(unit, bounds) for ranges in sets for unit, bounds in ranges.items()]


def applies(fact: PrintedRange | PrintedChoice, home: Home) -> bool:
    """Return whether a fact is for this parameter, where a section restricts itself."""
    if isinstance(fact, PrintedChoice) and fact.number:
        return fact.number in home.numbers or not home.numbers
    if not fact.applies:
        return True
    message = spelled(re.sub(r" ?parameters?$", "", fact.applies))
    return any(message in spelled(name) for name in (home.parameter.name, *home.rows))


def unit_agrees(fact: PrintedRange, unit: str) -> bool:
    """Return whether a printed unit is that of the database;
    a bare figure may count or be a percentage there.
    """
    if fact.unit:
        return unit_of(fact.unit) == unit
    return unit in {"", "counts", "%", "ms"} or is_worded(fact)


def is_worded(fact: PrintedRange) -> bool:
    """Return whether both bounds are the names of other parameters, without a unit."""
    return not fact.unit and not re.match(r"-?\d", fact.low) and not re.match(r"-?\d", fact.high)


def bound_agrees(book: Reference, message: str, bound: Bound) -> bool:
    """Return whether a printed bound, a figure or the name of another parameter, is the one of the
    database.
    """
    if isinstance(bound, BoundRef):
        return same_name(book.schema.parameters[bound.param].name, message, message.removesuffix(" value"))
    try:
        return bound is not None and float(message) == bound
    except ValueError:
        return False


def choices_span(book: Reference, section: Section, parameter: Parameter, fact: PrintedRange) -> bool:
    """Return whether the codes of a choice fill a printed range,
    or an erratum names the bounds that no code has.
    """
    codes = [choice.raw for choice in parameter.choices or () if choice.raw is not None]
    ends = zip((fact.low, fact.high), (min(codes, default=None), max(codes, default=None)), strict=True)
    wrong = [message for message, code in ends if code is None or float(message) != code]
    return not wrong or book.explained(parameter, section.page, wrong)


def range_text(fact: PrintedRange) -> str:
    return " ".join(
        filter(
            None, (fact.applies and f"{fact.applies}:", f"{fact.low} to {fact.high}", fact.unit, fact.note)
        )
    )


def held_text(unit: str, bounds: Range) -> str:
    low, high = (bound.param if isinstance(bound, BoundRef) else bound for bound in bounds)
    return f"{low} to {high} {unit}".rstrip()


# -- choices ----------------------------------------------------------------------------------------------


def check_choices(book: Reference) -> Iterator[Disagreement]:
    """Every printed choice has its letter and its label in the database, and it has no other."""
    described = set()
    for section in book.sections:
        yield from choices_of(book, section)
        described |= {home.parameter.id for home in book.homes(section)}
    for parameter in book.schema.parameters.values():
        for choice in parameter.choices or ():
            if parameter.id not in described and choice.code:
                about, database = f"{parameter.id} {choice.code}", f"({choice.code}) {choice.label}"
                yield Disagreement("choices", 0, about, parameter.page, "has no section of it", database)


def choices_of(book: Reference, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the choices of one section."""
    homes = book.homes(section)
    for fact in section.choices:
        if not any(applies(fact, home) for home in homes):
            message = f"({fact.letter}) {fact.text}"
            yield at_line("choices", section, fact.line, section.heading, message, "has no parameter")
    for home in homes:
        facts = lettered([fact for fact in section.choices if applies(fact, home)])
        yield from _choices(book, section, home.parameter, facts)


def lettered(facts: list[PrintedChoice]) -> list[PrintedChoice]:
    """Return choices with the letter that a screen hides under the cursor."""
    return [replace(fact, letter=fact.letter or ascii_lowercase[at]) for at, fact in enumerate(facts)]


def _choices(
    book: Reference, section: Section, parameter: Parameter, facts: list[PrintedChoice]
) -> Iterator[Disagreement]:
    content = list(parameter.choices or ())
    odd: list[Choice] = []
    for fact in facts:
        if not any(choice_agrees(book, section, parameter, fact, choice) for choice in content):
            near = [c for c in content if c.code == fact.letter or squashed(c.label) == squashed(fact.text)]
            odd += near
            database = ", ".join(f"({c.code}) {c.label}" for c in near) or "does not have it"
            about, message = f"{parameter.id} {fact.letter}", f"({fact.letter}) {fact.text}"
            yield at_line("choices", section, fact.line, about, message, database)
    if facts and all(fact.number for fact in facts):
        return  # a screen is no list
    for choice in content:
        added = choice.code is None and book.explained(parameter, PATCH_PAGE, [choice.label])
        agreed = any(choice_agrees(book, section, parameter, fact, choice) for fact in facts)
        if not added and not agreed and choice not in odd:
            about, database = f"{parameter.id} {choice.code or choice.key}", f"({choice.code}) {choice.label}"
            yield at_line("choices", section, 0, about, NOWHERE, database)


def choice_agrees(
    book: Reference, section: Section, parameter: Parameter, fact: PrintedChoice, choice: Choice
) -> bool:
    """Return whether a choice has its letter and its label, or an erratum names both labels."""
    if fact.letter != choice.code:
        return False
    plain = re.sub(
        r"^\([^)]*\) ", "", fact.text
    )  # "(G17, G18, G19) Primary axis 1 positive", in each of the planes
    if squashed(choice.label) in {squashed(fact.text), squashed(plain)}:
        return True
    return book.explained(parameter, section.page, [fact.text], [choice.label])
