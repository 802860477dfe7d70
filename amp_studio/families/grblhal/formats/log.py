"""What a saved text of a Grbl contains: listings of settings, between whatever a sender,
a forum or a person puts around them.

    $110=500.000 (X-axis maximum rate, mm/min)      as the control shows it, with a remark
    [12:30:01] > $110=500                           time stamps, marks of a direction, names of programs
    $$ < $0=10; $1=25; ok                           a whole answer in one line
    "$110": "500.000",                              a table or an object of another program
    | $110 | X-axis maximum rate | 500.000 | mm/min |    a table with words before the value
    $110  500.000                                   two columns
    110=500.000                                     no sign, as bCNC stores them (grbl_110 = …); below [grbl]
    {"key": "$110", "value": "500.000", …}          data of another program (data.py)
    ; [BOARD:T41U5XBB]                              what the control answers to $I, plain or as a remark
    Kleine CNC, 21.12.2015:                         a heading

A number that comes again begins a new listing.
A few settings that come again are changes of the listing before them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from html import unescape
from typing import NamedTuple

from amp_studio.formats import FormatError

from .data import IP, MARK, NUMBER, with_signs

_ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|[\x00-\x08\x0b-\x1f\x7f\u200b-\u200f]")
_THOUSANDS = re.compile(r"[+-]?[0-9]{1,3}(?:,[0-9]{3})+\.[0-9]+")
_UNIT = r"(?:[uµm]?s(?:ec)?|mm(?:/\S+)?|steps?/\S+|rpm|hz)(?:\s.*)?"
_SETTING = re.compile(r"\$(0|[1-9][0-9]{0,4})([\"'`*]{0,4})[ \t]*(:?=|[:|,;\t])[ \t]*")
_BARE = re.compile(rf"(?:grbl_)?(0|[1-9][0-9]{{0,2}})[ \t]*=[ \t]*({NUMBER}|{IP})[ \t]*(?:[(;].*)?")
_SECTION = re.compile(r"^\[grbl(?:HAL)?\][ \t]*$", re.MULTILINE | re.IGNORECASE)
_DIGIT = re.compile("[0-9]")
_FIGURE = re.compile(rf"(?:{IP}|{NUMBER})(?![\w.:])")
_SPLIT = re.compile(r"^\$[ ](?=[0-9]{1,5}[ ]*=)")
_COLUMNS = re.compile(rf"\$(0|[1-9][0-9]{{0,4}})[ ]+({NUMBER})(?:[ ]{{2,}}(.*)|[ ]?([(;#].*))?")
_CELLS = "|;\t,"
"""Characters between the cells of a table."""
_AHEAD = re.compile(
    r"""(?:
      \[[^\]]{0,40}\]                                                  # [12:30:01], [PRB], [ $$ ]
    | \d{4}[-/.]\d\d?[-/.]\d\d?[T,]? | \d\d?[-/.]\d\d?[-/.]\d{2,4},?   # a date
    | \d\d?:\d\d(?::\d\d)?(?:[.,][ ]{0,2}\d+)?(?:[ ]?[AP]\.?M\.?)?Z?      # a time, 12:30:01.  4 too
    | \([ ]{0,5}\d{1,6}\)(?=[ ]?[<>])                                 # ms since the line before
    | (?!error|alarm)[A-Za-z][\w.-]{0,19}(?:[ ][\w.-]{1,12}){0,2}[ ]?[>:]             # CNCjs>, client>, Recv:
    | \$\$[ ]?<? | [-=~]?>+ | <+(?![A-Z][a-z]+[|:,])[-=~]? | [|*•·"'`{,-]+
    )\s*""",
    re.VERBOSE | re.IGNORECASE,
)
_REMARK = re.compile(r"[(;%#]|//|/\*")
"""How a line begins that is no setting of the listing, even where it contains one."""
_COMMENTED = re.compile(r"^[ \t]*(?:(?:[#;%]|//)[ \t]*)+(?=\$[0-9]{1,5}[ \t]*=)", re.MULTILINE)
_NOT_COMMENTED = re.compile(r"^[^#;%/\n]*\$[0-9]{1,5}[ \t]*=", re.MULTILINE)
_END_OF_VALUE = re.compile(r"\(|;(?!\s*\$[0-9])|(?<=\s)(?://|#|/\*)")
_FOLLOWING = re.compile(r"\s+\$[0-9]{1,5}=")
_REMARK_BEHIND_TEXT = re.compile(r"\s+(?:[(;#]|//|/\*)")
_FACT = re.compile(r"\[([A-Z][A-Z0-9 ]{1,20}):([^\[\]]*)\]")
_GREETING = re.compile(r"\bgrbl(?:HAL)?[ ]+v?[0-9]\.[0-9]+\w?\b.*", re.IGNORECASE)
_STARTUP = re.compile(r"(\$N[0-9])=(.*)")
_REFUSED = re.compile(r"error\s*:\s*[0-9]+", re.IGNORECASE)
_AROUND = re.compile(
    r"ok|done|[^\x00-\x7f]|\$[$#GINXHC+]?\S{0,3}|<[^>]*>|\[.*\]|[-=_*#%~.!?\s\"'`{}()\[\],|/\\]*|ALARM:.*|error:.*|.*['\"]\$['\"].*",
    re.IGNORECASE,
)
"""Lines of a sender's log that contain no setting; overrides and jog cancel are one byte from 0x80 on."""
_MIN_LISTED, _MAX_LISTINGS, _LOOKED_AT = 8, 1000, 20_000
_MAX_LINES, _LONGEST, _LONGEST_VALUE = 200_000, 65_536, 400
"""A listing has some hundred lines, a log of a day some ten thousand; the longest value is a macro."""
_CELL = re.compile(r"(\$[0-9]{1,5})[ \t]*</t[dh]>[ \t]*<t[dh][^<>\n]{0,200}>", re.IGNORECASE)
_MARKUP = re.compile(r"<(?:td|pre|br|html|div|li|p)\b[^<>\n]{0,200}>", re.IGNORECASE)
_TAG = re.compile(
    r"</?(?:t[dhr]|table|thead|tbody|html|head|body|pre|br|div|ul|ol|li|b|i|em|strong|code|span|font|a|p|h[1-6])"
    r"\b[^<>\n]{0,200}>",
    re.IGNORECASE,
)
"""Cells and their marks in the table of a web page; what a control writes in < > begins otherwise."""
_LONGEST_PAGE = 400_000
_FACTS = (
    "VER",
    "OPT",
    "NEWOPT",
    "AXS",
    "FIRMWARE",
    "BOARD",
    "DRIVER",
    "DRIVER VERSION",
    "DRIVER OPTIONS",
    "PLUGIN",
    "NVS STORAGE",
    "AUX IO",
    "KINEMATICS",
    "SPINDLE",
    "COMPATIBILITY LEVEL",
    "MAX STEP RATE",
)


