"""The report as data: numbers are numbers, keys are names, and the schema in the documents describes it."""

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator

from amp_studio.dossier import motion_figures, write_report
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report import Additions, Contents
from amp_studio.report.build import build_report
from amp_studio.report.output.data import render_json, report_data
from amp_studio.schema import Value
from tests.campaigns import some

EXAMPLES = sorted(examples_folder().glob("*/*.amp"))


@pytest.fixture(scope="module")
def schema(checkout: Path) -> Draft7Validator:
    return Draft7Validator(json.loads((checkout / "docs/report.schema.json").read_text("utf-8")))


@pytest.fixture(scope="module")
def broken() -> dict[str, Any]:
    file = open_file(examples_folder() / "mill-1394" / "MILL_1394.amp").file
    file.set(("servo.excess_error", "1"), Value(0.2, "in"))
    return report_data(build_report(file, Contents(language="de", inactive=True)))


def test_the_document_is_indented_as_json_writes_it() -> None:
    file = open_file(examples_folder() / "grblhal-router" / "GRBL_ROUTER.amp").file
    file.header.name = 'a "name", [in] {brackets}\\ Ü'
    report = build_report(file, added=Additions(tuple(motion_figures(file))))
    expected = json.dumps(report_data(report), ensure_ascii=False, indent=1) + "\n"
    assert render_json(report).decode("utf-8") == expected


@pytest.mark.parametrize("path", some(EXAMPLES), ids=lambda path: path.parent.name)
def test_the_data_of_every_example_are_as_the_schema_describes_them(
    path: Path, schema: Draft7Validator
) -> None:
    data = report_data(build_report(open_file(path).file))
    assert [f"{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in schema.iter_errors(data)] == []


def test_a_finding_has_its_rule_its_values_and_what_its_fix_sets(
    broken: dict[str, Any], schema: Draft7Validator
) -> None:
    assert list(schema.iter_errors(broken)) == []
    found = {entry["rule"]: entry for entry in broken["findings"]}["9pc.servo.excess-below-following-error"]
    assert {"id": "servo.excess_error", "instance": "1"} in found["about"]
    (first, *_) = found["fix"]
    assert (first["id"], first["instance"], first["unit"]) == ("servo.excess_error", "1", "in")
    assert isinstance(first["value"], float)
    assert "Eilgänge enden im Not-Halt" in found["message"]


def test_values_are_numbers_in_their_unit_yes_and_no_and_labels(broken: dict[str, Any]) -> None:
    values = {(each["id"], each["instance"]): each for each in broken["values"]}
    assert (values["servo.excess_error", "1"]["value"], values["servo.excess_error", "1"]["unit"]) == (
        0.2,
        "in",
    )
    assert values["zone.overtravel_used", "1"]["value"] is True
    assert values["axis.type", "4"]["value"] == "rotary"
    assert values["password.character", "1"]["value"] is None
    assert values["password.character", "1"]["set"] is True


@pytest.mark.parametrize("path", some(EXAMPLES), ids=lambda path: path.parent.name)
def test_motion_is_data_as_the_schema_describes_it_and_no_larger_than_it_is_drawn(
    path: Path, schema: Draft7Validator, tmp_path: Path
) -> None:
    made = tmp_path / "report.json"
    write_report(open_file(path).file, made)
    data = json.loads(made.read_text("utf-8"))
    assert [error.message for error in schema.iter_errors(data)] == []
    runs = data["motion"]["runs"]
    assert runs
    assert len(json.dumps(runs)) < 100_000 * len(runs)
    for run in runs:
        assert run["figures"]
        for curve in (curve for panel in run["panels"] for curve in panel["curves"]):
            assert len(curve["x"]) == len(curve["y"]) > 1
            assert len(curve["x"]) <= 4 * 640
