"""A builder's rule that ends in an error with the values of a file reports it with its line:
it is not taken for one that is satisfied.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.validate import Finding, Validator, rules_beside
from tests.campaigns import some

RAPID = ("feedrate.rapid", "1")


def checked(
    mill: ParameterFile, folder: Path, check: str, reads: str = "rapid: feedrate.rapid@1"
) -> Validator:
    """Return a validator with one rule of a builder's, in line 3 of its file."""
    (folder / "rules.yaml").write_text(
        "# of this machine\nrules:\n  - id: builder.own\n    title: T\n    severity: warning\n    reads:"
        f" {{{reads}}}\n    optional: [rapid]\n    check: \"{check}\"\n    message: 'Rapid {{rapid}}.'\n",
        encoding="utf-8",
    )
    return Validator(mill, rules_beside(folder / "mill.amp", mill))


def reported(findings: tuple[Finding, ...]) -> list[str]:
    return [f.message for f in findings if f.rule == "rules.unusable"]


@pytest.mark.parametrize(
    "check",
    some(
        [
            "int(rapid * 1e300) > 5",
            "int(1e300) > int(rapid)",
            "1 / (int(rapid) - int(rapid)) > 5",
            "int(rapid) * 9223372036854775807 > 5",
            "int(string(rapid) + 'x') > 5",
        ],
        2,
    ),
)
def test_a_check_that_fails_with_the_values_is_an_error_with_its_line(
    mill: ParameterFile, tmp_path: Path, check: str
) -> None:
    (message,) = reported(checked(mill, tmp_path, check).run())
    assert (
        message == "rules.yaml, line 3: builder.own: it cannot be calculated with rapid = 12000 mm/min: "
        "a number is too large, divided by zero or no number."
    )


def test_every_instance_for_which_it_fails_is_reported_by_itself(mill: ParameterFile, tmp_path: Path) -> None:
    validator = checked(mill, tmp_path, "int(rapid * 1e300) > 5", "rapid: feedrate.rapid")
    findings = [f for f in validator.run() if f.rule == "rules.unusable"]
    assert [f.addresses for f in findings] == [(("feedrate.rapid", str(n)),) for n in range(1, 8)]
    assert len({f.key for f in findings}) == 7


def test_it_is_gone_as_soon_as_the_values_make_sense(mill: ParameterFile, tmp_path: Path) -> None:
    validator = checked(mill, tmp_path, "int(1000 / int(rapid)) < 1")
    assert reported(validator.run()) == []
    mill.set(RAPID, Value(0.0, "mm/min"))
    assert len(reported(validator.update([RAPID]))) == 1
    mill.set(RAPID, Value(5000.0, "mm/min"))
    assert reported(validator.update([RAPID])) == []


def test_a_value_that_is_not_set_is_no_failure(mill: ParameterFile, tmp_path: Path) -> None:
    validator = checked(mill, tmp_path, "rapid > 5.0")
    mill.set(RAPID, None)
    assert reported(validator.run()) == []


def test_a_secret_is_not_shown_where_a_rule_fails_with_it(mill: ParameterFile, tmp_path: Path) -> None:
    reads = "word: password.character@1, rapid: feedrate.rapid@1"
    (message,) = reported(checked(mill, tmp_path, "int(word * 1e300) > 5", reads).run())
    assert "calculated with word = •••• (secret), rapid = •••• (secret): a number" in message
