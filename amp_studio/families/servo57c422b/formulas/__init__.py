"""The named formulas of the 57C422B 2-axis servo module manual, a module for each subject.

Every function is pure. Positions are encoder counts after quadrature, speeds counts/s, accelerations
counts/s2, times ms unless the name has seconds; a word is the content of the register. A unit is whatever the
machine is laid out in. An argument that makes no sense raises ValueError with one sentence that names it.
Where the manual contradicts itself the formula is taken, not the printed number.
"""

from .cam import (
    bytes_word,
    cam_jump,
    cam_largest_value,
    cam_master_travel,
    cam_points,
    cam_step_time,
    cam_time_between_points,
    needs_words,
    word_bytes,
)
from .encoder import counts_per_revolution, highest_count_rate, unwind_constant
from .motion import (
    acceleration_word,
    backlash_moves,
    counts_per_second,
    counts_per_second_squared,
    deceleration_ratio,
    gear_ratio,
    gear_ratio_of_units,
    gear_ratio_word,
    home_speeds,
    measured_velocity,
    position_counts,
    s_curve_time,
    velocity_error_word,
    velocity_word,
    voltage_word,
)
from .registers import commands_set, double_of, double_words, scans

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What rules and calculators may call, by name."""
