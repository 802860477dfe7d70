"""The NUM database against the bare facts of its manual: parameters, words, bits, defaults and bounds."""

import re
from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

from disagreements import Disagreement, at_line
from manual_facts import ListedParameter, PrintedChoice, PrintedDefault, PrintedRange, PrintedWord, Section
from printed_book import Book, mentions

from amp_studio.schema import Choice, Parameter

MACHINE = "cnc"


class Claimant(NamedTuple):
    """An instance of a parameter that claims a word."""

    parameter: Parameter
    instance: str


class Words(Book):
    """The facts of the parameter manual and the database they are compared with."""

    @cached_property
    def words(self) -> dict[str, dict[int, tuple[Claimant, ...]]]:
        """``P35`` -> word -> who claims it."""
        found: dict[str, dict[int, tuple[Claimant, ...]]] = {}
        for parameter in self.schema.parameters.values():
            for instance, message in self.schema.on(MACHINE).numbers(parameter).items():
                number, _, word = message.partition("N")
                claimed = found.setdefault(number, {})
                claimed[int(word)] = (*claimed.get(int(word), ()), Claimant(parameter, instance))
        return found

    @cached_property
    def pages(self) -> dict[str, str]:
        """``P35`` -> the page that the list of chapter 2 sends to,
        or that of the list where it sends nowhere.
        """
        return {row.number: row.page for section in self.sections for row in section.listed}

    @cached_property
    def printed_words(self) -> dict[str, set[int]]:
        """``P35`` -> the words that the head of its section counts and the text names."""
        found: dict[str, set[int]] = {}
        for section in self.sections:
            for size in section.sizes:
                found.setdefault(size.number, set()).update(range(size.words))
            for fact in section.words:
                found.setdefault(fact.number, set()).update(span(fact.word))
        return found

    @cached_property
    def type_ranges(self) -> dict[str, tuple[float, float]]:
        """Type code -> the bounds that the table of types prints."""
        return {
            fact.applies.removeprefix("type "): (
                figure(fact.low, hexadecimal=True),
                figure(fact.high, hexadecimal=True),
            )
            for section in self.sections
            for fact in section.ranges
            if fact.applies.startswith("type ")
        }

    def claims_on(self, number: str, word: str = "") -> tuple[Claimant, ...]:
        """Return who claims these words of a parameter, or any word of it."""
        content = self.words.get(number, {})
        return tuple(claim for n in (span(word) if word else content) for claim in content.get(n, ()))

    def has_erratum(self, number: str, message: str, content: Iterable[object] = ()) -> bool:
        """Return whether an erratum of this parameter names what is printed and takes what is
        in the database.
        """
        errata = {key for claim in self.claims_on(number) for key in claim.parameter.errata}
        return any(
            any(mentions(reading.says, message) for reading in self.schema.errata[key].readings)
            and all(mentions(self.schema.errata[key].taken, str(one)) for one in content)
            for key in errata
        )


def span(word: str) -> list[int]:
    """Return 0 to 31 for ``N0-N31``; several runs may be in a row."""
    found: list[int] = []
    for part in re.split(r",\s*", word):
        first, _, last = part.replace("N", "").partition("-")
        found += range(int(first), int(last or first) + 1)
    return found


def runs(words: Iterable[int]) -> str:
    """Return ``N0-N31`` for a set of words."""
    message: list[list[int]] = []
    for word in sorted(words):
        if message and word == message[-1][-1] + 1:
            message[-1].append(word)
        else:
            message.append([word])
    return ", ".join(f"N{run[0]}" if len(run) == 1 else f"N{run[0]}-N{run[-1]}" for run in message)


def figure(message: str, *, hexadecimal: bool = False) -> float:
    """Return the value of a printed figure; those with a dollar are hexadecimal."""
    if message.startswith("$") or (hexadecimal and re.fullmatch(r"F+|0{4,}", message)):
        return float(int(message.lstrip("$"), 16))
    return float(message)


# -- the list of chapter 2 --------------------------------------------------------------------------------


