"""Drawings: a scene of shapes in world units with scales, labels and handles, and its one SVG writer.

Pictures of a machine's values and plots of a simulated motion are the same thing: scenes, one alone or
several below each other. What is drawn is decided above (`pictures`, `sim`); where it lies (`frame`,
`labels`, `strokes`) and how it looks (`svg`, the painter of the window) is decided here, once.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .frame import Placement
    from .labels import SAMPLE, Heading, Label, Labels, heading_of, labels_of
    from .panels import linked, map_scene, on_divisions, panel_of, ring_scene, round_divisions, zoomed
    from .record import scene_json
    from .scene import (
        MAX_DRAWN,
        MIN_DRAWN,
        Curve,
        Dot,
        Drag,
        FilledArea,
        Handle,
        HeatMap,
        NamedPlace,
        Picture,
        PictureNote,
        Point,
        Polyline,
        Ring,
        Scale,
        Scene,
        Series,
        ShapeSort,
        Text,
    )
    from .strokes import cell_boxes, strokes_of
    from .svg import (
        ARROWS,
        BAR,
        BAR_ROOM,
        BAR_STEPS,
        PALE,
        PLAIN,
        bar_figures,
        panels_json,
        picture_svg,
        scene_svg,
    )
    from .ticks import THIN, figure_text, grouped, multiple, round_step
    from .words import scene_in_words
else:
    __getattr__ = front_page(__name__)
