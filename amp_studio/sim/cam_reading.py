"""Points of a cam out of a table of columns."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np

from amp_studio.files import text_of_name
from amp_studio.schema import read_table_text

from .cam import CamPoints
from .errors import SimulationError
from .identification.drive_record import named_columns, read_number_table, seconds_of

_MAX_POINTS = 100_000
_COLUMNS = {
    "time": "time|t|zeit",
    "master": "master( position)?|leitachse",
    "position": "position|pos|axis|slave|weg",
}


def read_cam_points(path: Path) -> CamPoints:
    """Return the points of a table with a column of time (s without a unit) or of the master, and one of the
    position, both in counts; raises SimulationError, OSError.
    """
    name, text = text_of_name(path.name), read_table_text(path)
    places = named_columns(text, _COLUMNS)
    over: Literal["time", "master"] = "master" if "master" in places else "time"
    if over not in places or "position" not in places:
        raise SimulationError(f"{name}: it needs the columns position and time, or position and master")
    x, position = read_number_table(text, [places[over][0], places["position"][0]])
    if not 2 <= len(x) <= _MAX_POINTS:
        raise SimulationError(f"{name}: a cam has 2 to {_MAX_POINTS} points, not {len(x)}")
    if not (np.diff(x) > 0.0).all():
        raise SimulationError(f"{name}: its {over} does not rise from row to row")
    for column in ("master", "position"):
        if column in places and places[column][1] not in ("", "counts"):
            raise SimulationError(f"{name}: the {column} is in {places[column][1]}; it must be in counts")
    factor = seconds_of(name, places["time"][1]) if over == "time" else 1.0
    # A table may begin anywhere; the control's cam begins at 0 of both.
    return CamPoints(over, (x - x[0]) * factor, position - position[0])
