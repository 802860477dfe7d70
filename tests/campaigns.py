"""How many generated cases a test tries: few and the same each time in ``make test``,
many new ones in ``make campaign``.
"""

from __future__ import annotations

import os

CAMPAIGN = os.environ.get("AMP_STUDIO_FULL") == "1"
"""Whether ``make campaign`` or ``make mutants`` asks for all that can be tried."""
MORE = 25
"""How many times as many a campaign tries."""


def examples(fixed: int) -> int:
    """Return how many examples hypothesis generates: ``fixed`` of them, or those of a campaign."""
    return fixed * MORE if CAMPAIGN else fixed
