"""The desktop program is opened by the command alone, and by a file."""

from __future__ import annotations

from collections.abc import Sequence

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
