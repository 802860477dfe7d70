"""Every constraint that a manual states is covered by something: a range, a choice, a state, a need or a rule.

``constraints/`` lists the manuals' constraining statements, each with its line in the text and its page. What cannot
be decided from a parameter file is listed too, with the reason.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, model_validator
from ruamel.yaml import YAML

from amp_studio.schema import Schema, load_schema

LISTS = sorted(Path(__file__).with_name("constraints").glob("*.yaml"))


class Statement(BaseModel):
    """A statement of a manual that constrains what may be entered, or what follows from it."""

    model_config = ConfigDict(extra="forbid")
    line: int = Field(ge=1)
    page: str
    says: str
    by: tuple[str, ...] | str = ()
    left: str = ""

    @model_validator(mode="after")
    def _one_of_both(self) -> Statement:
        if bool(self.by) == bool(self.left):
            raise ValueError("either something tells it, or there is a reason why nothing can")
        return self

    def told_by(self) -> tuple[str, ...]:
        """Return what shows it."""
        return (self.by,) if isinstance(self.by, str) else self.by


@lru_cache
def statements(path: Path) -> tuple[Statement, ...]:
    """Return the statements of one list."""
    return TypeAdapter(tuple[Statement, ...]).validate_python(
        YAML(typ="safe").load(path.read_text(encoding="utf-8"))
    )


def schema_of(path: Path) -> Schema:
    """Return the family that a list is about: its name is ``<family>`` or ``<family>_<chapters>``."""
    return load_schema(path.stem.partition("_")[0])


def missing(schema: Schema, teller: str) -> str | None:
    """Return what is wrong with the entry that covers a statement."""
    kind, _, named = teller.rpartition(" ")
    if not kind:
        return None if teller in {rule.id for rule in schema.rules} else f"no rule {teller}"
    parameter = schema.parameters.get(named)
    if parameter is None:
        return f"no parameter {named}"
    held: dict[str, object] = {
        "range": parameter.ranges or parameter.range_variants or parameter.storage,
        "choices": parameter.choices or parameter.bits,
        "state": parameter.states,
        "need": parameter.needs,
        "type": parameter.type,
    }
    if kind not in held:
        return f"'{kind}' is not one of {', '.join(held)}"
    return None if held[kind] else f"{named} has no {kind}"


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_whatever_a_manual_demands_something_tells(path: Path) -> None:
    schema = schema_of(path)
    wrong = [
        f"line {statement.line}: {said}"
        for statement in statements(path)
        for teller in statement.told_by()
        if (said := missing(schema, teller))
    ]
    assert wrong == []


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_the_statements_stand_in_the_order_of_the_text(path: Path) -> None:
    lines = [statement.line for statement in statements(path)]
    assert lines == sorted(lines)
