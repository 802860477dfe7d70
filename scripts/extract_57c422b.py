"""Extract the bare facts of the 57C422B 2-Axis Servo Module's manual from its text.

    python scripts/extract_57c422b.py MANUAL.txt -o tests/manual/57c422b.yaml

MANUAL.txt is the scanned manual as plain text. Written are the registers of the headings and of the text
(``11,12`` is one value of two registers, ``68/69`` are two alike, ``99-103`` a span), bits, names of
commands, bounds, units and defaults, each with its section and line. Bit layouts are in figures,
which the text has not.
"""

import re
import sys
from collections.abc import Iterator, Sequence

from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow, cut, write_facts

HEAD = (
    "Bare facts of the 57C422B 2-Axis Servo Module's manual, written by "
    "scripts/extract_57c422b.py. Not to be\n"
    "edited by hand: where the scanned text misleads the extractor, exceptions_57c422b.yaml says "
    "so."
)

LIST_OF_FIGURES = "List of Figures"
ENTRY = re.compile(r"([45]\.\d+(?:\.\d+)?) ?(\D.*)")
ENTRY_PAGE = re.compile(r"(\d-\d+)$")
HEADING = re.compile(r"([45]\.\d+(?:\.\d+)?) (\D.+)")
HEADED = re.compile(r"Registers? (\d[\d,/ -]*): ?(.+)")
END_OF_PART = "CHAPTER 6"

LIST = r"\d+(?:(?:, and |, ?|/| and | ?- ?| through )\d+(?![\d.]))*"
MENTION = re.compile(rf"\b[Rr]egisters? (?P<words>{LIST})|\bR(?P<short>\d+(?:, ?\d+)?)")
PROGRAM = re.compile(r"(?:.*[=!] )?\d{4,5} ")
SET = re.compile(r"\b(CMD66%|CMD67%|COMMAND%|CAM_MODE%|MODES%)(?: ?= ?| OR )(\d[\dA-F]*H|[1-9]\d*)\b(?! O?H)")
SET_REGISTERS = {"CMD66%": "66", "CMD67%": "67", "COMMAND%": "66", "CAM_MODE%": "130"}
"""The variables of the printed programs that set bits; the others are those of register 65."""

AXIS = re.compile(r" ?(?:[(\[]|for the )([XY])[ -]axis")
BITS = (
    re.compile(r"\b[Rr]egister (?P<register>\d+),? bits? (?P<bits>\d+(?:(?: and | or )\d+)*)"),
    re.compile(r"\bR(?P<register>\d+), ?b(?P<bits>\d+)"),
    re.compile(r"\bbit \((?P<bits>\d+)\) in register (?P<register>\d+)"),
    re.compile(r"\b[Bb]its? (?P<bits>\d+) (?:in|of) register (?P<register>\d+)"),
)
OWN_BITS = re.compile(r"\b[Bb]its? (\d+(?: and \d+)*)\b(?! in register)")
NAMED = re.compile(r"[\"“]([a-z][^\"“”,]{3,40})[\"”]\s?(?:commands? |bit )?(?:in |\()(?:register |R)(\d+)")

SIGNED = r"-?\.?\d[\d,.]*\d|-?\d"
BOUNDS = (
    (re.compile(rf"(?P<applies>\w+ )?values? may range from (?P<low>{SIGNED}) to (?P<high>{SIGNED})"), ""),
    (re.compile(rf"maximum speed that can be programmed is (?P<high>{SIGNED}) (?P<unit>[\w/]+)"), ""),
    (re.compile(r"maximum programmed value is (?P<high>[\d.]+ x 10\d+) (?P<unit>[\w/ ]+/sec)"), ""),
    (re.compile(rf"must not exceed (?P<high>{SIGNED})"), ""),
    (re.compile(rf"must be greater than or equal to (?P<low>{SIGNED})"), ""),
    (re.compile(rf"maximum of (?P<high>{SIGNED}) (?P<applies>\w+)"), "count"),
    (re.compile(r"ratio range is (?P<low>\d+:\d+) to (?P<high>\d+:\d+)"), "ratio"),
    (re.compile(r"between (?P<low>\.?\d+ to \d+) and (?P<high>\d+ to \d+)"), "ratio"),
)
DEFAULTS = (
    re.compile(r"default value of R(?P<register>\d+) is (?P<value>-?\d+)"),
    re.compile(r"default value \((?P<value>-?\d+)\)"),
    re.compile(r"Initially, this value should be set to (?P<value>-?\d+)"),
    re.compile(r"[Tt]?h?e? ?default \((?P<value>-?\d+)\)"),
)
UNITS = (
    re.compile(r"in units of ([\w ]+)\."),
    re.compile(r"\(in (counts)\)"),
    re.compile(r"value is in (counts)"),
    re.compile(r"The unit is (\w+)\."),
    re.compile(r"equation is in (counts/\w+)"),
    re.compile(r"^\(?(encoder counts/sec)\) ?\* ?65\.536"),
    re.compile(r"number of (scans) "),
)


def registers(printed: str) -> str:
    """Return a list of registers in its short form: ``11,12``, ``68/69``, ``99-103``."""
    short = re.sub(r",? and ", ",", printed.replace(" through ", "-"))
    return short.replace(" ", "").strip(",")


def paged(lines: Sequence[str]) -> dict[str, str]:
    """Return section -> page, from the table of contents."""
    pages: dict[str, str] = {}
    section = ""
    for text in lines:
        if entry := ENTRY.match(text):
            section = entry[1]
        if section and (page := ENTRY_PAGE.search(text.rstrip())):
            pages[section], section = page[1], ""
    return pages


