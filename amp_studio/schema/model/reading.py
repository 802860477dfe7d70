"""How data from outside become records: pydantic's checks of the fields of a record, made when they are first needed."""

from __future__ import annotations

from typing import Any, get_type_hints

from pydantic import TypeAdapter
from pydantic_core import CoreSchema, core_schema

from .record import REQUIRED, Model

_ADAPTERS: dict[type[Any], TypeAdapter[Any]] = {}


def adapter(kind: type[Any]) -> TypeAdapter[Any]:
    """Return what checks data against a kind of record, and describes it as JSON Schema."""
    if kind not in _ADAPTERS:
        _ADAPTERS[kind] = TypeAdapter(kind)
    return _ADAPTERS[kind]


def record_schema(kind: type[Model], handler: Any) -> CoreSchema:
    """Return pydantic's schema of a kind of record: its fields by name, no others, then ``__post_init__``."""
    hints = get_type_hints(kind, include_extras=True)
    fields = []
    for name, default in kind.fields.items():
        schema = handler.generate_schema(hints[name])
        if default is not REQUIRED:
            schema = core_schema.with_default_schema(schema, default=default)
        fields.append(core_schema.dataclass_field(name, schema, kw_only=True))
    arguments = core_schema.dataclass_args_schema(kind.__name__, fields, collect_init_only=False)
    return core_schema.dataclass_schema(
        kind,
        arguments,
        list(kind.fields),
        post_init=True,
        ref=f"{kind.__module__}.{kind.__qualname__}:{id(kind)}",
        config=core_schema.CoreConfig(extra_fields_behavior="forbid", title=kind.__name__),
    )
