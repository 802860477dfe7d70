"""Tuning at the machine: chapter 36 and appendix A."""

from __future__ import annotations

import math
from collections.abc import Iterable

from amp_studio.validate import finite, positive, whole

DAC_FUNCTIONS = (100, 200, 300, 400, 500, 600)
"""Velocity feedback, following error, velocity integrator, velocity error, coarse IPCs, final velocity
(table A.B, page A-6)."""

DAC_PITCHES = (0.1, 0.5)
"""in: the pitches that Table A.C has (page A-7)."""
_DAC_SCALES = {
    100: (5000.0, 1000.0),
    200: (99999.9, 20000.0),
    300: (10000.0, 2000.0),
    400: (50.0, 20.0),
    500: (99999.9, 20000.0),
    600: (10000.0, 2000.0),
}

LAST_AXIS = 8
"""A 9/PC has axes 1 to 8 (page 3-5)."""


# -- appendix A


def dac_monitor_code(function: float, axis: float) -> int:
    """Value of 86 or 87: function code + axis number, as 200 + 4 = 204 (page A-6)."""
    if function not in DAC_FUNCTIONS:
        raise ValueError(f"A function code of the DAC monitor is 100, 200 to 600, not {function!r}.")
    number = whole("The axis number", axis)
    if number > LAST_AXIS:
        raise ValueError(f"The axis number must be 1 to {LAST_AXIS}, not {axis!r}.")
    return int(function) + number


def dac_monitor_function(code: float) -> tuple[int, int]:
    """Function code and axis number that a value of 86 or 87 means: 504 is 500 and axis 4 (page A-6)."""
    function, axis = divmod(whole("The code of the DAC monitor", code), 100)
    if dac_monitor_code(function * 100, axis) != code:
        raise ValueError(f"{code!r} is no function code plus axis number.")
    return function * 100, axis


def dac_starting_scale(function: float, pitch: float) -> float:
    """Value of 910 or 930 to begin with, for 820 or 830 at 10 V and a screw of 0.1 or 0.5 in pitch (page
    A-7).
    """
    if function not in _DAC_SCALES:
        raise ValueError(f"A function code of the DAC monitor is 100, 200 to 600, not {function!r}.")
    if pitch not in DAC_PITCHES:
        raise ValueError(f"Table A.C has pitches of 0.1 and 0.5 in; a scale for {pitch!r} in is not printed.")
    return _DAC_SCALES[int(function)][DAC_PITCHES.index(pitch)]


def typical_integral_gain(proportional_gain: float) -> tuple[float, float]:
    """Typical final Velocity Integral Gain: a tenth to a fifth of the proportional gain (page A-10)."""
    gain = positive("Velocity Proportional Gain", proportional_gain)
    return gain / 10.0, gain / 5.0


# -- chapter 36: axis calibration on line


def calibration_deviation(reading: float, actual: float) -> float:
    """Deviation of a calibration point: actual position less what the control reads (page 36-7).

    Negative where the actual position lies on the negative side of the absolute one.
    """
    return finite("The actual position", actual) - finite("The reading of the control", reading)


def calibration_limit(position: float, previous: float) -> float:
    """Largest deviation at a calibration point: 2 % of the way from the point before it (page 36-7)."""
    return 0.02 * abs(finite("The position", position) - finite("The previous position", previous))


def net_correction(corrections: Iterable[float]) -> float:
    """Net correction of a roll-over axis, which should be zero for one revolution (page 36-7)."""
    return math.fsum(finite("A correction", correction) for correction in corrections)
