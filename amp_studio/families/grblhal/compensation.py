"""Backlash of grblHAL ($160 and on), in builds that have it, and what is tuned with it."""

from __future__ import annotations

from amp_studio.calibration import Compensation, TuningPage

COMPENSATION = Compensation(
    reversal="axis.backlash",
    pages=(
        TuningPage(
            "reversal", "Backlash", "S2420", ("axis.backlash",), "Only in builds with backlash compensation."
        ),
        TuningPage(
            "steps", "Steps and Speeds", "S2415", ("axis.steps", "axis.max_rate", "axis.acceleration")
        ),
        TuningPage("limits", "Travel", "S2418", ("limits.soft", "axis.max_travel")),
        TuningPage(
            "home",
            "Homing",
            "S2353",
            ("homing.seek_rate", "homing.locate_rate", "homing.debounce", "homing.pull_off", "homing.passes"),
        ),
    ),
)
