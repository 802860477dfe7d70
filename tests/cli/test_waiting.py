"""What somebody at a terminal sees while an exchange waits."""

import io
import sys

import pytest

from amp_studio.cli.console import progress
from amp_studio.cli.screen import Screen, print_notice


class Terminal(io.BytesIO):
    """Remembers what was written; ``lines`` is the text of its lines."""

    def isatty(self) -> bool:
        return True

    @property
    def lines(self) -> list[str]:
        lines = self.getvalue().decode().split("\n")
        return [line.split("\r")[-1].replace("\x1b[K", "") for line in lines]


def at_terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """Put a terminal in the place of standard error."""
    made = Terminal()
    monkeypatch.setattr(sys, "stderr", Screen(made, encoding="utf-8"))
    return made


def test_a_silence_is_one_line_that_counts_and_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = at_terminal(monkeypatch)
    show = progress()
    show("keep", 50, 100)
    show("silent", 2, 20)
    assert terminal.lines == ["no answer for 2 s, trying again …"]
    show("silent", 3, 20)
    assert terminal.lines == ["no answer for 3 s, trying again …"]
    show("silent", 0, 20)
    show("keep", 50, 100)
    assert terminal.lines == ["the control answers again", "keep  50 %"], "the same per cent is shown again"


def test_an_error_is_on_a_line_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = at_terminal(monkeypatch)
    progress()("silent", 19, 20)
    print_notice("amp-studio: the control has not answered for 20 s")
    assert terminal.lines == ["amp-studio: the control has not answered for 20 s", ""]


def test_a_restart_shows_what_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = at_terminal(monkeypatch)
    show = progress()
    show("restart", 30, 600)
    assert terminal.lines == ["waiting for the control to restart   5 %"]
    show("restart", 1, 1)
    assert terminal.lines == ["waiting for the control to restart 100 %", ""]


def test_elsewhere_each_silence_is_one_line_and_its_end_another(capsys: pytest.CaptureFixture[str]) -> None:
    show = progress()
    for seconds in (2, 3, 4, 0, 2, 3):
        show("silent", seconds, 20)
    show("restart", 1, 600)
    show("restart", 90, 600)
    show("restart", 1, 1)
    assert capsys.readouterr().err.splitlines() == [
        "no answer for 2 s, trying again …",
        "the control answers again",
        "no answer for 2 s, trying again …",
        "waiting for the control to restart",
        "restart 100 %",
    ]
