"""How something is timed, and the one table of all results.

A measure is a list of seconds, of megabytes or of shares. Targets are medians on the machine
it runs on; the table shows "over" and nothing fails, because a time is not a test.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Literal


@dataclass(frozen=True)
class Measure:
    """One line of the table."""

    name: str
    figures: tuple[float, ...]
    """Seconds, megabytes or shares."""
    target: float | None = None
    """What the median should stay below; None for what is only reported, and for peers."""
    unit: Literal["s", "MB", "%"] = "s"

    @property
    def verdict(self) -> str:
        """``pass`` or ``over``; nothing where there is no target."""
        if self.target is None:
            return ""
        return "pass" if median(self.figures) < self.target else "over"


def worst(name: str, target: float, seconds: Sequence[float]) -> Measure:
    """Return the slowest of some times as the one figure that counts."""
    return Measure(f"{name}, at worst", (max(seconds),), target)


def timed(
    call: Callable[[], object], times: int, before: Callable[[], object] | None = None, warm: int = 1
) -> tuple[float, ...]:
    """Return the seconds of each of ``times`` calls; ``before`` runs ahead of each and does not count.

    ``warm`` calls come first and are thrown away, but where there is one call only, which shows that it runs.
    Python's collector runs as it does in the program.
    """
    seconds = []
    for n in range(-warm if times > 1 else 0, times):
        if before is not None:
            before()
        begin = time.perf_counter()
        call()
        elapsed = time.perf_counter() - begin
        if n >= 0:
            seconds.append(elapsed)
    return tuple(seconds)


def table(measures: Sequence[Measure]) -> str:
    """Return all measures as one table."""
    head = ("", "median", "min", "max", "target", "")
    rows = [head] + [
        (
            m.name,
            *(said(f, m.unit) for f in (median(m.figures), min(m.figures), max(m.figures))),
            f"< {said(m.target, m.unit)}" if m.target is not None else "",
            m.verdict,
        )
        for m in measures
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    lines = []
    for row in rows:
        cells = [
            row[0].ljust(widths[0]),
            *(cell.rjust(w) for cell, w in zip(row[1:], widths[1:], strict=True)),
        ]
        lines.append("  ".join(cells).rstrip())
    lines.insert(1, "-" * max(len(line) for line in lines))
    return "\n".join(lines)


def said(figure: float, measured: str = "s") -> str:
    """Write a figure with three digits and the unit that suits it: ``1.23 s``, ``45.6 ms``, ``789 µs``,
    ``12.3 MB``, ``3 %``.
    """
    if measured == "MB":
        return f"{figure:.1f} MB"
    if measured == "%":
        return f"{figure:.4g} %"
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        number = figure * factor
        if number >= 1 or unit == "µs":
            digits = 2 if number < 10 else 1 if number < 100 else 0
            return f"{number:.{digits}f} {unit}"
    raise AssertionError
