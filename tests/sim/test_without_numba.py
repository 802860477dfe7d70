"""The program works whole where the extra ``fast`` is not installed: plain Python in place of machine code,
the same results.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys
from amp_studio.cli import main
sys.exit(main())
"""
WITHOUT = f"""
import sys
sys.modules["numba"] = sys.modules["llvmlite"] = None  # an import raises ImportError
{PROGRAM}"""


def simulated(program: str, path: Path, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", program, "simulate", str(path), *arguments, "--json"],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "arguments",
    [
        ["procedure"],  # asks for machine code whatever its length
        # More than PLAIN_STEPS of the kernel: machine code is used where it is.
        ["step", "--set", "move.distance=6000"],
    ],
)
def test_a_simulation_needs_no_machine_code(checkout: Path, arguments: list[str]) -> None:
    path = checkout / "examples" / "mill-1394" / "MILL_1394.amp"
    assert simulated(WITHOUT, path, *arguments) == simulated(PROGRAM, path, *arguments)
