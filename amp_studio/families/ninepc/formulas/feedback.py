"""The SERCOS ring, feedback devices and gearing: chapter 7 and appendix B."""

from __future__ import annotations

import math
from collections.abc import Sequence

from amp_studio.validate import positive, whole

COUNTS_PER_LINE = 4
"""Quadrature: each line of an encoder gives four counts (page 7-33)."""

COUNTS_PER_INCH_LIMIT = 4_194_304
"""More feedback counts per inch than this may keep the system in E-Stop (page 7-33)."""

COUNTS_PER_CYCLE_LIMIT = 4_194_304
"""Upper end of Position Feedback Counts/Cycle; the same figure, but counts over one cycle (page 7-33)."""

SERCOS_CYCLE_MS = (1, 30)
"""Range of Cycle Time for SERCOS (page 7-4)."""


# -- chapter 7: SERCOS ring


def sercos_ring_baud(drives_mhz: Sequence[float]) -> float:
    """Baud rate of the ring in MHz: that of its slowest drive (page 7-3)."""
    if not drives_mhz:
        raise ValueError("A SERCOS ring needs at least one drive.")
    return min(positive("The baud rate of a drive", rate) for rate in drives_mhz)


def sercos_ring_cycle(drives_ms: Sequence[float]) -> float:
    """Cycle time of the ring in ms: that of the drive with the slowest update (page 7-4)."""
    if not drives_ms:
        raise ValueError("A SERCOS ring needs at least one drive.")
    return max(positive("The cycle time of a drive", cycle) for cycle in drives_ms)


def sercos_cycles(scan_ms: float) -> tuple[int, ...]:
    """SERCOS cycle times in ms that divide a system scan time evenly, within 1 to 30 ms (page 7-4)."""
    scan = whole("The system scan time in ms", scan_ms)
    low, high = SERCOS_CYCLE_MS
    return tuple(cycle for cycle in range(low, min(scan, high) + 1) if scan % cycle == 0)


def sercos_servos(cycle_ms: float, baud_mhz: float) -> int | None:
    """Largest recommended number of servos on the ring (page 7-4).

    4 at 1 ms and 2 MHz, 8 from 2 ms on; None at 1 ms and 4 MHz, where the manual only has "more".
    """
    positive("The baud rate", baud_mhz)
    if whole("The SERCOS cycle time in ms", cycle_ms) >= 2:
        return 8
    return 4 if baud_mhz <= 2 else None


# -- chapter 7, appendix B: feedback


def counts_per_cycle(lines: float) -> int:
    """Feedback counts per electrical cycle of an encoder with that many lines (page 7-33)."""
    return COUNTS_PER_LINE * whole("The number of lines", lines)


def counts_per_revolution(counts_per_cycle: float, markers: float = 1) -> float:
    """Counts per encoder revolution; with two markers a cycle is half a revolution (page 7-33)."""
    counts = positive("The number of counts per cycle", counts_per_cycle)
    return counts * whole("The number of markers", markers)


def dcm_counts_per_cycle(signal_period_mm: float, interpolation: float, small_period_mm: float) -> int:
    """Counts over the smaller marker distance of a distance-coded scale (pages 7-33 and B-2).

    ``interpolation`` is the number of A-quad-B cycles per signal period of the grating. LS176:
    0.02 mm, 5 and 20 mm give 20,000. ValueError when the distance is no whole number of counts.
    """
    period = positive("The signal period", signal_period_mm)
    cycles = whole("The number of A-quad-B cycles per signal period", interpolation)
    counts = positive("The smaller marker distance", small_period_mm) * cycles * COUNTS_PER_LINE / period
    if round(counts) < 1 or abs(counts - round(counts)) > 1e-6 * counts:
        raise ValueError(f"The smaller marker distance is {counts!r} counts, which is not a whole number.")
    return round(counts)


def scale_counts_per_cycle(lines: float, length: float, pitch: float) -> float:
    """Counts of a linear scale over one Lead Screw Thread Pitch (pages 7-33 and B-2).

    The scale has ``lines`` lines on ``length``. With 5000 lines on 0.5 inch and a pitch of 0.5 inch
    this is 20,000: the manual's own 5000 at that place leaves out the four counts of a line.
    """
    per_length = counts_per_cycle(lines) / positive("The length of the lines", length)
    return per_length * positive("Lead Screw Thread Pitch", pitch)


