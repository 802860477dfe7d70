"""The database of the 9/PC holds what its manual prints: every number, range, choice and stored value, or says why not.

The facts in 9pc.yaml were taken from the manual without a look at the database (scripts/extract_9pc.py). Each check
tells all its disagreements at once, each with number, line and section of the manual and with both readings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest
from book_9pc import Book, Disagreement, Exempt, exemptions, printed, unsettled
from checks_9pc import check_choices, check_numbers, check_ranges, choices_of, numbers_of, ranges_of
from manual_facts import PrintedNumber, PrintedRange, Section, StoredRow
from patch_9pc import check_stored, only_on, owners_of, row_of

from amp_studio.schema import Choice, Parameter, load_schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import load_compiled

Check = Callable[[Book], Iterator[Disagreement]]

CHECKS: dict[str, Check] = {
    "numbers": check_numbers,
    "ranges": check_ranges,
    "choices": check_choices,
    "stored": check_stored,
}


@pytest.fixture(scope="module")
def book() -> Book:
    return Book(load_schema("9pc"), printed())


@pytest.mark.parametrize("check", CHECKS)
def test_the_database_holds_what_the_manual_prints(book: Book, check: str) -> None:
    disagreements = unsettled(check, CHECKS[check](book), exemptions())
    assert not disagreements, "\n".join([f"{len(disagreements)} disagreements:", *disagreements])


def test_the_facts_are_those_of_the_whole_manual() -> None:
    """Chapters 3 to 34 describe parameters, 37 has the Patch AMP table, appendix A two numbers that it leaves out."""
    assert {section.chapter for section in printed()} == {*map(str, range(3, 35)), "37", "A"}
    counts = [
        sum(len(getattr(s, kind)) for s in printed()) for kind in ("numbers", "ranges", "choices", "stored")
    ]
    assert counts == [1376, 254, 857, 225]


# -- exceptions -------------------------------------------------------------------------------------------


def test_an_exception_says_why_in_a_sentence() -> None:
    for exempt in exemptions():
        assert exempt.check in CHECKS
        assert len(exempt.why.split()) > 4
        assert exempt.why.endswith(".")
        assert exempt.about or 0 not in exempt.span, "nothing else tells what is printed nowhere"


def test_an_exception_covers_its_lines_and_fails_where_it_is_not_needed() -> None:
    def odd(line: int, about: str) -> Disagreement:
        return Disagreement("ranges", line, about, "5-10 Home Calibration", "0 to 1 mm", "0 to 2 mm")

    exempt = [
        Exempt(check="ranges", lines="10-11", why="The scan is torn."),
        Exempt(check="choices", lines="99", why="Of another check."),
    ]
    assert unsettled("ranges", [odd(10, "a"), odd(11, "b")], exempt) == []
    assert unsettled("ranges", [odd(10, "a"), odd(11, "b"), odd(12, "c")], exempt) == [str(odd(12, "c"))]
    (spare,) = unsettled("ranges", [odd(10, "a")], exempt)
    assert "line 11" in spare
    assert "not needed" in spare
    narrow = [Exempt(check="ranges", lines="10", about=("a",), why="Only this one.")]
    assert unsettled("ranges", [odd(10, "a"), odd(10, "b")], narrow) == [str(odd(10, "b"))]


# -- no altered fact of the manual goes unseen ------------------------------------------------------------

OUT_OF_THE_WAY = "87654.3"
"""A figure that nothing holds and no erratum mentions."""


def unseen(book: Book, check: str, section: Section, altered: Section, line: int) -> bool:
    """Tell whether a section raises nothing new on a line that no exception covers."""
    if any(exempt.check == check and line in exempt.span for exempt in exemptions()):
        return False
    judge = {"numbers": numbers_of, "ranges": ranges_of, "choices": choices_of}[check]
    return set(judge(book, altered)) <= set(judge(book, section))


def with_fact(section: Section, kind: str, at: int, **changes: object) -> Section:
    facts = list(getattr(section, kind))
    facts[at] = replace(facts[at], **changes)
    return replace(section, **{kind: tuple(facts)})


def test_no_number_can_be_altered_unseen(book: Book) -> None:
    tabled = [n.number for section in printed() for n in section.numbers if n.place == "table"]
    other = dict(zip(tabled, [*tabled[20:], *tabled[:20]], strict=True))  # the number of another section

    def missed(section: Section, at: int, number: PrintedNumber) -> bool:
        wrong = (other[number.number], OUT_OF_THE_WAY)
        return any(
            unseen(book, "numbers", section, with_fact(section, "numbers", at, number=n), number.line)
            for n in wrong
        )

    assert [
        (number.line, number.number)
        for section in printed()
        for at, number in enumerate(section.numbers)
        if number.place == "table" and missed(section, at, number)
    ] == []


def test_no_axis_spindle_process_or_machine_can_be_altered_unseen(book: Book) -> None:
    other = {"process 1": "process 2", "process 2": "process 1", "single process": ""}
    assert [
        (number.line, key)
        for section in printed()
        for at, number in enumerate(section.numbers)
        for key in ("axis", "spindle", "pair", "process")
        if (said := getattr(number, key)) and (now := other.get(said, "9"))
        if unseen(book, "numbers", section, with_fact(section, "numbers", at, **{key: now}), number.line)
    ] == []


def test_no_page_can_be_altered_unseen(book: Book) -> None:
    assert [
        section.heading
        for section in printed()
        if any(n.place == "table" for n in section.numbers)
        if unseen(
            book, "numbers", section, replace(section, page="1-1", within_page=""), section.numbers[0].line
        )
    ] == []


def test_no_name_can_be_altered_unseen(book: Book) -> None:
    def renamed(section: Section) -> Section:
        numbers = tuple(replace(n, name=n.name and f"Unheard-of {n.name}") for n in section.numbers)
        return replace(section, heading="Unheard of", within="", numbers=numbers)

    assert [
        section.heading
        for section in printed()
        if any(n.place == "table" for n in section.numbers)
        if unseen(book, "numbers", section, renamed(section), section.numbers[0].line)
    ] == []


@pytest.mark.parametrize("end", ["low", "high"])
def test_no_bound_can_be_altered_unseen(book: Book, end: str) -> None:
    def missed(section: Section, at: int, fact: PrintedRange) -> bool:
        wrong = (OUT_OF_THE_WAY, "Unheard-of Limit")
        return any(
            unseen(book, "ranges", section, with_fact(section, "ranges", at, **{end: bound}), fact.line)
            for bound in wrong
        )

    assert [
        (fact.line, section.heading)
        for section in printed()
        for at, fact in enumerate(section.ranges)
        if missed(section, at, fact)
    ] == []


def test_no_unit_can_be_altered_unseen(book: Book) -> None:
    assert [
        (fact.line, section.heading)
        for section in printed()
        for at, fact in enumerate(section.ranges)
        if fact.unit
        and unseen(book, "ranges", section, with_fact(section, "ranges", at, unit="Hz"), fact.line)
        if fact.unit != "Hz"
    ] == []


@pytest.mark.parametrize("change", [{"letter": "z"}, {"text": "Unheard of"}], ids=["letter", "text"])
def test_no_choice_can_be_altered_unseen(book: Book, change: dict[str, str]) -> None:
    assert [
        (fact.line, section.heading)
        for section in printed()
        for at, fact in enumerate(section.choices)
        if unseen(book, "choices", section, with_fact(section, "choices", at, **change), fact.line)
    ] == []


def test_no_choice_can_be_left_out_unseen(book: Book) -> None:
    assert [
        (fact.line, section.heading)
        for section in printed()
        for fact in section.choices
        if not fact.number  # a screen shows what a table prints
        if unseen(
            book,
            "choices",
            section,
            replace(section, choices=tuple(f for f in section.choices if f != fact)),
            fact.line,
        )
    ] == []


def altered_rows(book: Book, row: StoredRow) -> Iterator[tuple[str, StoredRow]]:
    """Yield a row of the Patch AMP table with each of its facts altered in turn."""
    yield "default", replace(row, default=OUT_OF_THE_WAY)
    if row.machine or not any(only_on(book, claim, "lathe") for claim in owners_of(book, row.numbers[0])):
        yield "mark", replace(row, machine="" if row.machine else "lathe")
    for at, number in enumerate(row.numbers):
        numbers = list(row.numbers)
        numbers[at] = f"9{number}"
        yield "number", replace(row, numbers=tuple(numbers))
    if row.codes:
        for code, label in row.codes.items():
            rest = {c: said for c, said in row.codes.items() if c != code}
            yield f"code {code}", replace(row, codes=rest | {"77": label})
            yield f"code {code}", replace(row, codes=row.codes | {code: "Unheard of"})
    else:
        yield "low", replace(row, low=OUT_OF_THE_WAY)
        yield "high", replace(row, high=OUT_OF_THE_WAY)


def test_no_row_of_the_patch_table_can_be_altered_unseen(book: Book) -> None:
    exempt = {needed for e in exemptions() if e.check == "stored" for needed in e.needed_for()}
    assert [
        (row.line, what)
        for row in book.stored
        if any(owners_of(book, number) for number in row.numbers)
        for what, altered in altered_rows(book, row)
        if (row.line, f"{row.numbers[0]} {what}") not in exempt
        if set(row_of(book, altered)) <= set(row_of(book, row))
    ] == []


# -- nor an altered fact of the database ------------------------------------------------------------------


def changed(parameter_id: str, **changes: object) -> Book:
    """Return the book with one parameter of the database changed; a nested model takes a dict of its own changes."""
    compiled = load_compiled("9pc")

    def now(parameter: Parameter) -> Parameter:
        if parameter.id != parameter_id:
            return parameter
        new = {
            key: getattr(parameter, key).model_copy(update=said) if isinstance(said, Nested) else said
            for key, said in changes.items()
        }
        return parameter.model_copy(update=new)

    groups = tuple(
        group.model_copy(update={"parameters": tuple(map(now, group.parameters))})
        for group in compiled.groups
    )
    return Book(schema_of(compiled.model_copy(update={"groups": groups})), printed())


class Nested(dict[str, object]):
    """Changes to a model inside a parameter."""


HOME, LOOP, ZONES = "home.calibration", "servo.position_loop_type", "zone.group"
MM, INCH = (-999999.99, 999999.99), (-39370.07835, 39370.07835)


def choices(parameter_id: str, **first: object) -> tuple[Choice, ...]:
    """Return the choices of a parameter with its first one changed, or without it."""
    one, *rest = load_schema("9pc").parameters[parameter_id].choices or ()
    return (one.model_copy(update=first), *rest) if first else tuple(rest)


ALTERED = [
    ("numbers", HOME, {"numbers": Nested(start=1301)}, "1300"),
    ("numbers", HOME, {"name": "Homing Calibration"}, "is named 'Homing Calibration'"),
    ("numbers", HOME, {"page": "5-11"}, "has page 5-11"),
    ("numbers", HOME, {"instances": ("1", "2", "3")}, "8300"),
    ("ranges", HOME, {"ranges": {"mm": (MM[0], 999999.9), "in": INCH}}, "line 2280"),
    ("ranges", HOME, {"ranges": {"mm": MM}}, "line 2284"),
    ("ranges", HOME, {"ranges": {"mm": MM, "in": INCH, "deg": (0.0, 360.0)}}, f"{HOME} [deg]"),
    ("choices", ZONES, {"choices": choices(ZONES)}, "(a) Belongs to no groups"),
    ("choices", ZONES, {"choices": choices(ZONES, code="z")}, "(a) Belongs to no groups"),
    ("choices", ZONES, {"choices": choices(ZONES, label="Belongs to none")}, "(a) Belongs to no groups"),
    ("stored", HOME, {"default": Nested(value=1.0)}, "default 1.0 mm"),
    ("stored", HOME, {"default": None}, "has no default"),
    ("stored", HOME, {"ranges": {"mm": (MM[0], 999999.9), "in": INCH}}, "high bound 999999.99000 mm"),
    ("stored", HOME, {"storage": Nested(unit="in")}, "is kept in in"),
    ("stored", HOME, {"patchable": False}, "does not call it patchable"),
    ("stored", ZONES, {"patchable": True}, "calls it patchable"),
    ("stored", LOOP, {"choices": choices(LOOP, raw=9)}, "has no code 9"),
    ("stored", LOOP, {"default": Nested(value="off")}, "default Servo Off"),
]


@pytest.mark.parametrize(("check", "parameter_id", "changes", "told"), ALTERED)
def test_an_altered_database_is_told(
    book: Book, check: str, parameter_id: str, changes: dict[str, object], told: str
) -> None:
    new = set(CHECKS[check](changed(parameter_id, **changes))) - set(CHECKS[check](book))
    assert any(told in str(disagreement) for disagreement in new), new
