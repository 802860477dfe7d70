"""What all models have in common: a frozen record without unknown keys, and the names of things."""

import re
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

from amp_studio.schema.units import UNITS

ParameterId = Annotated[str, Field(pattern=r"^[a-z0-9_]+(\.[a-z0-9_]+)+$")]
Key = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_.+-]*$")]
PAGE_PATTERN = r"^[0-9A-Z]+(-[0-9]+)?(\.[0-9]+)*([a-z])?$"
Page = Annotated[str, Field(pattern=PAGE_PATTERN)]
Scope = Literal["global", "axis", "spindle", "process", "group", "word", "register"]


def _known_unit(unit: str) -> str:
    if unit not in UNITS:
        raise ValueError(f"'{unit}' is no unit: {', '.join(u for u in UNITS if u)}")
    return unit


Unit = Annotated[str, AfterValidator(_known_unit), WithJsonSchema({"enum": list(UNITS)})]


def _counted_out(instances: object) -> object:
    """Write out the spans of a list of instances: ``["1..400"]`` are 400 of them, ``["X.0..9"]`` ten parts of X."""
    if not isinstance(instances, list):
        return instances
    found: list[object] = []
    for name in instances:
        span = re.fullmatch(r"(.+\.)?(\d+)\.\.(\d+)", name) if isinstance(name, str) else None
        if span:
            found += [f"{span[1] or ''}{n}" for n in range(int(span[2]), int(span[3]) + 1)]
        else:
            found.append(name)
    return found


Instances = Annotated[tuple[str, ...], BeforeValidator(_counted_out, json_schema_input_type=tuple[str, ...])]


class Model(BaseModel):
    """A frozen record that refuses keys it does not know."""

    # Built when a file is first read into it: a start reads one kind, the compiled family.
    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
