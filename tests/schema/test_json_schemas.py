"""The JSON Schemas for editors: fresh, named in every fact file,
and of one mind with the models that read the files.
"""

import copy
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import write_schemas
from jsonschema import Draft7Validator

from amp_studio.find.synonyms import SYNONYMS_FILE
from amp_studio.schema import database_folder
from amp_studio.schema.registration import register, unregister
from amp_studio.schema.units import UNITS_FILE
from amp_studio.schema.yaml_reader import read_yaml, spelled_scalar
from tests.campaigns import CAMPAIGN
from tests.families.steps.stepper import FAMILY, REGISTRATION
from tests.schema.test_whole_family import kind_of

SCHEMAS = database_folder() / "schemas"
FACTS = sorted(database_folder().glob("*/**/*.yaml"))


@cache
def validator(name: str) -> Draft7Validator:
    """Return what checks data against a schema file."""
    return Draft7Validator(json.loads((SCHEMAS / f"{name}.schema.json").read_text("utf-8")))


def named_in(path: Path) -> Path:
    """Return the schema file that the first line of a file names; that each file of a family names its own
    is one of the things that test_whole_family.py lists.
    """
    first = path.read_text("utf-8").partition("\n")[0]
    named = re.fullmatch(r"# yaml-language-server: \$schema=(\S+)", first)
    return (path.parent / named[1]).resolve() if named else path


def faults(name: str, data: Any) -> list[str]:
    """Return what a schema reports about data, each with its place."""
    found = validator(name).iter_errors(data)
    return [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in found]


def test_the_schemas_are_what_the_models_say() -> None:
    kept = {path.name: path.read_text("utf-8") for path in SCHEMAS.glob("*.json")}
    assert kept == write_schemas.schemas(), "'make schema' writes them again"


def test_the_units_are_valid_by_their_schema() -> None:
    assert named_in(UNITS_FILE) == SCHEMAS / "units.schema.json"
    data = read_yaml(UNITS_FILE.read_text("utf-8")).data
    assert faults("units", data) == []
    data["units"]["mm"]["mesures"] = "length"
    assert faults("units", data) != []


def test_the_synonyms_are_valid_by_their_schema() -> None:
    assert named_in(SYNONYMS_FILE) == SCHEMAS / "synonyms.schema.json"
    data = read_yaml(SYNONYMS_FILE.read_text("utf-8")).data
    assert faults("synonyms", data) == []
    data["synonyms"][0]["means"] = data["synonyms"][0].pop("mean")
    assert faults("synonyms", data) != []


def test_an_editor_offers_the_units_that_a_family_has_alone() -> None:
    register(REGISTRATION)
    try:
        written = write_schemas.schemas()
    finally:
        unregister(FAMILY)
    group, family = (json.loads(written[f"{name}.schema.json"]) for name in ("group", "family"))
    offered = group["definitions"]["Parameter"]["properties"]["unit"]["anyOf"][0]["enum"]
    assert {"steps/mm", "steps/in"} <= set(offered)
    assert offered.index("mm") == 1
    assert "steps/mm" in json.dumps(family)


@pytest.mark.parametrize("kind", sorted({kind_of(path) for path in FACTS}))
def test_every_fact_file_is_valid_by_its_schema(kind: str) -> None:
    files = [path for path in FACTS if kind_of(path) == kind][:: 1 if CAMPAIGN else 3]
    wrong = {
        path.name: faults(kind, read_yaml(path.read_text("utf-8"), references=True).data) for path in files
    }
    assert {name: message for name, message in wrong.items() if message} == {}


def records(data: Any) -> Iterator[dict[str, Any]]:
    """Yield every mapping in some data."""
    if isinstance(data, dict):
        yield data
    for below in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        yield from records(below)


def test_a_mistyped_key_is_invalid_wherever_a_fact_file_has_keys() -> None:
    """Every mapping of a group, of which only those of names with what they are take any key."""
    data = read_yaml(
        (database_folder() / "9pc" / "groups" / "accdec.yaml").read_text("utf-8"), references=True
    ).data
    valid = copy.deepcopy(data)
    count = 0
    for record in records(data):
        if set(record) <= {"", "1", "2", "3"}:
            continue  # instances, with what they have
        record["no_such_key"] = 1
        assert faults("group", data), sorted(record)
        del record["no_such_key"]
        count += 1
    assert data == valid
    assert count > 60


def test_fields_are_described_by_their_docstrings() -> None:
    group = json.loads((SCHEMAS / "group.schema.json").read_text("utf-8"))
    parameter = group["definitions"]["Parameter"]["properties"]
    assert parameter["tunable"]["description"] == "Can be changed on line, at the running machine."
    assert group["definitions"]["GroupState"]["properties"]["scope"]["description"].startswith(
        "Only parameters of"
    )
    builder = json.loads((SCHEMAS / "builder-rules.schema.json").read_text("utf-8"))
    rule = builder["definitions"]["BuilderRule"]["properties"]
    assert rule["page"]["description"] == "Where it is written, in the builder's own words."
    assert rule["optional"]["description"].startswith("Names that may be")


def test_the_rules_of_the_documents_are_valid(checkout: Path) -> None:
    text = (checkout / "docs" / "rules.md").read_text("utf-8")
    block = re.search(
        r"^    # yaml-language-server: \$schema=builder-rules\.schema\.json\n((?:    .*\n|\n)+)",
        text,
        re.MULTILINE,
    )
    assert block
    data = read_yaml(re.sub("^    ", "", block[1], flags=re.MULTILINE)).data
    assert list(data) == ["rules", "suppressions"]
    assert faults("builder-rules", data) == []
    data["rules"][0]["severty"] = "error"
    del data["suppressions"][0]["reason"]
    assert len(faults("builder-rules", data)) == 2


def test_the_projects_of_the_examples_are_valid(checkout: Path) -> None:
    projects = sorted((checkout / "examples").glob("*/project.yaml"))
    assert len(projects) >= 5
    for path in projects:
        assert faults("project", read_yaml(path.read_text("utf-8"), spelled_scalar).data) == []
    assert faults("project", {"amp_studio_project": 1, "name": "x", "family": "9pd"})
