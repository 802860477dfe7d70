"""What a spindle puts out over its speed, with the gear of a programmed one and speeds that no gear has."""

from __future__ import annotations

from dataclasses import replace

from amp_studio.drawing import Dot, FilledArea, Point, Polyline, Scene, Text
from amp_studio.sim import Trace, value_text

from .file_pictures import FilePicture


def draw_spindle(picture: FilePicture, trace: Trace | None = None) -> Scene:
    """Return the gears of a spindle, with what ``trace`` of `spindle` made of a programmed speed."""
    base = replace(picture.scene(""), handles=())
    if trace is None:
        return base
    figure = {name: value for name, (value, _) in trace.result.items()}
    areas, lines, dots, texts = list(base.areas), list(base.lines), list(base.dots), list(base.texts)
    low, high = figure.get("gap_low"), figure.get("gap_high")
    if low is not None and high is not None:
        areas.append(FilledArea(low, base.y.low, high, base.y.high, "gap"))
        gap = f"{value_text(high - low)} rpm in no gear"
        texts.append(Text((high, 0.15 * base.y.high), gap, "", "left", None, "output"))
    speed, output = figure.get("speed"), figure.get("output")
    if speed is not None and output is not None:
        at: Point = abs(speed), output
        lines.append(Polyline(((0.0, output), at, (at[0], 0.0)), "now", dotted=True))
        dots.append(Dot(at, "point", "now"))
        texts.append(Text(at, f"S{value_text(abs(speed))}", _in_short(trace), "inside", None, "now"))
    return replace(base, areas=tuple(areas), lines=tuple(lines), dots=tuple(dots), texts=tuple(texts))


def _in_short(trace: Trace) -> str:
    """Return gear, output and time of a speed."""
    gear, output, time = (trace.result[name] for name in ("gear", "output", "ramp_time"))
    parts = [f"gear {value_text(gear[0])}"] if gear[0] is not None else []
    parts += [value_text(value, unit, 3) for value, unit in (output, time) if value is not None]
    return ", ".join(parts)
