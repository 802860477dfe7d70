"""The cam of an axis as the file has it: position, speed or acceleration over time or a master."""

from __future__ import annotations

from dataclasses import replace

from amp_studio.drawing import Scale, Scene
from amp_studio.files import ParameterFile
from amp_studio.schema import CamRoles
from amp_studio.sim import SimulationError, cam_picture, law_of

from .figures import ValueReader
from .shapes import SceneShapes

_VIEWS = {"": 0, "speed": 1, "acceleration": 2}
"""What is drawn -> which panel of the profile it is."""


def draw_cam(file: ParameterFile, roles: CamRoles, part: str) -> Scene:
    """Return one view of the cam of an axis; ``part`` is the axis, or ``AXIS@speed``, ``AXIS@acceleration``.

    A cam that cannot be read is a note.
    """
    axis, _, view = part.partition("@")
    figures = ValueReader(file)
    # Read for its note and for what the picture is drawn from; the law reads the points.
    figures.figure(roles.points, axis)
    shapes, panel = SceneShapes(figures), None
    points = 0
    form = law_of(file.schema.family.family).cam
    try:
        if form is None:
            raise SimulationError("This family has no cams that are printed")
        cam = form.present(file, axis)
        points, profile = len(cam.x), cam_picture(cam)
        panel = next(iter(profile.panels[_VIEWS[view] :]), None)
        for doubt in profile.facts:
            figures.add_note(doubt)
    except SimulationError as error:
        figures.add_note(str(error))
    # Without a panel there are no figures that a scale could have.
    empty = Scale("", "", 0.0, 1.0, is_written=False)
    subtitle = f"{figures.axis(axis)}, {points} points, page {roles.page}"
    scene = shapes.scene("cam", part, "Cam", subtitle, *((panel.x, panel.y) if panel else (empty, empty)))
    if panel is None:
        return scene
    y = replace(panel.y, label=panel.title)
    return replace(scene, y=y, curves=panel.curves, levels=panel.levels)
