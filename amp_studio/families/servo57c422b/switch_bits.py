"""The bits of registers 0 and 2 that the simulation uses, most of them inferred:
figures 4.1 to 4.3 are lost (erratum e-r2-bits).

Register 2: 011CH "enables drive fault input, overtravel L/S, feedback marker; home direction decreasing"
(4-48) is four bits and four statements; 01DH with "marker pulse, home negative" goes to the home switch first
(5-6), so bit 0 is the switch. The rest follows from the order of section 4.4.
Bits 4 and 12 of register 0 are printed.
"""

from __future__ import annotations

HOME_SWITCH, HOME_NEGATIVE, MARKER, OVERTRAVEL_SWITCHES = 1 << 0, 1 << 2, 1 << 3, 1 << 4
DRIVE_FAULT, SOFTWARE_OVERTRAVEL, OVERTRAVEL_COASTS = 1 << 8, 1 << 10, 1 << 11
"""Of register 2."""
INPUTS = {
    HOME_SWITCH: "home switch",
    OVERTRAVEL_SWITCHES: "overtravel switch at each end",
    DRIVE_FAULT: "drive fault input",
}
"""Bit of register 2 -> what it has the module look at."""
ROTARY = 1 << 4
"""Of register 0, printed (4-4)."""

SWITCHES = (
    "The bits of register 2 are inferred, not printed: figure 4.3 is lost (0 home switch, 2 negative, 3"
    " marker: by the words 011CH of 4-48 and 01DH of 5-6; 10 software overtravel, 11 its action: by the order"
    " of section 4.4)."
)
