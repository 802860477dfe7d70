"""What becomes of the values when a handle is dragged, or moved by keys."""

from __future__ import annotations

from collections.abc import Mapping

from amp_studio.drawing import Drag, Handle, Point, multiple
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, convert, dimension

WantedValues = Mapping[Address, Value]


def dragged(handle: Handle, at: Point) -> WantedValues:
    """Return the values of a handle that is at a world point; a value that has none there is left out."""
    found = {drag.address: drag.value_at(at[0] if drag.along == "x" else at[1]) for drag in handle.drags}
    return {address: value for address, value in found.items() if value is not None}


def stepped(file: ParameterFile, handle: Handle, right: int, up: int, times: int = 1) -> WantedValues:
    """Return the values of a handle that keys move so many steps to the right and up;
    one value follows all four keys.
    """
    found = {}
    for drag in handle.drags:
        count = (right if drag.along == "x" else up) if len(handle.drags) > 1 else right + up
        if count:
            # A value that falls along the picture, as a scaling, still follows the arrow that is pressed.
            value = _stepped(file, handle, drag, count * times if drag.rises else -count * times)
            if value is not None:
                found[drag.address] = value
    return found


def _stepped(file: ParameterFile, handle: Handle, drag: Drag, count: int) -> Value | None:
    """Return a value some steps further on, on a multiple of the step."""
    own = file.get(drag.address)
    if own is None or isinstance(own.value, bool):
        return None
    if isinstance(own.value, str):  # a table: its point moves
        at = handle.at[0 if drag.along == "x" else 1]
        return drag.value_at(at + count * drag.step)
    # A value in a unit of another dimension is a finding; there is no next step from it.
    if dimension(own.unit) != dimension(drag.unit):
        return None
    # On the grid of the steps: 12.37 goes to 13 and then to 14, as a person would enter it.
    number = multiple(convert(float(own.value), own.unit, drag.unit) + count * drag.step, drag.step)
    return Value(int(number) if isinstance(own.value, int) else number, drag.unit)
