"""Fixes that a person would make: one that brings a warning comes last,
and no speed is cut to what another value is to blame for.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.report import finding_text
from amp_studio.schema import Value
from amp_studio.validate import (
    BuilderRules,
    Validator,
    apply_fixes,
    axes_by_letter,
    read_builder_rules,
    rules_beside,
)

RAPID = ("feedrate.rapid", "1")


@pytest.fixture
def mill(checkout: Path) -> ParameterFile:
    """Return the example mill, whose axis 1 is X with a rapid of 10000 mm/min."""
    return open_file(checkout / "examples" / "mill-1394" / "MILL_1394.amp").file


def rules(tmp_path: Path, mill: ParameterFile, *given: tuple[str, str, str, str]) -> BuilderRules:
    """Return rules on the rapid of X: id, severity, check, and the rapid that their fix sets."""
    entries = [
        f"- {{id: own.{name}, title: a, severity: {severity}, reads: {{rapid: feedrate.rapid@X}}, check:"
        f" {check}, message: 'rule {name}'" + (f", fix: [{{set: rapid, value: {fix!r}}}]}}" if fix else "}")
        for name, severity, check, fix in given
    ]
    path = tmp_path / "rules.yaml"
    path.write_text("rules:\n" + "".join(f"  {entry}\n" for entry in entries), "utf-8")
    read = rules_beside(tmp_path / "mill.amp", mill)
    assert read.faults == ()
    return read


def test_a_fix_that_brings_a_warning_has_it_and_is_made_last(mill: ParameterFile, tmp_path: Path) -> None:
    own = rules(
        tmp_path,
        mill,
        ("a", "error", "rapid <= 9000.0", "8000.0"),
        ("b", "warning", "rapid >= 8500.0", ""),
        ("c", "warning", "rapid <= 9500.0", "8800.0"),
    )
    validator = Validator(mill, own)
    found = {finding.rule: finding for finding in validator.run() if finding.is_own}
    assert found["own.a"].brings.message == "rule b"
    assert finding_text(mill, found["own.a"]).endswith("= 8000 mm/min (it brings a warning: rule b)")
    assert found["own.c"].brings is None
    first = validator.first_fix(lambda finding: finding.is_own)
    assert first is not None
    assert first.rule == "own.c"
    mill.set(RAPID, Value(9200.0, "mm/min"))
    validator.update([RAPID])
    left = validator.first_fix(lambda finding: finding.is_own)
    assert left is not None
    assert left.rule == "own.a"


@pytest.mark.parametrize(("speed", "is_offered"), [("167.0", False), ("9000.0", True)])
def test_a_speed_is_not_cut_to_a_sixtieth(
    mill: ParameterFile, tmp_path: Path, speed: str, is_offered: bool
) -> None:
    own = rules(tmp_path, mill, ("a", "error", f"rapid <= {speed}", speed))
    (finding,) = [finding for finding in Validator(mill, own).run() if finding.is_own]
    assert bool(finding.fix) is is_offered


@pytest.fixture
def syntec(checkout: Path) -> ParameterFile:
    """Return the example mill, whose X has an encoder of 2500 lines and a rapid of 24000 mm/min."""
    return open_file(checkout / "examples" / "syntec-mill" / "SYNTEC_MILL.amp").file


def test_a_rapid_is_not_cut_for_an_encoder_that_slipped_unless_it_is_chosen(syntec: ParameterFile) -> None:
    """Ten times the lines of the like axes leave an eighth of the rapid (page 1.4.2)."""
    syntec.set(("resolution.encoder", "1"), Value(25000))
    validator = Validator(syntec)
    (error,) = [f for f in validator.run() if f.rule == "syntec.dda.rapid"]
    assert error.fix[0].value == Value(3123, "mm/min")
    assert [f.change.address for f in apply_fixes(validator, lambda _: True)] == []
    chosen = apply_fixes(validator, lambda f: f.rule == "syntec.dda.rapid", even_doubtful=True)
    assert [f.change.address for f in chosen] == [("feed.rapid", "1")]


def test_a_rapid_that_slipped_itself_is_cut_to_its_limit(syntec: ParameterFile) -> None:
    syntec.set(("feed.rapid", "1"), Value(240000, "mm/min"))
    validator = Validator(syntec)
    validator.run()
    (fixed, *_) = apply_fixes(validator, lambda _: True)
    assert (fixed.change.address, fixed.change.new) == (("feed.rapid", "1"), Value(31236, "mm/min"))


def test_no_ramp_becomes_ten_times_itself_unasked(checkout: Path) -> None:
    """The deceleration of a 57C422B follows an acceleration of ten times (page 4-14), which is to blame."""
    press = open_file(checkout / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp").file
    press.set(("command.acceleration", "X"), Value(500000.0, "counts/s2"))
    validator = Validator(press)
    assert any(finding.fix for finding in validator.run())
    assert apply_fixes(validator, lambda _: True) == []


def test_a_rule_reads_an_axis_by_its_letter_in_the_file(mill: ParameterFile, tmp_path: Path) -> None:
    own = rules(tmp_path, mill, ("a", "error", "rapid <= 9000.0", ""))
    assert axes_by_letter(mill)["X"] == "1"
    assert [rule.reads for rule in own.rules] == [{"rapid": "feedrate.rapid@1"}]
    (fault,) = read_builder_rules(tmp_path / "rules.yaml", mill.schema).faults
    assert "has no instance 'X'" in fault.message


@pytest.mark.parametrize(
    ("of", "what"),
    [
        ("kind", "is a choice"),
        ("('a' + kind)", "has a choice in it"),
        ("(string(kind) + 'b' + 'c')", "has a choice in it"),
        ("(kind == 'none' ? 'x' : 'a' + kind)", "has a choice in it"),
        ("['x', kind + ''][1]", "has a choice in it"),
    ],
)
def test_a_pattern_on_a_choice_is_refused(mill: ParameterFile, tmp_path: Path, of: str, what: str) -> None:
    """The message shows its label, and the pattern would see its key."""
    path = tmp_path / "rules.yaml"
    path.write_text(
        "rules:\n  - {id: own.a, title: a, severity: error, reads: {kind: servo.loop_type}, "
        f"check: \"{of}.matches('Digital')\", message: '{{kind}}'}}\n",
        "utf-8",
    )
    (fault,) = rules_beside(tmp_path / "mill.amp", mill).faults
    assert f"{what}, which has a key and is shown by its label" in fault.message
    assert fault.message.endswith("its keys are none, analog, digital, sercos.")