def check_list(book: Words) -> Iterator[Disagreement]:
    """Every P of chapter 2 is there with its type, category and page, and there is no other."""
    for section in book.sections:
        yield from listed_of(book, section)
    for number in book.words.keys() - book.pages.keys():
        yield Disagreement("list", 0, number, "chapter 2", "does not list it", "claims words of it")


def listed_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the rows of the list."""
    for row in section.listed:
        yield from row_of(book, row)


def row_of(book: Words, row: ListedParameter) -> Iterator[Disagreement]:
    """Yield the disagreements on one row of the list."""

    def differs(manual: str, database: str) -> Disagreement:
        return Disagreement("list", row.line, row.number, "chapter 2", manual, database)

    claims = book.claims_on(row.number)
    if not claims:
        yield differs("lists it", "has no such parameter")
    codes = {claim.parameter.storage.code if claim.parameter.storage else None for claim in claims}
    wrong = sorted(str(code) for code in codes if str(code) != row.type and (code is not None or row.type))
    if wrong and not book.has_erratum(row.number, row.type, wrong):
        yield differs(f"type {row.type}", f"type {', '.join(wrong)}")
    pages = {book.schema.page((claim.parameter.id, claim.instance)) for claim in claims}
    if row.page[:1].isdigit():
        odd = {page for page in pages if page != row.page}
    else:
        odd = {page for page in pages if not page.startswith("2-")}
    if odd and not book.has_erratum(row.number, row.page, odd):
        yield differs(f"page {row.page}", f"page {', '.join(sorted(odd))}")
    groups = {book.schema.group_of[claim.parameter.id].key for claim in claims}
    category = re.sub(r"[^a-z]", "_", row.category.lower()) or "reserved"
    if any(not group.startswith(category) for group in groups):
        yield differs(f"category {row.category or 'none'}", f"group {', '.join(sorted(groups))}")


# -- words and bits ---------------------------------------------------------------------------------------


def check_words(book: Words) -> Iterator[Disagreement]:
    """The words of the database are those that are printed, each once, and every type is that of the
    section.
    """
    for section in book.sections:
        yield from words_of(book, section)
    for number, content in book.words.items():
        printed = book.printed_words.get(number, set())
        more = content.keys() - printed
        if more and not (printed and book.has_erratum(number, runs(more))):
            says = f"prints {runs(printed) or 'no words'}"
            yield Disagreement("words", 0, number, book.pages.get(number, ""), says, f"has {runs(more)}")
        twice = [word for word, claims in content.items() if len(claims) > 1]
        if twice:
            names = sorted({claim.parameter.id for word in twice for claim in content[word]})
            yield Disagreement("words", 0, number, "twice", f"prints {runs(twice)} once", ", ".join(names))


def words_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the words of one section."""
    for size in section.sizes:
        content = book.words.get(size.number, {})
        codes = {str(c.parameter.storage and c.parameter.storage.code) for c in book.claims_on(size.number)}
        odd = codes - {size.type}
        if odd and not book.has_erratum(size.number, size.type, odd):
            says = f"type {size.type}"
            yield at_line("words", section, size.line, size.number, says, f"type {', '.join(sorted(odd))}")
        if len(content) != size.words and not book.has_erratum(size.number, str(size.words)):
            says = f"{size.words} words"
            yield at_line("words", section, size.line, size.number, says, f"{len(content)} words")
    for fact in section.words:
        lost = [n for n in span(fact.word) if n not in book.words.get(fact.number, {})]
        if lost and not book.has_erratum(fact.number, fact.word):
            yield at_line("words", section, fact.line, fact.number, fact.word, f"lacks {runs(lost)}")


def check_bits(book: Words) -> Iterator[Disagreement]:
    """Every printed bit is one that its word has, and is at the ends of a field there."""
    for section in book.sections:
        yield from bits_of(book, section)


