"""The named formulas of the NUM 1020/1040/1060 parameter manual, a module for each subject.

Every function is pure. An argument that makes no sense raises ValueError with one sentence that names it.
Where the manual contradicts itself the formula is taken, not the printed number;
the text of the function states it.
"""

from .axes import (
    assignment_word,
    axis_name,
    carried_partner,
    follows_itself,
    indexing_increment,
    limited_in_force,
)
from .measurement import (
    coded_conversion,
    coded_graduation,
    combined_ratio,
    encoder_measurement,
    measured_step,
    multi_divi,
    signal_fault,
    ssi_divi_factor,
    unwatched_axis,
)
from .sampling import (
    block_time_bounds,
    calibration_parameters,
    calibration_points_in_force,
    free_access_kbytes,
    plc_time_in_force,
    potentiometer_range_in_force,
    qvn_samples,
    sampling_period_in_force,
    sequence_word,
    stack_kbytes,
)
from .servo import (
    approach_speed,
    average_acceleration,
    axis_time_constant,
    axis_turns,
    axis_unit,
    buildup_acceleration,
    circle_error,
    circle_speed,
    effective_anticipation,
    filtered_reference,
    friction_correction,
    in_position_window,
    increments_per_sample,
    largest_traverse_rate,
    loop_gain_coefficient,
    loop_gain_per_second,
    loop_time_constant,
    max_following_error,
    measured_time_constant,
    movement_tolerances,
    of_group,
    reference_points,
    reference_voltage,
    slowest_axis,
    smallest_acceleration,
    steady_following_error,
    theoretical_speeds,
)
from .spindle import (
    hole_bottom_speed,
    indexing_reference,
    indexing_standstill,
    integration_constant,
    largest_measured_speed,
    position_anticipation,
    ranges_for_speed,
    speed_gap,
    spindle_increment,
    spindle_modulo,
    spindle_offset,
    spindle_reference_points,
    spindle_reference_volts,
    tapping_deceleration_distance,
    zero_crossing_anticipation,
)
from .travel import axis_travel, backlash_on_positive_move
from .units import (
    from_internal,
    internal_unit_mm,
    largest_travel_mm,
    rotary_unit_deg,
    servo_coefficient,
    to_internal,
)

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What rules and calculators may call, by name."""
