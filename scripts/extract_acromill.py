"""Extract the bare facts of AcroMill's system parameters from the text of its user's guide.

    python scripts/extract_acromill.py MANUAL.txt -o tests/manual/acromill.yaml

MANUAL.txt is the guide as plain text, the cells of tables separated by tabs. Written are the names of the
parameters of each tab, with their typical and default values and units, the values that the pictures of the
tabs show, ranges in brackets and values with their labels, the rows that the chapter on cutter compensation
repeats, and the lists of gains of appendix C, each with the tab or chapter, its page and its line.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from manual_facts import PrintedChoice, PrintedDefault, PrintedRange, Section, StoredRow, cut, write_facts

HEAD = (
    "Bare facts of AcroMill's user's guide, written by scripts/extract_acromill.py. Not to be "
    "edited by hand: where\n"
    "the printed text misleads the extractor, exceptions_acromill.yaml says so."
)

ENTRY = re.compile(r"(\S[^\t]*?)\.*\t(\d+)")
FIRST, BEHIND = "Sys Params", "P Parameters"
CHAPTERS = ["Common programming errors", "Start the Tuning procedure"]
"""Chapters with facts of the tabs' parameters."""
TABS = {
    "Servo",
    "Axes",
    "Control",
    "Home",
    "Jog",
    "I/O",
    "Speeds",
    "Compat",
    "Comm",
    "Spindle",
    "Display",
    "Tool",
    "Inputs",
    "Outputs",
    "Misc",
    "FOV",
    "ROV",
    "SOV",
    "Probe",
    "SOV Probe",
    "System Parameters",
    "Save",
    "Close",
    "Page 1",
    "Page 2",
    "I/O Logic Masks",
}
TABLE = ["Parameter", "Typical Value", "Default Value", "Units"]
UNIT = re.compile(r"Inch or mm|Radians|Integer")
"""Units of the rows that are repeated without the head of their table."""
GAIN = re.compile(r"(PGAIN|IGAIN|IDELAY|ILIMIT|DWIDTH|DGAIN|FFVEL|FFACC|TLM)\s+(\d*\.?\d+)")
SHOWN = re.compile(r"- ([^:]+): (\S.*)")
SET = re.compile(r"([A-Z][\w ]+) (NO|YES|Inches)")
RANGE = re.compile(r"\((\d+)(?:-|\.\.)(\d+)\)")
VALUE = re.compile(r"\b(\d+) ?= ?([A-Z][\w ]*\w)")


class Tab:
    """A tab while it is being read."""

    def __init__(self, heading: str, page: str, line: int) -> None:
        self.section = Section(heading=cut(heading), page=page, chapter="", line=line)
        self.ranges: list[PrintedRange] = []
        self.choices: list[PrintedChoice] = []
        self.stored: list[StoredRow] = []
        self.defaults: list[PrintedDefault] = []
        self.in_table = False

    def read(self, n: int, text: str) -> None:
        """Take the facts of one line."""
        bare = re.sub(r'<input type="\w+" value="([^"]*)"/>', r"\1", text)
        cells = [re.sub(r"<[^>]*>|\*\*", "", cell).strip() for cell in bare.split("\t")]
        if cells[:4] == TABLE:
            self.in_table = True
        elif gain := GAIN.fullmatch(text.strip()):
            self.defaults.append(PrintedDefault(line=n, number=gain[1], value=gain[2], note="in effect"))
        elif len(cells) == 1:
            self.in_table = False
            if shown := SHOWN.fullmatch(text.strip()) or SET.fullmatch(text.strip()):
                self._shown(n, shown[1], shown[2])
        elif self.in_table or (len(cells) == 5 and UNIT.fullmatch(cells[3].rstrip("."))):
            self._row(n, cells)
        elif not set(filter(None, cells)) <= TABS and cells[:2] != ["Parameter", "Value"]:
            for name, value in zip(cells[::2], cells[1::2], strict=False):
                if name and value and name not in TABS and value != "Format":
                    self._shown(n, name, value)

    def _row(self, n: int, cells: list[str]) -> None:
        """Take a row of the table of a tab."""
        name, typical, default, unit = cells[:4]
        row = StoredRow(line=n, numbers=(), name=cut(name), default=cut(default), unit=cut(unit.rstrip(".")))
        self.stored.append(replace(row, codes={"typical": cut(typical)}))
        said = " ".join(cells[4:])
        self._bounds(n, name, said)
        for value, label in VALUE.findall(said):
            self.choices.append(PrintedChoice(line=n, letter=value, text=cut(label), number=cut(name)))

    def _shown(self, n: int, name: str, value: str) -> None:
        """Take what a picture of the tab shows."""
        plain = cut(RANGE.sub("", name))
        self.stored.append(StoredRow(line=n, numbers=(), name=plain, codes={"shown": cut(value)}))
        self._bounds(n, plain, name)

    def _bounds(self, n: int, name: str, said: str) -> None:
        for low, high in RANGE.findall(said):
            self.ranges.append(PrintedRange(line=n, low=low, high=high, applies=cut(name)))

    def facts(self) -> Section:
        """Return the tab with its facts."""
        return replace(
            self.section,
            ranges=tuple(self.ranges),
            choices=tuple(self.choices),
            stored=tuple(self.stored),
            defaults=tuple(self.defaults),
        )


def sections(lines: Sequence[str], missed: list[str]) -> Iterator[Section]:
    """Yield the tabs of the system parameters and the chapters, in the order of the table of contents."""
    entries = [(n, m[1], m[2]) for n, text in enumerate(lines, 1) if (m := ENTRY.fullmatch(text.strip()))]
    first = next(i for i, (_, title, _) in enumerate(entries) if title == FIRST)
    last = next(i for i, (_, title, _) in enumerate(entries) if i > first and title == BEHIND)
    wanted = entries[first : last + 1]
    for i, (_, title, _) in enumerate(entries):
        if title in CHAPTERS:
            wanted += entries[i : i + 2]
    ends = {title for _, title, _ in wanted[last - first :]} - set(CHAPTERS)
    at = entries[last][0]
    found: list[tuple[int, str, str]] = []
    for _, title, page in wanted:
        line = next((n for n in range(at + 1, len(lines) + 1) if _heads(lines[n - 1].strip(), title)), None)
        if line is None:
            missed.append(f"no heading {title!r} (page {page})")
            continue
        found.append((line, title, page))
        at = line
    for (start, title, page), (end, _, _) in pairwise(found):
        if title in ends:
            continue
        tab = Tab(title, page, start)
        for n in range(start + 1, end):
            if lines[n - 1].strip():
                tab.read(n, lines[n - 1])
        if tab.stored or tab.ranges or tab.choices or tab.defaults:
            yield tab.facts()


def _heads(text: str, title: str) -> bool:
    """Return whether a line is the heading of an entry of the contents; the menu after one is in its line."""
    return text.startswith(title) if title == BEHIND else text.rstrip(".") == title


if __name__ == "__main__":
    sys.exit(write_facts(__doc__, HEAD, sections))
