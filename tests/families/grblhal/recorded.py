"""What a fresh build of the firmware for three axes lists of itself and of its settings,
and builds made of that.
"""

import re
from pathlib import Path

HERE = Path(__file__).parent
THREE_AXES = (HERE / "three_axes.txt").read_bytes()
"""Its lines of ``$I``, ``$EG`` and ``$ES``."""
LISTING = (HERE / "three_axes.settings").read_text("utf-8")
"""Its answer to ``$$``."""
HELP = (
    b"[SETTINGDESCR:22|Homes the machine.\\nNeeds switches.]\n[ALARMCODE:9||No switch.]\n[ERRORCODE:53||Not"
    b" here.]\n"
)
"""Help, an alarm and an error as it would say them, in other words than its own."""


def with_lines(*lines: str, without: str = "") -> bytes:
    """Return the description with further lines, and without those that contain a text."""
    kept = [line for line in THREE_AXES.decode().splitlines() if not without or without not in line]
    return "".join(f"{line}\n" for line in [*kept, *lines]).encode()


def build(letters: str) -> bytes:
    """Return the description of a build with other axes."""
    text = THREE_AXES.decode().replace("[AXS:3:XYZ]", f"[AXS:{len(letters)}:{letters}]")
    lines = [line for line in text.splitlines() if not re.search(r"\|[XYZ]-axis", line)]
    lines += [f"[SETTINGGROUP:{43 + n}|42|{letter}-axis]" for n, letter in enumerate(letters)]
    for base, quantity, unit in (
        (100, "travel resolution", "step/mm"),
        (110, "maximum rate", "mm/min"),
        (120, "acceleration", "mm/sec^2"),
        (130, "maximum travel", "mm"),
    ):
        lines += [
            f"[SETTING:{base + n}|{43 + n}|{letter}-axis {quantity}|{unit}|6|#####0.000|||0|0]"
            for n, letter in enumerate(letters)
        ]
    rotary = ",".join(f"{letter}-Axis" for letter in letters[3:])
    if rotary:
        lines.append(f"[SETTING:376|35|Rotary axes||1|{rotary}|||0|0]")
    return "".join(f"{line}\n" for line in lines).encode()
