"""Times, memory and characters of the control: chapters 9 and 10. Periods are in µs, other times in ms.

Where the control takes another value than it is given, the functions called ``..._in_force`` are those.
"""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, positive, whole

PERIOD_LIMITS = (2000.0, 20000.0)
"""Shortest and longest sampling period (page 9-10)."""

UC_SII_STEP = 2000.0
"""Step of the sampling period of a UC SII card: 2 ms (page 9-10)."""

PLC_LIMITS = (4.0, 14.0)
"""Shortest and longest time of the PLC application (page 9-28)."""

CALIBRATION_LIMIT = 1000.0
"""Most points of the interaxis calibration table (page 9-14)."""


def _within(value: float, limits: tuple[float, float]) -> float:
    return min(max(value, limits[0]), limits[1])


def sampling_period_in_force(period: float, uc_sii: bool) -> float:
    """Sampling period with which the CNC works: 2000 to 20000 µs,
    on a UC SII whole steps of 2 ms (page 9-10).
    """
    bounded = _within(finite("The sampling period", period), PERIOD_LIMITS)
    return bounded // UC_SII_STEP * UC_SII_STEP if uc_sii else bounded


def qvn_samples(period: float, qvn_period: float) -> float:
    """QVN samples in a sample of the CNC, which has to be a whole number (page 9-10)."""
    return positive("The sampling period", period) / positive("The QVN sampling period", qvn_period)


def block_time_bounds(axes: float, groups: float) -> tuple[float, float]:
    """Recommended bounds of the minimum block execution time by axes and axis groups (page 9-12).

    6 to 12 ms with up to 8 axes and up to 3 groups, 20 ms beyond. The table begins with 2 axes.
    """
    if whole("The number of axes", axes) <= 8 and whole("The number of groups", groups) <= 3:
        return 6.0, 12.0
    return 20.0, 20.0


def plc_time_in_force(time: float) -> float:
    """Time that the PLC application gets: 4 to 14 ms (page 9-28)."""
    return _within(finite("The time of the PLC", time), PLC_LIMITS)


def calibration_points_in_force(points: float) -> float:
    """Points of the interaxis calibration table: at most 1000 (page 9-14)."""
    return min(not_negative("The number of points", points), CALIBRATION_LIMIT)


def calibration_parameters(points: float) -> tuple[str, str, str, str]:
    """First and last programme parameters of master positions and slave corrections (page 9-14)."""
    last = int(calibration_points_in_force(whole("The number of points", points))) - 1
    return "E81000", f"E{81000 + last}", "E82000", f"E{82000 + last}"


def stack_kbytes(words: float) -> float:
    """Size of a programme stack in kbytes of 1024 bytes, of its words of 2 bytes (page 9-14)."""
    return not_negative("The stack size", words) * 2.0 / 1024.0


def potentiometer_range_in_force(low: float, high: float, spindle: bool) -> tuple[float, float]:
    """Range of a potentiometer in %: as given if it has 100 % in it, else the control's own (page 9-18).

    Both ends 0 to 255 and the upper one above the lower; else 0 to 120 for feed rates,
    50 to 100 for spindles.
    """
    if 0.0 <= low < high <= 255.0 and low <= 100.0 <= high:
        return low, high
    return (50.0, 100.0) if spindle else (0.0, 120.0)


def free_access_kbytes(total: float, customer: float, oem: float, num: float) -> float:
    """Memory left for the free access area 0, in kbytes: the total less areas 1 to 3 (page 9-22)."""
    left = not_negative("The total memory", total) - sum(
        not_negative("The size of an area", area) for area in (customer, oem, num)
    )
    if left < 0.0:
        raise ValueError(f"The areas are {-left:g} kbytes larger than the memory.")
    return left


def sequence_word(characters: str) -> int:
    """Word of P38 for a sequence of one to four characters, the last one in the lowest byte (page 10-4).

    The example prints 001B9143 for ESC [ C; with the code of the bracket it is 001B5B43 (erratum
    e-p38-bracket).
    """
    if not 1 <= len(characters) <= 4:
        raise ValueError(f"A sequence has one to four characters, not {len(characters)}.")
    word = 0
    for character in characters:
        if ord(character) > 255:
            raise ValueError(f"{character!r} is no character of one byte.")
        word = word << 8 | ord(character)
    return word
