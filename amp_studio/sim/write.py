"""Writes a trace to a file (CSV, SVG or PNG by its extension), as text and as JSON."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from amp_studio.files import Notify, write_atomic
from amp_studio.scenarios import CHARTS
from amp_studio.schema import write_number

from .errors import SimulationError
from .picture import plot_svg
from .rounding import value_text
from .trace import Trace
from .variations.text import parted, spread_lines, variation_lines, variations_summary

_PIXELS_PER_INCH = 144
"""Resolution of a PNG; a point of the SVG is 1/72 inch."""

_ENDINGS = (".csv", ".svg", ".png")


def trace_csv(trace: Trace) -> str:
    """Return the trace as CSV: column names, then one line for each row with exact numbers,
    empty where nothing was measured.
    """
    lines = [",".join(_heading(trace))]
    columns = [column.tolist() for column in trace.columns.values()]
    lines += [",".join(map(_cell, row)) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def _cell(number: float) -> str:
    return "" if math.isnan(number) else repr(number)


def _heading(trace: Trace) -> list[str]:
    """Return the column names with units; time and torque already have the unit in their name."""
    return [
        name if name in ("time_s", "torque_percent") else f"{name} [{trace.units[name]}]"
        for name in trace.columns
    ]


def _plot_png(trace: Trace, before: Trace | None = None, chart: str = CHARTS[0]) -> bytes:
    """Return the plot as PNG, drawn by Typst; ``before`` is drawn under the trace."""
    import typst  # needed for a PNG only

    page = (
        "#set page(width: auto, height: auto, margin: 0pt)\n"
        '#image(bytes(sys.inputs.at("plot")), format: "svg")\n'
    )
    image = typst.compile(
        page.encode(),
        format="png",
        ppi=_PIXELS_PER_INCH,
        sys_inputs={"plot": plot_svg(trace, before, chart=chart)},
    )
    if not isinstance(image, bytes):
        raise SimulationError("the plot did not fit on one page")
    return image


def trace_text(trace: Trace, named: Callable[[str], str] = str) -> str:
    """Return the result as text for the terminal: alarms, figures, recommendations, assumptions;
    ``named`` names a parameter by its id.
    """
    lines = [f"{trace.scenario}{', axis ' + trace.axis_title if trace.axis else ''}: {trace.model}"]
    lines += [f"DOUBTFUL: {doubt}" for doubt in trace.doubts]
    lines += [
        f"ALARM {alarm.code} at {value_text(alarm.time_s, 's')}: {alarm.message}" for alarm in trace.alarms
    ]
    result, spread = parted(trace)
    width = max(len(name) for name in (*result, *spread))
    for name, (value, unit) in result.items():
        words = name.replace("_", " ").ljust(width)
        none = "not steady" if name.startswith("steady") else "not reached"
        lines.append(f"  {words}  {none if value is None else value_text(value, unit, 6)}")
    lines += spread_lines(spread, width)
    lines += [f"  {line}" for line in variation_lines(trace)]
    for heading, entries in (
        (
            "Recommendations",
            [
                f"{named(a.parameter)} = {value_text(a.value, a.unit, 9)}:"
                f" {a.why}{f' Price: {a.price}' if a.price else ''}"
                for a in trace.recommendations
            ],
        ),
        ("Assumptions", list(trace.assumptions)),
    ):
        if entries:
            lines += [heading, *(f"  {entry}" for entry in entries)]
    return "\n".join(lines)


def write_trace(
    trace: Trace,
    path: Path,
    notify: Notify = lambda _note: None,
    *,
    before: Trace | None = None,
    chart: str = CHARTS[0],
) -> None:
    """Write ``.csv``, ``.svg`` or ``.png``, whole or not at all; ``notify`` is called with each lost file
    attribute, and ``chart`` is how an open loop is drawn.

    Raises SimulationError for another ending, SaveError where it cannot.
    """
    ending = path.suffix.lower()
    if ending == ".csv":
        content = trace_csv(trace).encode()
    elif ending == ".svg":
        content = plot_svg(trace, before, chart=chart).encode()
    elif ending == ".png":
        content = _plot_png(trace, before, chart)
    else:
        raise SimulationError(
            f"{path.name}: unknown format of a trace. Use the file extension {', '.join(_ENDINGS)}"
        )
    write_atomic(path, content, keep_backup=False, notify=notify)


def with_uncertainty(summary: dict[str, Any]) -> dict[str, Any]:
    """Return what `trace_summary` gives of `identify` with the standard error of a figure in it too,
    as its ``uncertainty``.
    """
    result = summary["result"]
    for name, figure in result.items():
        error = result.get(f"{name}_standard_error")
        if error is not None:
            figure["uncertainty"] = error["value"]
    return summary


def trace_summary(trace: Trace, named: Callable[[str], str] = str) -> dict[str, Any]:
    """Return the result without the curves, in the form of ``simulate --json``;
    ``named`` names a parameter by its id.
    """
    return {
        "scenario": trace.scenario,
        "axis": trace.axis,
        "letter": trace.letter or trace.axis,
        "model": trace.model,
        "result": {name: {"value": value, "unit": unit} for name, (value, unit) in trace.result.items()},
        "alarms": [{"code": a.code, "time_s": a.time_s, "message": a.message} for a in trace.alarms],
        "advice": [
            {
                "param": named(a.parameter),
                "value": f"{write_number(a.value)} {a.unit}".rstrip(),
                "why": a.why,
                "price": a.price,
            }
            for a in trace.recommendations
        ],
        "doubts": list(trace.doubts),
        "assumptions": list(trace.assumptions),
        "trace": {"columns": list(trace.columns), "rows": trace.rows},
        **variations_summary(trace),
    }
