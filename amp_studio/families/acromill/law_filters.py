"""The two filters between the PID and the torque limit of an ACR controller (User's Guide, appendix C,
page 128).

The guide prints the form of the filters,

    H(z) = (a0 + a1/z + a2/z²) / (1 - b1/z - b2/z²),  two of them in a row,

and what LOPASS and NOTCH shall do; not how they fill the coefficients. Both are designed here as second-order
analog filters, mapped with the bilinear transform so that the named frequency stays in its place (A. V.
Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, 3rd ed. 2010, chapter 7):
assumptions that each result names.
"""

from __future__ import annotations

import math

from amp_studio.sim import SimulationError

from .law_facts import ids

Biquad = tuple[float, float, float, float, float]
"""(a0, a1, a2, b1, b2) of the printed form."""

PASS: Biquad = (1.0, 0.0, 0.0, 0.0, 0.0)
"""A filter that is not in use: the output of the PID goes to the torque limit as it is (page 128)."""


def lopass(frequency: float, servo_hz: float) -> Biquad:
    """Return LOPASS: 3 dB less at ``frequency`` (page 128), in Hz; no ripple below it, a Butterworth
    filter.
    """
    k = _warped("LOPASS", frequency, servo_hz)
    return _bilinear((0.0, 0.0, 1.0), (1.0, math.sqrt(2.0), 1.0), k)


def notch(frequency: float, width: float, servo_hz: float) -> Biquad:
    """Return NOTCH(frequency, width), both in Hz.

    A notch as wide as its frequency lets nothing through there, and one of 1 Hz takes very little out (page
    128): at the frequency itself the share 1 - width / frequency is left. How fast it rises beside the
    frequency is not printed; taken is a quality of 1,
    so that the notch that is as wide as its frequency is 3 dB down over that width.
    """
    if not 0.0 < width <= frequency:
        raise SimulationError(
            f"NOTCH({frequency:g}, {width:g}): the width must be above 0 and at most the frequency",
            ids.notch_width,
        )
    k = _warped("NOTCH", frequency, servo_hz)
    return _bilinear((1.0, 1.0 - width / frequency, 1.0), (1.0, 1.0, 1.0), k)


def _warped(name: str, frequency: float, servo_hz: float) -> float:
    """Return the frequency as the digital filter needs it; raises SimulationError for one it cannot have."""
    if not 0.0 < frequency < 0.5 * servo_hz:
        raise SimulationError(
            f"{name} {frequency:g} Hz cannot be simulated: it must be above 0 and below half of the servo"
            f" update frequency, which is {servo_hz:g} Hz",
            ids[f"{name.lower()}_frequency"],
        )
    # The bilinear transform bends frequencies; the tangent puts this one back in its place.
    return math.tan(math.pi * frequency / servo_hz)


def _bilinear(above: tuple[float, float, float], below: tuple[float, float, float], k: float) -> Biquad:
    """Return the filter (above s) / (below s), coefficients of s², s and 1 at 1 rad/s,
    with k in the place of 1 rad/s.
    """

    def mapped(c2: float, c1: float, c0: float) -> tuple[float, float, float]:
        return c2 + c1 * k + c0 * k * k, 2.0 * (c0 * k * k - c2), c2 - c1 * k + c0 * k * k

    n0, n1, n2 = mapped(*above)
    d0, d1, d2 = mapped(*below)
    # The printed form takes b1 and b2 off below the line: their signs are turned.
    return n0 / d0, n1 / d0, n2 / d0, -d1 / d0, -d2 / d0