@dataclass
class LoggedListing:
    """One listing: number -> text, and number -> line."""

    settings: dict[int, str] = field(default_factory=dict)
    lines: dict[int, int] = field(default_factory=dict)
    remarks: dict[int, str] = field(default_factory=dict)
    whole: dict[int, str] = field(default_factory=dict)
    """Number -> all that is behind its sign, where nothing is written around it."""
    heading: str = ""
    """The last line before it that is neither a setting nor a part of a log."""
    changed: dict[int, tuple[str, str]] = field(default_factory=dict)
    """Settings that a later line gives another value: the value of the listing, and the later one."""
    is_apart: bool = False
    """Sentences are between it and what is before it."""
    aside: dict[int, str] = field(default_factory=dict)
    """Line -> a few settings behind sentences, as an example is: they change nothing."""

    def put(self, number: int, text: str, line: int, remark: str, whole: str) -> None:
        self.settings[number], self.lines[number], self.remarks[number] = text, line, remark
        self.whole[number] = whole

    def texts_of(self, texts: Iterable[int]) -> dict[int, str]:
        """Return the values of the settings that are texts:
        they may contain the characters that begin a remark.

        Where no figure has a remark there are none; else one begins behind a blank.
        """
        wholes = {n: self.whole.get(n) or self.settings[n] for n in texts}
        figures = (n for n, text in self.settings.items() if n not in wholes and re.fullmatch(NUMBER, text))
        if any(self.remarks[n] for n in figures):
            for n in filter(self.whole.get, wholes):
                wholes[n] = _REMARK_BEHIND_TEXT.split(wholes[n], maxsplit=1)[0]
        return wholes

    @property
    def first_line(self) -> int:
        return min(self.lines.values())


@dataclass
class Log:
    """What a text contains."""

    listings: list[LoggedListing] = field(default_factory=list)
    startup: dict[str, str] = field(default_factory=dict)
    """``$N0`` -> its block of G-code."""
    facts: dict[str, list[str]] = field(default_factory=dict)
    """What the control answers to ``$I``: ``BOARD`` -> what is behind it, each time."""
    greeting: str = ""
    others: list[tuple[int, str]] = field(default_factory=list)
    """Lines that are neither a setting nor a part of a log."""
    bare: list[int] = field(default_factory=list)
    """Lines of a setting whose ``$`` is missing."""
    refused: list[int] = field(default_factory=list)
    """Lines of a changed setting that the control answered with an error."""
    is_comment: bool = False
    """Every setting is behind the sign of a comment, as in the source of a program."""


