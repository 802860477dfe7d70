"""The names of the room are all there, though each is loaded only when it is asked for."""

from __future__ import annotations

import subprocess
import sys

import pytest

from amp_studio import report


def test_every_name_is_there() -> None:
    assert set(report._PLACES) == set(report.__all__)
    assert all(getattr(report, name) is not None for name in report.__all__)
    with pytest.raises(AttributeError, match="no attribute nothing"):
        report.nothing  # noqa: B018  # to ask for it is the test


def test_a_finding_is_put_into_words_without_the_room_that_sets_pages() -> None:
    script = "import sys; from amp_studio.report import finding_text; print('amp_studio.report.pdf' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
