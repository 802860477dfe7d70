"""Notes keep their lines and what they are indented by, in every format that a person reads."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.files.notes import set_machine_note, set_value_note
from amp_studio.report import Contents
from amp_studio.report.wording import note_lines
from amp_studio.report.write import print_report
from tests.report.conftest import DATE

WRITTEN = "Belt changed:\n  - X\n\n\t- Z & <Y>"


def test_blanks_at_the_start_of_a_line_are_kept() -> None:
    assert note_lines(WRITTEN) == [
        "Belt changed:",
        "\u00a0\u00a0- X",
        "",
        "\u00a0\u00a0\u00a0\u00a0- Z & <Y>",
    ]


@pytest.mark.parametrize(
    ("ending", "lines"),
    [
        (".html", "Belt changed:<br>\u00a0\u00a0- X<br><br>\u00a0\u00a0\u00a0\u00a0- Z &amp; &lt;Y&gt;"),
        (".txt", "Belt changed:\n{0}\u00a0\u00a0- X\n\n{0}\u00a0\u00a0\u00a0\u00a0- Z & <Y>"),
    ],
)
def test_a_report_has_them(tmp_path: Path, mill: ParameterFile, ending: str, lines: str) -> None:
    set_value_note(mill, ("home.calibration", "1"), WRITTEN)
    set_machine_note(mill, WRITTEN)
    without = frozenset({"pictures", "motion", "power-up", "exchanges", "signatures"})
    print_report(mill, tmp_path / f"r{ending}", Contents(without=without, changed_only=True), date=DATE)
    text = (tmp_path / f"r{ending}").read_text("utf-8")
    about = next(line for line in text.splitlines() if "Belt changed:" in line and "1300" in line)
    assert lines.format(" " * about.index("Belt")) in "\n".join(
        line.rstrip(" ") for line in text.splitlines()
    )