def is_listing(text: str) -> bool:
    """Return whether a text is for the most part settings of a Grbl, or has at least a few of them."""
    text = with_signs(text)
    if "$" not in text:
        bare = {match[1] for line in text.splitlines() if (match := _BARE.fullmatch(line.strip()))}
        return {"100", "110"} <= bare or (bool(bare) and _SECTION.search(text) is not None)
    return any(_has_settings(text, deep) for deep in (False, True)) or _without_signs(text) is not None


def _has_settings(text: str, anywhere: bool) -> bool:
    """Return whether a text is a listing: it has more settings than other lines, or many."""
    found = others = 0
    for n, _, line, pieces in _lines(text, anywhere):
        found += len(pieces)
        others += not pieces and _is_other(line)
        # A text of any length may be offered: it is not read through to know that it is no listing.
        if found >= _MIN_LISTED or n > _LOOKED_AT:
            break
    return found >= _MIN_LISTED or (found > others and not anywhere)


def read_log(text: str) -> Log:
    """Return the listings of a text in their order, and what is around them.

    Settings in the middle of a line are read only where the text has no listing otherwise:
    "then I set $22=1" is none. Settings that are comments are read where there are no others.
    """
    text = with_signs(text)
    if (bare := _without_signs(text)) is not None:
        found = _read(bare, anywhere=False)
        found.is_comment = True
        return found
    found = _read(text, anywhere=False)
    if max((len(listing.settings) for listing in found.listings), default=0) >= _MIN_LISTED:
        return found
    deeper = _read(text, anywhere=True)
    return deeper if sum(len(one.settings) for one in deeper.listings) >= _MIN_LISTED else found


def _without_signs(text: str) -> str | None:
    """Return a text whose settings all are comments without the signs of these; None where others are there,
    or too few.
    """
    if len(_COMMENTED.findall(text)) < _MIN_LISTED or _NOT_COMMENTED.search(text):
        return None
    return _COMMENTED.sub("", text)


def _read(text: str, *, anywhere: bool) -> Log:
    reader = _Reader()
    for n, whole, line, pieces in _lines(text, anywhere):
        if not pieces:
            reader.take_other_line(n, whole, line)
        for piece in pieces:
            reader.take_setting(n, piece)
    return reader.finished()


class _Reader:
    """Sorts the lines of a log into listings, line by line: a listing ends where a number comes again."""

    def __init__(self) -> None:
        self.log = Log()
        self.parts = [LoggedListing()]
        self.heading = ""
        self.before = (0, 0)
        """Number and line of the last setting."""
        self.is_apart = False
        """A line that is no setting came after it."""

    def take_other_line(self, n: int, whole: str, line: str) -> None:
        """Take a line without a setting."""
        if "$N" in line and (startup := _STARTUP.fullmatch(_plain(line))):
            self.log.startup[startup[1]] = startup[2].strip()
            return
        # The error belongs to the line right before it, as the control answers line by line.
        if _REFUSED.match(line) and self.before[1] == n - 1:
            _refuse(self.log, self.parts, *self.before)
            return
        _take_fact(self.log, whole)
        is_other = _is_other(line)
        if is_other:
            self.log.others.append((n, whole))
            self.is_apart = True
        if _is_heading(whole) or (is_other and not _is_heading(self.heading)):
            self.heading = whole.strip("#=* ")

    def take_setting(self, n: int, piece: _Piece) -> None:
        """Take a setting of a line."""
        number, value, remark, rest, is_bare = piece
        part = self.parts[-1]
        # Behind sentences a smaller number is another example, not the same listing going on.
        begins = number in part.settings or (self.is_apart and number < self.before[0])
        if begins and part.settings and len(self.parts) < _MAX_LISTINGS:
            part = LoggedListing(is_apart=self.is_apart)
            self.parts.append(part)
        self.is_apart = False
        part.heading, self.heading = part.heading or self.heading, ""
        part.put(number, value, n, remark, rest)
        self.log.bare += [n] * is_bare
        self.before = number, n

    def finished(self) -> Log:
        """Return what was read."""
        # Not where each of them is found: a log may have ten thousand that differ.
        self.log.facts = {tag: [*dict.fromkeys(texts)] for tag, texts in self.log.facts.items()}
        self.log.listings = _whole([part for part in self.parts if part.settings])
        return self.log


