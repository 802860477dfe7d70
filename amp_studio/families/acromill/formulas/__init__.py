"""The named formulas of the AcroMill user's guide, a module for each subject.

Every function is pure. Lengths may be in any one unit (inch or mm) that Pulses/Unit counts for, speeds are
that unit per minute unless a text states otherwise, ramps that unit per second squared;
gains are in volts and encoder pulses.

An argument that makes no sense raises ValueError with one sentence that names it. Where the guide contradicts
itself the formula is taken, not the printed number; the text of the function states it.
A page is that of the section.
"""

from .ballscrew import (
    ballscrew_difference,
    ballscrew_mean,
    ballscrew_offset,
    ballscrew_positions,
    ballscrew_words,
    is_ballscrew_table,
)
from .feedback import pulses_of, pulses_per_revolution, pulses_per_unit
from .geometry import compensated_radius, is_joined, largest_position
from .motion import index_time, overridden_feed, ramp_for, ramp_time
from .servo import (
    dac_gain,
    derivative_width,
    filter_gain,
    lopass_limit,
    proportional_gain,
    proportional_volts,
    servo_rate,
    torque_limit,
    velocity_feedforward,
)
from .spindle import spindle_scaling, spindle_volts

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What rules and calculators may call, by name."""
