"""Runs the fault campaigns whole and prints one table: ``make faults``,
``make faults FAULTS="--only journal --share 0.1"``.
"""

import argparse
import os
import resource
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from .campaigns import CAMPAIGNS

MEMORY = 4 << 30
"""Bytes that one process may take: a content that asks for more is a violation."""


def _start() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def _part(number: int, seed: int, runs: int) -> tuple[list[str], float]:
    """Return the violations, and the seconds of processor time that they took to find."""
    began = _processor_seconds()
    with tempfile.TemporaryDirectory(prefix="amp-studio-faults-") as folder:
        os.environ["XDG_CONFIG_HOME"] = os.environ["XDG_STATE_HOME"] = folder
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
        found = CAMPAIGNS[number].run(seed, runs, Path(folder))
    return found, _processor_seconds() - began


def _processor_seconds() -> float:
    """Return the processor time of this process and of those that it has started and waited for."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(used.ru_utime + used.ru_stime for used in both)


def main() -> int:
    """Run what is asked for; 1 where anything was violated."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="campaigns whose name holds this")
    parser.add_argument("--share", type=float, default=1.0, help="of the whole number of runs")
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    options = parser.parse_args()
    violated = False
    print(f"{'campaign':44} {'runs':>9} {'violations':>11} {'seconds':>9} {'CPU ms/run':>11}")
    with ProcessPoolExecutor(options.processes, initializer=_start) as pool:
        for number, campaign in enumerate(CAMPAIGNS):
            if options.only.casefold() not in campaign.name.casefold():
                continue
            began, runs = time.monotonic(), max(1, round(campaign.whole * options.share))
            sizes = [min(campaign.at_once, runs - done) for done in range(0, runs, campaign.at_once)]
            parts = [pool.submit(_part, number, options.seed + n, size) for n, size in enumerate(sizes)]
            results = [part.result() for part in parts]
            found = [fault for faults, _ in results for fault in faults]
            cost = sum(seconds for _, seconds in results) / runs * 1000
            violated |= bool(found)
            took = time.monotonic() - began
            print(f"{campaign.name:44} {runs:9} {len(found):11} {took:9.0f} {cost:11.2f}", flush=True)
            print(*(f"    {fault}\n" for fault in found), sep="", end="", flush=True)
    return int(violated)


if __name__ == "__main__":
    sys.exit(main())
