"""Actions that the monkey chose once, done again in one window over the files of every family;
``make faults`` has it choose others, ten minutes a family.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from .monkey import ALL

ACTIONS = Path(__file__).with_name("actions.jsonl")


def test_the_window_lives_through_what_the_monkey_did(checkout: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults.monkey", ALL, "--replay", str(ACTIONS)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=checkout,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith(f"{len(ACTIONS.read_text('utf-8').splitlines())} actions, 0 errors")
