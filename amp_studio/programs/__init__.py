"""What a control does with the words of a part program under a parameter file: their numbers,
codes and what is active.

What a code means, and by which format a letter is read, are facts of a family (``program.yaml``).
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .at_power_up import PowerUp, PowerUpLine, power_up
    from .block import BlockReader, BlockWord, ReadBlock
    from .formats import NumberFormat, digits_of, number_of
    from .interpreter import path_letters, path_parts
    from .source import read_program
    from .toolpath import ARC, DWELL, EXACT, KEPT, LINE, MAX_ROWS, PLANES, RAPID, ROUNDED, SLOW, ToolPath
    from .words import ProgramBlockError
else:
    __getattr__ = front_page(__name__)
