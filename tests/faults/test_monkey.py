"""Actions that the monkey chose once, done again in the window of each family: the first hundred, and all in
``make faults``, which has it choose others too.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.campaigns import CAMPAIGN

from .monkey import FAMILIES

ACTIONS = Path(__file__).with_name("actions")


@pytest.mark.parametrize("family", FAMILIES)
def test_the_window_lives_through_what_the_monkey_did(family: str, checkout: Path, tmp_path: Path) -> None:
    actions = (ACTIONS / f"{family}.jsonl").read_text("utf-8").splitlines(keepends=True)
    actions = actions if CAMPAIGN else actions[:100]
    log = tmp_path / "actions.jsonl"
    log.write_text("".join(actions), "utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults.monkey", family, "--replay", str(log)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=checkout,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith(f"{len(actions)} actions, 0 errors")
