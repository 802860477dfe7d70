"""What all models have in common: a frozen record without unknown keys, and the names of things.

A record is a plain object. Data from outside become one through pydantic, which is loaded only then: a
start reads facts that were checked when they were compiled, and pydantic would take a quarter of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal, Self, dataclass_transform, get_type_hints

from amp_studio.schema.units import UNITS


class Pattern:
    """Of a text in a record: the regular expression that it fits."""

    def __init__(self, pattern: str) -> None:
        self.pattern = pattern

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.str_schema(pattern=self.pattern)


class NotEmpty:
    """Of a text in a record: it has at least one character."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.str_schema(min_length=1)


class Then:
    """Of a field of a record: what checks or changes the value that was read;
    the text of a ValueError is what is wrong with it.
    """

    def __init__(self, check: Callable[[Any], Any], **json_schema: Any) -> None:
        self.check, self.json_schema = check, json_schema

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.no_info_after_validator_function(self.check, handler(source))

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> Any:
        return handler(schema) | self.json_schema


class First:
    """Of a field of a record: what changes the given data before they are read,
    with the family that is read, if any.

    ``also`` are the other kinds of data that are taken, for editors.
    """

    def __init__(self, change: Callable[[Any, Any], Any], also: Any = None) -> None:
        self.change, self.also = change, also

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.with_info_before_validator_function(
            lambda given, info: self.change(given, info.context),
            handler(source),
            json_schema_input_schema=handler.generate_schema(
                source if self.also is None else source | self.also
            ),
        )


ParameterId = Annotated[str, Pattern(r"^[a-z0-9_]+(\.[a-z0-9_]+)+$")]
Key = Annotated[str, Pattern(r"^[a-z0-9][a-z0-9_.+-]*$")]
PAGE_PATTERN = r"^[0-9A-Z]+(-[0-9]+)?(\.[0-9]+)*([a-z])?$"
Page = Annotated[str, Pattern(PAGE_PATTERN)]
Scope = Literal["global", "axis", "spindle", "process", "group", "word", "register"]


def _known_unit(unit: str) -> str:
    if unit not in UNITS:
        raise ValueError(f"'{unit}' is no unit: {', '.join(u for u in UNITS if u)}")
    return unit


Unit = Annotated[str, Then(_known_unit, enum=list(UNITS))]


def _counted_out(instances: object, _family: object) -> object:
    """Write out the spans of a list of instances: ``["1..400"]`` are 400 of them,
    ``["X.0..9"]`` ten parts of X.
    """
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


Instances = Annotated[tuple[str, ...], First(_counted_out)]


_REQUIRED: Any = object()
"""The default of a field that has none."""


@dataclass_transform(kw_only_default=True, frozen_default=True)
class Model:
    """A frozen record that refuses keys it does not know.

    To construct one, or ``model_validate``, checks all of its data and raises pydantic's ValidationError, a
    ValueError. ``model_construct`` and ``model_copy`` check nothing: they are for data that have been
    checked. ``__post_init__`` is what a kind of record asks of its fields together.
    """

    fields: ClassVar[Mapping[str, Any]] = {}
    """Name of each field -> its default, or ``_REQUIRED``."""
    _adapter: ClassVar[Any] = None
    """What checks data from outside; made for each kind of record when the first are read."""

    def __init_subclass__(cls) -> None:
        # Defaults stay class attributes: what is not stored in a record is found there.
        own = {name: cls.__dict__.get(name, _REQUIRED) for name in cls.__annotations__}
        cls.fields = {**cls.fields, **own}

    def __init__(self, **given: Any) -> None:
        self.__dict__.update(self.model_validate(given).__dict__)

    @classmethod
    def model_validate(cls, data: Any, context: Any = None) -> Self:
        """Return the record of data from outside; raises pydantic's ValidationError.
        ``context`` is the family that is read.
        """
        from pydantic import TypeAdapter

        # Its own one: by attribute a kind of record would get that of the kind above it.
        adapter = cls.__dict__.get("_adapter")
        if adapter is None:
            cls._adapter = adapter = TypeAdapter(cls)
        found: Self = adapter.validate_python(data, context=context)
        return found

    @classmethod
    def model_construct(cls, **fields: Any) -> Self:
        """Return a record of fields that have been checked."""
        made = object.__new__(cls)
        made.__dict__.update(fields)
        return made

    def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self:
        """Return a copy with other values in some fields, which are not checked."""
        return type(self).model_construct(**self.__dict__ | dict(update or {}))

    def model_dump(
        self, *, exclude: Collection[str] = (), exclude_none: bool = False, exclude_defaults: bool = False
    ) -> dict[str, Any]:
        """Return the fields as YAML and JSON have them; without those that are excluded, None or the
        default.
        """

        def plain(value: Any) -> Any:
            if isinstance(value, Model):
                return value.model_dump(exclude_none=exclude_none, exclude_defaults=exclude_defaults)
            if isinstance(value, (tuple, list)):
                return [plain(entry) for entry in value]
            if isinstance(value, dict):
                return {key: plain(entry) for key, entry in value.items()}
            return value

        return {
            name: plain(value)
            for name, value in self.items()
            if name not in exclude
            and not (exclude_none and value is None)
            and not (exclude_defaults and value == self.fields[name])
        }

    def __post_init__(self) -> None:
        """Raise ValueError where the fields that were read contradict each other."""

    def items(self) -> Iterator[tuple[str, Any]]:
        """Yield each field with its value, in the order in which they are written."""
        return ((name, getattr(self, name)) for name in self.fields)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model) or type(self) is not type(other):
            return NotImplemented
        # A record out of the cache lacks the fields that have their default: getattr finds those at the
        # class.
        return self.__dict__ == other.__dict__ or all(
            value == getattr(other, name) for name, value in self.items()
        )

    def __hash__(self) -> int:
        return hash((type(self), *(value for _, value in self.items())))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self.items())})"

    def __setattr__(self, name: str, _value: object) -> None:
        raise AttributeError(f"{type(self).__name__}.{name} cannot be changed: a record is frozen")

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> Any:
        """Return pydantic's schema: the fields by name, no others, then ``__post_init__``."""
        from pydantic_core import core_schema

        hints = get_type_hints(cls, include_extras=True)
        fields = []
        for name, default in cls.fields.items():
            schema = handler.generate_schema(hints[name])
            if default is not _REQUIRED:
                schema = core_schema.with_default_schema(schema, default=default)
            fields.append(core_schema.dataclass_field(name, schema, kw_only=True))
        return core_schema.dataclass_schema(
            cls,
            core_schema.dataclass_args_schema(cls.__name__, fields),
            list(cls.fields),
            post_init=True,
            # pydantic takes two schemas with one reference for the same.
            ref=f"{cls.__module__}.{cls.__qualname__}:{id(cls)}",
            config=core_schema.CoreConfig(extra_fields_behavior="forbid", title=cls.__name__),
        )
