"""The sheet for keying values in at a control by hand: what differs, in the control's own words,
in a safe order.

``make_sheet`` compares a file with what a control contains; ``Ticks`` remembers how far it is done;
``read_back`` compares what the control's screen shows afterwards. How a family's control is keyed into is its
``Keying`` (``keying``), found through its registration.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .build import SheetError, make_sheet
    from .keying import Instruction, Keyed, Keying, Stage, plain_text
    from .model import Sheet, SheetEntry
    from .read_back import (
        STATES,
        ReadBack,
        ReadBackError,
        ReadBackState,
        compare_screen,
        judged,
        read_screen_readings,
    )
    from .ticks import Ticks, TicksError, ticks_path
else:
    __getattr__ = front_page(__name__)
