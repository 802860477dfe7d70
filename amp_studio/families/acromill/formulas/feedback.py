"""Encoder pulses and lengths: the Axes tab and appendix C."""

from __future__ import annotations

from amp_studio.validate import finite, positive, whole


def pulses_per_revolution(lines: float, multiplier: float) -> int:
    """Pulses of one turn of an encoder after the multiplication, whatever its sign (pages 60 and 113).

    1000 lines at 4 or -4 are 4000, the least for good running at low speed.
    """
    return whole("The number of lines", lines) * whole(
        "Encoder Mult", abs(finite("Encoder Mult", multiplier))
    )


def pulses_per_unit(pulses_per_revolution: float, revolutions_per_unit: float) -> float:
    """Pulses/Unit: pulses of a turn of the encoder times its turns for a unit of travel (pages 60 and 114).

    4096 pulses and a unit of one turn are the PPU X4096 of page 114. That the turns multiply is ours.
    """
    return positive("The number of pulses", pulses_per_revolution) * positive(
        "Turns per unit", revolutions_per_unit
    )


def pulses_of(length: float, pulses_per_unit: float) -> float:
    """Encoder pulses of a length, in the unit of Pulses/Unit (page 60).

    The four turns of EXC AXIS0 4 with PPU 4096 are 16384 pulses (page 114).
    """
    return finite("The length", length) * positive("Pulses/Unit", pulses_per_unit)
