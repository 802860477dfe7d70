"""A fresh file is calm: what is wrong with printed defaults is a state until somebody begins."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.axis_abilities import why_axes_are_fixed
from amp_studio.files.example_files import examples_folder
from amp_studio.guide import present, progress, tick
from amp_studio.schema import Value, family_ids, load_schema
from amp_studio.validate import NOT_SET, Finding, Validator


def displayed(file: ParameterFile) -> list[Finding]:
    """Return what is left of the findings without those about values as delivered."""
    validator = Validator(file)
    return [f for f in present(validator, validator.run()).findings if f.rule != NOT_SET]


@pytest.mark.parametrize("family", family_ids())
def test_a_fresh_file_has_no_finding_with_axes_or_without(family: str) -> None:
    assert displayed(new_file(family)) == []
    schema = load_schema(family)
    declared = schema.family.declared_axes
    axes = "XYZ"[: max(2, declared.least if declared else 0)]
    assert displayed(new_file(family, None, () if why_axes_are_fixed(schema) else tuple(axes))) == []


def test_what_is_as_delivered_has_its_steps() -> None:
    validator = Validator(new_file("acromill"))
    state = present(validator, validator.run())
    assert sum(f.severity == "warning" for f in state.delivered) == 31
    assert state.steps == (2, 3, 4, 5, 8)


def test_what_a_user_has_set_wrong_is_a_finding_at_once() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    file.set(("home.calibration", "1"), Value(1e6, "mm"))
    assert ("home.calibration", "1") in [f.causes[0] for f in displayed(file)]


def test_once_a_user_has_begun_the_first_step_has_its_errors() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    file.set(("home.position", "1"), Value(1.0, "mm"))
    assert {f.rule for f in displayed(file) if f.severity == "error"} == {
        "9pc.servo.hardware-missing",
        "9pc.servo.loop-type-missing",
    }


def test_a_step_that_is_ticked_as_done_has_its_errors_though_only_axes_are_named() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    assert displayed(file) == []
    tick(file, "control", "R. Meier")
    assert {f.rule for f in displayed(file)} >= {"9pc.servo.hardware-missing", "9pc.servo.loop-type-missing"}


def test_a_ticked_step_is_reached_before_the_others() -> None:
    """The gains of an AcroMill are its third step, and none of the first two is finished."""
    file = new_file("acromill")
    tick(file, "gains", "R. Meier")
    assert {f.rule for f in displayed(file)} >= {"acromill.servo.not-tuned"}
    validator = Validator(file)
    assert 3 not in present(validator, validator.run()).steps


@pytest.mark.parametrize("path", sorted(examples_folder().glob("*/*.amp")), ids=lambda path: path.stem)
def test_a_complete_file_has_no_such_state(path: Path) -> None:
    validator = Validator(open_file(path).file)
    assert present(validator, validator.run()).delivered == ()
    assert progress(validator).deferred == ()