def bits_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the bits of one section."""
    for fact in section.bits:
        if not any(has_bits(claim.parameter, fact) for claim in book.claims_on(fact.number, fact.word)):
            about = f"{fact.number} {fact.word}".strip()
            content = ", ".join(
                sorted(
                    {
                        f"{claim.parameter.id} {fields(claim.parameter)}"
                        for claim in book.claims_on(fact.number, fact.word)
                    }
                )
            )
            yield at_line(
                "bits", section, fact.line, about, f"bit {fact.bits}", content or "has no such word"
            )


def fields(parameter: Parameter) -> list[tuple[int, int]]:
    """Return the first and the last bit of every field."""
    if parameter.bits:
        return [(bit.bit, bit.bit + bit.width - 1) for bit in parameter.bits]
    return [(bit, bit) for bit in range((parameter.storage and parameter.storage.bits) or 0)]


def has_bits(parameter: Parameter, fact: PrintedWord) -> bool:
    """Return whether the printed bits are whole fields of a parameter."""
    message = sorted(map(int, fact.bits.split("-")))
    return message[0] in {low for low, _ in fields(parameter)} and message[-1] in {
        high for _, high in fields(parameter)
    }


# -- codes of bits ----------------------------------------------------------------------------------------


def check_codes(book: Words) -> Iterator[Disagreement]:
    """Every printed code of a field of bits has its text in the database, and the field has no other."""
    for section in book.sections:
        yield from codes_of(book, section)


def codes_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the codes of one section, and the choices of its fields that no code
    prints.
    """
    told: dict[tuple[str, str], list[int]] = {}
    for fact in section.choices:
        content = choices_of(book, fact)
        told.setdefault((fact.number, fact.applies), []).append(int(fact.letter, 2))
        if not any(
            choice.raw == int(fact.letter, 2) and same_text(choice.label, fact.text) for choice in content
        ):
            labels = ", ".join(f"{choice.raw} {choice.label}" for choice in content) or "has no such field"
            about, says = f"{fact.number} bits {fact.applies}", f"{fact.letter} {fact.text}"
            yield at_line("codes", section, fact.line, about, says, labels)
    for (number, bits), codes in told.items():
        fact = PrintedChoice(line=0, letter="", text="", number=number, applies=bits)
        for choice in choices_of(book, fact):
            if choice.raw not in codes:
                says, held_one = "does not print it", f"{choice.raw} {choice.label}"
                yield at_line("codes", section, 0, f"{number} bits {bits}", says, held_one)


def choices_of(book: Words, fact: PrintedChoice) -> list[Choice]:
    """Return the choices of the field of bits that a code is printed for."""
    low, high = sorted(map(int, fact.applies.split("-")))
    found = {claim.parameter.id: claim.parameter for claim in book.claims_on(fact.number)}
    return [
        choice
        for parameter in found.values()
        for bit in parameter.bits or ()
        if (bit.bit, bit.bit + bit.width - 1) == (low, high)
        for choice in bit.choices or ()
    ]


def same_text(label: str, message: str) -> bool:
    """Return whether a label is the printed one, without what is before or after it."""
    short, whole = (re.sub(r"[^a-z0-9.µ]", "", text.lower()) for text in (label, message))
    return whole.startswith(short) if short[:1].isdigit() else short in whole


# -- defaults and bounds ----------------------------------------------------------------------------------


def check_defaults(book: Words) -> Iterator[Disagreement]:
    """Every printed default is the one of its word, and the database has no other."""
    printed: set[str] = set()
    for section in book.sections:
        yield from defaults_of(book, section)
        printed |= {
            claim.parameter.id
            for fact in section.defaults
            for claim in book.claims_on(fact.number, fact.word)
        }
    for parameter in book.schema.parameters.values():
        if parameter.default is not None and parameter.id not in printed:
            says = f"default {parameter.default.value}"
            yield Disagreement("defaults", 0, parameter.id, parameter.page, "prints none", says)


