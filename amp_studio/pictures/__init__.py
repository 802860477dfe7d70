"""Pictures of a machine's values that can be edited: a scene of shapes in world units with handles, and its drawing as SVG.

Which parameters a picture is drawn from are facts of the family (``pictures.yaml``). A picture draws what is set; what is not
set, inactive or out of range becomes a note, and nothing is guessed.
"""

from .draw import FilePicture, draw, drawn_in, pictures_of
from .editing import dragged, stepped
from .record import scene_json
from .scene import Dot, Drag, FilledArea, Handle, PictureNote, Polyline, Scene, ShapeSort, Text
from .svg import scene_svg
from .words import scene_in_words

__all__ = [
    "Dot",
    "Drag",
    "FilePicture",
    "FilledArea",
    "Handle",
    "PictureNote",
    "Polyline",
    "Scene",
    "ShapeSort",
    "Text",
    "dragged",
    "draw",
    "drawn_in",
    "pictures_of",
    "scene_in_words",
    "scene_json",
    "scene_svg",
    "stepped",
]
