"""Which findings a changed file has that it did not have before."""

from amp_studio.validate import Finding
from amp_studio.validate.findings_between import new_findings

PITCH = ("servo.lead_screw_pitch", "1")


def finding(rule: str, severity: str = "warning", message: str = "") -> Finding:
    """Return a finding about the pitch."""
    return Finding(rule, severity, (PITCH,), message, instance="1")


def test_a_finding_of_other_figures_is_no_new_one_and_a_more_severe_one_is() -> None:
    before = [finding("a", message="12 mm is too much"), finding("b")]
    after = [finding("a", message="13 mm is too much"), finding("b", "error"), finding("c")]
    assert [f.rule for f in new_findings(before, after)] == ["b", "c"]


def test_values_that_were_not_given_are_no_new_finding() -> None:
    assert new_findings([], [Finding("schema.unset", "advice", (PITCH,), "")]) == []
