"""A short part of each fault campaign; ``make faults`` runs them whole."""

from pathlib import Path

import pytest

from .campaigns import CAMPAIGNS, Campaign
from .verbs import compiler, fail_calls

SEED = 4
"""With it the bad line is a pseudo terminal that is cut twice;
a control that dies in a commit is waited for 20 s."""


@pytest.mark.parametrize(
    "campaign", [campaign for campaign in CAMPAIGNS if campaign.short], ids=lambda campaign: campaign.name
)
def test_no_fault_is_answered_otherwise_than_promised(campaign: Campaign, tmp_path: Path) -> None:
    if campaign.run is fail_calls and compiler() is None:
        pytest.skip("the failing calls are made with a C compiler, and there is none")
    assert campaign.run(SEED, campaign.short, tmp_path) == []
