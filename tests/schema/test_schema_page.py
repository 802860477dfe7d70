"""The picture of numbers and references in docs/schema.md is what the program does."""

import re
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.schema import load_schema
from amp_studio.schema.conditions import conditions_of
from amp_studio.schema.machine_schema import number_of
from amp_studio.schema.model.parameter import Numbers

PAGE = (Path(__file__).parents[2] / "docs" / "schema.md").read_text("utf-8")
PICTURE = PAGE[PAGE.index("    instance  ") : PAGE.index("- **Numbers**: the first")].splitlines()
COLUMNS = {m[0]: m.start() for m in re.finditer(r"the control|[0-9.]+", PICTURE[0])}
INSTANCES = {"the control": ""}


def cells(line: str) -> dict[str, str]:
    """Return instance -> what the picture shows there."""
    found = ((name, re.match(r"[^\s\[\]]*", line[at:])) for name, at in COLUMNS.items())
    return {INSTANCES.get(name, name): text[0] for name, text in found if text and text[0]}


NUMBERED = [line.strip() for line in PICTURE if line.startswith("    {")]
READ = [line.strip() for line in PICTURE if line.startswith("    id")]


def test_the_picture_has_the_five_ways_and_every_reference() -> None:
    assert len(NUMBERED) == 5
    assert [line.split()[0] for line in READ] == ["id", "id", "id@3", "id@*", "id@<", "id@>", "id@."]


@pytest.mark.parametrize("line", NUMBERED)
def test_a_way_to_number_gives_the_numbers_of_the_picture(line: str) -> None:
    displayed = cells(f"    {line}")
    assert displayed
    numbers = Numbers.model_validate(YAML(typ="safe").load(line[: line.rindex("}") + 1]))
    assert {i: number_of(numbers, n, i) for n, i in enumerate(displayed)} == displayed


@pytest.mark.parametrize("line", READ)
def test_a_reference_reads_what_the_picture_shows(line: str) -> None:
    displayed = tuple(cells(f"    {line}"))
    ids = {("",): "servo.sercos_baud", ("2.1", "2.2", "2.3"): "spindle.voltage_at_max"}
    parameter = ids.get(displayed, "home.calibration")
    conditions = conditions_of(load_schema("9pc"), "mill")
    found = conditions.reference(line.split(maxsplit=1)[0].replace("id", parameter), "2", None)
    read = tuple(instance for _, instance in found.addresses)
    assert tuple(i for i in read if i in {"", *COLUMNS}) == displayed
    assert found.is_list is ("[" in line)