def defaults_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the defaults of one section; without a word, one of its words must have
    it.
    """
    for fact in section.defaults:
        claims = book.claims_on(fact.number, fact.word)
        agreed = [default_is(claim, fact) for claim in claims]
        whole = all(agreed) if fact.word else any(agreed)
        if not (agreed and whole) and not book.has_erratum(fact.number, fact.value):
            about = f"{fact.number} {fact.word}".strip()
            content = sorted({f"{c.parameter.id} {held_default(c)}" for c in claims}) or ["has no such word"]
            says = f"{fact.note} {fact.value} {fact.unit}".strip()
            yield at_line("defaults", section, fact.line, about, says, ", ".join(content))


def held_default(claim: Claimant) -> float | bool | str | None:
    """Return the default of an instance; that of a choice is its code."""
    default = claim.parameter.default
    if default is None:
        return None
    value = (default.instances or {}).get(claim.instance, default.value)
    codes = {choice.key: choice.raw for choice in claim.parameter.choices or ()}
    return codes.get(str(value)) if str(value) in codes else value


def default_is(claim: Claimant, fact: PrintedDefault) -> bool:
    """Return whether an instance has the printed default, in the printed unit."""
    content, default = held_default(claim), claim.parameter.default
    if content is None or default is None:
        return False
    unit = fact.unit.replace("µ", "u")
    try:
        return figure(fact.value) == content and (not default.unit or not unit or default.unit == unit)
    except ValueError:
        labels = {choice.key: choice.label for choice in claim.parameter.choices or ()}
        return fact.value.lower() in {str(default.value).lower(), labels.get(str(default.value), "").lower()}


def check_ranges(book: Words) -> Iterator[Disagreement]:
    """Every printed bound is in the database, and a bound there is either printed
    or the whole range of the type.
    """
    printed: set[str] = set()
    for section in book.sections:
        yield from ranges_of(book, section)
        printed |= {
            claim.parameter.id
            for fact in section.ranges
            for claim in book.claims_on(*place_of(fact))
            if place_of(fact)[0]
        }
    for parameter in book.schema.parameters.values():
        code = str(parameter.storage.code) if parameter.storage else ""
        for bounds in (parameter.ranges or {}).values():
            whole = book.type_ranges.get(code)
            if parameter.id not in printed and whole is not None and tuple(bounds) != whole:
                says = f"type {code} has {whole[0]:g} to {whole[1]:g}"
                yield Disagreement(
                    "ranges", 0, parameter.id, parameter.page, says, f"has {bounds[0]} to {bounds[1]}"
                )


def place_of(fact: PrintedRange) -> tuple[str, str]:
    """Return parameter and words that a printed range is of; nothing for the range of a type."""
    number, _, word = fact.applies.partition(" ")
    return ("", "") if number == "type" else (number, word)


def ranges_of(book: Words, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the bounds of one section."""
    for fact in section.ranges:
        number, word = place_of(fact)
        claims = book.claims_on(number, word)
        if not number or (claims and all(range_is(claim.parameter, fact) for claim in claims)):
            continue
        if fact.note == "recommended" or all(
            book.has_erratum(number, message) for message in (fact.low, fact.high) if message
        ):
            continue
        content = sorted({f"{claim.parameter.id} {held_range(claim.parameter)}" for claim in claims})
        says = f"{fact.low} to {fact.high} {fact.unit}".strip()
        yield at_line(
            "ranges", section, fact.line, fact.applies, says, ", ".join(content) or "has no such word"
        )


def held_range(parameter: Parameter) -> str:
    """Return the bounds or the codes of a parameter."""
    codes = [choice.raw for choice in parameter.choices or ()]
    return str(codes or [f"{low} to {high}" for low, high in (parameter.ranges or {}).values()])


def range_is(parameter: Parameter, fact: PrintedRange) -> bool:
    """Return whether printed bounds are in the database, or for a choice whether all their codes are
    choices.
    """
    low, high = (figure(message) if message else None for message in (fact.low, fact.high))
    codes = {choice.raw for choice in parameter.choices or ()}
    if codes:
        ends = [int(end) for end in (low, high) if end is not None]
        return set(range(min(ends), max(ends) + 1)) <= codes
    if high is not None and fact.note == "less than":
        high -= 1
    return any(
        (low is None or low == content[0]) and (high is None or high == content[1])
        for content in (parameter.ranges or {}).values()
    )
