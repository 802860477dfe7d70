"""Registers, bits and values of the 57C422B database against those its manual prints."""

import re
from collections.abc import Iterator
from functools import cache

from disagreements import Disagreement, at_line, nowhere
from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow
from printed_book import Book, claims_of, mentions, squashed

from amp_studio.schema import Parameter, Schema

OF_Y = 2048
SHARED = {64, 4095}
"""Registers that both axes have together; every other one of X has its like on Y, so many registers on."""
LIKE = {68: 72, 69: 73, 104: 72, 105: 73}
"""Interrupt registers, whose bits are those of another (4-43 and 4-45)."""


@cache
def registers(printed: str) -> list[int]:
    """Return the registers of ``11,12``, ``68/69`` or ``0-14,31``."""
    found: list[int] = []
    for first, last in re.findall(r"(\d+)(?:-(\d+))?", printed):
        found += range(int(first), int(last or first) + 1)
    return found


@cache
def held_by(schema: Schema) -> dict[int, set[tuple[str, str]]]:
    found: dict[int, set[tuple[str, str]]] = {}
    for text, claims in claims_of(schema).items():
        for claim in claims:
            storage = schema.parameters[claim.parameter].storage
            first = int(text.removeprefix("R"))
            for register in range(first, first + (storage.words if storage else 1)):
                found.setdefault(register, set()).add((claim.parameter, claim.instance.partition(".")[0]))
    return found


@cache
def own_of(schema: Schema) -> dict[str, frozenset[int]]:
    found: dict[str, set[int]] = {}
    for register, holders in held_by(schema).items():
        for name, axis in holders:
            found.setdefault(name, set()).update([register] if axis != "Y" else [])
    return {name: frozenset(registers) for name, registers in found.items()}


@cache
def words_of(schema: Schema, name: str) -> str:
    """Return all texts of a parameter, squashed: name, bits, help and errata."""
    parameter = schema.parameters[name]
    labels = [bit.label for bit in parameter.bits or ()]
    message = [reading.says for key in parameter.errata for reading in schema.errata[key].readings]
    told = (parameter.help.what, parameter.help.find, parameter.help.wrong)
    return squashed(" ".join([parameter.name, *labels, *told, *message]))


class Module(Book):
    """The facts of the manual and the database they are compared with."""

    @property
    def held(self) -> dict[int, set[tuple[str, str]]]:
        """Register -> parameters that are in it, each with its axis; a value of two words is in two."""
        return held_by(self.schema)

    def owners(self, printed: str) -> list[Parameter]:
        names = dict.fromkeys(n for r in registers(printed) for n, _ in sorted(self.held.get(r, ())))
        return [self.schema.parameters[name] for name in names]

    def own(self, name: str) -> frozenset[int]:
        """Return the registers of a parameter on the X axis, or on both together."""
        return own_of(self.schema).get(name, frozenset())

    def of_section(self, section: Section) -> list[Parameter]:
        """Return what a section describes: the owners of its registers, or all of the cam where it has
        none.
        """
        tabled = [n.number for n in section.numbers if n.place == "table"]
        if tabled:
            return self.owners(tabled[0])
        return [p for p in self.schema.parameters.values() if p.id.startswith("cam.")]


# -- registers --------------------------------------------------------------------------------------------


def check_numbers(book: Module) -> Iterator[Disagreement]:
    """Every printed register belongs to its parameters,
    and every register of the database is printed at its page.
    """
    described: dict[int, str] = {}
    for section in book.sections:
        for fact in section.numbers:
            yield from number_of(book, section, fact)
            if fact.place == "table" or (fact.axis and "-" in fact.number):
                described |= dict.fromkeys(registers(fact.number), section.page)
    for register, holders in book.held.items():
        like = register - OF_Y if register >= OF_Y and register not in SHARED else register
        for name, axis in holders:
            parameter = book.schema.parameters[name]
            if described.get(like) != parameter.page:
                yield nowhere("numbers", name, f"has R{register} on page {parameter.page}")
            if register not in SHARED and (axis == "Y") != (register >= OF_Y):
                yield nowhere("numbers", name, f"has R{register} for axis {axis!r}")
        if register < OF_Y and register not in SHARED:
            twins = {name for name, _ in book.held.get(register + OF_Y, ())}
            if twins != {name for name, _ in holders}:
                yield nowhere("numbers", f"R{register}", f"R{register + OF_Y} is of {sorted(twins)}")


