"""Random machines of every family: each offered fix mends its finding, brings nothing as severe,
and fixing comes to an end.
"""

from fix_campaign import campaign
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.campaigns import CAMPAIGN


def test_every_fix_that_is_offered_in_a_random_machine_keeps_its_promises() -> None:
    tried, broken = campaign(seed=0, count=4000 if CAMPAIGN else 30)
    assert broken == []
    assert tried > (4000 if CAMPAIGN else 20), "and there are fixes to try"


@given(seed=st.integers(10**6, 10**9))
@settings(max_examples=500 if CAMPAIGN else 2, suppress_health_check=[HealthCheck.too_slow])
def test_so_does_every_other(seed: int) -> None:
    assert campaign(seed, 1)[1] == []
