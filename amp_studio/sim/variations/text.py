"""What a sweep shows, as lines and for JSON; nothing for any other trace."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from amp_studio.sim.rounding import value_text
from amp_studio.sim.trace import Figure, Trace

_PERCENTILE = re.compile(r"(.+)_p([0-9]+)")
MORE_IS_BETTER = ("phase_margin", "gain_margin", "damping_ratio")
"""Figures of which the best is the largest."""
Spread = dict[str, dict[str, Figure]]
"""Figure -> percentile -> its value."""


def parted(trace: Trace) -> tuple[Mapping[str, Figure], Spread]:
    """Return the figures of a trace, and percentiles apart."""
    if not trace.over:
        return trace.result, {}
    single: dict[str, Figure] = {}
    spread: Spread = {}
    for name, figure in trace.result.items():
        found = _PERCENTILE.fullmatch(name)
        if found:
            spread.setdefault(found[1], {})[found[2]] = figure
        else:
            single[name] = figure
    return single, spread


def spread_lines(spread: Spread, width: int) -> Iterator[str]:
    """Yield the percentiles, a line a figure."""
    if spread:
        parts = next(iter(spread.values()))
        yield f"  {'percentiles'.ljust(width)}  {''.join(f'{part} %'.rjust(11) for part in parts)}"
    for name, parts in spread.items():
        unit = next(iter(parts.values()))[1]
        texts = ["–" if value is None else value_text(value, "", 4) for value, _ in parts.values()]
        columns = "".join(text.rjust(11) for text in texts)
        yield f"  {name.replace('_', ' ').ljust(width)}  {columns} {unit}".rstrip()


def best_row(trace: Trace) -> int | None:
    """Return the safe variation that has the best of the figure that a sweep is about;
    None where none is safe.
    """
    values = np.where(trace.columns["safe"] == 1.0, trace.columns[trace.figure], math.nan)
    if not np.isfinite(values).any():
        return None
    return int(np.nanargmax(values) if trace.figure in MORE_IS_BETTER else np.nanargmin(values))


def _safe_ranges(trace: Trace) -> dict[str, tuple[float, float]]:
    """Return between which values of each varied thing a variation is safe; empty where none is."""
    safe = trace.columns["safe"] == 1.0
    if not safe.any():
        return {}
    return {
        name: (float(trace.columns[name][safe].min()), float(trace.columns[name][safe].max()))
        for name in trace.over
    }


def variation_lines(trace: Trace) -> Iterator[str]:
    """Yield the best variation, the safe region and the present point."""
    if not trace.over:
        return
    row = best_row(trace)
    if row is not None:
        there = ", ".join(
            f"{name} {value_text(float(trace.columns[name][row]), trace.units[name])}" for name in trace.over
        )
        yield f"best {trace.figure.replace('_', ' ')} of the safe ones: {there}"
    for name, (low, high) in _safe_ranges(trace).items():
        yield f"safe: {name} {value_text(low)} to {value_text(high, trace.units[name])}"
    present = [f"{name} {value_text(*figure)}" for name, figure in _present(trace).items()]
    if present:
        yield f"at present: {', '.join(present)}"


def _present(trace: Trace) -> dict[str, tuple[float, str]]:
    return {name: (value, unit) for name, (value, unit) in trace.limits.items() if value is not None}


def variations_summary(trace: Trace) -> dict[str, Any]:
    """Return what JSON has of a sweep beside its result."""
    if not trace.over:
        return {}
    row, spread = best_row(trace), parted(trace)[1]
    measured = [name for name in trace.columns if name not in trace.over]
    return {
        "percentiles": {
            name: {part: value for part, (value, _) in parts.items()} for name, parts in spread.items()
        },
        "best": (
            None
            if row is None
            else {"at": _figures(trace, trace.over, row), "figures": _figures(trace, measured, row)}
        ),
        "safe": {
            "count": int(trace.columns["safe"].sum()),
            "ranges": {name: list(ends) for name, ends in _safe_ranges(trace).items()},
        },
        "present": {name: {"value": value, "unit": unit} for name, (value, unit) in _present(trace).items()},
    }


def _figures(trace: Trace, names: Any, row: int) -> dict[str, dict[str, Any]]:
    values = {name: float(trace.columns[name][row]) for name in names}
    return {
        name: {"value": value if math.isfinite(value) else None, "unit": trace.units[name]}
        for name, value in values.items()
    }
