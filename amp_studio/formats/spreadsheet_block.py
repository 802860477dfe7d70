"""A block of cells as spreadsheets exchange it: text with tabs, or a table in HTML.
Read and written without loss.

A spreadsheet shows a number in its own manner (``0,43``, ``1.234,50``, ``12-Nov``). LibreOffice and Excel
give the number itself beside it (``sdval``, ``x:num``), which is taken where it is there. Where it is not,
the shown text counts, and one that can be read two ways is left for the person to decide: nothing is guessed.
"""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Sequence
from html.parser import HTMLParser
from typing import NamedTuple

from amp_studio.errors import AmpStudioError
from amp_studio.files import cell_text, text_cell
from amp_studio.schema import write_number

_LONGEST, _LONGEST_MARKUP = 4_000_000, 1_500_000
"""Characters of a block that is read, and of its HTML; of a larger one the text is taken."""
_MAX_CELLS = 50_000

_QUOTED = re.compile(r'"((?:[^"]|"")*)"(?=\t|\r\n|\n|\r|\Z)')
_PLAIN = re.compile(r"[^\t\r\n]*")
_BLANKS = re.compile("[\u00a0\u2007\u2009\u202f]")
_ROW_END = re.compile(r"\r\n|\n|\r")
_SHOWN_NUMBER = re.compile(r"[-+−]?[0-9][0-9.,' \u00a0\u202f]*(?:[eE][-+]?[0-9]+)?")
_LIKE_GROUPS = re.compile(r"[-+]?[1-9][0-9]{0,2}(?:\.[0-9]{3})+(?![0-9])")
_DECIMAL_COMMA = re.compile(
    r"[-+]?(?:[0-9]{1,3}(?:\.[0-9]{3})+|[0-9]*),(?:[0-9]{1,2}|[0-9]{4,})(?![0-9])|[-+]?0,[0-9]+"
)


class BlockError(AmpStudioError, ValueError):
    """A content of the clipboard that is no block of cells: one sentence."""


class BlockCell(NamedTuple):
    """One cell to be written: its text, and the number and unit of it where it is a number."""

    text: str
    number: float | int | None = None
    unit: str = ""


def read_block(text: str, markup: str = "") -> list[list[str]]:
    """Return the rows of a block, all of one length;
    from the table in the HTML ``markup`` where there is one. Raises BlockError.
    """
    if len(markup) > _LONGEST_MARKUP:
        markup = ""
    if len(text) > _LONGEST:
        raise BlockError("The clipboard has more than 4 million characters. Copy fewer cells.")
    # HTML first: it has the numbers themselves, the text only what the spreadsheet shows.
    rows = (_rows_of_html(markup) if "<td" in markup.lower() else []) or _rows_of_text(text)
    width = max(map(len, rows), default=0)
    if width * len(rows) > _MAX_CELLS:
        raise BlockError(f"The clipboard has more than {_MAX_CELLS:,} cells. Copy fewer.")
    return [[_plain(cell_text(cell)) for cell in row] + [""] * (width - len(row)) for row in rows]


def _plain(text: str) -> str:
    """Return a cell with the blanks and the minus of a keyboard:
    spreadsheets group digits by narrow blanks that no line breaks at.
    """
    text = _BLANKS.sub(" ", text)
    return "-" + text[1:] if re.match(r"\u2212\s*[0-9.,]", text) else text


def two_ways(rows: Sequence[Sequence[str]]) -> set[str]:
    """Return the texts of a block whose point may set groups of thousands apart,
    as a comma beside them is decimal.

    ``1.234`` alone is one and a bit; in a table that also has ``0,5`` it may be a thousand.
    """
    texts = {cell.strip() for row in rows for cell in row}
    # Without a decimal comma anywhere a point can only be decimal.
    if not any(_DECIMAL_COMMA.match(text) for text in texts):
        return set()
    return {text for text in texts if _LIKE_GROUPS.match(text) and "," not in text}


def _rows_of_text(text: str) -> list[list[str]]:
    """Read text with tabs; a cell in quotes may contain tabs, line ends and doubled quotes."""
    rows: list[list[str]] = [[]]
    at = 0
    while True:
        cell = _QUOTED.match(text, at) or _PLAIN.match(text, at)
        assert cell is not None  # an empty cell fits too
        rows[-1].append(cell[1].replace('""', '"') if cell.re is _QUOTED else cell[0])
        at = cell.end()
        if at >= len(text):
            break
        if text[at] == "\t":
            at += 1
            continue
        end = _ROW_END.match(text, at)
        at = end.end() if end else at + 1
        if at >= len(text):
            break
        rows.append([])
    return rows if rows != [[""]] else []


# -- HTML


def _rows_of_html(markup: str) -> list[list[str]]:
    """Return the rows of the first table; none for what is no HTML that Python reads."""
    reader = _TableReader()
    try:
        reader.feed(markup)  # never closed: what has no end would be tried from each character of it on
    except BlockError:
        raise
    except (
        AssertionError,
        ValueError,
    ):  # a declaration or a character in digits that Python's reader does not take
        return []
    return reader.whole()