def largest_scale_pitch(lines: float, length: float) -> float:
    """Largest Lead Screw Thread Pitch to enter for a linear scale, in the unit of ``length`` (page B-2).

    Where the counts over the pitch would be more than the parameter takes, a smaller pitch is entered.
    The division is ours, the manual only has so. The scale has ``lines`` lines on ``length``.
    """
    return COUNTS_PER_CYCLE_LIMIT / scale_counts_per_cycle(lines, length, 1.0)


def lead_from_threads_per_inch(threads: float) -> float:
    """Lead in inches of a single-start screw or thread (pages 7-17, 16-5 and 33-5).

    5 threads per inch are a lead of .20 inch; an E- or F-word in threads per inch means a lead likewise.
    """
    return 1.0 / positive("The number of threads per inch", threads)


def feedback_sign(moves_positive: bool, counts_up: bool) -> int:
    """Sign of Position or Velocity Feedback, 1 or -1, from a turn by hand (pages 7-36 and 7-50).

    Plus where the feedback counts up while the axis moves in its positive direction, or down in its
    negative one; minus otherwise.
    """
    return 1 if moves_positive == counts_up else -1


def screw_revolutions_per_feedback_revolution(gear_teeth: float, screw_teeth: float) -> float:
    """Gear ratio between position feedback device and lead screw (page 7-38).

    ``gear_teeth`` sit on the feedback device (1026), ``screw_teeth`` on the screw (1027). The same
    number of teeth passes on both wheels, so the screw makes gear / screw turns while the device makes one.
    """
    return whole("The number of gear teeth", gear_teeth) / whole("The number of screw teeth", screw_teeth)


def feedback_revolutions_per_screw_revolution(motor_teeth: float, screw_teeth: float) -> float:
    """Turns of the velocity feedback device for one turn of the screw (pages 7-52 and 7-53).

    ``motor_teeth`` is Teeth on Motor Gear, ``screw_teeth`` Teeth on Lead Screw for Velocity Feedback. The
    manual names both without an equation; it follows as on page 7-38.
    """
    return whole("The number of screw teeth", screw_teeth) / whole("The number of motor teeth", motor_teeth)


def gear_train(pairs: Sequence[tuple[float, float]]) -> tuple[int, int]:
    """One pair of teeth for a series of gears or pulleys, in lowest terms (pages 7-38, 7-52 and 7-82).

    Each pair is (feedback or motor side, screw or spindle side). The manual asks to factor the series into
    the two parameters; that the pairs multiply is ours.
    """
    if not pairs:
        raise ValueError("A gear train needs at least one pair of wheels.")
    near = math.prod(whole("The number of teeth", first) for first, _ in pairs)
    return lowest_terms(near, math.prod(whole("The number of teeth", second) for _, second in pairs))


def counts_per_length(counts_per_cycle: float, gear_teeth: float, screw_teeth: float, lead: float) -> float:
    """Feedback counts per unit of axis travel, in the unit of ``lead`` (pages 7-38 and 7-40)."""
    counts = positive("The number of counts per cycle", counts_per_cycle)
    per_screw = counts / screw_revolutions_per_feedback_revolution(gear_teeth, screw_teeth)
    return per_screw / positive("Lead Screw Thread Pitch", lead)


def counts_per_inch(counts_per_cycle: float, gear_teeth: float, screw_teeth: float, lead_mm: float) -> float:
    """Feedback counts per inch of travel with the lead in mm; see COUNTS_PER_INCH_LIMIT (page 7-33)."""
    return counts_per_length(counts_per_cycle, gear_teeth, screw_teeth, lead_mm) * 25.4


def lowest_terms(teeth_a: float, teeth_b: float) -> tuple[int, int]:
    """The gear ratio as an upload gives it back: 44:40 becomes 11:10 (page 7-38)."""
    a = whole("The number of teeth", teeth_a)
    b = whole("The number of teeth", teeth_b)
    divisor = math.gcd(a, b)
    return a // divisor, b // divisor