def number_of(book: Module, section: Section, fact: PrintedNumber) -> Iterator[Disagreement]:
    """Yield what is wrong with the parameters of a printed register."""

    def differs(manual: str, database: str) -> Disagreement:
        return at_line("numbers", section, fact.line, fact.number, manual, database)

    printed = registers(fact.number)
    for register in printed:
        if register not in book.held:
            yield differs(f"prints {register}", "no parameter has it")
        elif fact.axis and fact.axis not in {axis for _, axis in book.held[register]}:
            yield differs(f"prints {register} for {fact.axis}", "has it for another axis")
    if fact.place != "table":
        return
    for parameter in book.owners(fact.number):
        if beyond := book.own(parameter.id) - set(printed):
            yield differs(f"describes {fact.number}", f"{parameter.id} has {sorted(beyond)}")
        if not squashed(parameter.name).startswith(squashed(fact.name)):
            yield differs(f"is named {fact.name!r}", f"is named {parameter.name!r}")
        if parameter.page != section.page:
            yield differs(f"is on page {section.page}", f"{parameter.id} has page {parameter.page}")


# -- bits and names ---------------------------------------------------------------------------------------


def check_choices(book: Module) -> Iterator[Disagreement]:
    """Every bit that is printed with its number is in the database by that name, and every named command
    too.
    """
    printed: dict[str, set[int]] = {}
    for section in book.sections:
        for fact in section.choices:
            yield from choice_of(book, section, fact)
            for parameter in book.owners(fact.number):
                printed.setdefault(parameter.id, set()).update(map(int, filter(None, [fact.letter])))
    for parameter in (parameter for parameter in book.schema.parameters.values() if parameter.bits):
        like = [p.id for r in book.own(parameter.id) for p in book.owners(str(LIKE.get(r, r)))]
        bits = set().union(*(printed.get(name, set()) for name in like))
        for bit in parameter.bits or ():
            if bit.width == 1 and not bit.unknown and bit.bit not in bits:
                yield nowhere("choices", f"{parameter.id} bit {bit.bit}", bit.label)


def choice_of(book: Module, section: Section, fact: PrintedChoice) -> Iterator[Disagreement]:
    """Yield the disagreements on a printed bit or on the name of one."""
    owners = book.owners(fact.number)
    here = [parameter.id for parameter in book.of_section(section)]
    if not owners:
        yield at_line(
            "choices", section, fact.line, fact.number, fact.letter or fact.text, "no parameter has it"
        )
    for parameter in owners:
        named = [bit for bit in parameter.bits or () if not bit.label.startswith("Unnamed")]
        known = [bit for one in named for bit in range(one.bit, one.bit + one.width)]
        readings = [r.says for key in parameter.errata for r in book.schema.errata[key].readings]
        doubted = any(mentions(says, f"bit {fact.letter}") for says in readings)
        if fact.letter and int(fact.letter) not in known and not doubted:
            yield at_line("choices", section, fact.line, parameter.id, f"bit {fact.letter}", f"knows {known}")
        told = (words_of(book.schema, name) for name in (parameter.id, *here))
        if fact.text and not any(squashed(fact.text) in one for one in told):
            yield at_line("choices", section, fact.line, parameter.id, f"names {fact.text!r}", "does not")


# -- ranges, units and defaults ---------------------------------------------------------------------------


def figure(printed: str) -> float:
    """Return a printed bound: ``3.28 x 1010`` has lost its raised figure, ``1:32767`` is a ratio."""
    if power := re.fullmatch(r"([\d.]+) x 10(\d+)", printed):
        return float(power[1]) * 10 ** int(power[2])
    first, colon, second = printed.partition(":")
    return float(first) / float(second) if colon else float(printed)


def bounds_of(parameter: Parameter) -> list[tuple[int, float]]:
    """Return the ends of the ranges (0 low, 1 high), as shown; a field with a sign has those of its width."""
    tables = [parameter.ranges or {}, *(variant.ranges for variant in parameter.range_variants)]
    found = [
        (end, float(b))
        for t in tables
        for both in t.values()
        for end, b in enumerate(both)
        if isinstance(b, int | float)
    ]
    for bit in parameter.bits or ():
        if bit.signed:
            found += [(0, -(2.0 ** (bit.width - 1))), (1, 2.0 ** (bit.width - 1) - 1)]
    return found


