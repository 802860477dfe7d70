"""The program works whole where the extra ``fast`` is not installed: plain Python in place of machine code,
the same results.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.sim.engine import compiled
from tests.campaigns import CAMPAIGN

WITHOUT = """
import json, sys
sys.modules["numba"] = sys.modules["llvmlite"] = None  # an import raises ImportError
from amp_studio.cli import run
from amp_studio.sim.engine import compiled
compiled.PLAIN_STEPS = 0  # machine code is used where it is
sys.exit(sum(run(arguments) for arguments in json.loads(sys.argv[1])))
"""

SCENARIOS = ("step", "procedure") if CAMPAIGN else ("step",)
"""The second one asks for machine code whatever its length, and takes two seconds without it."""


def test_a_simulation_needs_no_machine_code(
    checkout: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = str(checkout / "examples" / "mill-1394" / "MILL_1394.amp")
    lines = [["simulate", path, scenario, "--json"] for scenario in SCENARIOS]
    command = [sys.executable, "-c", WITHOUT, json.dumps(lines)]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    monkeypatch.setattr(compiled, "PLAIN_STEPS", 0)
    assert not any(cli.run(line) for line in lines)
    assert capsys.readouterr().out == done.stdout
