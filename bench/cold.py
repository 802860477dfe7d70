"""What a user waits for when he starts a program: a fresh process each time."""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from statistics import median

from measure import Measure

BENCH = Path(__file__).resolve().parent
PATIENCE = 60.0
"""Seconds after which a desktop program that has painted nothing is ended."""
PROGRAM = (sys.executable, "-m", "amp_studio.cli")
NOT_INSTALLED = ("coverage", "scipy")
"""Packages of the tests that numba loads where it finds them; an installed program is without them."""


def measures(folder: Path, full: Path, printed: Path, example: Path, times: int) -> Iterator[Measure]:
    """Yield the measures of cold processes; ``folder`` takes what they write."""
    settings = _private(folder, own_bytecode=times > 1)
    runs = times + 1 if times > 1 else 1  # the first leaves compiled modules, and is thrown away
    python = [_run((sys.executable, "-c", "pass"), settings) for _ in range(runs)][-times:]
    yield Measure("  Python itself, cold process", tuple(python))

    def program(*arguments: str | Path) -> tuple[float, ...]:
        return tuple([_run((*PROGRAM, *map(str, arguments)), settings) for _ in range(runs)][-times:])

    bare = median(python)  # a start is judged by it, not in seconds
    yield Measure("--version, cold process", program("--version"), 8 * bare)
    yield Measure("validate, cold process", program("validate", full), 25 * bare)
    picture = program("simulate", example, "step", "-o", folder / "step.svg")
    yield Measure("simulate a move and draw it, cold process", picture, 1.0)
    yield Measure("report to PDF, cold process", program("report", printed, "-o", folder / "full.pdf"), 2.0)
    page = program("report", printed, "-o", folder / "full.html", "--without", "motion")
    yield Measure("report to a web page without motion, cold process", page, 0.5)
    whole = program("report", printed, "-o", folder / "whole.html")
    yield Measure("report to a web page with motion, cold process", whole, 1.0)
    paint = [_until_painted(example, settings) for _ in range(runs)][-times:]
    yield Measure("first paint of the desktop program, cold process", tuple(paint), 0.75)


def _private(folder: Path, own_bytecode: bool) -> Mapping[str, str]:
    """No display, no settings of the person who measures,
    and compiled modules kept as an installed program has them.

    ``own_bytecode`` keeps them apart from those of this person: the first run, which is thrown away,
    compiles every module.
    """
    absent = folder / "absent"
    absent.mkdir(exist_ok=True)
    for package in NOT_INSTALLED:
        (absent / f"{package}.py").write_text("raise ImportError\n", "utf-8")
    path = os.pathsep.join(filter(None, (str(absent), str(BENCH.parent), os.environ.get("PYTHONPATH", ""))))
    own = {"QT_QPA_PLATFORM": "offscreen", "XDG_CONFIG_HOME": str(folder), "PYTHONPATH": path}
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    if own_bytecode:
        own["PYTHONPYCACHEPREFIX"] = str(folder / "bytecode")
    return kept | own


def _run(command: tuple[str, ...], settings: Mapping[str, str]) -> float:
    begin = time.perf_counter()
    done = subprocess.run(command, env=settings, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    elapsed = time.perf_counter() - begin
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.decode()}")
    return elapsed


def _until_painted(example: Path, settings: Mapping[str, str]) -> float:
    """Return the time from the start of the process until it reports
    that it has painted the table of the example.
    """
    command = (sys.executable, str(BENCH / "first_paint.py"), str(example))
    begin = time.perf_counter()
    with subprocess.Popen(command, env=settings, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        watchdog = threading.Timer(PATIENCE, process.kill)
        watchdog.start()
        assert process.stdout is not None
        assert process.stderr is not None
        line = process.stdout.readline()
        elapsed = time.perf_counter() - begin
        said = process.stderr.read()
        watchdog.cancel()
    if line.strip() != b"painted":
        raise RuntimeError(f"the desktop program was not painted: {said.decode()}")
    return elapsed
