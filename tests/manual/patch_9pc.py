"""The 9/PC database against the Patch AMP table of its manual: what the control itself stores."""

import re
from collections.abc import Iterator
from typing import NamedTuple

from book_9pc import PATCH_PAGE, Reference, unit_of
from checks_9pc import held_ranges
from disagreements import Disagreement
from manual_facts import Section, StoredRow
from printed_book import Claim, mentions, squashed

from amp_studio.schema import Parameter, UnitError, convert
from amp_studio.schema.model import BoundRef


class Difference(NamedTuple):
    """What a row and a parameter say differently, and what an erratum that explains it has to name,
    if one may.
    """

    what: str
    manual: str
    database: str
    printed: tuple[str, ...] = ()
    held: tuple[object, ...] = ()


def check_stored(book: Reference) -> Iterator[Disagreement]:
    """Every row of the Patch AMP table is what the database contains: default, bounds, codes and mark."""
    rows = {
        claim.parameter for row in book.stored for number in row.numbers for claim in owners_of(book, number)
    }
    for section in book.sections:
        yield from rows_of(book, section)
    for parameter in book.schema.parameters.values():
        if parameter.patchable and parameter.id not in rows:
            yield Disagreement(
                "stored", 0, parameter.id, PATCH_PAGE, "has no row of it", "calls it patchable"
            )


def rows_of(book: Reference, section: Section) -> Iterator[Disagreement]:
    """Yield the disagreements on the rows of one section."""
    for row in section.stored:
        yield from row_of(book, row)


def row_of(book: Reference, row: StoredRow) -> Iterator[Disagreement]:
    """Yield the disagreements on one row."""
    where = f"{PATCH_PAGE} {row.name}"
    owners = {number: owners_of(book, number) for number in row.numbers}
    for number, claims in owners.items():
        if not claims and not left_out(book, row, number):
            yield Disagreement("stored", row.line, number, where, "has the number", "no parameter has it")
    for claim in {claim.parameter: claim for claims in owners.values() for claim in claims}.values():
        for found in differences(book, row, claim):
            if not book.explained(
                book.schema.parameters[claim.parameter], PATCH_PAGE, found.printed, found.held
            ):
                about = f"{row.numbers[0]} {found.what}"
                database = f"{found.database} ({claim.parameter})"
                yield Disagreement("stored", row.line, about, where, found.manual, database)


def owners_of(book: Reference, number: str) -> list[Claim]:
    """Return the instances a number belongs to where no other one disputes it."""
    machines = [machine.key for machine in book.schema.family.machines]
    claims = book.claims.get(number, ())
    return [
        c for c in claims if not any(book.schema.on(machine).is_disputed(c.parameter) for machine in machines)
    ]


def left_out(book: Reference, row: StoredRow, number: str) -> bool:
    """Return whether an erratum names a row of the table, by the number of its first axis,
    that is no parameter.
    """
    readings = (
        r for erratum in book.schema.errata.values() for r in erratum.readings if r.page == PATCH_PAGE
    )
    names = (f"1{number[1:]}" if len(row.numbers) > 1 else number, row.name)
    return any(all(mentions(reading.says, name) for name in names) for reading in readings)


def differences(book: Reference, row: StoredRow, claim: Claim) -> Iterator[Difference]:
    """Yield everything in which a row and a parameter differ."""
    parameter = book.schema.parameters[claim.parameter]
    if not parameter.patchable:
        yield Difference("patchable", "has a row of it", "does not call it patchable")
    if row.machine and not only_on(book, claim, row.machine):
        marked = f"marks it for the {row.machine}"
        yield Difference("mark", marked, "has it on other machine types")
    if not row.machine and only_on(book, claim, "lathe"):
        yield Difference("mark", "does not mark it for the lathe", "has it on the lathe only", ("mark",))
    yield from default_difference(row, claim, parameter)
    if row.codes:
        yield from code_differences(row, parameter)
    elif parameter.choices:
        codes = [choice.raw for choice in parameter.choices if choice.raw is not None]
        if not codes or (float(row.low), float(row.high)) != (min(codes), max(codes)):
            message = (row.low, row.high)
            yield Difference("codes", f"has {row.low} to {row.high}", f"has the codes {codes}", message)
    else:
        yield from bound_differences(book, row, parameter)