_Piece = tuple[int, str, str, str, bool]
"""A setting of a line: number, text, remark, all that is behind its sign,
and whether the sign before the number is missing."""


def _lines(text: str, anywhere: bool) -> Iterator[tuple[int, str, str, list[_Piece]]]:
    """Yield number, text, text without what a sender writes before it,
    and the settings of each line that is not empty.
    """
    if _MARKUP.search(text, 0, _LONGEST_PAGE):
        for tag in ("<tr", "<br", "</p>", "</li>", "</div>"):
            if text.count(tag) > text.count("\n"):  # a page without lines
                text = text.replace(tag, f"\n{tag}")
        text = unescape(_TAG.sub(" ", _CELL.sub(r"\1=", text)))
    for n, came in enumerate(re.split(r"\r\n|\r|\n", text.lstrip(MARK)), 1):
        whole = _ESCAPES.sub("", came[:_LONGEST]).replace("\u00a0", " ").strip()
        if n > _MAX_LINES:
            raise FormatError(f"a log has at most {_MAX_LINES:,} lines", n)
        if whole:
            line = _plain(whole)
            yield n, whole, line, list(_settings(whole, line, anywhere))


def _plain(whole: str) -> str:
    """Return a line without time stamps, names and marks before it."""
    if whole.startswith("<") and whole.endswith(">"):
        return whole  # a status report
    at = 0
    while (match := _AHEAD.match(whole, at)) and not _FACT.match(whole, at):
        at = match.end()
    return whole[at:].strip()


def _settings(whole: str, line: str, anywhere: bool) -> Iterator[_Piece]:
    """Yield the settings of a line: one without its sign, one in columns, or those behind their signs."""
    if not _DIGIT.search(line):
        return  # most lines of a text that is made to cost time
    if match := _BARE.fullmatch(line):
        if line == whole:
            # Only at the start of a line: behind a time stamp 110=500 may be anything.
            yield int(match[1]), match[2], "", "", True
        return
    if line.startswith("$ "):
        line = _SPLIT.sub("$", line)
    if match := _COLUMNS.fullmatch(line):
        yield int(match[1]), match[2], (match[3] or match[4] or "").strip("(;) "), "", False
        return
    if anywhere:
        line = re.sub(r"^\([^)]*\)\s*", "", line)
    if not _REMARK.match(line):
        yield from _settings_with_sign(whole, line, anywhere)


def _settings_with_sign(whole: str, line: str, anywhere: bool) -> Iterator[_Piece]:
    """Yield the settings of a line: number, separator and value each; a cell of a table is the last."""
    ahead = _SETTING.search(line) if anywhere else _SETTING.match(line)
    begins_plainly = line[:1] == "$" and whole[:1] not in "\"'`|*{[,"
    while ahead:
        number, separator, behind = int(ahead[1]), ahead[3], line[ahead.end() :][:_LONGEST_VALUE]
        # Words that name the setting may come before the value, in the language of any sender.
        if separator in _CELLS and (cell := _cell(behind, separator)):
            yield number, cell, "", "", False
            return
        value = _value_behind(line, ahead)
        if not value.is_certain:
            return
        is_plain = separator == "=" and value.is_alone and begins_plainly
        rest = _FOLLOWING.split(behind, maxsplit=1)[0].strip() if is_plain else ""
        yield number, value.text, value.remark, rest, False
        ahead = value.following


class _ValueText(NamedTuple):
    """What is behind the separator of a setting."""

    text: str
    remark: str
    is_quoted: bool
    is_certain: bool
    """A value, not a word of a sentence: behind an equals sign, in quotes, or a figure."""
    following: re.Match[str] | None
    """The next setting of the line."""

    @property
    def is_alone(self) -> bool:
        return not self.is_quoted and not self.following


def _value_behind(line: str, ahead: re.Match[str]) -> _ValueText:
    """Return the value behind a number and its separator, without the marks around it."""
    begin, most = ahead.end(), ahead.end() + _LONGEST_VALUE
    following = _SETTING.search(line, begin, most)
    # Only as far as the next setting: a line may have ten thousand of them.
    end = _END_OF_VALUE.search(line, begin, following.end() if following else most)
    if end:
        following = None
    stop = end.start() if end else len(line)
    text = line[begin : following.start() if following else stop].strip()
    is_quoted = bool(ahead[2]) or text[:1] in ('"', "'", "`")
    text = _without_marks(text, ahead, ends_there=is_quoted or following is not None)
    remark = "" if following else line[stop:].strip("(;) \t")
    is_certain = ahead[3] in ("=", ":=") or is_quoted or bool(_FIGURE.match(text))
    return _ValueText(text, remark, is_quoted, is_certain, following)


