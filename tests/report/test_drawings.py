"""The drawings of a report: each once, under another title, and diagrams two of a page."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report import Contents, print_report
from amp_studio.report.drawings import drawings
from amp_studio.report.wording import joined_places
from tests.campaigns import some

EXAMPLES = sorted(examples_folder().glob("*/*.amp"))


@pytest.mark.parametrize("path", some(EXAMPLES), ids=lambda path: path.parent.name)
def test_each_drawing_is_there_once_under_another_title(path: Path) -> None:
    found = drawings(open_file(path).file)
    assert len({figure.title for figure in found}) == len({figure.svg for figure in found}) == len(found)


def test_a_spindle_without_signals_has_its_loops_once() -> None:
    found = drawings(open_file(examples_folder() / "lathe-ls176" / "LATHE_LS176.amp").file)
    assert [figure.title for figure in found if figure.title.startswith("Loops S")] == ["Loops S"]


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="needs poppler's tools")
def test_two_loops_of_an_axis_are_on_a_page(tmp_path: Path) -> None:
    file = open_file(examples_folder() / "acromill-router" / "ROUTER.amp").file
    print_report(file, tmp_path / "r.pdf", Contents(changed_only=True))
    done = subprocess.run(
        ["pdftotext", "-layout", tmp_path / "r.pdf", "-"], capture_output=True, text=True, check=True
    )
    pages = re.findall(r"Loops ([XYZ]), signals at \S+ in/min  +(\d+)", done.stdout)
    assert len(pages) == 6
    assert len(set(pages)) == 3


def test_a_letter_that_two_axes_share_is_at_both() -> None:
    assert joined_places(["Axis 1", "Axis 2"]) == "Axis 1, 2"
    assert joined_places(["X", "S (axis 7)", "S (axis 8)"]) == "X, S (axis 7), S (axis 8)"
