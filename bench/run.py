"""Measure AMP Studio and print one table: ``make bench``, or ``python bench/run.py``.

Everything is measured on a file of eight axes with every parameter set, and on the mill of the examples.
"""

import argparse
import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Collection, Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import cold
import comparing
import drag
import exchange
import find
import grid
import machine
import many_files
import moving
import published
import rules
import screen
import sim
import sim_laws
import warm
from measure import Measure, table

GROUPS = (
    "cold",
    "warm",
    "rules",
    "hall",
    "find",
    "published",
    "sim",
    "laws",
    "screen",
    "grid",
    "comparing",
    "drag",
    "memory",
    "exchange",
    "moving",
)
"""In the order of the table."""


def main() -> None:
    """Measure the groups that are asked for, or with --quick each once."""
    parser = argparse.ArgumentParser(description="Measure AMP Studio and print one table.")
    parser.add_argument(
        "--quick", action="store_true", help="everything once: shows that it runs, not how fast"
    )
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=GROUPS, help="these groups of measures")
    chosen = parser.parse_args()
    times = 1 if chosen.quick else 15
    print(
        f"Python {platform.python_version()} on {platform.system()}, {processor()}, {os.cpu_count()}"
        f" processors{load()}"
    )
    with tempfile.TemporaryDirectory(prefix="amp-studio-bench-") as name:
        print(table(list(measures(Path(name), times, chosen.only))))


def measures(folder: Path, times: int, groups: Collection[str]) -> Iterator[Measure]:
    """Yield the measures of these groups in the order of the table."""
    full = machine.write_full_file(folder)
    example = (
        Path(shutil.copytree(machine.example_path().parent, folder / "mill")) / machine.example_path().name
    )
    printed = (
        full if times > 1 else example
    )  # where nothing is to be known but that it runs, a small one will do
    few = max(1, times // 3)
    each = {
        "cold": lambda: cold.measures(folder, full, printed, example, max(1, times // 2)),
        "warm": lambda: warm.measures(folder, full, printed, example, times),
        "rules": lambda: rules.measures(folder, full, times),
        "hall": lambda: rules.measures_of_hall(folder, times),
        "find": lambda: find.measures(full, times),
        "published": published.measures,
        "sim": lambda: sim.measures(folder, times),
        "laws": lambda: sim_laws.measures(times),
        "screen": lambda: screen.measures(full, example, times),
        "grid": lambda: grid.measures(folder, times),
        "comparing": lambda: comparing.measures(folder, times),
        "drag": lambda: drag.measures(folder, times),
        "memory": lambda: many_files.measures(folder, full, times),
        "exchange": lambda: exchange.measures(folder, full, example, few),
        "moving": lambda: moving.measures(folder, times),
    }
    for group in GROUPS:
        if group in groups:
            yield from each[group]()


def processor() -> str:
    """Return the name of the processor, where the system shows it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def load() -> str:
    """Report how busy the machine is with other things, if it can; a busy machine measures too much."""
    return f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""


if __name__ == "__main__":
    main()
