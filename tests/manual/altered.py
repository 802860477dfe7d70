"""Facts and parameters with one thing altered, which a check has to report."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from manual_facts import Section

from amp_studio.schema import Parameter, Schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import load_compiled

OUT_OF_THE_WAY = "87654.3"
"""A figure that is nowhere in the database and in no erratum."""

Fact = Any
"""A fact of the kind that an alteration is for: each kind has separate fields."""
Alter = Callable[[Fact], Iterable[tuple[str, Fact | None]]]
"""What gives a fact altered, once for each way, or None for it left out, and names what is altered."""


def each(**wrong: tuple[object, ...]) -> Alter:
    """Return what sets each of these fields that is printed to each of its wrong values, one at a time."""

    def altered(fact: Fact) -> Iterator[tuple[str, Fact]]:
        for key, values in wrong.items():
            for value in values if getattr(fact, key) else ():
                yield f"{key} {value}", replace(fact, **{key: value})

    return altered


def together(**wrong: object) -> Alter:
    """Return what sets all these fields at once, printed or not."""
    return lambda fact: [(" and ".join(wrong), replace(fact, **wrong))]


def only(applies: Callable[[Fact], bool], alter: Alter) -> Alter:
    """Return what alters only the facts that this applies to."""
    return lambda fact: alter(fact) if applies(fact) else ()


def left_out(_: Fact) -> list[tuple[str, None]]:
    """Leave a fact out."""
    return [("left out", None)]


def altered_facts(section: Section, kind: str, alter: Alter) -> Iterator[tuple[int, str, Section]]:
    """Yield line and what is altered of each fact of a kind, with the section in which it is."""
    facts = getattr(section, kind)
    for at, fact in enumerate(facts):
        for what, now in alter(fact):
            others = (*facts[:at], *(() if now is None else (now,)), *facts[at + 1 :])
            yield fact.line, what, replace(section, **{kind: others})


class Nested(dict[str, object]):
    """Changes to a model inside a parameter."""


def altered_schema(family: str, parameter_id: str, changes: Mapping[str, object]) -> Schema:
    """Return the schema with one parameter changed."""
    compiled = load_compiled(family)

    def now(parameter: Parameter) -> Parameter:
        if parameter.id != parameter_id:
            return parameter
        new = {
            key: getattr(parameter, key).model_copy(update=message)
            if isinstance(message, Nested)
            else message
            for key, message in changes.items()
        }
        return parameter.model_copy(update=new)

    groups = tuple(
        group.model_copy(update={"parameters": tuple(map(now, group.parameters))})
        for group in compiled.groups
    )
    return schema_of(compiled.model_copy(update={"groups": groups}))
