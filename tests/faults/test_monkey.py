"""Actions that the monkey chose once, done again in the window of each family;
``make faults`` has it choose others.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from .monkey import FAMILIES

ACTIONS = Path(__file__).with_name("actions")


@pytest.mark.parametrize("family", FAMILIES)
def test_the_window_lives_through_what_the_monkey_did(family: str, checkout: Path) -> None:
    log = ACTIONS / f"{family}.jsonl"
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults.monkey", family, "--replay", str(log)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=checkout,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith(f"{len(log.read_text('utf-8').splitlines())} actions, 0 errors")
