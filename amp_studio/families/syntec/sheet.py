"""How values are keyed into a Syntec: its parameter screens only, no protocol is published for it.

The guide prints neither how the screens are left nor, but for one group, when a value takes effect.
"""

from __future__ import annotations

from amp_studio.files import ParameterFile
from amp_studio.schema import Address
from amp_studio.sheet import Instruction, Keying


def _obstacle(file: ParameterFile, address: Address) -> str:
    return "" if file.machine_schema.number(address) else "no parameter number is printed for it"


KEYING = Keying(
    title="Sheet for the parameter screens",
    obstacle=_obstacle,
    before=(
        Instruction(
            "Write down what the control shows now, or keep a copy as the machine's builder describes it."
        ),
        Instruction("Pr2401 to Pr2440, the first software stroke limits, need the password.", "3.2"),
        Instruction("For each line: find the parameter by its number, key in the value, tick it."),
    ),
    after=(
        Instruction(
            "Reset the control: the guide prints so for Pr2401 to Pr2440, and nothing for the others.", "3.2"
        ),
        Instruction("Read each value on its screen, write it down, and compare."),
    ),
)
