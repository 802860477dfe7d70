"""Whatever fix is offered in any state that the tables of cases bring about keeps its promises,
whosever it is.

One case in twelve in ``make test``, each in ``make campaign``. Applied alone it is within range, ends its
finding and brings nothing as severe; and one that is marked as safe sets what the control uses anyway, or
what no motion depends on.
"""

from collections.abc import Iterator

import pytest
from fix_campaign import unkept
from rule_machines import FAMILIES, Case, cases

from amp_studio.schema import fault, load_schema
from tests.campaigns import CAMPAIGN, some

NO_MOTION = {
    "57c422b.interrupt.source-in-file": (
        "what the module writes about an interrupt, for the application to clear"
    ),
    "9pc.servo.tables-without-motor": "the tables are of standard motors, and there is none",
    "9pc.oci.transfer-below-monitor": "how often a screen is told of changes",
    "9pc.patch.third-spindle": "the 9/PC has no third spindle",
    "acromill.control.acr2000-masks": "of inputs and outputs that the ACR2000 does not have",
    "num.axes.handwheel-bits": "there are four handwheels, and the other bits belong to none",
    "num.measure.sensor-unused-bits": "bits that page 5-18 leaves without a meaning",
    "num.spindle.meaningless-bits": "there are four spindles, and the other bits belong to none",
    "num.spindle.meaningless-type-bits": "bits that page 8-10 leaves without a meaning",
    "num.spindle.meaningless-reversal-bits": "there are six speed ranges, and the other bits belong to none",
    "num.comm.master-gap": "of a serial line",
    "num.comm.plctool-notation": "of a serial line",
}
"""Rule whose fix is safe, though it does not say that the control uses that value anyway -> why it is."""


def broken_promises(case: Case) -> Iterator[str]:
    """Apply each fix that is offered while a case is broken, and yield what it does not keep."""
    here = case.machine
    here.validator.is_alone = False
    with here.changed(case.given), here.changed(case.breaks or {}):
        before = here.findings
        for finding in [finding for finding in before if finding.fix]:
            with here.recorded():
                here.set({setting.address: setting.value for setting in finding.fix})
                message = [
                    fault(here.file.evaluation, setting.address, setting.value) for setting in finding.fix
                ]
                yield from filter(None, (*message, *unkept(finding, before, here.findings)))


@pytest.mark.parametrize("family", some(FAMILIES))
def test_an_offered_fix_keeps_what_it_promises(family: str) -> None:
    broken = [case for case in cases(family) if case.breaks is not None][:: 1 if CAMPAIGN else 24]
    assert [f"{case}: {message}" for case in broken for message in broken_promises(case)] == []


@pytest.mark.parametrize("family", FAMILIES)
def test_a_safe_fix_changes_no_motion(family: str) -> None:
    safe = {rule.id: rule for rule in load_schema(family).rules if any(fix.safe for fix in rule.fix)}
    used = {name for name, rule in safe.items() if rule.effective}
    assert safe.keys() - used == {name for name in NO_MOTION if name.startswith(f"{family}.")}
    for case in cases(family):
        if case.rule in used and case.breaks is not None:
            with case.machine.changed(case.given), case.machine.changed(case.breaks):
                found = case.machine.of(case.rule)
                assert all(f.fix == f.effective for f in found if f.fix), "what the control uses anyway"
