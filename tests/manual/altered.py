"""Facts and parameters with one thing altered, which a check has to tell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from manual_facts import Section

from amp_studio.schema import Schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import load_compiled

OUT_OF_THE_WAY = "87654.3"
"""A figure that nothing holds and no erratum mentions."""

Wrong = Mapping[str, tuple[object, ...]]


def altered_facts(
    sections: tuple[Section, ...], kind: str, wrong: Wrong
) -> Iterator[tuple[int, str, tuple[Section, ...]]]:
    """Yield line and name of each fact of a kind, with the whole text in which it is altered."""
    for at, section in enumerate(sections):
        facts = getattr(section, kind)
        for i, fact in enumerate(facts):
            for key, values in wrong.items():
                for value in values if getattr(fact, key) else ():
                    now = (*facts[:i], replace(fact, **{key: value}), *facts[i + 1 :])
                    yield (
                        fact.line,
                        key,
                        (*sections[:at], replace(section, **{kind: now}), *sections[at + 1 :]),
                    )


def altered_schema(family: str, parameter_id: str, changes: Mapping[str, object]) -> Schema:
    """Return the schema with one parameter changed."""
    compiled = load_compiled(family)
    groups = tuple(
        group.model_copy(
            update={
                "parameters": tuple(
                    parameter.model_copy(update=dict(changes)) if parameter.id == parameter_id else parameter
                    for parameter in group.parameters
                )
            }
        )
        for group in compiled.groups
    )
    return schema_of(compiled.model_copy(update={"groups": groups}))
