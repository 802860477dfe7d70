"""Every command of the page of coverage runs on its example."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from amp_studio.cli import run

from .stage import leave_out_what_takes_long

ROOT = Path(__file__).parents[2]
ROWS = re.findall(
    r"^\| ([^|]+) \| ([^|]+) \| [^|]+ \| `([^`]+)` \|$",
    (ROOT / "docs" / "coverage.md").read_text("utf-8"),
    re.MULTILINE,
)


@pytest.mark.parametrize(
    ("family", "what", "command"), ROWS, ids=[f"{family}: {what}" for family, what, _ in ROWS]
)
def test_a_capability_is_shown_by_its_command(
    family: str, what: str, command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    leave_out_what_takes_long(monkeypatch)
    verb, *words = shlex.split(command)
    examples = ROOT / "examples"
    words = [str(examples / word) if (examples / word).is_file() else word for word in words]
    code = run([verb, *words, *([] if verb == "calculate" else ["--json"])])
    message = capsys.readouterr()
    assert code in (0, 1), message.err
    if answer := what.partition(" → ")[2]:
        assert answer in message.out.strip().split(", ")
        return
    for alarm in re.findall(r"MOT-0\d\d|ALARM:\d", what.rsplit(",", maxsplit=1)[-1]):
        assert alarm in message.out, family


def test_the_page_has_all_of_its_rows() -> None:
    assert len(ROWS) == 314
