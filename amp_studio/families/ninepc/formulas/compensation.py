"""Cutter compensation and corner override: chapter 22."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, percent_of


def compensation_radius(entry: float, is_diameter: bool) -> float:
    """Radius that cutter compensation uses of a table entry: half of a diameter (page 22-3)."""
    return finite("The table entry", entry) / (2.0 if is_diameter else 1.0)


def is_block_generated(length: float, minimum: float) -> bool:
    """Whether a generated block is executed: not below Minimum Block Generation Length (page 22-4).

    With .75 inch a generated block of 0.5 inch is left out.
    """
    return not_negative("The length of the block", length) >= not_negative("The minimum length", minimum)


def lowest_compensated_feedrate(programmed: float, percent: float, override: float = 100.0) -> float:
    """Lowest feedrate of compensation on inside arcs: programmed x override x percentage (page 22-5).

    In the unit of ``programmed``; both percentages in %. 80 % of 200 are 160. (The third example prints 180
    and 144 for an override of 80 %, which are those of 90 %; erratum e-405-example.)
    """
    feedrate = not_negative("The programmed feedrate", programmed) * not_negative("The override", override)
    return feedrate / 100.0 * percent_of("Minimum Feed Reduction %", percent) / 100.0


def compensated_feedrate(needed: float, programmed: float, percent: float, override: float = 100.0) -> float:
    """Feedrate on an inside arc: what constant cutting needs, but not below the lowest (page 22-5).

    Of 200 programmed 120 are needed: they are allowed with 50 %, and become 160 with 80 %.
    """
    lowest = lowest_compensated_feedrate(programmed, percent, override)
    return max(not_negative("The feedrate for constant cutting", needed), lowest)


def corner_feedrate(feedrate: float, percent: float, override: float = 100.0) -> float:
    """Feedrate in an inside corner: 60 % of 100 are 60, and 48 with an override of 80 % (page 22-10)."""
    active = not_negative("The feedrate", feedrate) * not_negative("The override", override) / 100.0
    return active * percent_of("Corner Override %", percent) / 100.0
