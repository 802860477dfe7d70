"""Which joints an axis has with plain kinematics, and what they allow together."""

from __future__ import annotations

import re
from collections.abc import Sequence

from amp_studio.families.linuxcnc.kinematics import LETTERS, joint_letters

NONE = 1e99
"""What LinuxCNC takes for a limit that is not there (J131)."""


def joint_letter(joint: str, kinematics: str, joints: float) -> str:
    """The letter of a joint (K65): joint 1 of trivkins coordinates=XZ is Z.
    "" where kinematics are not plain.
    """
    letters = joint_letters(kinematics, int(joints))
    return letters[int(joint)] if 0 <= int(joint) < len(letters) else ""


def greatest_of_joints(values: Sequence[float | None], axis: str, kinematics: str, joints: float) -> float:
    """The greatest value among the joints of an axis, -1e99 where none has one:
    the least limits of Y1 and Y2 of a gantry.
    """
    return max(_of_axis(values, axis, kinematics, joints), default=-NONE)


def least_of_joints(values: Sequence[float | None], axis: str, kinematics: str, joints: float) -> float:
    """The least value among the joints of an axis, 1e99 where none has one."""
    return min(_of_axis(values, axis, kinematics, joints), default=NONE)


def any_joint_has(values: Sequence[float | None], axis: str, kinematics: str, joints: float) -> bool:
    """Whether a joint of an axis has a value."""
    return bool(_of_axis(values, axis, kinematics, joints))


def _of_axis(values: Sequence[float | None], axis: str, kinematics: str, joints: float) -> list[float]:
    letters = joint_letters(kinematics, int(joints))
    return [
        value for letter, value in zip(letters, values, strict=False) if letter == axis and value is not None
    ]


def has_letter(coordinates: str, axis: str) -> bool:
    """Whether the axes of the machine (T110) have this one; small letters count too."""
    return axis in coordinates.upper()


def letters_wanted(coordinates: str) -> float:
    """How many joints the letters of the axes need (K65): XYYZ needs 4."""
    return float(len(re.findall(f"[{LETTERS}]", coordinates.upper())))


def same_letters(kinematics: str, coordinates: str) -> bool:
    """Whether the kinematics have the letters of the axes in the same order (K78); so where they name none,
    or are not plain.
    """
    given = re.search(r"^\s*trivkins\b.*\bcoordinates=(\S+)", kinematics)
    return given is None or given[1].upper() == re.sub(r"\s", "", coordinates).upper()


def greatest_linear(speeds: Sequence[float | None]) -> float:
    """The greatest speed of the axes that do not turn: of all nine in order, X Y Z A B C U V W,
    null where there is none.
    """
    return max(
        (v for letter, v in zip(LETTERS, speeds, strict=False) if letter not in "ABC" and v is not None),
        default=0.0,
    )
