"""Encoders, scales and handwheels, and the words that adapt them: chapter 5."""

from __future__ import annotations

from math import gcd

from amp_studio.validate import positive, whole

_LARGEST = 32767
"""MULTI and DIVI must be below 32768 (page 5-6)."""


def encoder_measurement(periods: float, interpolation: float = 1.0) -> float:
    """Increments the CNC counts of an encoder (page 5-6): four for each line or period,
    times the interpolation.

    2500 lines with an EXE that interpolates by 10 are 100,000.
    """
    return positive("The number of lines", periods) * 4.0 * positive("The interpolation", interpolation)


def multi_divi(movement: float, measurement: float) -> tuple[int, int]:
    """MULTI and DIVI in lowest terms for a movement in internal units
    and the increments counted for it (page 5-6).

    50,000 units in 100,000 increments are 1 and 2. For handwheels it is the same (page 5-12).
    """
    multi, divi = _lowest(whole("The movement", movement), whole("The measurement", measurement))
    if max(multi, divi) > _LARGEST:
        raise ValueError(f"{multi} / {divi} cannot be written with numbers below 32768.")
    return multi, divi


def ssi_divi_factor(bits: float) -> float:
    """Factor of DIVI for a sensor whose measurement arrives in so many bits (page 5-8): 16 for 12 bits,
    1 from 16 on.

    The control shifts a shorter measurement to the left until it fills 16 bits.
    """
    return 2.0 ** max(0, 16 - whole("The number of bits", bits))


def measured_step(multi: float, divi: float, sensor: float) -> float:
    """Movement of one encoder increment in internal units (page 5-6): MULTI / DIVI,
    whatever a short frame is shifted by.

    The sensor is the word of P34. What an SSI frame of fewer than 16 bits sends is shifted to the left first
    (page 5-8): 1 / 16 with 12 bits is one unit. A DIVI that does not contain the shift gives no scale at all.
    """
    word = int(sensor)
    bits = word >> 3 & 31
    factor = ssi_divi_factor(bits) if word >> 25 & 3 == 1 and bits else 1.0
    if factor > 1.0 and divi % factor:
        raise ValueError(f"DIVI must be a multiple of {factor:.0f} with this frame, not {divi:g}.")
    return multi * factor / positive("DIVI", divi)


def coded_conversion(period: float, interpolation: float) -> tuple[int, int]:
    """MULTI and DIVI of a scale that moves with the axis, from its period in internal units (page 5-22).

    Period 20 with an EXE of 10 gives 1 and 2. The manual takes the maker's period times k, which represents
    the unit and for a gear.
    """
    return multi_divi(period, 4 * whole("The interpolation", interpolation))


def coded_graduation(period: float, multi: float, divi: float) -> float:
    """Graduation p of a scale with coded marks, in increments (page 5-22):
    the maker's period in µm over MULTI / DIVI.

    20 µm at 1/2 are 40, the value of P36 N0 to N31; N32 to N63 take the graduations between two marks.
    Printed so, but sure for µm and without a gear only (erratum e-p36-k).
    """
    return positive("The period", period) * positive("DIVI", divi) / positive("MULTI", multi)


def combined_ratio(bits: float, periods: float, interpolation: float = 1.0) -> tuple[int, int]:
    """Numerator and denominator of P36 for a combined sensor, in lowest terms (page 5-23).

    Steps of the SSI frame over increments in one turn: 13 bits with 1024 periods and an IBV of 10 are 8192 /
    40960, that is 1 / 5 (the manual prints 8 / 40, which is the same).
    """
    increments = 4 * whole("The number of periods", periods) * whole("The interpolation", interpolation)
    return _lowest(2 ** whole("The number of bits", bits, most=64), increments)


def signal_fault(axis: float) -> int:
    """Number of the error that a bad encoder signal shows (page 5-18): 210 and the address of the axis."""
    address = whole("The address", axis, 0)
    if address > 31:
        raise ValueError(f"An address is 0 to 31, not {address}.")
    return 210 + address


def unwatched_axis(measured: float, declared: float, spindles: float, handwheels: float) -> float:
    """Lowest address of an axis in P2 whose encoder P25N0 does not declare for the signal check (page 5-25).

    -1 where there is none. Inputs that P6 or P14 give to a spindle (24 to 27) or a handwheel (28 to 31) serve
    no axis (page 4-8).
    """
    others = (int(spindles) & 15) << 24 | (int(handwheels) & 15) << 28
    left = int(measured) & ~int(declared) & ~others
    # x & -x leaves the lowest bit alone; without any it is 0, and the result -1.
    return float((left & -left).bit_length() - 1)


def _lowest(above: int, below: int) -> tuple[int, int]:
    common = gcd(above, below)
    return above // common, below // common
