"""Spindles and rigid tapping: chapter 8. Speeds are in rpm, angles in degrees, sampling periods in µs.

The control counts the angle of a spindle in increments, of which a revolution has a power of two: the modulo.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from amp_studio.validate import finite, not_negative, positive, whole

from .servo import DAC_POINTS_AT_9_V

MIN_MODULO = 4096
"""Least number of increments in a revolution (page 8-12)."""

INCREMENTS_PER_SAMPLE = 32768
"""Most increments that a measured spindle may turn in one sample (page 8-11)."""

FULL_REFERENCE_V = 10.0
"""Reference at which a spindle has the highest speed of its range (page 8-16)."""


# -- measurement of the angle


def spindle_modulo(points: float) -> int:
    """Increments in a revolution: the power of two at or above the encoder's points,
    at least 4096 (page 8-12).
    """
    modulo = MIN_MODULO
    while modulo < whole("The number of encoder points", points):
        modulo *= 2
    return modulo


def spindle_increment(points: float) -> float:
    """Internal unit of a spindle in degrees: 360 over the modulo (page 8-13)."""
    return 360.0 / spindle_modulo(points)


def spindle_offset(angle: float, points: float) -> int:
    """Angle in internal units, as in P42 and P44: degrees x modulo / 360, rounded (page 8-5).

    Page 8-5 prints 4096 / 360, which is right with the least modulo only (erratum e-p42-modulo).
    """
    return round(finite("The angle", angle) / spindle_increment(points))


def largest_measured_speed(points: float, period: float) -> float:
    """Highest speed in rpm that can be measured: 32768 increments in a sample (page 8-11)."""
    revolutions = INCREMENTS_PER_SAMPLE / spindle_modulo(points)
    return revolutions * 60e6 / positive("The sampling period", period)


# -- indexing


def indexing_reference(error: float, gain: float, limit: float) -> float:
    """Reference in rpm while a spindle is indexed: error x P45, at most the limit either way (page 8-6).

    ``error`` in revolutions; ``limit`` is P43 or the programmed G92 S, whichever is smaller.
    """
    bound = not_negative("The limit speed", limit)
    wanted = finite("The position error", error) * not_negative("The gain", gain)
    return max(-bound, min(bound, wanted))


def indexing_standstill(period: float) -> float:
    """Speed in rpm below which an indexed spindle counts as stopped:
    3/4096 revolution in a sample (page 8-5).
    """
    return 3.0 / 4096.0 * 60e6 / positive("The sampling period", period)


# -- speed ranges


def ranges_for_speed(
    speed: float, minima: Sequence[float], maxima: Sequence[float], limits: Sequence[float]
) -> list[int]:
    """Speed ranges, 40 to 45, in which a speed may be programmed (page 8-16).

    A range whose highest speed is 0 does not exist; a limit speed of 0 means the highest speed.
    """
    wanted = not_negative("The spindle speed", speed)
    ranges = []
    _same_length(minima, maxima, limits)
    for n, (low, high, limit) in enumerate(zip(minima, maxima, limits, strict=True)):
        if high > 0 and low <= wanted <= (limit or high):
            ranges.append(40 + n)
    return ranges


def speed_gap(
    minima: Sequence[float | None], maxima: Sequence[float | None], limits: Sequence[float | None]
) -> float:
    """Speed in rpm above which the next range begins too late,
    0 where no speed between the ranges is lost (page 8-16).

    A range ends at its limit speed, or at its highest speed if that is 0; the next speed is 1 rpm higher. A
    range whose highest speed is 0 does not exist, and one that ends before it begins has no speeds.
    """
    _same_length(minima, maxima, limits)
    ranges = [*_ranges(minima, maxima, limits)]
    last = max((end for _, end in ranges), default=0.0)
    # By their ends: the first gap that is met is the lowest one.
    for _, end in sorted(ranges, key=lambda found: found[1]):
        following = (low for low, other in ranges if other > end and low is not None)
        if end < last and not any(low <= end + 1.0 for low in following):
            return end
    return 0.0


def _ranges(
    minima: Sequence[float | None], maxima: Sequence[float | None], limits: Sequence[float | None]
) -> Iterator[tuple[float | None, float]]:
    """Yield beginning and end of each range that has speeds."""
    for low, high, limit in zip(minima, maxima, limits, strict=True):
        if high and (low is None or low <= (limit or high)):
            yield low, limit or high


def _same_length(*words: Sequence[float | None]) -> None:
    if len({len(of_all) for of_all in words}) > 1:
        counts = ", ".join(str(len(of_all)) for of_all in words)
        raise ValueError(
            f"Each range has a lowest, a highest and a limit speed, but there are {counts} of them."
        )


def spindle_reference_volts(speed: float, range_max: float) -> float:
    """Speed reference in V: its share of the 10 V at the highest speed of the range (page 8-16).

    That lower speeds are in proportion is implied, not printed.
    """
    top = positive("The highest speed of the range", range_max)
    if not_negative("The spindle speed", speed) > top:
        raise ValueError(f"The range ends at {top:g} rpm, below {speed:g}.")
    return FULL_REFERENCE_V * speed / top


def spindle_reference_points(speed: float, range_max: float) -> int:
    """Speed reference in DAC points, of which 29491 are 9 V (page 6-14), rounded."""
    return round(spindle_reference_volts(speed, range_max) * DAC_POINTS_AT_9_V / 9.0)


# -- rigid tapping


def tapping_deceleration_distance(pitch: float, speed: float, deceleration: float) -> float:
    """Distance above the bottom at which a tap begins to slow down: pitch x S² / (2 x A x 60²) (page 8-32).

    In the length unit of ``pitch``, with S in rpm and A, the word of P62, in revolutions per s squared. The
    brackets are not printed (erratum e-p62-distance).
    """
    turns = not_negative("The spindle speed", speed) ** 2 / (2.0 * 3600.0 * positive("A", deceleration))
    return positive("The pitch", pitch) * turns


def hole_bottom_speed(millivolts: float, range_max: float) -> float:
    """Speed in rpm of the least reference in the hole bottom, by the 10 V of the range (pages 8-32 and
    8-16).
    """
    top = positive("The highest speed of the range", range_max)
    return not_negative("The reference", millivolts) / 1000.0 / FULL_REFERENCE_V * top


def integration_constant(samples: float) -> float:
    """First word of P63 for a group: 1000 / Ti, with Ti in samples and at least 2 (page 8-34)."""
    if finite("Ti", samples) < 2.0:
        raise ValueError(f"Ti must be at least 2 samples, not {samples:g}.")
    return 1000.0 / samples


def position_anticipation(time_constant: float, period: float) -> float:
    """Second word of P63 for a group: 10^6 x P56 / P50, with P56 in ms and P50 in µs (page 8-35)."""
    return 1e6 * not_negative("The time constant", time_constant) / positive("The sampling period", period)


def zero_crossing_anticipation(speed: float, acceleration: float, period: float) -> float:
    """Third word of P63 for a group, in samples: (speed / acceleration) x 10^6 / P50 (page 8-35).

    ``speed`` is the highest tapping speed in mm/s, ``acceleration`` that of the tapping axis in mm/s².
    """
    seconds = not_negative("The tapping speed", speed) / positive("The acceleration", acceleration)
    return seconds * 1e6 / positive("The sampling period", period)