def is_bound(parameter: Parameter, end: int, message: float) -> bool:
    """Return whether a printed figure is a bound, as shown or as in the register."""
    scale = parameter.storage.scale if parameter.storage else 1.0
    return any(
        at == end and any(abs(message - one) <= 1e-9 * abs(one) for one in (bound, bound * scale))
        for at, bound in bounds_of(parameter)
    )


def check_ranges(book: Module) -> Iterator[Disagreement]:
    """Every printed bound is in the database, and no other."""
    printed: list[tuple[Parameter, int, float]] = []
    for section in book.sections:
        for fact in section.ranges:
            yield from range_of(book, section, fact)
            printed += [(p, end, message) for p in book.of_section(section) for end, message in ends(fact)]
    for parameter in book.schema.parameters.values():
        for end, bound in bounds_of(parameter):
            one = [parameter.storage.scale if parameter.storage else 1.0, 1.0]
            message = [figure_ for p, at, figure_ in printed if p == parameter and at == end]
            if not any(abs(f - bound * scale) <= 1e-9 * abs(f) for f in message for scale in one):
                yield nowhere("ranges", f"{parameter.id} {'high' if end else 'low'}", str(bound))


def ends(fact: PrintedRange) -> list[tuple[int, float]]:
    """Return the printed ends, 0 the low one and 1 the high one."""
    if " to " in fact.low + fact.high:
        return []
    low, high = (fact.high, fact.low) if fact.note == "ratio" else (fact.low, fact.high)
    found = [(end, figure(message)) for end, message in enumerate((low, high)) if message]
    return [(end, message + 1) for end, message in found] if fact.note == "nor 0" else found


def range_of(book: Module, section: Section, fact: PrintedRange) -> Iterator[Disagreement]:
    """Yield the disagreements on one printed range."""
    owners = book.of_section(section)
    for end, message in ends(fact):
        if not any(is_bound(p, end, message) for p in owners):
            held = {p.id: bounds_of(p) for p in owners if bounds_of(p)}
            yield at_line(
                "ranges", section, fact.line, f"{fact.low} to {fact.high}", f"end {message:g}", f"{held}"
            )
    if " to " in fact.low + fact.high:
        taken = " ".join(book.schema.errata[key].taken for p in owners for key in p.errata)
        low, high = (figure(f"0{message}".partition(" ")[0]) for message in (fact.low, fact.high))
        if f"{low:g} to {high:g} times" not in taken:
            yield at_line(
                "ranges", section, fact.line, fact.low, f"{fact.low} and {fact.high}", f"takes {taken!r}"
            )


UNITS = {
    "encoder counts": "counts",
    "encoder counts/sec": "counts/s",
    "counts/scan": "counts/s",
    "scans": "ms",
}


def check_stored(book: Module) -> Iterator[Disagreement]:
    """Every printed unit and default is in the database, and every default there is printed."""
    printed: set[str] = set()
    for section in book.sections:
        for row in section.stored:
            yield from row_of(book, section, row)
            printed |= {p.id for p in book.owners(row.numbers[0]) if row.default and section.page}
    for parameter in book.schema.parameters.values():
        if parameter.default and parameter.id not in printed:
            yield nowhere("stored", parameter.id, f"default {parameter.default.value}")


def row_of(book: Module, section: Section, row: StoredRow) -> Iterator[Disagreement]:
    """Yield the disagreements on a printed unit or default."""
    if not book.owners(row.numbers[0]):
        yield at_line(
            "stored", section, row.line, row.numbers[0], f"{row.default} {row.unit}", "no parameter has it"
        )
    for parameter in book.owners(row.numbers[0]):
        storage, default = parameter.storage, parameter.default
        unit = (storage.unit if storage else None) or ""
        if row.unit and UNITS.get(row.unit, row.unit) != unit:
            yield at_line("stored", section, row.line, parameter.id, f"unit {row.unit}", f"unit {unit}")
        scale = storage.scale if storage else 1.0
        held = default.value * scale if default and isinstance(default.value, int | float) else None
        if row.default and (held is None or abs(held - float(row.default)) > 1e-9):
            yield at_line(
                "stored", section, row.line, parameter.id, f"default {row.default}", f"default {held}"
            )