class Part:
    """A numbered section while it is being read."""

    def __init__(self, heading: str, page: str, line: int) -> None:
        found = HEADED.fullmatch(heading)
        self.heading, self.page, self.line = cut(found[2] if found else heading), page, line
        self.number = registers(found[1]) if found else ""
        self.numbers: list[PrintedNumber] = []
        self.ranges: list[PrintedRange] = []
        self.choices: list[PrintedChoice] = []
        self.stored: list[StoredRow] = []
        if found:
            self.numbers.append(PrintedNumber(line=line, number=self.number, name=self.heading))

    def read(self, n: int, text: str) -> None:
        """Take the facts of one line."""
        self._mentions(n, text)
        self._bits(n, text)
        elsewhere = text
        for form in BITS:
            elsewhere = form.sub("", elsewhere)
        if self.number.isdigit():
            for found in OWN_BITS.finditer(elsewhere):
                for bit in re.findall(r"\d+", found[1]):
                    self.choices.append(PrintedChoice(line=n, letter=bit, text="", number=self.number))
        for name, number in NAMED.findall(text):
            self.choices.append(PrintedChoice(line=n, letter="", text=cut(name), number=number))
        for form, note in BOUNDS:
            for found in form.finditer(text):
                said = found.groupdict()
                low, high, unit = (said.get(key) or "" for key in ("low", "high", "unit"))
                applies = said.get("applies") or ""
                what = applies.strip() if applies.strip() not in {"The", "the"} else ""
                low, high = low.replace(",", ""), high.replace(",", "")
                self.ranges.append(
                    PrintedRange(line=n, low=low, high=high, unit=unit, applies=what, note=note)
                )
        if "cannot be a negative number" in text and not (self.ranges and self.ranges[-1].low):
            note = "nor 0" if "cannot be a negative number or 0" in text else ""
            self.ranges.append(PrintedRange(line=n, low="0", high="", note=note))
        self._stored(n, text)

    def run(self, n: int, text: str) -> None:
        """Take the bits that a line of a program sets."""
        for name, value in SET.findall(text):
            word = int(value[:-1], 16) if value.endswith("H") else int(value)
            for bit in range(word.bit_length()):
                if word >> bit & 1:
                    number = SET_REGISTERS.get(name, "65")
                    self.choices.append(PrintedChoice(line=n, letter=str(bit), text="", number=number))
        self._bits(n, text)

    def _bits(self, n: int, text: str) -> None:
        for form in BITS:
            for found in form.finditer(text):
                for bit in re.findall(r"\d+", found["bits"]):
                    self.choices.append(PrintedChoice(line=n, letter=bit, text="", number=found["register"]))

    def _mentions(self, n: int, text: str) -> None:
        here: set[tuple[str, str]] = set()
        for found in MENTION.finditer(text):
            number = registers(found["words"] or found["short"])
            axis = AXIS.match(text, found.end())
            one = number, axis[1] if axis else ""
            if number != self.number and one not in here:
                here.add(one)
                self.numbers.append(PrintedNumber(line=n, number=number, axis=one[1], place="mention"))

    def _stored(self, n: int, text: str) -> None:
        if not self.number:
            return
        found = next((match for form in DEFAULTS if (match := form.search(text))), None)
        unit = next((match for form in UNITS if (match := form.search(text))), None)
        if found or unit:
            said = (found["value"] if found else ""), (cut(unit[1]) if unit else "")
            row = StoredRow(line=n, numbers=(self.number,), name=self.heading, default=said[0], unit=said[1])
            self.stored.append(row)

    def facts(self) -> Section:
        """Return the section with its facts."""
        return Section(
            heading=self.heading,
            page=self.page,
            chapter=self.page[0],
            line=self.line,
            numbers=tuple(self.numbers),
            ranges=tuple(self.ranges),
            choices=tuple(self.choices),
            stored=tuple(self.stored),
        )


def headline(lines: Sequence[str], n: int, title: str) -> str:
    """Return a heading with its words on the next line."""
    following = lines[n].strip() if n < len(lines) else ""
    broken = re.fullmatch(r"[A-Z]\w+(?: [A-Z]\w+){0,2}", following)
    return f"{title.strip()} {following}" if broken else title.strip()


def sections(lines: Sequence[str], missed: list[str]) -> Iterator[Section]:
    """Yield the sections of the two chapters on the registers."""
    start = next(n for n, text in enumerate(lines) if text.strip() == LIST_OF_FIGURES)
    end = next(n for n, text in enumerate(lines) if n > start and text.strip() == END_OF_PART)
    pages = paged(lines[:start])
    parts: list[Part] = []
    begun: set[str] = set()
    for n, text in enumerate(lines[start:end], start + 1):
        found = HEADING.fullmatch(text.strip())
        if found and found[1] in pages and found[1] not in begun and not text.strip().endswith("."):
            begun.add(found[1])
            parts.append(Part(headline(lines, n, found[2]), pages[found[1]], n))
        elif parts and PROGRAM.match(text):
            parts[-1].run(n, text)
        elif parts:
            parts[-1].read(n, text)
    missed += [f"no heading {key} (page {page})" for key, page in pages.items() if key not in begun]
    yield from (part.facts() for part in parts)


if __name__ == "__main__":
    sys.exit(write_facts(__doc__, HEAD, sections))
