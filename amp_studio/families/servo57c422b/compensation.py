"""Backlash of an axis in encoder counts: registers 39 and 40 (page 4-21)."""

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
    ),
)
