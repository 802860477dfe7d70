"""Two files of one family whose controls describe themselves are compared, though each has its schema."""

import json
from pathlib import Path

import pytest

from amp_studio import Difference, MachineParameters
from amp_studio.cli import run
from amp_studio.families.grblhal.described import schema_of
from amp_studio.files import Header, ParameterFile, compare, new_file
from amp_studio.files.diff import merge
from amp_studio.files.other_schema import by_schema
from amp_studio.files.storage import save_file
from amp_studio.schema import Value
from tests.families.grblhal.recorded import THREE_AXES, with_lines

PLASMA = with_lines("[SETTING:350|1|Arc voltage|V|6|##0.00|10|300|0|0]")


def of_control(description: bytes) -> ParameterFile:
    schema = schema_of(description)
    return ParameterFile(schema, Header(signature=schema.signature, machine="grblhal"))


def test_a_file_of_the_same_schema_stays_itself() -> None:
    file = new_file("grblhal")
    assert by_schema(file, file.schema) is file


def test_what_the_other_schema_does_not_have_is_kept_as_an_unknown_entry() -> None:
    file = of_control(PLASMA)
    file.set(file.find("$350"), Value(120.5, "V"))
    file.set(file.find("$110"), Value(500.0, "mm/min"))
    found = by_schema(file, schema_of(THREE_AXES))
    assert found.values == {("axis.max_rate", "X"): Value(500.0, "mm/min")}
    assert found.unknown == {"general.arc_voltage": "120.5 V"}


def test_a_choice_is_the_same_by_its_code_and_another_type_is_none() -> None:
    file = new_file("grblhal")
    file.set(("general.mode", ""), Value("laser_mode"))
    text = "[SETTING:32|1|Mode of operation||3|Mill,Laser|||0|0]"
    found = by_schema(file, schema_of(with_lines(text, without="[SETTING:32|")))
    assert found.get(("general.mode", "")) == Value("laser")
    old = by_schema(file, schema_of(with_lines("[SETTING:20|3|Soft||5||||0|0]", without="[SETTING:20|")))
    assert old.get(("limits.soft", "")) == Value(False), "hidden there, and never sent"
    assert old.evaluation.state(("limits.soft", "")).state == "hidden"


def test_the_library_compares_choices_by_what_the_control_stores() -> None:
    """Machines of two controls that number their choices otherwise were compared by the names alone."""

    a, b = (
        of_control(with_lines(f"[SETTING:32|1|Mode of operation||3|{choices}|||0|0]", without="[SETTING:32|"))
        for choices in ("Laser,Mill", "Mill,Laser")
    )
    for file in (a, b):
        file.set(("general.mode", ""), Value("laser"))
    (difference,) = MachineParameters(a).diff(MachineParameters(b))
    assert (difference.a, difference.b) == (Value("laser"), Value("mill"))
    b.set(("general.mode", ""), Value("mill"))
    assert MachineParameters(a).diff(MachineParameters(b)) == ()


def test_diff_lists_what_only_one_control_has(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    plain, plasma = of_control(THREE_AXES), of_control(PLASMA)
    for file in (plain, plasma):
        file.set(("axis.max_rate", "X"), Value(500.0, "mm/min"))
    plasma.set(("general.arc_voltage", ""), Value(120.5, "V"))
    a, b = tmp_path / "a.amp", tmp_path / "b.amp"
    save_file(plain, a)
    save_file(plasma, b)
    assert run(["diff", str(a), str(b), "--json"]) == 1
    (row,) = json.loads(capsys.readouterr().out)["differences"]
    assert (row["param"], row["a"], row["b"]) == ("$350", None, "120.5 V")
    (difference,) = MachineParameters(plain).diff(b)
    assert difference == Difference(("general.arc_voltage", ""), None, Value(120.5, "V"))
    assert run(["diff", str(b), str(a)]) == 1
    assert "1 differs, 1 is the same, 0 not set in A, 1 not set in B" in capsys.readouterr().out
    assert run(["diff", str(a), str(b)]) == 1
    displayed = capsys.readouterr().out
    assert "$350 Arc voltage" in displayed
    assert "1 differs, 1 is the same, 1 not set in A, 0 not set in B" in displayed


def test_diff_of_a_new_file_and_one_of_a_control_is_by_parameter(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    reported = of_control(THREE_AXES)
    made = new_file("grblhal", None, "XYZ")
    reported.take(made.values)
    a, b = tmp_path / "a.amp", tmp_path / "b.amp"
    save_file(made, a)
    save_file(reported, b)
    assert run(["diff", str(a), str(b)]) == 0
    assert run(["set", str(b), "$22=Enable"]) == 0
    capsys.readouterr()
    assert run(["diff", str(a), str(b)]) == 1
    assert "$22 Homing cycle" in capsys.readouterr().out
    assert run(["sheet", str(b), "--against", str(a)]) == 0


def test_a_merge_is_by_the_schema_of_ours_and_keeps_what_it_does_not_have() -> None:
    base, ours, theirs = of_control(THREE_AXES), of_control(THREE_AXES), of_control(PLASMA)
    theirs.take(
        {("general.arc_voltage", ""): Value(120.5, "V"), ("axis.max_rate", "X"): Value(600.0, "mm/min")}
    )
    merged, conflicts = merge(base, ours, theirs)
    assert conflicts == []
    assert merged.values == {("axis.max_rate", "X"): Value(600.0, "mm/min")}
    assert merged.unknown == {"general.arc_voltage": "120.5 V"}


def test_axes_are_compared_in_their_order() -> None:
    file = new_file("grblhal", None, "XYZAB")
    found = compare(file.schema, {}, {a: v for a, v in file.values.items() if a[0] == "axis.steps"})
    assert [difference.address[1] for difference in found.differences] == ["X", "Y", "Z", "A", "B"]
