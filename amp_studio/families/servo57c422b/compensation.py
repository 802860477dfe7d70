"""Backlash of an axis in encoder counts, registers 39 and 40 (page 4-21), and its gains (page 5-2)."""

from __future__ import annotations

from amp_studio.calibration import Compensation, TuningPage

COMPENSATION = Compensation(
    reversal="output.backlash",
    pages=(
        TuningPage(
            "reversal",
            "Backlash",
            "4-21",
            ("output.backlash",),
            "Used while automatic backlash compensation is enabled in register 65; the sign is the direction"
            " of the approach.",
        ),
        TuningPage(
            "servo",
            "Gains",
            "5-2",
            ("gain.deadband", "gain.velocity", "gain.proportional", "gain.integral", "gain.feedforward"),
            "In this order, deadband 0. Start: proportional 100, integral 0, velocity 25 (0 for a drive that"
            " takes a velocity), feedforward 0. Velocity, then proportional gain up to vibration of the shaft"
            " and back, integral from 10, feedforward at top speed until register 80 is small and not"
            " negative.",
        ),
    ),
)
