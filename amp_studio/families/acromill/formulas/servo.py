"""Gains, torque limit and filters: the Servo tab and appendix C."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

from amp_studio.validate import finite, not_negative, positive, whole

LOPASS_SHARE = 0.1
"""The low-pass frequency must not exceed this part of the servo update frequency (page 128)."""


# -- gains


def proportional_gain(volts: float, pulses: float) -> float:
    """P Gain in V/pulse that puts out ``volts`` at a following error of ``pulses`` (page 128).

    10 V for one turn of 4096 pulses is 0.00244140625: the default 0.00244 of page 59, 0.002441406 on page 93.
    """
    return positive("The output", volts) / positive("The following error", pulses)


def proportional_volts(p_gain: float, pulses: float) -> float:
    """Volts that P Gain puts out for a following error, before any limit (pages 59 and 128)."""
    return not_negative("P Gain", p_gain) * finite("The following error", pulses)


def velocity_feedforward(p_gain: float, following_error: float, velocity: float) -> float:
    """Vel FFwd in V per pulse/s that takes away the following error at constant speed (page 115).

    ``following_error`` in pulses and ``velocity`` in pulses a second are read with Vel FFwd at 0.
    """
    return proportional_volts(p_gain, following_error) / positive("The velocity", velocity)


def torque_limit(amplifier_amps: float, amplifier_volts: float, motor_amps: float, percent: float) -> float:
    """Torque Limits in volts for a share of what the motor may have continuously (page 115).

    15 A at 10 V and a motor of 6 A: 100 % is 10 / 15 × 6 = 4 V and 10 % is 0.4 V,
    where the guide prints TLM X4.
    """
    full = positive("The input of the amplifier", amplifier_volts) / positive("Its current", amplifier_amps)
    return (
        full * positive("The current of the motor", motor_amps) * not_negative("The share", percent) / 100.0
    )


def dac_gain(bits: float, volts: float) -> float:
    """DAC GAIN, the figure for one volt, of a converter whose half range is ``volts`` (pages 114 and 128).

    16 bits over ±10 V: 32768 / 10 = 3276.8. The division is ours, the guide prints both figures.
    """
    return 2.0 ** (whole("The number of bits", bits) - 1) / positive("The range", volts)


# -- sampling and filters


def servo_rate(period_us: float) -> float:
    """Servo update frequency in Hz for a period in µs (pages 113 and 128): 500 µs are 2000 Hz,
    400 µs 2500 Hz.
    """
    return 1e6 / positive("The servo period", period_us)


def derivative_width(periods: float, period_us: float) -> float:
    """D Time in seconds for a number of servo periods (page 113); 0 periods are 0, which means each of them.

    The typical 0.002 s of page 59 is four periods of 500 µs.
    """
    return whole("The number of periods", periods, least=0) * positive("The servo period", period_us) / 1e6


def lopass_limit(servo_hz: float) -> float:
    """Highest low-pass frequency in Hz, a tenth of the servo update frequency (page 128): 500 at 5000 Hz."""
    return LOPASS_SHARE * positive("The servo update frequency", servo_hz)


def filter_gain(sections: Sequence[Sequence[float]], frequency_hz: float, servo_hz: float) -> float:
    """Magnitude of the two cascaded filters at a frequency, from their coefficients (page 128).

    A section is (a0, a1, a2, b1, b2) of (a0 + a1/z + a2/z²) / (1 - b1/z - b2/z²); z is on the unit circle at
    that frequency. How LOPASS and NOTCH fill the coefficients is not printed.
    """
    angle = 2.0 * math.pi * not_negative("The frequency", frequency_hz)
    delay = cmath.exp(-1j * angle / positive("The servo update frequency", servo_hz))
    gain = 1.0
    for a0, a1, a2, b1, b2 in sections:
        below = 1.0 - (b1 + b2 * delay) * delay
        if below == 0:
            raise ValueError("The filter has a pole at this frequency.")
        gain *= abs((a0 + (a1 + a2 * delay) * delay) / below)
    return gain
