"""Which pictures a file has, and the one of a name and a part."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial

from amp_studio.drawing import PictureNote, Scene
from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    CamRoles,
    JogRoles,
    LoopRoles,
    ParameterId,
    RampRoles,
    TravelRoles,
    axis_name,
)

from .gain import draw_gain
from .gears import draw_gears, spindles
from .jog import draw_jog
from .parts import axes_with, every_axis, pairs
from .table import draw_table
from .travel import draw_travel, ends_of_travel

FASTEST = 100.0
"""%: the rapid feedrate."""

PartNames = tuple[tuple[str, str], ...]
"""Key of a part (axes, a spindle) -> what a person calls it; "" where there is only one."""


@dataclass(frozen=True)
class FilePicture:
    """One picture that a file has, in each of its parts."""

    file: ParameterFile
    name: str
    title: str
    parts: PartNames
    drawn: Callable[[str, Scene | None], Scene]
    axes: int = 0
    """How many axes make a part."""
    has_speed: bool = False
    """Whether a part may have a speed: ``X@25`` at 25 % of the rapid feedrate."""

    def scene(self, part: str = "", like: Scene | None = None) -> Scene:
        """Draw a part, the first one by default; raises KeyError for one that there is not.

        ``like`` is what was drawn before a drag began: its scales stay.
        """
        scene = self.drawn(self.key(part), like)
        # An empty frame would look like a fault of the program.
        if scene.handles or scene.notes or scene.curves:
            return scene
        return replace(scene, notes=(PictureNote("No parameter of this picture is active on this machine"),))

    def key(self, part: str) -> str:
        """Return the key of the part that a person calls so, the first one by default; raises KeyError.

        Axes on which nothing is set are drawn when they are asked for.
        """
        # The @ in the key of a cam is that of its view.
        part, _, share = part.partition("@") if self.has_speed else (part, "", "")
        if share:
            return f"{self.key(part)}@{_percent(share):g}"
        wanted = re.split(r"[+,\s]+", part.upper().strip("+, "))
        if wanted == [""]:
            return self.parts[0][0]
        for key, name in self.parts:
            if wanted in (key.upper().split("+"), name.upper().split()):
                return key
        # A pair without a value is not offered, but a link or a user may ask for it.
        if own := self._axes_of(wanted):
            return "+".join(own)
        raise KeyError(
            f"There is no part '{part}': {', '.join(name or 'one alone' for _, name in self.parts)}"
        )

    def axis(self, name: str) -> str:
        """Return what a person calls an axis."""
        return axis_name(self.file.evaluation, name) or name

    def _axes_of(self, names: list[str]) -> list[str]:
        """Return the axes of these names; empty where they make no part."""
        letters = {name.upper(): axis for axis, name in _named(self.file, every_axis(self.file))}
        own = [letters.get(each, each) for each in names]
        # X against X is no plan.
        is_part = self.axes == len(own) == len(set(own)) and set(own) <= set(letters.values())
        return own if is_part else []


def pictures_of(file: ParameterFile) -> tuple[FilePicture, ...]:
    """Return the pictures of a file: those of its family that have a part to draw."""
    return tuple(picture for picture in _pictures(file) if picture.parts)


def _pictures(file: ParameterFile) -> Iterator[FilePicture]:
    """Yield the pictures that the facts of the family draw, those without a part to draw too."""
    roles = file.schema.pictures
    if travel := roles.travel:
        yield FilePicture(file, "travel", "Travel", _pairs(file, travel), partial(_travel, file), 2)
    if ramps := roles.ramps:
        own = _own(file, _of_ramps(ramps))
        yield FilePicture(file, "ramps", "Ramps", own, partial(_ramps, file, ramps), 1)
    if gears := roles.gears:
        own = tuple((each, each) for each in spindles(file, gears))
        yield FilePicture(file, "gears", "Gears", own, partial(draw_gears, file, gears))
    if jog := roles.jog:
        yield from _ladders(file, jog)
    if error := roles.error:
        own = _own(file, (error.gain, *error.limits))
        yield FilePicture(file, "error", "Error limits", own, partial(draw_gain, file, error), 1)
    if loop := roles.loop:
        own = _own(file, _of_loop(loop))
        yield FilePicture(file, "loop", "Loops", own, partial(_loop, file, loop), has_speed=True)
    if cam := roles.cam:
        yield FilePicture(file, "cam", "Cam", _cam_views(file, cam), partial(_cam, file, cam))
    for table in roles.tables:
        own = _own(file, (table.param,))
        yield FilePicture(file, "calibration", "Calibration", own, partial(draw_table, file, table), 1)


def _pairs(file: ParameterFile, travel: TravelRoles) -> PartNames:
    ends = [p for span in (*travel.spans, *travel.zones) for p in (span.low, span.high)]
    found = pairs(file, [*ends, *([travel.reach.length] if travel.reach else [])])
    return tuple(("+".join(axes), " ".join(name for _, name in _named(file, axes))) for axes in found)


def _ladders(file: ParameterFile, roles: JogRoles) -> Iterator[FilePicture]:
    alone = (("", ""),)
    yield FilePicture(file, "jog", "Jog", alone, lambda _, like: draw_jog(file, roles, "jog", like))
    if roles.increments:
        yield FilePicture(
            file, "increments", "Increments", alone, lambda _, like: draw_jog(file, roles, "increments", like)
        )


def _cam_views(file: ParameterFile, cam: CamRoles) -> PartNames:
    """Return the cam of each axis that has points, its speed and its acceleration."""
    # `axes_with` offers an axis even where none has a value; a cam without points is nothing to draw.
    own = [name for name in _own(file, (cam.points,)) if file.evaluation.canonical((cam.points, name[0]))]
    views = {"": "", "@speed": " speed", "@acceleration": " acceleration"}
    return tuple((f"{axis}{key}", f"{name}{view}") for axis, name in own for key, view in views.items())


def _travel(file: ParameterFile, part: str, like: Scene | None) -> Scene:
    assert file.schema.pictures.travel is not None
    return draw_travel(file, file.schema.pictures.travel, tuple(part.split("+")), like)


def travel_ends(file: ParameterFile, axes: Iterable[str]) -> list[tuple[float, float]]:
    """Return the least and the greatest place of each axis that the limits of the picture of the travel
    leave; infinite where none is set.
    """
    roles = file.schema.pictures.travel
    return ends_of_travel(file, roles, tuple(axes)) if roles else [(-math.inf, math.inf) for _ in axes]


def _ramps(file: ParameterFile, roles: RampRoles, part: str, like: Scene | None) -> Scene:
    from .ramps import draw_ramps  # numpy is loaded when a ramp is drawn

    return draw_ramps(file, roles, part, like)


def _loop(file: ParameterFile, roles: LoopRoles, part: str, like: Scene | None) -> Scene:
    from .loop import draw_loop  # so is the simulator

    return draw_loop(file, roles, part, like)


def _cam(file: ParameterFile, roles: CamRoles, part: str, _like: Scene | None) -> Scene:
    from .cam import draw_cam  # so is the simulator

    return draw_cam(file, roles, part)


def _percent(text: str) -> float:
    """Return a share of the rapid feedrate in %; raises KeyError for what is none."""
    try:
        # As a user types it, with the comma of some languages.
        share = float(text.strip().removesuffix("%").replace(",", "."))
    except ValueError:
        share = math.nan
    if not 0.0 < share <= FASTEST:
        raise KeyError(f"'{text}' is no share of the rapid feedrate: give more than 0 and at most 100 %")
    return share


def _of_ramps(roles: RampRoles) -> list[ParameterId]:
    kinds = [p for kind in roles.kinds for p in (kind.acceleration, *kind.rise) if p]
    return [roles.feedrate, *kinds]


def _of_loop(roles: LoopRoles) -> list[ParameterId]:
    return [p for block in roles.blocks for p in block.params]


def _own(file: ParameterFile, parameters: Iterable[ParameterId]) -> PartNames:
    return _named(file, axes_with(file, parameters))


def _named(file: ParameterFile, axes: Iterable[str]) -> PartNames:
    return tuple((axis, axis_name(file.evaluation, axis) or axis) for axis in axes)


def draw(file: ParameterFile, name: str, part: str = "") -> Scene:
    """Draw one picture of a file; raises KeyError for a name or a part that it does not have."""
    pictures = pictures_of(file)
    picture = next((each for each in pictures if each.name == name), None)
    if picture is None:
        known = ", ".join(each.name for each in pictures) or "none"
        raise KeyError(f"{file.schema.family.name} has no picture '{name}'. Pictures: {known}")
    return picture.scene(part)


def drawn_in(pictures: Iterable[FilePicture], address: Address) -> tuple[str, str] | None:
    """Return the picture and the part with a handle of a value; None where no handle moves it."""
    for picture in pictures:
        keys = [key for key, _ in picture.parts]
        # Instances of gears are parts of their spindle: before the point is what a picture is of.
        own = next((key for key in keys if address[1].partition(".")[0] in key.split("+")), keys[0])
        scene = picture.scene(own)
        if any(drag.address == address for handle in scene.handles for drag in handle.drags):
            return picture.name, own
    return None
