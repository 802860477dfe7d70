"""Electronic gearing of the 57C422B: the commanded position of the geared axis, scan by scan (pages 4-15,
4-20, 4-24).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from amp_studio.sim import Piece, SimulationError

from .formulas.motion import GEAR_SCALE
from .law_facts import ids
from .law_sample import SCAN

LARGEST, SMALLEST = 127.0, 1.0 / 32767.0
"""Range of the gear ratio (page 4-15)."""


def gear_fraction(ratio: float | None, numerator: float | None, denominator: float | None) -> tuple[int, int]:
    """Return the gear ratio as two whole numbers: of register 25 and 26,
    or the 32-bit number over 16777216 (page 4-15).

    ``ratio`` counts where there is no numerator. Raises SimulationError outside 127:1 to 1:32767, where
    gearing is not enabled.
    """
    if numerator is None or denominator is None:
        upper, lower = round((ratio or 0.0) * GEAR_SCALE), int(GEAR_SCALE)
    else:
        upper, lower = round(numerator), round(denominator)
    if lower <= 0 or not SMALLEST <= abs(upper / lower) <= LARGEST:
        raise SimulationError(
            f"The gear ratio {upper}/{lower} is not between 1:32767 and 127:1, so gearing is not enabled",
            ids.gear_ratio,
        )
    return upper, lower


def geared(master: Sequence[int], upper: int, lower: int) -> Iterator[int]:
    """Yield the commanded position of the geared axis for each position of the master,
    in counts from the first.

    Nothing is lost, however long the axis runs: the module keeps all remainders (page 4-15). Towards which
    side a broken count is cut is not printed; here it is down.
    """
    rest, position, before = 0, 0, master[0] if master else 0
    for now in master:
        # Whole numbers: the remainder goes into the next scan, so that no count is lost (4-15).
        travel, rest = divmod((now - before) * upper + rest, lower)
        position, before = position + travel, now
        yield position


def followed(master: Sequence[int], upper: int, lower: int, acceleration: float) -> list[float]:
    """Return the commanded position of an axis that is geared at rest to a moving master, scan by scan,
    in counts.

    ``acceleration`` in counts/s² of ramp velocity control, 0 without it:
    the axis is at the speed of its master at once.
    """
    wanted = list(geared(master, upper, lower))
    step = acceleration * SCAN * SCAN
    position, travel, together = 0.0, 0.0, step <= 0.0
    positions = [0.0]
    for before, now in pairwise(wanted):
        asked = float(now - before)
        if not together:
            travel = min(max(asked, travel - step), travel + step)
            # Once in step it stays so: ramp velocity control is for the start alone (4-21).
            together = travel == asked
        position += asked if together else travel
        positions.append(position)
    return positions


def pieces_of(positions: Sequence[float]) -> list[Piece]:
    """Return the pieces of a profile that goes from each position to the next in one scan."""
    return [Piece(SCAN, (after - before) / SCAN) for before, after in pairwise(positions)]
