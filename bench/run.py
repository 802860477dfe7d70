"""Measure AMP Studio and print one table: ``make bench``, or ``python bench/run.py [--quick]``.

Everything is measured on a file of eight axes with every parameter set, and on the mill of the examples.
"""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Iterator
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
import published
import rules
import screen
import sim
import sim_laws
import warm
from measure import Measure, table


def main() -> None:
    """Measure everything, or with --quick everything once."""
    parser = argparse.ArgumentParser(description="Measure AMP Studio and print one table.")
    parser.add_argument(
        "--quick", action="store_true", help="everything once: shows that it runs, not how fast"
    )
    times = 1 if parser.parse_args().quick else 15
    print(
        f"Python {platform.python_version()} on {platform.system()}, {processor()}, {os.cpu_count()}"
        f" processors{load()}"
    )
    with tempfile.TemporaryDirectory(prefix="amp-studio-bench-") as name:
        print(table(list(measures(Path(name), times))))


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield every measure in the order of the table."""
    full = machine.write_full_file(folder)
    example = (
        Path(shutil.copytree(machine.example_path().parent, folder / "mill")) / machine.example_path().name
    )
    printed = (
        full if times > 1 else example
    )  # where nothing is to be known but that it runs, a small one will do
    yield from cold.measures(folder, full, printed, example, max(1, times // 2))
    yield from warm.measures(folder, full, printed, example, times)
    yield from rules.measures(folder, full, times)
    yield from find.measures(full, times)
    yield from published.measures()
    yield from sim.measures(folder, times)
    yield from sim_laws.measures(times)
    yield from screen.measures(folder, full, times)
    yield from grid.measures(folder, times)
    yield from comparing.measures(folder, times)
    yield from drag.measures(folder, times)
    yield from many_files.measures(folder, full, times)
    yield from exchange.measures(folder, full, example, max(1, times // 3))


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
