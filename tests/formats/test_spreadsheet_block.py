"""A block of cells goes to a spreadsheet and comes back as it was;
what a spreadsheet shows is not mistaken for what it is.
"""

import shutil
import subprocess
from pathlib import Path

import pytest

from amp_studio.formats.spreadsheet_block import (
    BlockCell,
    BlockError,
    block_html,
    block_text,
    read_block,
    two_ways,
)
from tests.campaigns import CAMPAIGN

ROWS = [
    [BlockCell("11 mm", 11.0, "mm"), BlockCell("0.433 in", 0.433, "in"), BlockCell("2097152", 2097152)],
    [BlockCell("Closed Loop"), BlockCell("=1+1"), BlockCell("0x0021")],
    [BlockCell('two\nlines\tand "quotes"'), BlockCell(""), BlockCell("4 °", 4, "°")],
]
TEXTS = [[cell.text for cell in row] for row in ROWS]

FROM_LIBREOFFICE = """<table cellspacing="0" border="0"><colgroup span="4" width="85"></colgroup>
<tr><td height="17" align="right" sdval="0.433" sdnum="1033;1031;0,00">0,43</td>
<td align="right" sdval="11.25" sdnum="1033;0;0.0&quot; mm&quot;">11.3 mm</td>
<td align="right" sdval="0.5" sdnum="1033;0;0%">50%</td>
<td align="right" sdval="46301" sdnum="1033;0;YYYY-MM-DD">2026-10-06</td></tr>
<tr><td align="left">11 mm</td><td sdval="12345.678" sdnum="1033;1031;#.##0,0">12.345,7</td>
<td>two<br>lines</td><td>a &quot;quoted&quot; &lt;b&gt;</td></tr>
<tr><td colspan=2>merged</td><td sdval="0.0000001">0.0000001</td><td sdval="0" sdnum="1033;">Err:510</td></tr>
</table>"""
"""What LibreOffice 24.2 writes of a sheet, whose clipboard is written by the same code."""


def test_text_with_tabs_comes_back_as_it_was() -> None:
    assert read_block(block_text(ROWS)) == TEXTS


def test_html_comes_back_as_it_was() -> None:
    rows = [row[:2] for row in ROWS[:2]]
    assert read_block("", block_html(rows)) == [row[:2] for row in TEXTS[:2]]


def test_a_formula_in_a_text_is_none_to_a_spreadsheet() -> None:
    assert block_text([[BlockCell("=1+1")]]) == "'=1+1"


def test_a_number_with_the_comma_of_its_language_is_read_one_way() -> None:
    """The real clipboard of LibreOffice 7.4 in German; without its number 12,125 can be read two ways."""
    cells = [
        '<td align="right" sdval="12,125" sdnum="1031;">12,125</td>',
        '<td align="right" sdval="12345,6789" sdnum="1031;1031;#.##0,00">12.345,68</td>',
        '<td align="right" sdval="0,02" sdnum="1031;0;0,00&quot; mm&quot;">0,02 mm</td>',
    ]
    markup = f'<table cellspacing="0" border="0"><tr>{"".join(cells)}</tr></table>'
    rows = read_block("12,125\t12.345,68\t0,02 mm\n", markup)
    assert rows == [["12.125", "12345.6789", "0.02 mm"]]
    assert two_ways(rows) == set()


def test_a_number_counts_and_not_what_is_shown_of_it() -> None:
    rows = read_block("0,43\t11.3 mm", FROM_LIBREOFFICE)
    assert rows[0] == ["0.433", "11.25 mm", "50%", "2026-10-06"]
    assert rows[1] == ["11 mm", "12345.678", "two\nlines", 'a "quoted" <b>']
    assert rows[2] == ["merged", "", "0.0000001", "Err:510"]


