"""What is tuned in the INI file of a LinuxCNC: the loop of a joint and its homing. Codes are those of its
documents.
"""

from __future__ import annotations

from amp_studio.calibration import Compensation, TuningPage

COMPENSATION = Compensation(
    pages=(
        TuningPage("backlash", "Backlash", "J124", ("joint.backlash",)),
        TuningPage(
            "servo",
            "Servo",
            "D1169",
            (
                "joint.pid_p",
                "joint.pid_i",
                "joint.pid_d",
                "joint.pid_ff0",
                "joint.pid_ff1",
                "joint.pid_ff2",
                "joint.deadband",
                "joint.ferror",
                "joint.min_ferror",
            ),
        ),
        TuningPage(
            "home",
            "Homing",
            "J163",
            ("joint.home_search_velocity", "joint.home_latch_velocity", "joint.home_offset", "joint.home"),
        ),
    )
)