class _TableReader(HTMLParser):
    """Reads the first table of a page; a cell over several columns or rows leaves the others empty."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.rows: list[list[str]] = []
        self._blocked: dict[int, int] = {}
        """Column -> rows that a cell above still covers."""
        self._tables = 0
        self._is_done = self._is_skipping = False
        self._cell: list[str] | None = None
        self._number: str | None = None
        self._span = (1, 1)

    def whole(self) -> list[list[str]]:
        self._end_cell()
        return self.rows

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if self._is_done:
            return
        if tag == "table":
            self._tables += 1
        elif tag in ("style", "script", "head"):
            self._is_skipping = True
        elif self._tables != 1:
            return
        elif tag == "tr":
            self._end_cell()
            self.rows.append([])
        elif tag in ("td", "th"):
            self._begin_cell(dict(attrs))
        elif tag in ("br", "p", "div") and self._cell:
            self._cell.append("\n")

    def handle_endtag(self, tag: str) -> None:
        if tag in ("style", "script", "head"):
            self._is_skipping = False
        elif tag == "table" and self._tables:
            self._tables -= 1
            if not self._tables:
                self._end_cell()
                self._is_done = True
        elif tag in ("td", "th", "tr") and self._tables == 1:
            self._end_cell()

    def handle_data(self, data: str) -> None:
        if self._cell is not None and not self._is_skipping and not self._is_done:
            self._cell.append(re.sub(r"[ \t\r\n]+", " ", data))

    def _begin_cell(self, attributes: dict[str, str | None]) -> None:
        """Begin a cell behind those that cells above cover; raises BlockError where there are too many."""
        self._end_cell()
        if not self.rows:
            self.rows.append([])
        self._leave_out_covered()
        self._cell = []
        self._number = attributes.get("sdval") or attributes.get("x:num")
        self._span = _span(attributes.get("colspan")), _span(attributes.get("rowspan"))
        # Counted while it is read: spans of 1000 make many cells of few characters.
        if sum(map(len, self.rows)) > _MAX_CELLS:
            raise BlockError(f"The clipboard has more than {_MAX_CELLS:,} cells. Copy fewer.")

    def _leave_out_covered(self) -> None:
        row = self.rows[-1]
        while self._blocked.get(len(row), 0) > 0:
            self._blocked[len(row)] -= 1
            row.append("")

    def _end_cell(self) -> None:
        """Put the cell that was read into its row; the others of its span stay empty."""
        if self._cell is None:
            return
        lines = "".join(self._cell).split("\n")
        text = "\n".join(line.strip(" ") for line in lines).strip().replace("\u00a0", " ")
        columns, rows = self._span
        for n in range(columns):
            if rows > 1:
                self._blocked[len(self.rows[-1])] = rows - 1
            self.rows[-1].append("" if n else _cell_text(text, self._number))
        self._cell = None


def _span(text: str | None) -> int:
    return (
        min(max(int(text), 1), 1000) if text and text.isascii() and text.isdecimal() and len(text) < 6 else 1
    )


def _cell_text(cell: str, number: str | None) -> str:
    """Return what a cell means that shows a text and has a number too: the number,
    with the unit that is shown.

    A date, a time, a percentage or a truth value is a number too, but not the one that is seen:
    it stays a text.
    """
    # LibreOffice 7.4 writes it with the decimal separator of its language, and never in groups.
    number = number.replace(",", ".") if number is not None else ""
    if not re.fullmatch(r"[-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?", number):
        return cell
    match = _SHOWN_NUMBER.match(cell)
    if match is None:
        return cell
    unit = cell[match.end() :].strip()
    # A date, a time or a percentage: its number counts days, or hundredths.
    if re.match(r"[%\d:/.-]", unit):
        return cell
    return f"{number} {unit}" if unit else number


# -- writing


def block_text(rows: Sequence[Sequence[BlockCell]]) -> str:
    """Return a block as text with tabs, which every program reads."""
    return "\n".join("\t".join(_field(text_cell(cell.text)) for cell in row) for row in rows)


def _field(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if re.search('[\t\r\n"]', text) else text


def block_html(rows: Sequence[Sequence[BlockCell]], heads: int = 0) -> str:
    """Return a block as a table in HTML, in which numbers are numbers that show their unit;
    the first ``heads`` rows are heads.
    """
    lines = [
        (
            '<html xmlns:x="urn:schemas-microsoft-com:office:excel"><head><meta'
            ' charset="utf-8"></head><body><table>'
        )
    ]
    for n, row in enumerate(rows):
        lines.append(
            "<tr>" + "".join(_html_cell(cell, "th" if n < heads else "td") for cell in row) + "</tr>"
        )
    return "\n".join([*lines, "</table></body></html>"])


def _html_cell(cell: BlockCell, tag: str) -> str:
    """Return a cell by which both LibreOffice and Excel take a number as one, and a text as it is."""
    text = html.escape(cell.text).replace("\n", "<br>")
    figure = "" if cell.number is None else write_number(cell.number)
    if not re.fullmatch(r"-?[0-9]+(\.[0-9]+)?", figure):
        return f'<{tag} style="mso-number-format:\'\\@\'" sdnum="1033;0;@">{text}</{tag}>'
    unit = re.sub(r"[\"'\\;]", "", cell.unit)
    if not unit:
        return f'<{tag} align=right x:num="{figure}" sdval="{figure}" sdnum="1033;">{text}</{tag}>'
    # LibreOffice takes a number without the unit of its format (tried with 24.2), so there it is a text that
    # keeps it.
    form = html.escape(rf"General\0022 {unit}\0022")
    return f'<{tag} align=right style="mso-number-format:\'{form}\'" x:num="{figure}">{text}</{tag}>'


def cells_of(rows: Sequence[Sequence[str]]) -> Iterator[tuple[int, int, str]]:
    """Yield row, column and text of every cell that is not empty."""
    for r, row in enumerate(rows):
        for c, cell in enumerate(row):
            if cell.strip():
                yield r, c, cell.strip()
