"""Every command of the page of coverage runs on its example."""

import json
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
    if verb == "simulate":
        assert_shown(words[1], message.out)


SHOWN = {
    "home": {"home_position"},
    "jog": {"feedrate", "stop_position"},
    "travel": {"limit"},
    "spindle": {"gear", "speed"},
    "tap": {"reversal_error"},
    "probe": {"captured_position"},
    "fault": {"run_out"},
    "gear": {"gear_ratio"},
    "cam": {"points", "peak_velocity_error"},
    "backlash": {"move_1"},
    "step": {"peak_following_error"},
    "frequency": {"bandwidth"},
    "circle": {"radius_error"},
    "hard-stop": {"detection_torque"},
    "adaptive-feed": {"torque_after", "time_off_torque"},
    "passive-home": {"home_position"},
    "handwheel": {"step", "distance", "feedrate"},
    "clamp": {"time_before", "motion_time", "time"},
    "synchronize": {"speed", "seek_time", "deviation"},
}
"""Scenario -> figures that it shows of what a row is about, unless the motion ends in an alarm."""


def assert_shown(scenario: str, output: str) -> None:
    """Check that the figures are there and a motion whose end is the subject has words for it."""
    result = json.loads(output)
    assert result["scenario"] == scenario
    there = {name for name, figure in result["result"].items() if figure["value"] is not None}
    missing = SHOWN.get(scenario, set()) - there
    assert not missing or result["alarms"], missing
    assert result["trace"]["rows"] > 0


def test_the_page_has_all_of_its_rows() -> None:
    assert len(ROWS) == 322
