"""The demonstration is the main job from end to end; it ends with nothing that differs."""

import pytest

from amp_studio.demo import run_demo

from .docs.stage import leave_out_what_takes_long


def test_the_demonstration_in_the_terminal_succeeds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Open, validate, print, download, verify, upload, compare: exit code 0."""
    leave_out_what_takes_long(monkeypatch)
    assert run_demo(terminal=True) == 0

    message = capsys.readouterr().out
    assert "0 errors" in message
    assert "read back equal" in message
    assert "0 values differ" in message
