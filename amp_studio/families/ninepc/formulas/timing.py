"""Scans: chapter 33."""

from __future__ import annotations

import math

from amp_studio.validate import not_negative, positive, whole


def fine_foreground_minimum_ms(axes_on_largest_drive: float) -> int:
    """Smallest Fine Foreground Scan Time: 7 ms and 1 ms per axis of the fullest drive (page 33-20)."""
    return 7 + whole("The number of axes on the largest drive", axes_on_largest_drive)


def coarse_scan_ms(fine_ms: float, fine_scans: float) -> float:
    """Coarse scan time, which is the logic foreground interval, in ms (page 33-14)."""
    return positive("Fine Foreground Scan Time", fine_ms) * whole("Fine Scans per Logic Scan", fine_scans)


def fine_foreground_from_maximum_ms(fine_maximum_ms: float) -> int:
    """Fine Foreground Scan Time from the screen's maximum: twice that, rounded up to a ms (page 33-22)."""
    return math.ceil(2.0 * positive("The maximum fine scan time", fine_maximum_ms))


def fine_scans_per_logic_scan(
    fine_ms: float, fine_maximum_ms: float, activation_maximum_ms: float, logic_maximum_ms: float
) -> int:
    """Fine Scans per Logic Scan from the maxima of the timing screen, all in ms (page 33-22).

    The larger of block activation interval and foreground logic time, plus the maximum fine scan time,
    over the fine scan time that was set; rounded up.
    """
    longer = max(
        not_negative("The maximum block activation interval", activation_maximum_ms),
        not_negative("The maximum foreground logic time", logic_maximum_ms),
    )
    needed = longer + positive("The maximum fine scan time", fine_maximum_ms)
    return math.ceil(round(needed / positive("Fine Foreground Scan Time", fine_ms), 9))
