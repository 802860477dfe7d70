"""The desktop program is opened by the command alone, and by a file."""

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from amp_studio import ui
from amp_studio.cli.program import run_verb


@pytest.mark.parametrize("arguments", [[], ["MILL.amp"], ["a folder/mill.AMP", "-lathe.amp"]])
def test_the_desktop_program_opens_on_the_files_that_are_named(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str]
) -> None:
    opened: list[Sequence[str]] = []

    def main(files: Sequence[str]) -> int:
        opened.append(files)
        return 0

    monkeypatch.setattr(ui, "main", main)
    assert run_verb(arguments) == 0
    assert opened == [arguments]


def test_a_verb_goes_before_files(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_verb(["get", "nothing.amp"]) == 2
    assert "nothing.amp" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="there is always a display")
@pytest.mark.parametrize("line", ["", "MILL_1394.amp", "merge a.amp a.amp a.amp -o b.amp --window"])
def test_without_a_display_one_line_shows_it(
    line: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    shutil.copy(Path(__file__).parents[2] / "examples/mill-1394/MILL_1394.amp", "a.amp")
    assert run_verb(line.split()) == 2
    displayed = capsys.readouterr().err
    assert displayed.count("\n") == 1
    assert displayed.startswith("amp-studio: There is no display for the desktop program")
