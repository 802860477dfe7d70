"""The PDF as a reader sees it: its pages, its texts, its fonts."""

import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.output.pdf import typeset
from tests.report.conftest import IN_EVERY_ORDER

DATE = datetime(2026, 7, 1, 14, 5, tzinfo=UTC)

poppler = pytest.mark.skipif(shutil.which("pdfinfo") is None, reason="needs poppler's tools")


def output_of(*command: str | Path) -> str:
    done = subprocess.run(command, capture_output=True, check=True, encoding="utf-8", errors="replace")
    return done.stdout


def pages_of(path: Path) -> int:
    found = re.search(r"^Pages:\s+(\d+)", output_of("pdfinfo", path), re.MULTILINE)
    assert found
    return int(found.group(1))


def texts_of(path: Path, *options: str) -> list[str]:
    """Return the text of each page."""
    return output_of("pdftotext", *options, path, "-").split("\f")[:-1]


@poppler
@IN_EVERY_ORDER
def test_every_page_bears_machine_file_and_its_number(
    printed: Callable[..., Path], which: str, sort: Sort
) -> None:
    path = printed(which, sort)
    pages = texts_of(path, "-layout")
    assert len(pages) == pages_of(path) >= 3
    for number, text in enumerate(pages, 1):
        assert "Mill 7" in text
        assert "mill.amp" in text or number == 1  # the cover has the whole path, with places to break
        assert f"page {number} of {len(pages)}" in text
        assert "2026-07-01 14:05" in text


@poppler
@IN_EVERY_ORDER
def test_every_value_is_printed_and_table_heads_are_repeated(
    printed: Callable[..., Path], eight_axes: ParameterFile, mill: ParameterFile, which: str, sort: Sort
) -> None:
    path, file = printed(which, sort), mill if which == "mill" else eight_axes
    text = output_of("pdftotext", "-raw", path, "-")
    words = set(text.split())
    if sort not in ("group", "steps"):
        assert {r.number for r in build_report(file, Contents(inactive=True)).rows() if r.number} <= words
    assert "Set up by" in text
    assert "Released by" in text
    heads = {"Where", "Number", "Code"}  # of findings, of values, of what is active after power-up
    pages = texts_of(path)
    first = next(n for n, page in enumerate(pages) if "Marks" in page) + 1
    for number, page in enumerate(pages[first:-1], first + 1):
        assert heads & set(page.split()), number


@poppler
@IN_EVERY_ORDER
def test_many_axes_lie_across_the_page_and_few_do_not(
    printed: Callable[..., Path], which: str, sort: Sort
) -> None:
    side_by_side = sort in ("group", "steps")  # the axes of a parameter; else each axis has its list
    assert lies_across(printed(which, sort)) == side_by_side


def lies_across(path: Path) -> bool:
    """Return whether the pages of values are wider than they are high."""
    last = str(pages_of(path) - 2)  # those of power-up and of signatures are upright
    size = re.search(r"size:\s+([\d.]+) x ([\d.]+)", output_of("pdfinfo", "-f", last, "-l", last, path))
    assert size
    return float(size.group(1)) > float(size.group(2))


@poppler
def test_nothing_runs_over_the_edge_of_its_column(tmp_path: Path, eight_axes: ParameterFile) -> None:
    """Every word of a page lies between its margins, even with the longest numbers a double can have."""
    for address in list(eight_axes.values):
        value = eight_axes.values[address]
        if eight_axes.schema.parameters[address[0]].type == "real":
            eight_axes.set(address, type(value)(-123456.78901234567, value.unit))
    path = tmp_path / "r.pdf"
    print_report(eight_axes, path, Contents("group", without=frozenset({"pictures"})))
    assert lies_across(path)
    boxes = output_of("pdftotext", "-bbox", path, "-")
    for page in re.finditer(r'<page width="([\d.]+)".*?</page>', boxes, re.DOTALL):
        width, margin = float(page.group(1)), 12 / 25.4 * 72
        for right in re.findall(r'xMax="([\d.]+)"', page.group()):
            assert float(right) <= width - margin + 1.0


@poppler
def test_only_fonts_that_travel_in_the_file_are_used(printed: Callable[..., Path]) -> None:
    lines = output_of("pdffonts", printed("mill", "axis")).splitlines()[2:]
    assert lines
    assert all(re.search(r"\byes yes (yes|no)\b", line) for line in lines), lines
    assert {line.split("+")[1].split("-")[0] for line in lines} == {"LibertinusSerif"}


def test_typst_runs_in_a_process_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """It keeps about 100 MB of each document where it runs."""
    monkeypatch.setitem(sys.modules, "typst", None)
    assert typeset("one", DATE).startswith(b"%PDF")
