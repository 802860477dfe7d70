"""Extract the bare facts of Syntec's slides on the axis parameters from their text.

    python scripts/extract_syntec.py MANUAL.txt -o tests/manual/syntec.yaml

MANUAL.txt is the slides as plain text, a heading a slide, the cells of tables separated by tabs. Written are
parameter numbers (``21~40`` is one fact), units, defaults, ranges and values with their labels,
each with its slide and line.
"""

import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow, cut, write_facts

HEAD = (
    "Bare facts of Syntec's slides on the axis parameters, written by scripts/extract_syntec.py. "
    "Not to be edited\nby hand: where the printed text misleads, exceptions_syntec.yaml says so."
)

SPAN = r"(\d{2,4})(?:\s?[~-]\s?(?:Pr\.?\s?)?(\d{2,4}))?(?![\d/])"
DESCRIBES = re.compile(rf"\W*Pr\.?\s?{SPAN}\s?:\s?(.+)")
ROW = re.compile(r"(\d{3,4})(?:~(\d{3,4}))?\t")
MENTIONS = re.compile(
    rf"(?:\bPr\.?\s?|\bNo(?=\d{{3}})|[Pp]arameters?\s(?=\d)){SPAN}((?:,\s?\d{{2,4}}(?:-\d{{2,4}})?)*)"
)
VALUE = re.compile(r"(?<![\d:.])(\d)(?:\s?[~-]\s?(\d))?\s?:\s?(?!\d)([^:;,.)]*[^:;,.)\s])")
EXAMPLE = re.compile(rf"Pr\.?\s?{SPAN}~?\s?=\s?(\d)\s?\((\w+)\)")
TIMES = re.compile(r"((?:(?:one|two|three|four)(?:,\s|\sor\s)?)+)\stimes")
COUNTS = {"one": "1", "two": "2", "three": "3", "four": "4"}
PLACES = (
    (r"Incremental encoder _ introduction", "2.2.1"),
    (r"Incremental encoder _ Parameters", "2.2.2."),
    (r"Incremental encoder _ Operation", "2.2.3."),
    (r"Incremental encoder _ Home grid", "2.2.4."),
    (r"Incremental encoder _ Alarm", "2.2.5."),
    (r"Parameter-", "1.2."),
    (r"Setting Example", "1.3."),
    (r"DDA", "1.4."),
    (r"Alarm_", "1.5."),
    (r"Absolute encoder", "2.1."),
    (r".*Software stroke limit|G22", "3."),
    (r"MPG", "4."),
)
"""The slides have no numbers: the section that a heading belongs to, and behind the last dot the slide in
it."""

SERIES = re.compile(r"(\d+\w* series(?:; \w+)?|\d+\w/\d+\w) : (\d+)")


def bare(text: str) -> str:
    """Return a line without the marks of bold print, of raised letters and of lists."""
    return re.sub(r"<[^>]*>|\*\*|\\", "", text).strip()


def span(first: str, last: str | None) -> str:
    """Return ``21~40`` or ``2542``."""
    return f"{first}~{last}" if last else first


