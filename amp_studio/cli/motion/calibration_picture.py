"""The errors of an axis as a picture: as they were measured, and as they are expected to remain."""

from __future__ import annotations

from typing import Literal

from amp_studio.calibration import Proposal
from amp_studio.drawing import Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.schema import unit_text

_MICRO = 1000.0
"""Errors are drawn in µm where positions are in mm."""
_SORTS: dict[tuple[str, bool], ShapeSort] = {
    ("measured", True): "dim",
    ("measured", False): "second",
    ("expected", True): "now",
    ("expected", False): "ink",
}


_DIRECTIONS: dict[bool, tuple[str, Literal["above", "below"]]] = {
    True: ("rising", "below"),
    False: ("falling", "above"),
}
"""Whether the axis rises -> the name of the direction, and where its curve is named."""


def proposal_scene(proposal: Proposal, title: str) -> Scene:
    """Return the mean errors of both directions over the position, before and after."""
    times, unit = (_MICRO, "µm") if proposal.unit == "mm" else (1.0, unit_text(proposal.unit))
    lines, texts = [], []
    for when, sides in (("measured", proposal.before), ("expected", proposal.after)):
        for side, curve in sides.items():
            points = tuple((float(at), float(by) * times) for at, by in curve.points)
            sort = _SORTS[when, side]
            direction, where = _DIRECTIONS[side]
            lines.append(Polyline(points, sort, dashed=when == "measured"))
            texts.append(Text(points[-1], f"{when}, {direction}", "", where, None, sort))
    xs, ys = zip(*(point for line in lines for point in line.points), strict=True)
    margin, room = 0.02 * (max(xs) - min(xs)), 0.15 * (max(ys) - min(ys)) or 1.0
    return Scene(
        "calibration",
        proposal.axis,
        title,
        f"error {float(proposal.span_before) * times:.4g} {unit} measured,"
        f" {float(proposal.span_after) * times:.4g} {unit} expected",
        Scale("position", unit_text(proposal.unit), min(xs) - margin, max(xs) + 6 * margin),
        Scale("error", unit, min(*ys, 0.0) - room, max(*ys, 0.0) + room),
        lines=tuple(lines),
        texts=tuple(texts),
    )
