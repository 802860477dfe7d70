"""The demonstration is the main job from end to end; it ends with nothing that differs."""

from __future__ import annotations

import pytest

from amp_studio.demo import run_demo


def test_the_demonstration_in_the_terminal_succeeds(capsys: pytest.CaptureFixture[str]) -> None:
    """Open, validate, print, download, verify, upload, compare: exit code 0."""
    assert run_demo(terminal=True) == 0

    message = capsys.readouterr().out
    assert "0 errors" in message
    assert "read back equal" in message
    assert "0 values differ" in message