class Slide:
    """A slide while it is being read."""

    def __init__(self, heading: str, page: str, line: int) -> None:
        self.heading, self.page, self.line = heading, page, line
        self.described = ""
        self.name = ""
        self.numbers: list[PrintedNumber] = []
        self.ranges: list[PrintedRange] = []
        self.choices: list[PrintedChoice] = []
        self.stored: list[StoredRow] = []

    def read(self, n: int, printed: str) -> None:
        """Take the facts of one line."""
        text = bare(printed)
        if row := ROW.match(text):
            self._row(n, span(row[1], row[2]), [cell.strip() for cell in text.split("\t")])
        elif found := DESCRIBES.match(text):
            self.described, self.name = span(found[1], found[2]), cut(re.split(r"[(.]|.* is ", found[3])[0])
            self.numbers.append(PrintedNumber(line=n, number=self.described, name=self.name))
            self._values(n, found[3].partition("(")[2], self.described)
        elif self.described:
            self._below(n, text)
        for found in EXAMPLE.finditer(text):
            self.choices.append(
                PrintedChoice(line=n, letter=found[3], text=found[4], number=span(found[1], found[2]))
            )
        self._mentions(n, text)

    def _row(self, n: int, number: str, cells: list[str]) -> None:
        """Take a row of a table: number, name, range or unit, and more behind."""
        name, said, behind = cut(cells[1].partition("(")[0]), cells[2], cells[3:]
        self.numbers.append(PrintedNumber(line=n, number=number, name=name))
        if bounds := re.fullmatch(r"\[(-?\d+)~(-?\d+)\]", said):
            defaults = behind[1].split()
            self.ranges.append(
                PrintedRange(line=n, low=bounds[1], high=bounds[2], unit=behind[0], applies=number)
            )
            both = [
                StoredRow(line=n, numbers=(number,), name=name, unit=behind[0], default=one)
                for one in defaults
            ]
            self.stored += both
            return
        told = " ".join(behind)
        codes = {cut(series): value for series, value in SERIES.findall(told)}
        if said or codes:
            self.stored.append(StoredRow(line=n, numbers=(number,), name=name, unit=said, codes=codes))
        if most := re.search(r"\bmax (\d) ", told):
            self.ranges.append(PrintedRange(line=n, low="", high=most[1], applies=number))
        if not codes:
            self._values(n, told, number)

    def _below(self, n: int, text: str) -> None:
        """Take what is below the number that it is about."""
        said = text.lstrip("-•✓ ").strip()
        row = StoredRow(line=n, numbers=(self.described,), name=self.name)
        if found := re.search(r"\b[Uu]nit\s?:\s?(\S+)", said):
            self.stored.append(replace(row, unit=found[1]))
        elif found := re.match(r"Default\s?:\s?([^(]+)", said):
            self.stored.append(replace(row, default=cut(found[1])))
        elif found := TIMES.match(said.lower()):
            for word in re.findall(r"\w+", found[1].replace(" or ", " ")):
                self.choices.append(
                    PrintedChoice(line=n, letter=COUNTS[word], text="", number=self.described)
                )
        elif VALUE.match(said):
            self._values(n, said, self.described)
        elif said.startswith("Setting value\t"):
            for value in re.findall(r"\t(\d)", said):
                self.choices.append(PrintedChoice(line=n, letter=value, text="", number=self.described))

    def _values(self, n: int, text: str, number: str) -> None:
        """Take the values with their labels."""
        for first, last, label in VALUE.findall(text):
            self.choices.append(
                PrintedChoice(line=n, letter=span(first, last), text=cut(label), number=number)
            )

    def _mentions(self, n: int, text: str) -> None:
        """Take the numbers that are only mentioned."""
        here = {number.number for number in self.numbers if number.line == n}
        for first, last, more in MENTIONS.findall(text):
            others = (one.strip().replace("-", "~") for one in more.split(",") if one)
            for number in (span(first, last), *others):
                if number not in here:
                    here.add(number)
                    self.numbers.append(PrintedNumber(line=n, number=number, place="mention"))

    def facts(self) -> Section:
        """Return the slide with its facts."""
        return Section(
            heading=cut(self.heading),
            page=self.page,
            chapter=self.page.partition(".")[0],
            line=self.line,
            numbers=tuple(self.numbers),
            ranges=tuple(self.ranges),
            choices=tuple(self.choices),
            stored=tuple(self.stored),
        )


def sections(lines: Sequence[str]) -> Iterator[Section]:
    """Yield the slides that hold facts."""
    slides: list[Slide] = []
    counted: Counter[str] = Counter()
    for n, text in enumerate(lines, 1):
        if text.startswith("# "):
            heading = bare(text[2:])
            place = next((place for form, place in PLACES if re.match(form, heading, re.IGNORECASE)), "0")
            counted[place] += 1
            slides.append(Slide(heading, f"{place}{counted[place]}" if place.endswith(".") else place, n))
        elif slides and text.strip():
            slides[-1].read(n, text)
    for section in (slide.facts() for slide in slides):
        if section.numbers or section.ranges or section.choices or section.stored:
            yield section


if __name__ == "__main__":
    sys.exit(write_facts(__doc__, HEAD, lambda lines, _: sections(lines)))
