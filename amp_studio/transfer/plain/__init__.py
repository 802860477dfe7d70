"""Plain files to and from any control that takes one: XMODEM, YMODEM,
and raw as a tape punch and reader do it.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .files import protocol_of, receive_files, send_files
    from .line import Patience
    from .raw import Tape
    from .receiver import LARGEST
    from .ymodem import PlainFile, file_name
else:
    __getattr__ = front_page(__name__)
