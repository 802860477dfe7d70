"""Lists of what a manual states, each statement with its line, its page and what shows it to a person."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, model_validator
from ruamel.yaml import YAML

from amp_studio.schema import Schema, load_schema


class Statement(BaseModel):
    """A statement of a manual that constrains what may be entered, or what follows from it."""

    model_config = ConfigDict(extra="forbid")
    line: int = Field(ge=1)
    page: str
    word: str = ""
    """The word that the manual puts before it, such as ``caution``."""
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
    texts = parameter.help
    content: dict[str, object] = {
        "range": parameter.ranges or parameter.range_variants or parameter.storage,
        "choices": parameter.choices or parameter.bits,
        "state": parameter.states,
        "need": parameter.needs,
        "type": parameter.type,
        "help": texts.what,
        "danger": texts.danger,
        "warning": texts.warning,
        "note": texts.note,
    }
    if kind not in content:
        return f"'{kind}' is not one of {', '.join(content)}"
    return None if content[kind] else f"{named} has no {kind}"


def untold(path: Path) -> list[str]:
    """Return the statements that nothing shows although their list names something."""
    return [
        f"line {statement.line}: {message}"
        for statement in statements(path)
        for teller in statement.told_by()
        if (message := missing(schema_of(path), teller))
    ]
