"""The sheet for keying values in at a control by hand: what differs, in the control's own words, in a safe order.

``make_sheet`` compares a file with what a control contains; ``Ticks`` remembers how far somebody has come;
``read_back`` compares what the control's screen shows afterwards. How a family's control is keyed into is its
``Keying`` (``keying``), found through its registration.
"""

from .build import SheetError, make_sheet
from .keying import Instruction, Keying, Stage, keying_of
from .model import LeftOut, Sheet, SheetEntry
from .read_back import STATES, ReadBack, ReadBackError, Shown, compare_shown, judged, read_shown
from .ticks import Ticks, TicksError, ticks_path

__all__ = [
    "STATES",
    "Instruction",
    "Keying",
    "LeftOut",
    "ReadBack",
    "ReadBackError",
    "Sheet",
    "SheetEntry",
    "SheetError",
    "Shown",
    "Stage",
    "Ticks",
    "TicksError",
    "compare_shown",
    "judged",
    "keying_of",
    "make_sheet",
    "read_shown",
    "ticks_path",
]
