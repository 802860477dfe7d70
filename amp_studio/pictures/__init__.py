"""Pictures of a machine's values that can be edited: scenes (`drawing`) with handles,
drawn of a parameter file.

Which parameters a picture is drawn from are facts of the family (``pictures.yaml``). A picture draws what is
set; what is not set, inactive or out of range becomes a note, and nothing is guessed.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .approach import PlaneWay, draw_approach, draw_usual_approach, run_way, usual_way
    from .editing import dragged, stepped
    from .file_pictures import FASTEST, FilePicture, draw, drawn_in, pictures_of
    from .homing_course import draw_homing
    from .limits import LiveLimits, axis_limits
    from .spindle_speed import draw_spindle
    from .table import CurveText
else:
    __getattr__ = front_page(__name__)
