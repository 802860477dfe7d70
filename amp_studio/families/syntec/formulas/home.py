"""Homing to an index: sections 2.2.4 and 2.2.5."""

from __future__ import annotations

from amp_studio.validate import not_negative, positive

INACCURATE_TURNS = 0.1
"""Home grids that differ by more bring MOT-022 (page 2.2.5.1)."""

SEARCH_PITCHES = 5.0
"""Pitches after which MOT-029 and MOT-036 give up (pages 2.2.5.2 and 2.2.5.4)."""


def home_grid(turns: float) -> float:
    """Home grid in percent of the motor turns between the dog and the first index (page 2.2.4.1)."""
    return not_negative("turns", turns) * 100.0


def is_home_grid_advised(grid: float) -> bool:
    """Whether the home grid function should be ON: below 20 or above 80 percent (page 2.2.4.1)."""
    return not_negative("grid", grid) < 20.0 or grid > 80.0


def is_index_ignored(grid: float, enabled: bool) -> bool:
    """Whether the first index is passed over: below 50 percent with the home grid function ON (page
    2.2.4.1).
    """
    return enabled and not_negative("grid", grid) < 50.0


def is_home_inaccurate(first_grid: float, grid: float) -> bool:
    """Whether a later homing brings MOT-022: its home grid is off by more than 0.1 turn (page 2.2.5.1)."""
    error = abs(not_negative("grid", grid) - not_negative("first_grid", first_grid))
    return round(error, 9) > INACCURATE_TURNS * 100.0


def homing_search_limit(pitch: float) -> float:
    """Way, in the unit of the pitch, after which MOT-029 or MOT-036 ends homing: 5 pitches (page 2.2.5.2)."""
    return SEARCH_PITCHES * positive("pitch", pitch)
