"""How many generated cases a test tries: few and the same each time in ``make test``,
many new ones in ``make campaign``.
"""

import os
from collections.abc import Iterable
from typing import TypeVar

CAMPAIGN = os.environ.get("AMP_STUDIO_FULL") == "1"
"""Whether ``make campaign`` or ``make mutants`` asks for all that can be tried."""
MORE = 25
"""How many times as many a campaign tries."""
FEWER = 8
"""Of how many ``make test`` tries one."""


def examples(usual: int) -> int:
    """Return how many examples hypothesis generates where ``usual`` are enough to find most:
    some of them, or those of a campaign.
    """
    return usual * MORE if CAMPAIGN else -(-usual // FEWER)


Case = TypeVar("Case")


def some(cases: Iterable[Case], of: int = 3) -> list[Case]:
    """Return the first of ``of`` cases, of the next so many, and so on; in a campaign all."""
    return list(cases)[:: 1 if CAMPAIGN else of]
