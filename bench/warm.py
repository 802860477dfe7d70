"""What happens again and again in a program that runs: opening, checking, editing, saving, printing,
simulating.
"""

import gc
import tracemalloc
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

import peers
from measure import Measure, timed
from rules import EDITED

from amp_studio.files import Document, new_file, open_file
from amp_studio.report import print_report
from amp_studio.schema import Value, load_schema
from amp_studio.schema.load import load_compiled
from amp_studio.sim import simulate
from amp_studio.validate import Validator


def measures(folder: Path, full: Path, printed: Path, example: Path, times: int) -> Iterator[Measure]:
    """Yield the measures of a warm process; ``folder`` takes what is written."""
    yield Measure(
        "load the schema from its cache", timed(lambda: load_schema("9pc"), times, _forget_schema), 0.030
    )
    axes = ("X", "Y", "Z", "A", "B", "C", "S", "S")
    yield Measure("  the loaded schema in memory", (_memory(),), 60.0, "MB")
    yield Measure("new file of eight axes", timed(lambda: new_file("9pc", "mill", axes), times))
    yield Measure("open and validate", timed(lambda: Validator(open_file(full).file).run(), times), 0.030)
    yield Measure("  open alone", timed(lambda: open_file(full), times))
    yield from peers.measures(full, times)
    yield from _saves(folder, full, times)
    file, pdf = open_file(printed).file, folder / "warm.pdf"
    print_it = timed(lambda: print_report(file, pdf, source=printed), times)
    yield Measure("report to PDF", print_it)
    mill = open_file(example).file
    yield Measure(
        "simulate a rapid move of one axis", timed(lambda: simulate(mill, "step", "1"), times, warm=2)
    )


def _forget_schema() -> None:
    load_compiled.cache_clear()
    load_schema.cache_clear()


def _memory() -> float:
    """Return the megabytes that Python allocates for the loaded family and keeps."""
    _forget_schema()
    gc.collect()
    tracemalloc.start()
    schema = load_schema("9pc")
    schema.on("mill").addressed_by("1")
    schema.on("lathe").addressed_by("1")
    gc.collect()
    held = tracemalloc.get_traced_memory()[0] / 1e6
    tracemalloc.stop()
    return held


def _saves(folder: Path, full: Path, times: int) -> Iterator[Measure]:
    """Yield a save of one changed value: backup, sync, hash check and history included."""
    path = folder / "saved.amp"
    path.write_bytes(full.read_bytes())
    values = cycle([Value(12.0, "mm"), Value(11.0, "mm")])
    with Document.open(path) as document:
        change = lambda: document.file.set(EDITED, next(values))  # noqa: E731  # one line to hand over
        yield Measure("save", timed(document.save, times, change))
