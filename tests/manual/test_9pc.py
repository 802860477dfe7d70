"""What only the check of the 9/PC has: headings, pages and names of whole sections, and the Patch AMP
table.
"""

from collections.abc import Iterator
from dataclasses import replace

from altered import OUT_OF_THE_WAY
from book_9pc import Reference
from families import NINEPC
from manual_facts import Section, StoredRow
from patch_9pc import only_on, owners_of, row_of


def test_the_facts_are_those_of_all_chapters() -> None:
    """Chapters 3 to 34 describe parameters, 37 has the Patch AMP table,
    appendix A two numbers that it leaves out.
    """
    chapters = {section.chapter for section in NINEPC.book.sections}
    assert chapters == {*map(str, range(3, 35)), "37", "A"}


def tabled() -> Iterator[tuple[int, Section]]:
    """Yield place and section of each one with a table of numbers that no exception excuses."""
    excused = NINEPC.excused("numbers")
    for at, section in enumerate(NINEPC.book.sections):
        if any(n.place == "table" for n in section.numbers) and section.numbers[0].line not in excused:
            yield at, section


def test_no_page_can_be_altered_unseen() -> None:
    assert [
        section.heading
        for at, section in tabled()
        if not NINEPC.new_with_section("numbers", at, replace(section, page="1-1", within_page=""))
    ] == []


def test_no_name_can_be_altered_unseen() -> None:
    def renamed(section: Section) -> Section:
        numbers = tuple(replace(n, name=n.name and f"Unheard-of {n.name}") for n in section.numbers)
        return replace(section, heading="Unheard of", within="", numbers=numbers)

    assert [
        section.heading
        for at, section in tabled()
        if not NINEPC.new_with_section("numbers", at, renamed(section))
    ] == []


def altered_rows(book: Reference, row: StoredRow) -> Iterator[tuple[str, StoredRow]]:
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
            rest = {c: message for c, message in row.codes.items() if c != code}
            yield f"code {code}", replace(row, codes=rest | {"77": label})
            yield f"code {code}", replace(row, codes=row.codes | {code: "Unheard of"})
    else:
        yield "low", replace(row, low=OUT_OF_THE_WAY)
        yield "high", replace(row, high=OUT_OF_THE_WAY)


def test_no_row_of_the_patch_table_can_be_altered_unseen() -> None:
    book = NINEPC.book
    exempt = {needed for e in NINEPC.exempt if e.check == "stored" for needed in e.needed_for()}
    assert [
        (row.line, what)
        for row in book.stored
        if any(owners_of(book, number) for number in row.numbers)
        for what, altered in altered_rows(book, row)
        if (row.line, f"{row.numbers[0]} {what}") not in exempt
        if set(row_of(book, altered)) <= set(row_of(book, row))
    ] == []
