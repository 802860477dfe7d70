"""The named formulas of the Syntec slides, a module for each subject.

Every function is pure. Lengths that a parameter contains are in BLU; travel per turn may be in any one unit,
and a feedrate is then that unit per minute. Speeds of the following error are mm/min with the BLU in mm, or
deg/min with it in deg. "Pages" are the sections that ``parameter_db/syntec/family.yaml`` counts.

An argument that makes no sense raises ValueError with one sentence that names it. Where the manual
contradicts itself the formula is taken, not the printed number; the text of the function states it.
"""

from .dda import (
    DDA_LIMIT,
    commands_per_interpolation,
    dda_feedrate,
    dda_motor_speed,
    dda_pulses_per_minute,
    hardware_basic_time_us,
    interpolation_time_us,
    is_basic_time_printed,
)
from .following import (
    alarm_speed,
    fatal_alarm_speed,
    fatal_following_error_limit,
    following_error,
    following_error_limit,
)
from .home import home_grid, homing_search_limit, is_home_grid_advised, is_home_inaccurate, is_index_ignored
from .limits import is_inside_protection, protected_range
from .resolution import (
    axis_move,
    blu_count,
    blu_length,
    encoder_resolution,
    motor_turns_per_screw_turn,
    pulse_length,
    pulses_per_turn,
    scale_pulse_length,
    travel_per_motor_turn,
)

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What rules and calculators may call, by name."""
