"""Actions that the monkey chose once, done again in one window over the files of every family;
``make faults`` has it choose others, ten minutes a family.
"""

import subprocess
import sys
from pathlib import Path

from tests.campaigns import CAMPAIGN

from .monkey import ALL

ACTIONS = Path(__file__).with_name("actions.jsonl")
SOME = 60
"""Actions that ``make test`` does again; ``make faults`` does all of them."""


def test_the_window_lives_through_what_the_monkey_did(checkout: Path, tmp_path: Path) -> None:
    actions = ACTIONS.read_text("utf-8").splitlines()[: None if CAMPAIGN else SOME]
    log = tmp_path / "actions.jsonl"
    log.write_text("\n".join(actions), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults.monkey", ALL, "--replay", str(log)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=checkout,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith(f"{len(actions)} actions, 0 errors")
