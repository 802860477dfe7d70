"""Extract the bare facts of the NUM 1020/1040/1060 Parameter Manual from its text.

    python scripts/extract_num.py MANUAL.txt -o tests/manual/num.yaml

MANUAL.txt is the scanned manual as plain text, the cells of its tables separated by tabs. Written are the
list of chapter 2 and, of every section, the words and bits it names, their codes, bounds and defaults, each
with its line. Sections whose heading the scan lost, and lines that look like facts and gave none,
are reported on stderr.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from manual_facts import (
    ListedParameter,
    PrintedChoice,
    PrintedDefault,
    PrintedRange,
    PrintedSize,
    PrintedWord,
    Section,
    cut,
    write_facts,
)

HEAD = (
    "Bare facts of the NUM 1020/1040/1060 Parameter Manual, written by scripts/extract_num.py. "
    "Not to be edited by\nhand: where the scanned text misleads the extractor, "
    "exceptions_num.yaml says so."
)

CONTENTS_ENTRY = re.compile(r"^(\d+(?:\.\d+)?)\s+(\S.*?)\s+(\d+) - (\d+)$")
HEADING = re.compile(r"(?:#+ )?(\d+(?:\.\d+)?) (\S.*)")
LISTED = re.compile(r"(P\d+)\t([^\t\d]*)\t(\d?)\t([^\t]*)(?:\t(.*))?")
TYPE = re.compile(r"(\d)\t[^\t]+\t[^\t]+\t((?:[\dA-F, ]|[-+])+?(?:-| to )[-+\dA-F, ]+)")
FILE_LINE = re.compile(r"P(\d+)N(\d+):t(\d)n(\d+);")

PARAMETER = re.compile(r"\bP(\d+)(?:-P(\d+))?\b")
RUN = r"N?(?:\d+|o\b)(?!\.\d)(?:\s*(?:-|to|and|,|or|or word|, [Ww]ord)\s*N?\d+\b)*"
WORDS = re.compile(rf"\b(?:[Ww]ords?|WORDS?)(?: \}})? ({RUN})|(?<![\w.])(N\d+(?:\s*(?:-|to)\s*N?\d+)?)\b")
OF = re.compile(r"[^.;]{0,12}?\b(?:of|in) (?:machine )?(?:parameter )?P(\d+)\b")
GAP = 25
"""At most so many letters are between a parameter and its word ("P7, word 0")."""
WORD_HEADING = re.compile(r"(?:#+ |\*\*)?(?:Words?|WORD) N?[\do][^\t]*")
CODE = re.compile(r"((?:[01]\t)+):? ?([^\t]*[a-zA-Z][^\t]*)")
BITS = re.compile(r"\b[Bb]its? (\d+)(?:\s*(?:-|to|à|et|and)\s*(\d+))?")

VALUE = r"(\\?\$[\dA-F]+|[\d,]+(?: \d{4})?)"
UNIT = (
    r"(?:\s*(\$\\mu\\text\{m\}\$|\$\\mu\$ ?s|\$\\mu\\text\{s\}\$|[µμ][ms]|ms|ns|mV|rpm|%|KB|blocks|points))?"
)
DEFAULTS = (
    re.compile(
        r"(?i)\b(default|basic) values?(?: initialised)?(?: of parameter P\d+)?(?: of| is| forced to|:)"
        rf" ?(?:{VALUE}|(zero)){UNIT}"
    ),
    re.compile(rf"(?:{VALUE}|(zero)){UNIT} \((default)(?: value)?\)"),
    re.compile(rf"\((default) {VALUE}\)"),
)
RANGES = (
    re.compile(rf"\bbetween {VALUE}{UNIT}\s+and {VALUE}{UNIT}"),
    re.compile(rf"\bis from {VALUE}{UNIT}\s+to {VALUE}{UNIT}"),
    re.compile(rf"^Word N\d+ .*\({VALUE}{UNIT} to {VALUE}{UNIT}\)"),
    re.compile(rf"minimum [a-z ]+ is {VALUE}{UNIT}\s+and the maximum[a-z ]+ is {VALUE}{UNIT}"),
    re.compile(rf"less than {VALUE}{UNIT} nor greater than {VALUE}{UNIT}"),
    re.compile(rf"^- {VALUE}() to {VALUE}() for "),
)
LOWS = (re.compile(rf"{VALUE}{UNIT} is the lowest"),)
HIGHS = (
    re.compile(rf"{VALUE}{UNIT} is the highest"),
    re.compile(rf"less than or equal to {VALUE}{UNIT}"),
    re.compile(rf"[Mm]aximum of {VALUE}{UNIT}"),
    re.compile(rf"number is limited to {VALUE}{UNIT}"),
    re.compile(rf"coefficients must be\s+\$?< ?{VALUE}()"),
)
ONE_VALUE = re.compile(rf"^- {VALUE} for ")
LOOKS = re.compile(r"\bdefault values?\b(?! is set)|\brange of permissible\b|\bbasic value\b")


@dataclass
class Draft:
    """A section while it is being read; ``about`` and ``word`` are those the last lines spoke of."""

    heading: str
    page: str
    line: int
    parameter: str = ""
    about: str = ""
    word: str = ""
    sizes: list[PrintedSize] = field(default_factory=list)
    words: list[PrintedWord] = field(default_factory=list)
    bits: list[PrintedWord] = field(default_factory=list)
    defaults: list[PrintedDefault] = field(default_factory=list)
    choices: list[PrintedChoice] = field(default_factory=list)
    ranges: list[PrintedRange] = field(default_factory=list)
    listed: list[ListedParameter] = field(default_factory=list)

    def facts(self) -> Section:
        """Return the section with its facts."""
        return Section(
            heading=cut(self.heading),
            page=self.page,
            chapter=self.page.partition("-")[0],
            line=self.line,
            parameter=self.parameter,
            listed=tuple(self.listed),
            sizes=tuple(self.sizes),
            words=tuple(dict.fromkeys(self.words)),
            bits=tuple(dict.fromkeys(self.bits)),
            defaults=tuple(self.defaults),
            ranges=tuple(self.ranges),
            choices=tuple(self.choices),
        )


# -- sections ---------------------------------------------------------------------------------------------


def squashed(text: str) -> str:
    """Return letters and digits in lower case: a scan loses blanks and adds them."""
    return re.sub(r"[^a-z0-9]", "", text.lower())


def sections(lines: Sequence[str], missed: list[str]) -> Iterator[Section]:
    """Yield the sections that hold facts."""
    plain = [re.sub(r"</?b>", "", text).strip("\t ") for text in lines]
    contents = {
        m[1]: (m[2], f"{m[3]}-{m[4]}") for text in reversed(plain) if (m := CONTENTS_ENTRY.match(text))
    }
    listed = [row for n, text in enumerate(lines, 1) if (row := listed_row(n, text))]
    described = {row.page: row.number for row in listed}
    drafts = [Draft("Record of Revisions", "", 1)]
    seen = set()
    for n, text in enumerate(plain, 1):
        match = HEADING.fullmatch(text)
        title, page = contents.get(match[1], ("", "")) if match else ("", "")
        if match and squashed(title) == squashed(match[2]) and "\t" not in text:
            drafts.append(Draft(title, page, n, described.get(page, "")))
            seen.add(match[1])
        read_line(drafts[-1], n, text, lines, missed)
    missed += [
        f"no heading {number} {title!r} (page {page})"
        for number, (title, page) in sorted(contents.items(), key=lambda entry: page_order(entry[1][1]))
        if number not in seen
    ]
    for draft in drafts:
        section = draft.facts()
        if any(
            (section.listed, section.sizes, section.words, section.bits, section.defaults, section.ranges)
        ):
            yield section


def page_order(page: str) -> tuple[int, ...]:
    """Return what sorts pages."""
    return tuple(map(int, page.split("-")))


def listed_row(n: int, text: str) -> ListedParameter | None:
    """Return a row of the list of chapter 2."""
    match = LISTED.fullmatch(text)
    if not match:
        return None
    page = (match[5] or "").strip()
    return ListedParameter(
        line=n, number=match[1], category=match[2], type=match[3], name=cut(match[4]), page=page
    )


def read_line(draft: Draft, n: int, text: str, lines: Sequence[str], missed: list[str]) -> None:
    """Add the facts of one line."""
    if row := listed_row(n, lines[n - 1]):
        draft.listed.append(row)
        return
    if match := FILE_LINE.match(text):
        size = PrintedSize(line=n, number=f"P{match[1]}", words=int(match[4]), type=match[3], place="listing")
        draft.sizes.append(size)
        return
    if match := re.fullmatch(r"No\. of words\t(\d+)", text):
        kind = re.match(r"Type (\d)", lines[n - 2])
        category = lines[n - 3].partition("\t")[2]
        draft.sizes.append(
            PrintedSize(
                line=n,
                number=draft.parameter,
                words=int(match[1]),
                type=kind[1] if kind else "",
                category=category,
            )
        )
        return
    named = list(PARAMETER.finditer(text))
    if re.match(r"#+ ", text) and draft.parameter:
        draft.about = draft.parameter
    if named and not draft.parameter:
        draft.about = f"P{named[-1][1]}"
    if match := TYPE.fullmatch(text):
        low, high = re.split(r"(?<=\w)-| to ", match[2])
        place, bounds = f"type {match[1]}", (value_of(low), value_of(high).lstrip("+"))
        draft.ranges.append(PrintedRange(line=n, low=bounds[0], high=bounds[1], applies=place))
        return
    if match := re.fullmatch(r"Setting P(\d+)", text):
        draft.about = f"P{match[1]}"
    about = draft.about or draft.parameter
    read_words(draft, n, text, named, about)
    read_bits(draft, n, text, named, about)
    before = len(draft.defaults) + len(draft.ranges)
    if draft.parameter:
        read_defaults(draft, n, text, lines)
        read_ranges(draft, n, text)
        if LOOKS.search(text) and before == len(draft.defaults) + len(draft.ranges):
            missed.append(f"line {n} not read: {text[:90]!r}")


# -- words and bits ---------------------------------------------------------------------------------------


def runs(text: str) -> Iterator[str]:
    """Yield ``N0-N31``, ``N5`` ... for "N0 to N31", "0, 1 and 2", "N1, word N3"."""
    text = re.sub(r"\bNo\b", "N0", text)
    for match in re.finditer(r"N?(\d+)(?:\s*(?:-|to)\s*N?(\d+))?", text):
        first, last = int(match[1]), int(match[2] or match[1])
        yield f"N{first}" if first == last else f"N{first}-N{last}"


def owners(
    text: str, named: list[re.Match[str]], start: int, end: int, about: str, parameter: str
) -> list[str]:
    """Return the parameters that the words printed from ``start`` to ``end`` belong to."""
    if match := OF.match(text, end):
        return [f"P{match[1]}"]
    near = [m for m in named if m.end() <= start and "." not in text[m.end() : start]]
    if near and (start - near[-1].end() <= GAP or not parameter):
        first, last = int(near[-1][1]), int(near[-1][2] or near[-1][1])
        return [f"P{number}" for number in range(first, last + 1)]
    return [about] if about else []


def read_words(draft: Draft, n: int, text: str, named: list[re.Match[str]], about: str) -> None:
    """Add the words that a line names; a line that begins with one begins what belongs to it."""
    for match in WORDS.finditer(text):
        if match[2] and not draft.parameter:
            continue  # a block of a part programme
        for number in owners(text, named, match.start(), match.end(), about, draft.parameter):
            found = list(runs(match[1] or match[2]))
            draft.words += [PrintedWord(line=n, number=number, word=word) for word in found]
            if number == about and WORD_HEADING.fullmatch(text) and match.start() < len("#### Word"):
                draft.word = ", ".join(found)


def read_bits(draft: Draft, n: int, text: str, named: list[re.Match[str]], about: str) -> None:
    """Add the bits that a line names, in words or as the head of a table of codes; a picture has
    divisions.
    """
    if "<div>" in text:
        return
    cells = text.split("\t")
    if re.fullmatch(r"Bits?", cells[0]) and draft.parameter:
        cells = [cell for cell in cells[1:] if cell.isdigit()]
        draft.bits.append(PrintedWord(line=n, number=about, word=draft.word, bits=f"{cells[0]}-{cells[-1]}"))
    if (code := CODE.fullmatch(text)) and draft.bits:
        letter = code[1].replace("\t", "")
        said = re.sub(r"\$\\mu\$ ", "µ", code[2])
        fact = PrintedChoice(line=n, letter=letter, text=cut(said), number=about, applies=draft.bits[-1].bits)
        draft.choices.append(fact)
    for match in BITS.finditer(text):
        word = draft.word
        beside = [m for m in WORDS.finditer(text) if 0 <= match.start() - m.end() <= len(", ")]
        behind = re.match(r" of word N?(\d+)", text[match.end() :])
        if beside or behind:
            word = f"N{behind[1]}" if behind else ", ".join(runs(beside[-1][1] or beside[-1][2]))
        bits = match[1] if match[2] is None else f"{match[1]}-{match[2]}"
        for number in owners(
            text, named, (beside[-1] if beside else match).start(), match.end(), about, draft.parameter
        ):
            draft.bits.append(PrintedWord(line=n, number=number, word=word, bits=bits))


# -- values -----------------------------------------------------------------------------------------------


def value_of(text: str) -> str:
    """Return a figure without the commas of thousands and the signs of the scan."""
    return "0" if text == "zero" else text.replace(",", "").replace("\\", "").replace(" ", "")


def unit_of(text: str | None) -> str:
    """Return a printed unit without the signs of the scan."""
    return re.sub(r"[^\wµ%]|text", "", (text or "").replace(r"\mu", "µ").replace("μ", "µ"))


def word_before(draft: Draft, text: str, at: int) -> str:
    """Return the word that a line names last before ``at``, else the one that the lines above are about."""
    named = [m[1] or m[2] for m in WORDS.finditer(text) if m.end() <= at]
    return ", ".join(runs(named[-1])) if named else draft.word


def read_defaults(draft: Draft, n: int, text: str, lines: Sequence[str]) -> None:
    """Add what a line calls a default or a basic value, and the values of a table of words."""

    def said(value: str, unit: str | None = "", word: str = draft.word, note: str = "default") -> None:
        number = draft.about or draft.parameter
        fact = PrintedDefault(
            line=n, number=number, word=word, value=value_of(value), unit=unit_of(unit), note=note
        )
        draft.defaults.append(fact)

    for at, pattern in enumerate(DEFAULTS):
        for match in pattern.finditer(text):
            word = word_before(draft, text, match.start())
            if at == 0:
                said(match[2] or match[3], match[4], word, match[1].lower())
            elif at == 1:
                said(match[1] or match[2], match[3], word)
            else:
                said(match[2], "", word)
    above = " ".join(lines[n - 5 : n - 1]).lower()
    if (row := re.fullmatch(r"N(\d+)-N(\d+): (\d+)", text)) and "default values initialised:" in above:
        said(row[3], "", f"N{int(row[1])}-N{int(row[2])}")
    if (row := re.match(r"(\d+-\d+)(%) for ", text)) and "default value is set" in above:
        said(row[1], row[2])
    if row := re.match(r"(N\d+)\t(\\\$[\dA-F]+)\t", text):
        said(row[2], "", row[1], "value")
    if row := re.search(r"default language is (\w+)", text):
        said(row[1])


def read_ranges(draft: Draft, n: int, text: str) -> None:
    """Add bounds, both or one of them."""

    def said(low: str, high: str, unit: str, note: str = "", at: int = 0) -> None:
        place = f"{draft.parameter} {word_before(draft, text, at)}".strip()
        fact = PrintedRange(line=n, low=low, high=high, unit=unit, applies=place, note=note)
        draft.ranges.append(fact)

    for pattern in RANGES:
        for match in pattern.finditer(text):
            opens = text[: match.start()]
            note = "recommended" if "recommended" in opens[-30:] else ""
            said(value_of(match[1]), value_of(match[3]), unit_of(match[4] or match[2]), note, match.start())
    for patterns, low in ((LOWS, True), (HIGHS, False)):
        for pattern in patterns:
            for match in pattern.finditer(text):
                value, unit = value_of(match[1]), unit_of(match[2])
                note = "less than" if "<" in match[0] else ""
                said(value if low else "", "" if low else value, unit, note, match.start())
    if one := ONE_VALUE.match(text):
        said(value_of(one[1]), value_of(one[1]), "")


if __name__ == "__main__":
    sys.exit(write_facts(__doc__, HEAD, sections))
