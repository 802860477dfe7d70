"""Backlash of the axes (P18, page 7-14) and the loop gain (P21, page 6-14).
The parameters contain no calibration table.
"""

from __future__ import annotations

from amp_studio.calibration import Compensation, TuningPage

COMPENSATION = Compensation(
    reversal="travel.backlash",
    is_signed=True,
    pages=(
        TuningPage(
            "reversal",
            "Backlash",
            "7-14",
            ("travel.backlash",),
            "A positive value is added where the axis moves in the positive direction. A reset brings back"
            " what P18 contains.",
        ),
        TuningPage(
            "servo",
            "Servo",
            "6-14",
            ("servo.loop_gain", "servo.in_position_window", "servo.max_following_error"),
        ),
        TuningPage("travel", "Travel", "7-12", ("travel.limit_min", "travel.limit_max")),
        TuningPage("home", "Homing", "7-10", ("travel.switch_position",)),
        TuningPage(
            "spindle",
            "Spindle",
            "8-16",
            (
                "spindle.range_min",
                "spindle.range_max",
                "spindle.indexing_speed",
                "spindle.window",
                "spindle.gain",
            ),
        ),
    ),
)
"""The axis calibration of a 1020, 1040 or 1060 is written with utility UT2 at the control, not by
parameters."""
