"""How a process apart is begun: for what keeps memory, cannot be interrupted, or may end its process.

It runs one function of the program and nothing of the program that asks: a process of multiprocessing runs
the script of a library's caller once more, with whatever that script does at a control.
"""

from __future__ import annotations

import sys
from pathlib import Path


def child_command(module: str, function: str) -> list[str]:
    """Return the command line of a process that calls ``function(asked, out)`` of a module with its input and
    its output, as bytes.

    The process finds the program where this one did, and nothing else that lies in its folder (``-P``).
    """
    call = f"from {module} import {function}; {function}(sys.stdin.buffer, sys.stdout.buffer)"
    script = f"import sys; sys.path.insert(0, sys.argv.pop()); {call}"
    return [sys.executable, "-P", "-c", script, str(Path(__file__).parents[1])]
