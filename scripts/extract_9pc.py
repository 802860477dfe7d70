"""Extract the bare facts of the 9/PC AMP Reference Manual from its text.

    python scripts/extract_9pc.py MANUAL.txt -o tests/manual/9pc.yaml

MANUAL.txt is the scanned manual as plain text, the cells of its tables separated by tabs. Written are
parameter numbers, ranges, choices and the rows of the Patch AMP table, each with its section and line. What
looks like a fact and is not understood is reported on stderr;
``tests/manual`` compares the database with the rest.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from manual_facts import (
    Fact,
    PrintedChoice,
    PrintedNumber,
    PrintedRange,
    Section,
    StoredRow,
    cut,
    write_facts,
)

HEAD = (
    "Bare facts of the 9/PC AMP Reference Manual, written by scripts/extract_9pc.py. Not to be "
    "edited by hand:\nwhere the scanned text misleads the extractor, exceptions_9pc.yaml says so."
)

CONTENTS_ENTRY = re.compile(r"^(\S[^\t]*)\t(\d+-\d+|[A-Z]-\d+)$")
LAST_CONTENTS_PAGE = "B-3"
PATCH_HEADING = "Patch AMP Values"

NUMBER = re.compile(r"[-+]?(?:\d[\d,]*)?\.?\d+")
UNIT = (
    r"(?:mm|inch|in|deg)/(?:min/)?sec(?:/sec)*|(?:mm|in)/min(?:/sec)?|mm/s(?:/s)*|mm/m|mmpm|ipm|mm|inches|inch|in\.?"
    r"|degrees?|volts(?: dc)?|rpm|RPM|%|msec|ms|seconds|sec|Hz|Amps|thread leads|threads"
)
TABLE_NUMBER = re.compile(r"\[(\d+)\]|(\d+)(?= \((?:single process|process \d)\))")
ONLY_NUMBERS = re.compile(rf"(?:(?:{TABLE_NUMBER.pattern})\s*(?:\([^)]*\))?\s*)+")
HEADED = {"axis": "axis", "spindle": "spindle", "parameter": "name", "deskew": "pair"}
COLUMNS = {
    "mill": "machine",
    "lathe": "machine",
    "single process": "process",
    "process 1": "process",
    "process 2": "process",
}
LONGEST_RANGE_IN_WORDS = 50
PROSE = re.compile(r"(?:The|This|These|Set|If|When|Use|Refer|You|Important)\b")


@dataclass
class Draft:
    """A section while it is being read."""

    heading: str
    page: str
    line: int
    lines: list[tuple[int, str]] = field(default_factory=list)

    def describes(self) -> bool:
        """Return whether the heading is that of a parameter: "Function" is below it or follows it."""
        return any(text.replace("*", "").endswith("Function") for _, text in self.lines[:4])

    def facts(self) -> Section:
        """Return the section with its facts."""
        chapter = self.page.partition("-")[0]
        head = Section(heading=cut(self.heading), page=self.page, chapter=chapter, line=self.line)
        if self.heading == PATCH_HEADING:
            return replace(head, stored=tuple(patch_rows(self.lines)))
        numbers = (*table_numbers(self.lines), *loose_numbers(self.lines), *screen_numbers(self.lines))
        under_range = range_part(self.lines)
        return replace(
            head,
            numbers=tuple(sorted(numbers, key=lambda n: (n.line, int(n.number)))),
            ranges=tuple(ranges(under_range)),
            choices=(*screen_choices(self.lines), *choices(under_range)),
        )


# -- sections ---------------------------------------------------------------------------------------------


def squashed(text: str) -> str:
    """Return letters, digits and signs in lower case: a scan loses blanks and adds them."""
    return re.sub(r"[^a-z0-9+%#]", "", text.replace("**Function**", "").lower())


def sections(lines: Sequence[str], missed: list[str]) -> Iterator[Section]:
    """Yield the sections that hold facts, in the order of the contents list."""
    entries = [(n, m[1], m[2]) for n, text in enumerate(lines, 1) if (m := CONTENTS_ENTRY.match(text))]
    titles = [entry for entry in entries if entry[1] != "Function"]  # a part of every section, listed once
    last = next((i for i, (_, _, page) in enumerate(titles) if page == LAST_CONTENTS_PAGE), len(titles) - 1)
    drafts: list[Draft] = []
    at = titles[last][0]
    for _, title, page in titles[: last + 1]:
        found = next((n for n in range(at + 1, len(lines) + 1) if is_heading(lines, n, title)), None)
        if found is None:
            missed.append(f"no heading {title!r} (page {page})")
            continue
        drafts.append(Draft(title, page, found))
        at = found
    ends = [*(draft.line for draft in drafts[1:]), len(lines) + 1]
    above: Section | None = None
    for draft, end in zip(drafts, ends, strict=True):
        draft.lines = [(n, lines[n - 1].rstrip("\n")) for n in range(draft.line, end)]
        section = draft.facts()
        if draft.describes():
            above = section
        elif above and not above.numbers and above.page.startswith(f"{section.chapter}-"):
            section = replace(section, within=above.heading, within_page=above.page)
        missed += unread(draft.lines, section)
        if section.numbers or section.ranges or section.choices or section.stored:
            yield section


def is_heading(lines: Sequence[str], n: int, title: str) -> bool:
    """Return whether line ``n`` is the heading ``title``, alone or broken over two lines."""
    line = lines[n - 1].strip()
    if not line or "\t" in line or line.startswith("- ") or lines[n - 2].strip():
        return False
    following = lines[n].strip() if n < len(lines) else ""
    return squashed(title) in {squashed(line), squashed(line + following)}


def unread(lines: Sequence[tuple[int, str]], section: Section) -> Iterator[str]:
    """Yield the lines that look like facts and gave none."""
    facts: tuple[Fact, ...] = (*section.numbers, *section.ranges, *section.choices, *section.stored)
    read = {fact.line for fact in facts}
    ranged = {n for n, _ in range_part(lines)}
    if [text.strip() for _, text in lines].count("Range") > 1:
        yield f"line {section.line}: more than one range under {section.heading!r}: was a heading overlooked?"
    for n, text in lines:
        looks = re.search(r"\[\d+\]", text) or (n in ranged and re.search(r"\d\S* to |^\(\w\)", text))
        if n not in read and (looks or (section.stored and re.match(r"\d+.*\t", text))):
            yield f"line {n} not read: {text.strip()[:90]!r}"


# -- numbers ----------------------------------------------------------------------------------------------


def table_numbers(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedNumber]:
    """Yield the numbers of the tables, each with the names of its row and its column."""
    heads: list[str] = []
    columns: list[str] = []
    above: dict[str, str] = {}
    for n, text in lines:
        cells = [cell.strip() for cell in text.split("\t")]
        if len(cells) < 2:
            heads, columns, above = [], [], {}
        elif any(cell.lower().endswith("number") for cell in cells) and not TABLE_NUMBER.search(text):
            heads, columns, above = [cell.lower() for cell in cells], [], {}
        elif heads and not TABLE_NUMBER.search(text) and any(cell.lower() in COLUMNS for cell in cells):
            columns = [cell.lower() for cell in cells]
        elif heads:
            yield from row_numbers(n, cells, heads, columns, above)


def row_numbers(
    n: int, cells: list[str], heads: list[str], columns: list[str], above: dict[str, str]
) -> Iterator[PrintedNumber]:
    """Yield the numbers of one row; ``above`` keeps what a blank cell below repeats."""
    said: dict[str, str] = {}
    found: list[PrintedNumber] = []
    for at, cell in enumerate(cells):
        head = heads[at] if at < len(heads) else ""
        if ONLY_NUMBERS.fullmatch(cell):
            column = columns[at] if at < len(columns) else ""
            here = {COLUMNS[column]: column} if column in COLUMNS else {}
            for match in re.finditer(rf"(?:{TABLE_NUMBER.pattern})\s*(?:\(([^)]*)\))?", cell):
                process = {"process": match[3]} if match[3] in COLUMNS else {}
                place = above | said | here | process
                found.append(PrintedNumber(line=n, number=match[1] or match[2], **place))
        elif cell and head == "control type":
            found = [replace(number, machine=cell.lower()) for number in found]
        elif cell and head == "parameter name":
            found = [replace(number, name=cut(cell)) for number in found]
        elif cell and (kind := HEADED.get(head, "axis" if head.endswith("axis number") else "")):
            said[kind] = re.sub(r"^(?:Axis )?\((\d)\)$", r"\1", cut(cell))
    above |= {kind: value for kind, value in said.items() if kind != "name"}
    yield from found


def loose_numbers(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedNumber]:
    """Yield the numbers alone under "Parameter Number", and those only mentioned: "[777]", "# 86"."""
    headed = False
    for n, text in lines:
        line = text.strip()
        if match := re.match(r"# (\d+)\t", line):
            yield PrintedNumber(line=n, number=match[1], place="mention")
        if "\t" in line or not line:
            continue
        if match := re.fullmatch(r"\[(\d+)\]" if not headed else r"\[?(\d+)\]?", line):
            yield PrintedNumber(line=n, number=match[1])
        else:
            found = re.findall(r"\[(\d+)\]", line)
            yield from (PrintedNumber(line=n, number=number, place="mention") for number in found)
        headed = re.sub(r"\*", "", line).endswith("Number")


def screens(lines: Sequence[tuple[int, str]]) -> Iterator[tuple[int, str, str]]:
    """Yield line, name and number of each picture of the editor that shows one parameter (``Name : 250``)."""
    for n, text in lines:
        if match := re.fullmatch(r"([A-Z][^\t:]*?) : (\d+)\t", text):
            yield n, match[1], match[2]


def screen_numbers(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedNumber]:
    """Yield the numbers of the screens."""
    for n, name, number in screens(lines):
        yield PrintedNumber(line=n, number=number, name=cut(name), place="screen")


def screen_choices(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedChoice]:
    """Yield the choices of the screens; the one the cursor is on shows no letter."""
    texts = dict(lines)
    for n, _, number in screens(lines):
        at = n + 1
        while match := re.fullmatch(r"([^\t]+)\t(?:[<(](\w)[>)])?", texts.get(at, "")):
            said = cut(match[1].replace("\\$", "$"))
            yield PrintedChoice(line=at, letter=match[2] or "", text=said, number=number)
            at += 1


# -- ranges and choices -----------------------------------------------------------------------------------


def range_part(lines: Sequence[tuple[int, str]]) -> list[tuple[int, str]]:
    """Return the lines between "Range" and "Notes"."""
    start = next((i for i, (_, text) in enumerate(lines) if text.strip() == "Range"), len(lines))
    end = next((i for i, (_, text) in enumerate(lines) if i > start and text.strip() == "Notes"), len(lines))
    return list(lines[start + 1 : end])


def applies_to(text: str) -> str | None:
    """Return what a line such as "Range for the connector parameters:" announces."""
    match = re.fullmatch(r"Range for (?:the )?(.*):", text.strip())
    return cut(match[1]) if match else None


def ranges(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedRange]:
    """Yield the range lines, one range for each unit."""
    applies = ""
    for n, text in lines:
        applies = applies_to(text) or applies
        if PROSE.match(text) or text.startswith("(") or text.count("\t") > 1:
            continue
        label, _, body = text.strip().rpartition(":\t")
        body = re.sub(r",?\s+or$|(?<!in)\s*\.$", "", body)
        for part, behind in clauses(body):
            for found in range_of(part):
                unit, note = found.unit, cut(f"{found.note} {behind}".strip())
                if re.fullmatch(UNIT, behind):
                    unit, note = behind, ""
                yield replace(found, line=n, unit=unit, note=note, applies=label or applies)


def clauses(body: str) -> list[tuple[str, str]]:
    """Return the ranges of a line, each with the words in brackets at its end."""
    match = re.fullmatch(r"(.*?)\s*\(([^()]*)\)", body)
    body, behind = (match[1], match[2]) if match else (body, "")
    if both := re.fullmatch(rf"(\S+) to (\S+ (?:{UNIT}))/(\S+ (?:{UNIT}))", body):
        return [(f"{both[1]} to {high}", behind) for high in both.groups()[1:]]
    return [(part, behind) for part in re.split(rf"\s+or\s+(?={NUMBER.pattern} to )", body)]


def range_of(part: str) -> Iterator[PrintedRange]:
    """Yield ``LOW to HIGH`` once for each unit that is at either bound."""
    low, to, high = part.partition(" to ")
    lows, highs = bound(low), bound(high)
    words = not NUMBER.match(low) and not NUMBER.match(high)
    if not to or (words and (len(part) > LONGEST_RANGE_IN_WORDS or not high[:1].isupper())):
        return
    units = dict.fromkeys(unit for _, unit, _ in (*lows, *highs) if unit) or {"": None}
    for unit in units:
        first, last = (next((b for b in side if b[1] in {unit, ""}), side[0]) for side in (lows, highs))
        yield PrintedRange(line=0, low=first[0], high=last[0], unit=unit, note=last[2] or first[2])


def bound(text: str) -> list[tuple[str, str, str]]:
    """Return value, unit and the words behind, once for each unit ("0.0001 mm or .0001 degree")."""
    match = re.match(rf"({NUMBER.pattern})(?:\s?({UNIT})(?![\w/]))?", text)
    if not match:
        return [(cut(text), "", "")]
    found = [(match[1], match[2] or "")]
    rest = text[match.end() :]
    while more := re.match(rf" or (?:({NUMBER.pattern}) )?({UNIT})(?![\w/])", rest):
        found.append((more[1] or found[0][0], more[2]))
        rest = rest[more.end() :]
    words = rest.strip(" .")
    return [(plain(value), unit, words if len(words) <= 60 else "") for value, unit in found]


def plain(number: str) -> str:
    """Return a number without the commas of thousands and with a digit before the point."""
    return re.sub(r"^([-+]?)\.", r"\g<1>0.", number.replace(",", "")).lstrip("+")


def choices(lines: Sequence[tuple[int, str]]) -> Iterator[PrintedChoice]:
    """Yield letter and text of every row of a table of choices, in the order of the letters."""
    applies, found = "", []
    for n, text in lines:
        applies = applies_to(text) or applies
        cells = [cell.strip() for cell in text.split("\t")]
        for at, cell in enumerate(cells):
            match = re.fullmatch(r"\(([a-z])\)(?: (.+))?", cell)
            said = (match[2] or (cells[at + 1] if at + 1 < len(cells) else "")) if match else ""
            if match and said:
                said = cut(said.replace("\\$", "$"))
                found.append(PrintedChoice(line=n, letter=match[1], text=said, applies=applies))
    yield from sorted(found, key=lambda choice: choice.letter)


# -- the Patch AMP table ----------------------------------------------------------------------------------


def patch_rows(lines: Sequence[tuple[int, str]]) -> Iterator[StoredRow]:
    """Yield the rows of the Patch AMP table."""
    for n, text in lines:
        cells = [cell.strip() for cell in text.split("\t")]
        if len(cells) != 4 or not (head := re.fullmatch(r"(\d+(?: \d+)*)( \^L)?", cells[0])):
            continue
        row = StoredRow(
            line=n,
            numbers=tuple(head[1].split()),
            name=cut(cells[1]),
            default=cut(cells[2]),
            machine="lathe" if head[2] else "",
        )
        yield stored(row, cells[3].replace("\\$", "$"))


def stored(row: StoredRow, said: str) -> StoredRow:
    """Return the row with its bounds or its codes."""
    codes = re.findall(r"(?:^|(?<=\s))(-?\d+) ?- (\S.*?)(?=\s-?\d+ ?- |$)", said)
    if codes:
        return replace(row, codes={code: cut(label) for code, label in codes})
    found = next(ranges([(row.line, said)]), None)
    if found is None:
        return row
    return replace(row, low=found.low, high=found.high, unit=cut(f"{found.unit} {found.note}"))


if __name__ == "__main__":
    sys.exit(write_facts(__doc__, HEAD, sections))
