"""The PDF as a reader sees it: its pages, its texts, its fonts."""

from __future__ import annotations

import re
import shutil
import subprocess
from datetime import datetime
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import SORTS, build_report, write_report
from amp_studio.report.model import Sort

poppler = pytest.mark.skipif(shutil.which("pdfinfo") is None, reason="needs poppler's tools")


def said_by(*command: str | Path) -> str:
    done = subprocess.run(command, capture_output=True, check=True, encoding="utf-8", errors="replace")
    return done.stdout


def pages_of(path: Path) -> int:
    found = re.search(r"^Pages:\s+(\d+)", said_by("pdfinfo", path), re.MULTILINE)
    assert found
    return int(found.group(1))


@poppler
@pytest.mark.parametrize("sort", SORTS)
def test_every_page_bears_machine_file_and_its_number(
    tmp_path: Path, mill: ParameterFile, date: datetime, sort: Sort
) -> None:
    path = tmp_path / "r.pdf"
    write_report(mill, path, sort=sort, source=tmp_path / "mill.amp", date=date)
    count = pages_of(path)
    assert count >= 3
    for page in range(1, count + 1):
        text = said_by("pdftotext", "-layout", "-f", str(page), "-l", str(page), path, "-")
        assert "Mill 7" in text
        assert "mill.amp" in text
        assert f"page {page} of {count}" in text
        assert "2026-07-01 14:05" in text


@poppler
@pytest.mark.parametrize("sort", SORTS)
def test_every_value_is_printed_and_table_heads_are_repeated(
    tmp_path: Path, eight_axes: ParameterFile, sort: Sort
) -> None:
    path = tmp_path / "r.pdf"
    write_report(eight_axes, path, sort=sort)
    text = said_by("pdftotext", "-raw", path, "-")
    words = set(text.split())
    if sort != "group":
        assert {r.number for r in build_report(eight_axes).rows() if r.number} <= words
    assert "Set up by" in text
    assert "Released by" in text
    heads = {"Where", "Number"}  # of findings, of values
    for page in range(2, pages_of(path) + 1):
        assert heads & set(said_by("pdftotext", "-f", str(page), "-l", str(page), path, "-").split()), page


@poppler
def test_many_axes_lie_across_the_page_and_few_do_not(
    tmp_path: Path, mill: ParameterFile, eight_axes: ParameterFile
) -> None:
    for file, sort, across in (
        (eight_axes, "group", True),
        (eight_axes, "number", False),
        (mill, "axis", False),
    ):
        write_report(file, tmp_path / "r.pdf", sort=sort)  # type: ignore[arg-type]
        last = str(pages_of(tmp_path / "r.pdf"))
        size = re.search(
            r"size:\s+([\d.]+) x ([\d.]+)", said_by("pdfinfo", "-f", last, "-l", last, tmp_path / "r.pdf")
        )
        assert size
        assert (float(size.group(1)) > float(size.group(2))) == across


@poppler
def test_nothing_runs_over_the_edge_of_its_column(tmp_path: Path, eight_axes: ParameterFile) -> None:
    """Every word of a page lies between its margins, even with the longest numbers a double can have."""
    for address in list(eight_axes.values):
        value = eight_axes.values[address]
        if not isinstance(value.value, (str, bool)):
            eight_axes.set(address, type(value)(-123456.78901234567, value.unit))
    path = tmp_path / "r.pdf"
    write_report(eight_axes, path, sort="group")
    boxes = said_by("pdftotext", "-bbox", path, "-")
    for page in re.finditer(r'<page width="([\d.]+)".*?</page>', boxes, re.DOTALL):
        width, margin = float(page.group(1)), 12 / 25.4 * 72
        for right in re.findall(r'xMax="([\d.]+)"', page.group()):
            assert float(right) <= width - margin + 1.0


@poppler
def test_only_fonts_that_travel_in_the_file_are_used(tmp_path: Path, mill: ParameterFile) -> None:
    write_report(mill, tmp_path / "r.pdf")
    lines = said_by("pdffonts", tmp_path / "r.pdf").splitlines()[2:]
    assert lines
    assert all(re.search(r"\byes yes (yes|no)\b", line) for line in lines), lines
    assert {line.split("+")[1].split("-")[0] for line in lines} == {"LibertinusSerif"}
