"""Protection ranges of the software stroke limits: section 3."""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.validate import finite


def protected_range(first: float, second: float) -> tuple[float, float] | None:
    """Protected range of an axis from its two ends in G22, in either order;
    none where they are equal (page 3.4).
    """
    low, high = sorted((finite("first", first), finite("second", second)))
    return None if low == high else (low, high)


def is_inside_protection(
    positions: Sequence[float], positives: Sequence[float], negatives: Sequence[float]
) -> bool:
    """Whether a position lies in the block of the axes' ranges,
    which it does in all of them or not at all (page 3.5).

    An axis whose two ends are equal has no range and takes no part; without any range nothing is protected.
    """
    if not len(positions) == len(positives) == len(negatives):
        raise ValueError("positions, positives and negatives must be as many.")
    ranges = [protected_range(*ends) for ends in zip(positives, negatives, strict=True)]
    inside = [
        found[0] <= finite("position", p) <= found[1]
        for p, found in zip(positions, ranges, strict=True)
        if found
    ]
    return bool(inside) and all(inside)
