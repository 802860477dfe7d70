"""A text of many lines is read in the time of its lines: a log of a day is no reason to wait."""

import time
from pathlib import Path

import pytest

from amp_studio.formats import import_file

LISTING = [f"${n}=100" for n in (0, 1, 2, 100, 101, 102, 110, 111, 112, 120, 121, 122)]
MARLIN = ["echo:  M92 X80.00 Y80.00 Z400.00", "echo: M203 X500.00 Y500.00 Z5.00"]
TEXTS = {
    "settings that nobody knows": [*LISTING, *(f"${n}={n}" for n in range(1000, 11_000))],
    "one code again and again": [*MARLIN, *["echo: M301 P22.20 I1.08"] * 40_000],
    "lines of blanks": [*LISTING, *[" " * 30] * 60_000],
    "many names of one control": [*LISTING, *(f"[BOARD:b{n}]" for n in range(100_000))],
}


@pytest.mark.parametrize("kind", TEXTS)
def test_a_long_text_is_read_in_the_time_of_its_lines(kind: str, tmp_path: Path) -> None:
    """Each of these took a minute and more."""
    path = tmp_path / "long.txt"
    path.write_text("\n".join(TEXTS[kind]), encoding="utf-8")
    begun = time.process_time()
    assert import_file(path).values
    assert time.process_time() - begun < 6