def only_on(book: Reference, claim: Claim, machine: str) -> bool:
    """Return whether a parameter has no number on every other machine type, or is inactive there."""
    others = {m.key for m in book.schema.family.machines} - {machine}
    conditions = book.schema.family.conditions
    for state in book.schema.parameters[claim.parameter].states:
        if state.unless and conditions[state.unless].when == f"machine == '{machine}'":
            return True
        if state.when:
            others -= {other for other in others if conditions[state.when].when == f"machine == '{other}'"}
    return not others & claim.machines


def default_difference(row: StoredRow, claim: Claim, parameter: Parameter) -> Iterator[Difference]:
    """Yield the default where it differs."""
    default = parameter.default
    printed, _, unit = row.default.partition(" ")
    figure = re.match(r"-?[\d.]+", printed)
    manual = f"default {row.default}"
    message = (figure[0] if figure else row.default,)
    if default is None:
        yield Difference("default", manual, "has no default", message)
        return
    value = (default.instances or {}).get(claim.instance, default.value)
    if parameter.choices:
        choice = next(c for c in parameter.choices if c.key == value)
        if squashed(row.default) not in {squashed(choice.label), squashed(choice.key)}:
            yield Difference("default", manual, f"default {choice.label}", (row.default,), (choice.label,))
    elif not figure or not agrees(figure[0], unit or "%" * printed.endswith("%"), value, default.unit):
        database = f"default {value} {default.unit}".rstrip()
        yield Difference("default", manual, database, message, (value,))


def bound_differences(book: Reference, row: StoredRow, parameter: Parameter) -> Iterator[Difference]:
    """Yield the bounds that differ, and the unit in which the value is kept."""
    unit = row.unit.removesuffix(" nominal rated torque")
    kept = parameter.storage.unit if parameter.storage else None
    if unit and unit_of(unit) not in {"", kept}:
        yield Difference("unit", f"is kept in {row.unit}", f"is kept in {kept}")
    for end, figure in enumerate((row.low, row.high)):
        name, held = ("low", "high")[end], list(outermost(book, parameter, end))
        if not any(agrees(figure, unit, bound, own) for own, bound in held):
            database = ", ".join(f"{bound} {own}".rstrip() for own, bound in held) or "no range"
            yield Difference(name, f"{name} bound {figure} {row.unit}".rstrip(), database, (figure,))


def outermost(book: Reference, parameter: Parameter, end: int) -> Iterator[tuple[str, float]]:
    """Yield unit and figure of a bound; one that is another parameter reaches as far as that one's own
    bound.
    """
    for unit, bounds in held_ranges(parameter):
        bound = bounds[end]
        if isinstance(bound, BoundRef):
            reach = outermost(book, book.schema.parameters[bound.param], end)
            yield from ((own, figure) for own, figure in reach if own == unit)
        elif bound is not None:
            yield unit, bound


def agrees(printed: str, unit: str, value: object, held_unit: str) -> bool:
    """Return whether a value of the database is a printed figure;
    converted to another unit it is rounded as shortly.
    """
    there = unit_of(unit) if unit else held_unit
    try:
        converted = convert(float(str(value)), held_unit, there)
    except (UnitError, ValueError):
        return False
    if there != held_unit:
        converted = round(converted, len(printed.partition(".")[2]))
    return converted == float(printed)


def code_differences(row: StoredRow, parameter: Parameter) -> Iterator[Difference]:
    """Yield the codes that only one side has, and those that mean different things."""
    choices = {str(choice.raw): choice.label for choice in parameter.choices or () if choice.raw is not None}
    for code in row.codes | choices:
        printed, held = row.codes.get(code), choices.get(code)
        if printed is None or held is None or not labels_agree(printed, held):
            manual = f"code {code} - {printed}" if printed else f"has no code {code}"
            yield Difference(
                f"code {code}", manual, f"code {code} is {held!r}" if held else "has no such code"
            )


def labels_agree(printed: str, label: str) -> bool:
    """Return whether one label is part of the other: the table and the chapter shorten each in its own
    way.
    """
    one, other = squashed(printed), squashed(label)
    return one == other or (min(len(one), len(other)) > 3 and (one in other or other in one))
