"""The named formulas of the 9/PC AMP reference manual, a module for each subject.

Every function is pure. Unless its text states otherwise, lengths may be in any one unit (mm, inch or
degree), speeds are that unit per minute, accelerations that unit per second squared, and a gain is
the number of parameter 1710: gain 1 means 0.001 units of following error per unit per minute.

An argument that makes no sense raises ValueError with one sentence that names it. Where the manual
contradicts itself the formula is taken, not the printed number; the text of the function states it.
"""

from .axes import dcm_position, home_distance, inside_zone, rollover_position
from .calibration import calibration_fault, calibration_net, calibration_points
from .compensation import (
    compensated_feedrate,
    compensation_radius,
    corner_feedrate,
    is_block_generated,
    lowest_compensated_feedrate,
)
from .coupled import dual_group_limit, split_axis_skew, split_axis_skew_at
from .cycles import (
    chamfer_length,
    depth_before_finish,
    depth_of_pass,
    lead_along,
    retracted_depth,
    threading_infeed,
)
from .feedback import (
    COUNTS_PER_INCH_LIMIT,
    counts_per_cycle,
    counts_per_inch,
    counts_per_length,
    counts_per_revolution,
    dcm_counts_per_cycle,
    feedback_revolutions_per_screw_revolution,
    feedback_sign,
    gear_train,
    largest_scale_pitch,
    lead_from_threads_per_inch,
    lowest_terms,
    scale_counts_per_cycle,
    screw_revolutions_per_feedback_revolution,
    sercos_cycles,
    sercos_ring_baud,
    sercos_ring_cycle,
    sercos_servos,
)
from .jog import remembered_retract_moves
from .motion import (
    arc_radius_error,
    arc_reaches,
    deceleration_in_force,
    exponential_speed,
    exponential_time_ms,
    f1_rapid,
    is_velocity_step,
    jerk_limits,
    linear_ramp,
    linear_ramp_per_ms,
    response_time_ms,
    scurve_time,
    vector_feedrate_limit,
)
from .oci import watchlist_bytes
from .password import is_factory_password, password_codes
from .probing import (
    approach_end,
    deceleration_room,
    feedrate_change_percent,
    probe_radius,
    probe_travel_limit,
    trigger_direction,
)
from .servo import (
    acceleration_command,
    analog_voltage,
    continuous_voltage,
    following_error,
    following_error_with_feed_forward,
    friction_compensation,
    gain_break_point,
    gain_for_inertia,
    gain_from_following_error,
    gain_time_constant_ms,
    integral_gain_limit,
    load_inertia_ratio,
    maximum_motor_speed,
    maximum_servo_acceleration,
    minimum_excess_error,
    peak_current_percent,
    reduced_gain,
    reversal_first_direction,
    standard_motor_gain,
    suppressed_feedrate,
    torque_percent,
    torque_with_offset,
    typical_suppression_point,
    velocity_gain_bounds,
)
from .spindle import (
    acceleration_time_s,
    css_spindle_speed,
    deviation_band,
    deviation_filter_time_ms,
    feed_per_minute,
    orient_turn,
    spindle_following_error,
    spindle_motor_speed,
    spindle_ramp_step,
    spindle_speed,
    spindle_voltage,
    spindle_zero_angle,
    tapping_acceleration,
    tapping_gain,
    tapping_ramp,
)
from .spindle_sync import (
    follower_position,
    mirrored_angle,
    synchronized_feedback_ratio,
    synchronized_range,
    synchronized_speed,
)
from .timing import (
    coarse_scan_ms,
    fine_foreground_from_maximum_ms,
    fine_foreground_minimum_ms,
    fine_scans_per_logic_scan,
)
from .tools import (
    fewest_pockets,
    gauge_difference,
    gauged_offset,
    offset_change_allowed,
    split_t_word,
    tolerance_band,
    tool_life_group,
)
from .tuning import (
    calibration_deviation,
    calibration_limit,
    dac_monitor_code,
    dac_monitor_function,
    dac_starting_scale,
    net_correction,
    typical_integral_gain,
)
from .words import largest_word, word_value

FORMULAS = {name: formula for name, formula in sorted(globals().items()) if callable(formula)}
"""What rules and calculators may call, by name."""
