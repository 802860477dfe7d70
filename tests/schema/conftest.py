"""Small families of our own making: written as YAML in the test, compiled as the real ones are."""

from collections.abc import Mapping
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.schema import Address, Evaluation, Schema, Value, load_schema, read_address
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family

HEAD = """
family: small
name: Small control
document: small-manual
title: Small Manual
machines: [{key: mill, name: Mill}, {key: lathe, name: Lathe}]
default_machine: mill
scopes:
  global: {instances: [""], label: Control}
  axis: {instances: ["1", "2", "3"], label: "Axis {i}"}
units:
  metric: {length: mm, velocity: mm/min, acceleration: mm/s2}
  inch: {length: in, velocity: in/min, acceleration: in/s2}
effect: {level: restart}
groups: [all]
"""
"""What a family has when a test has nothing to add."""


class Facts:
    """The fact files of one small family."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        (folder / "groups").mkdir(parents=True)

    def write(self, name: str, text: str) -> Path:
        """Write one fact file."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(dedent(text), encoding="utf-8")
        return path

    def group(self, parameters: str, key: str = "all") -> Path:
        """Write the file of a group; ``parameters`` is the YAML list of its parameters."""
        return self.write(
            f"groups/{key}.yaml", f'key: {key}\nname: All\nchapter: "1"\nparameters:\n{dedent(parameters)}'
        )

    def schema(self, parameters: str, head: str = HEAD) -> Schema:
        """Return the schema of a family with these parameters."""
        self.write("family.yaml", head)
        self.group(parameters)
        return schema_of(compile_family(self.folder))


class Machine:
    """One machine of a family: its values, and what follows from them."""

    def __init__(self, schema: Schema, values: Mapping[str, Value] = {}, machine: str = "") -> None:
        self.schema = schema
        self.values: dict[Address, Value] = {read_address(name): value for name, value in values.items()}
        self.machine = machine or schema.family.default_machine
        self.evaluation = Evaluation(schema, self.values.get, lambda: self.machine)

    def set(self, name: str, value: Value) -> None:
        """Set one value and say so."""
        self.values[read_address(name)] = value
        self.evaluation.forget_dependents(read_address(name))


@pytest.fixture
def facts(tmp_path: Path) -> Facts:
    """Return the fact files of a small family, none written yet."""
    return Facts(tmp_path / "small")


@pytest.fixture(scope="session")
def head() -> str:
    """Return the ``family.yaml`` of a small family, to be added to."""
    return HEAD


@pytest.fixture(scope="session")
def machine() -> type[Machine]:
    """Return what makes a machine out of a schema and its values."""
    return Machine


@pytest.fixture(scope="session")
def ninepc() -> Schema:
    """Return the real 9/PC family."""
    return load_schema("9pc")
