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

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What the rules of the family may call."""
