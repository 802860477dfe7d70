"""The analog output of the spindle: the Spindle tab."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, positive


def spindle_scaling(volts: float, highest_rpm: float) -> float:
    """Spindle Scaling in V/rpm of a drive with its highest speed at ``volts`` (page 77): 10 V, 3000 rpm:
    0.00333.
    """
    return positive("The voltage", volts) / positive("The highest speed", highest_rpm)


def spindle_volts(scaling: float, rpm: float) -> float:
    """Volts that an S command puts out (page 77): S1500 at 10 V / 3000 rpm gives 5 V."""
    return not_negative("Spindle Scaling", scaling) * finite("The speed", rpm)