def _without_marks(text: str, ahead: re.Match[str], *, ends_there: bool) -> str:
    """Return a value without the marks around it, and up to the cell or mark that ends it."""
    marks = "\"'`* " if ahead[2] else "\"'` "
    if ahead[3] in _CELLS:
        text = text.lstrip("\"'`* ").split(ahead[3], 1)[0]
    text = text.lstrip(marks)
    if ends_there:
        text = re.split(r"[\"'`*]|[,;|}\]]\s*$", text, maxsplit=1)[0]
    return text.strip().strip(marks)


def _cell(cells: str, separator: str) -> str:
    """Return the first cell of a table that is a number, behind words that name the setting or at once;
    empty where there is none; the number of an IP address too.
    """
    plain = (cell.strip("\"'`* \t") for cell in cells.split(separator)[:4])
    return next(
        (cell for cell in plain if re.fullmatch(rf"{NUMBER}|(?:\d{{1,3}}\.){{3}}\d{{1,3}}", cell)), ""
    )


def _is_other(line: str) -> bool:
    return not (
        _AROUND.fullmatch(line) or _REMARK.match(line) or _GREETING.search(line) or _STARTUP.match(line)
    )


def _is_heading(text: str) -> bool:
    return text.startswith("#") or text.endswith(":")


def _take_fact(log: Log, whole: str) -> None:
    if greeting := _GREETING.search(whole):
        log.greeting = greeting[0].strip()
    for tag, text in _FACT.findall(whole):
        if tag in _FACTS:
            log.facts.setdefault(tag, []).append(text)


def _refuse(log: Log, parts: list[LoggedListing], number: int, line: int) -> None:
    """Take back a change that the control has refused: the answer to it is an error."""
    part = parts[-1]
    if any(number in earlier.settings for earlier in parts[:-1]) and part.lines.get(number) == line:
        del part.settings[number], part.lines[number], part.remarks[number]
        log.refused.append(line)


def _whole(parts: list[LoggedListing]) -> list[LoggedListing]:
    """Return whole listings, each with the changes that come after it; those that are the same once."""
    # Half of the largest: the listings of one text are of one control, and so about as long.
    least = max(_MIN_LISTED, max((len(part.settings) for part in parts), default=0) / 2)
    listings: list[LoggedListing] = []
    for part in parts:
        is_last_whole = not listings or len(listings[-1].settings) >= least
        if not listings or len(part.settings) >= least:
            if not is_last_whole:
                earlier = listings.pop()  # settings that were sent before they were listed
                _fill_in(part, earlier)
            listings.append(part)
        elif part.is_apart and is_last_whole:
            listings[-1].aside |= {part.lines[n]: f"${n}={text}" for n, text in part.settings.items()}
        else:
            _change(listings[-1], part)
    return _without_repeats(listings)


def _without_repeats(listings: list[LoggedListing]) -> list[LoggedListing]:
    """Return the last of those listings that are the same."""
    last = {tuple(sorted(part.settings.items())): part for part in listings}
    return [part for part in listings if last[tuple(sorted(part.settings.items()))] is part]


def _fill_in(listing: LoggedListing, earlier: LoggedListing) -> None:
    """Put settings into a listing that lacks them, unless it was parted from what is before it."""
    if not listing.is_apart:
        for n in earlier.settings.keys() - listing.settings.keys():
            listing.put(n, earlier.settings[n], earlier.lines[n], earlier.remarks[n], earlier.whole[n])


def _change(listing: LoggedListing, changes: LoggedListing) -> None:
    for number, text in changes.settings.items():
        if number in listing.settings and listing.settings[number] != text:
            listing.changed[number] = listing.settings[number], text
        listing.put(number, text, changes.lines[number], changes.remarks[number], changes.whole[number])


def figure(text: str) -> str:
    """Return the number at the beginning of a text, with a point; the text where it begins with none.

    ``26,667`` is 26.667: a control writes no thousands; ``5,000.000`` has them anyway. ``10 usec`` and
    ``10us`` are 10, ``200.000ok`` is 200.000.
    """
    if _THOUSANDS.fullmatch(text):
        return text.replace(",", "")
    match = re.fullmatch(
        rf"({NUMBER})(?:ok|{_UNIT}|[^\w.:+-].*)?", text.replace("\u2212", "-"), re.IGNORECASE
    )
    if not match:
        return text
    return match[1].replace(",", ".")
