"""What rules of LinuxCNC ask about joints and axes.

Every function is pure. Lists have a value for each joint in order, null where it has none. Lengths are mm,
or degrees.
"""

from .joints import (
    any_joint_has,
    greatest_linear,
    greatest_of_joints,
    has_letter,
    joint_letter,
    least_of_joints,
    letters_wanted,
    same_letters,
)
from .steps import has_step_before

__all__ = [
    "any_joint_has",
    "greatest_linear",
    "greatest_of_joints",
    "has_letter",
    "has_step_before",
    "joint_letter",
    "least_of_joints",
    "letters_wanted",
    "same_letters",
]

FORMULAS = {name: globals()[name] for name in __all__}
"""What the rules of the family may call."""