def test_excel_gives_numbers_too() -> None:
    markup = """<html xmlns:x="urn:schemas-microsoft-com:office:excel"><head>
    <style>td {mso-ignore:padding}</style></head>
    <body><table><!--StartFragment--><tr><td class=xl65 x:num="0.43299999999999999">0,43</td><td x:num>12</td>
    <td x:str>&nbsp;11 mm</td></tr><tr><td rowspan=2>a</td><td>b</td></tr>
    <tr><td>c</td></tr><!--EndFragment--></table>"""
    assert read_block("", markup) == [["0.43299999999999999", "12", "11 mm"], ["a", "b", ""], ["", "c", ""]]


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("a\tb\r\nc\td\r\n", [["a", "b"], ["c", "d"]]),
        ("a\rb", [["a"], ["b"]]),
        ('"two\nlines"\t"a ""b"""', [["two\nlines", 'a "b"']]),
        ('5" pipe\t"open', [['5" pipe', '"open']]),
        ("a\t\t\n\tb", [["a", "", ""], ["", "b", ""]]),
        ("2\u202f097\u00a0152\t\u22121,5 mm", [["2 097 152", "-1,5 mm"]]),
        ("", []),
        ("\n", []),
    ],
)
def test_rows_and_cells_are_those_of_a_spreadsheet(text: str, rows: list[list[str]]) -> None:
    found = read_block(text)
    assert found == rows or (not rows and not any(cell for row in found for cell in row))


def test_a_point_beside_a_decimal_comma_can_be_read_two_ways() -> None:
    assert two_ways([["0,5", "1.234"], ["1.5", "12.345,6"]]) == {"1.234"}
    assert two_ways([["0.5", "1.234"]]) == set()
    assert two_ways([["11,25 mm", "1.000 mm"]]) == {"1.000 mm"}


def test_what_is_too_large_for_a_table_is_refused() -> None:
    with pytest.raises(BlockError, match="more than"):
        read_block("x" * 5_000_000)
    with pytest.raises(BlockError, match="more than"):
        read_block("\t" * 60_000)
    with pytest.raises(BlockError, match="more than"):
        read_block("", "<table>" + '<tr><td colspan="1000">a</td></tr>' * 60 + "</table>")


def test_damaged_html_is_read_as_far_as_it_goes() -> None:
    assert read_block("", "<table><td>a<td>b<tr><td>c") == [["a", "b"], ["c", ""]]
    assert read_block("plain", "<td") == [["plain"]]
    assert read_block("", "<table><tr><td colspan='99999999999'>a</td></tr></table>") == [["a"]]


@pytest.mark.skipif(not (CAMPAIGN and shutil.which("soffice")), reason="make campaign, with LibreOffice")
def test_libreoffice_takes_a_block_and_gives_it_back(tmp_path: Path) -> None:
    """Into a sheet as HTML, and out of it as what its clipboard has."""
    page = tmp_path / "block.html"
    page.write_text(block_html(ROWS), encoding="utf-8")
    for way in (
        ["--infilter=HTML (StarCalc)", "--convert-to", "fods", "block.html"],
        ["--convert-to", "html:HTML (StarCalc)", "--outdir", "back", "block.fods"],
    ):
        subprocess.run(
            ["soffice", f"-env:UserInstallation=file://{tmp_path}/profile", "--headless", *way],
            cwd=tmp_path,
            check=True,
            capture_output=True,
            timeout=60,
        )
    back = read_block("", (tmp_path / "back" / "block.html").read_text(encoding="utf-8"))
    assert back[:2] == TEXTS[:2]
    assert [back[2][0], back[2][2]] == ['two\nlines and "quotes"', "4 °"], "a tab is a blank in HTML"


@pytest.mark.parametrize("markup", ["<table><td>&#" + "9" * 5000 + ";", "<table><![x[ ]]><td>1"])
def test_html_that_cannot_be_read_leaves_the_text(markup: str) -> None:
    assert read_block("7\t8", markup) == [["7", "8"]]
