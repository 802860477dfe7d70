"""The arithmetic of the firmware that rules and calculators use.

Every function is pure. Lengths are mm, or degrees of an axis that turns; speeds are per minute, accelerations
per second squared. An argument that makes no sense raises ValueError with one sentence that names it.
"""

from .axes import axis_place, homing_phases, is_turning, mask_end, rotary_end
from .motion import ramp_travel, step_rate, steps_per_unit

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What the rules and calculators of the family may call."""
