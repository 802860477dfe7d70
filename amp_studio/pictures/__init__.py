"""Pictures of a machine's values that can be edited: a scene of shapes in world units with handles, and its drawing as SVG.

Which parameters a picture is drawn from are facts of the family (``pictures.yaml``). A picture draws what is set; what is not
set, inactive or out of range becomes a note, and nothing is guessed.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .editing import dragged, stepped
    from .file_pictures import FilePicture, draw, drawn_in, pictures_of
    from .frame import Placement, figure_text
    from .labels import Label, Labels, labels_of
    from .record import scene_json
    from .scene import Dot, FilledArea, Handle, Point, Polyline, Scale, Scene, ShapeSort, Text
    from .svg import ARROWS, scene_svg
    from .table import CurveText
    from .words import scene_in_words
else:
    __getattr__ = front_page(__name__)
