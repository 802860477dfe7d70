"""What is tuned at a Syntec control: loop and ramps (pages 1.5.1 to 1.5.4), homing (2.2.2.2 to 2.2.2.4). Its
manual names neither a backlash nor a calibration table.
"""

from __future__ import annotations

from amp_studio.calibration import Compensation, TuningPage

COMPENSATION = Compensation(
    pages=(
        TuningPage(
            "servo",
            "Servo",
            "1.5.3",
            (
                "servo.loop_gain",
                "servo.feed_forward",
                "servo.loss_pulse_range",
                "feed.rapid",
                "motion.acceleration_time",
                "motion.axis_acceleration",
            ),
        ),
        TuningPage(
            "home",
            "Homing",
            "2.2.2.3",
            ("home.first_speed", "home.second_speed", "home.offset", "home.protective_turns"),
        ),
    )
)
