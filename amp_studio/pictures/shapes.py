"""The shapes of one picture while it is drawn."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from amp_studio.drawing import Dot, FilledArea, Handle, Point, Polyline, Scale, Scene, Text

from .figures import DrawnValue, ValueReader


@dataclass
class SceneShapes:
    """The shapes drawn so far, of the values that ``figures`` reads."""

    figures: ValueReader
    areas: list[FilledArea] = field(default_factory=list)
    lines: list[Polyline] = field(default_factory=list)
    dots: list[Dot] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    handles: list[Handle] = field(default_factory=list)

    def limit(self, points: tuple[Point, Point], each: DrawnValue) -> None:
        """Draw a dashed line at a value that bounds others."""
        self.lines.append(Polyline(points, "error" if each.wrong else "limit", dashed=True))

    def scene(
        self, name: str, part: str, title: str, subtitle: str, x: Scale, y: Scale, **further: Any
    ) -> Scene:
        """Return the picture; ``further`` are other fields of a scene."""
        return Scene(
            name,
            part,
            title,
            subtitle,
            x,
            y,
            areas=tuple(self.areas),
            lines=tuple(self.lines),
            dots=tuple(self.dots),
            texts=tuple(self.texts),
            handles=tuple(self.handles),
            notes=tuple(self.figures.notes.values()),
            drawn_from=tuple(self.figures.read),
            **further,
        )
