"""What each control family does differently, a folder each: formulas, text formats, drivers,
the law of its axes.

The rooms below find it through this table and by nothing else (``schema/registration.py``).
docs/family-code.md lists what one more family has to write, and how another package brings one.
"""

from __future__ import annotations

FAMILIES = {
    "9pc": "amp_studio.families.ninepc:REGISTRATION",
    "num": "amp_studio.families.num:REGISTRATION",
    "acromill": "amp_studio.families.acromill:REGISTRATION",
    "57c422b": "amp_studio.families.servo57c422b:REGISTRATION",
    "syntec": "amp_studio.families.syntec:REGISTRATION",
    "grblhal": "amp_studio.families.grblhal:REGISTRATION",
    "linuxcnc": "amp_studio.families.linuxcnc:REGISTRATION",
}
"""Family -> its record."""

SCENARIOS = {
    "9pc": ("procedure", "hard-stop", "adaptive-feed", "synchronize"),
    "num": ("clamp",),
    "57c422b": ("procedure", "gear", "cam", "backlash", "passive-home"),
}
"""Family -> the scenarios that its law alone has, for help and completion, which load no law."""

FORMATS = {
    "9pc": {"patch": "patch sheet of a 9/PC (.patch)"},
    "num": {"num": "NUM parameter table (.par .num .txt)"},
    "acromill": {
        "acr": "ACR command script (.acr)",
        "bsc": "ballscrew compensation of an ACR controller (.bsc)",
    },
    "57c422b": {"basic": "AutoMax BASIC task (.bas)", "registers": "AutoMax register table (.reg)"},
    "grblhal": {"grbl": "Grbl settings, as $$ lists them (.settings .grbl .nc)"},
    "linuxcnc": {"ini": "LinuxCNC configuration (.ini)"},
}
"""Family -> its text formats with their endings, for help, which loads none (a test compares them)."""
