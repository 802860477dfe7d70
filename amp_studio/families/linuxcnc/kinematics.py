"""Which joint moves which axis with plain kinematics:
each letter of ``coordinates=`` has the next joint (K55 to K65).
"""

from __future__ import annotations

import re

LETTERS = "XYZABCUVW"


def joint_letters(kinematics: str | None, joints: int) -> tuple[str, ...]:
    """Return the letter of each joint, from joint 0; empty where kinematics are not plain, or not known.

    Without ``coordinates=`` the letters have their joints in the order of all nine (K58).
    """
    words = (kinematics or "").split()
    if not words or words[0] != "trivkins":
        return ()
    given = next((word.partition("=")[2] for word in words[1:] if word.startswith("coordinates=")), "")
    return tuple(re.findall(f"[{LETTERS}]", (given or LETTERS).upper())[: max(joints, 0)])
