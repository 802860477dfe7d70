"""Whatever repair is offered in any state that the tables of cases bring about keeps its promises, whosever it is.

Applied alone it is within range, ends its finding and leaves no error that was not there before; and one that is said
to be safe sets what the control uses anyway, or what no motion depends on.
"""

from __future__ import annotations

import pytest
from rule_stands import FAMILIES, Case, cases

from amp_studio.schema import fault, load_schema
from amp_studio.validate import Finding

NO_MOTION = {
    "57c422b.interrupt.source-in-file": "what the module writes about an interrupt, for the application to clear",
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
"""Rule whose repair is safe, though it does not say that the control uses that value anyway -> why it is."""

BROUGHT_TO_LIGHT = {
    ("schema.range", "57c422b.command.gear-words-range"): "a ratio of 0 to 0 could not be judged",
    (
        "9pc.servo.spindle-type-order",
        "9pc.servo.spindle-type-duplicate",
    ): "spindle 1 and 2 change places one by one",
    (
        "9pc.axis.spindle-name",
        "9pc.cylindrical.feed-exists",
    ): "an error of the word that named the spindle anyway",
    (
        "9pc.axis.spindle-name",
        "9pc.cylindrical.park-exists",
    ): "an error of the word that named the spindle anyway",
    (
        "9pc.axis.spindle-name",
        "9pc.cylindrical.linear-exists",
    ): "an error of the word that named the spindle anyway",
    (
        "9pc.axis.spindle-name",
        "9pc.virtual-c.center-line-exists",
    ): "an error of the word that named the spindle anyway",
    (
        "9pc.plane.second-parallel-1",
        "9pc.plane.parallel-1-first-unknown",
    ): "the same error of the name that moves up",
    (
        "9pc.plane.second-parallel-2",
        "9pc.plane.parallel-2-first-unknown",
    ): "the same error of the name that moves up",
    (
        "9pc.servo.analog-velocity-port",
        "9pc.servo.same-device-type",
    ): "two kinds of device are said to be one",
    (
        "9pc.servo.analog-velocity-port",
        "9pc.servo.same-device-counts",
    ): "one device is said to have two resolutions",
    (
        "9pc.servo.position-hiperface-counts",
        "9pc.servo.counts-per-inch",
    ): "the counts that the device really has",
}
"""A rule's repair and the error that is there after it, but was in the values before -> why it is no fault of that."""


def errors_of(findings: tuple[Finding, ...]) -> set[tuple[str, object]]:
    """Return which errors there are, and about what."""
    return {finding.key for finding in findings if finding.severity == "error"}


def broken_promises(case: Case) -> list[str]:
    """Apply each repair that is offered while a case is broken, and tell what it does not keep."""
    here, told = case.stand, []
    with here.changed(case.given), here.changed(case.breaks or {}):
        before = here.findings
        for finding in [finding for finding in before if finding.repairs]:
            who = f"{case}: {finding.rule} {finding.repairs}"
            with here.recorded():
                here.set({repair.address: repair.value for repair in finding.repairs})
                told += [
                    f"{who}: out of range"
                    for repair in finding.repairs
                    if fault(here.file.situation, repair.address, repair.value)
                ]
                after = here.findings
                if any(f.key == finding.key for f in after):
                    told.append(f"{who}: still there")
                told += [
                    f"{who}: {rule}"
                    for rule, *_ in errors_of(after) - errors_of(before)
                    if (finding.rule, rule) not in BROUGHT_TO_LIGHT
                ]
    return told


@pytest.mark.parametrize("family", FAMILIES)
def test_an_offered_repair_keeps_what_it_promises(family: str) -> None:
    assert [told for case in cases(family) if case.breaks is not None for told in broken_promises(case)] == []


@pytest.mark.parametrize("family", FAMILIES)
def test_a_safe_repair_changes_no_motion(family: str) -> None:
    safe = {rule.id: rule for rule in load_schema(family).rules if any(fix.safe for fix in rule.fix)}
    used = {name for name, rule in safe.items() if rule.effective}
    assert safe.keys() - used == {name for name in NO_MOTION if name.startswith(f"{family}.")}
    for case in cases(family):
        if case.rule in used and case.breaks is not None:
            with case.stand.changed(case.given), case.stand.changed(case.breaks):
                found = case.stand.of(case.rule)
                assert all(f.repairs == f.effective for f in found if f.repairs), (
                    "what the control uses anyway"
                )
