"""The steps of commissioning of a family: the facts, with the parameters of each written out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain

from amp_studio.schema import Commissioning, Group, Parameter, Schema, unknown_name

REST = "rest"
"""The id of the last step: what is in no other."""


@dataclass(frozen=True)
class SetupStep:
    """One step, and its parameters in the order in which they are set."""

    number: int
    """From 1."""
    id: str
    title: str
    what: str
    page: str
    """Where the manual has it; empty where no facts say it."""
    parameters: tuple[Parameter, ...]
    again: tuple[Parameter, ...] = ()
    """Parameters of earlier steps at which this one looks again; they count there."""


@lru_cache(maxsize=64)  # a control that describes itself has its own schema
def steps_of(schema: Schema) -> tuple[SetupStep, ...]:
    """Return the steps of a family: each parameter is in one of them, in the last one where no other has it.

    Without facts about the order the groups are the steps.
    """
    found = _by_facts(schema, schema.commissioning) if schema.commissioning else _by_groups(schema.groups)
    return tuple(SetupStep(n, *part) for n, part in enumerate(found, 1))


_Part = tuple[str, str, str, str, tuple[Parameter, ...], tuple[Parameter, ...]]


def _by_facts(schema: Schema, order: Commissioning) -> Iterator[_Part]:
    """Yield the parts of the facts, then one with the parameters that are in none of them."""
    left = dict(schema.parameters)  # a control that describes itself may lack some
    named = {name for step in order.steps for name in step.params}
    groups = {group.key: group for group in schema.groups}
    for step in order.steps:
        of_groups = chain.from_iterable(groups[key].parameters for key in step.groups if key in groups)
        wanted = (*step.params, *(p.id for p in of_groups if p.id not in named))
        # Taken out as they are given: a parameter that several steps name is in the first of them.
        ids = [name for name in wanted if name in left]
        again = tuple(schema.parameters[name] for name in step.again if name in schema.parameters)
        yield step.id, step.title, step.what, step.page, tuple(left.pop(name) for name in ids), again
    if left:
        yield REST, order.rest.title, order.rest.what, order.rest.page, tuple(left.values()), ()


def _by_groups(groups: tuple[Group, ...]) -> Iterator[_Part]:
    for group in groups:
        yield group.key, group.own_name, "", "", group.parameters, ()


@lru_cache(maxsize=64)
def step_of(schema: Schema) -> Mapping[str, SetupStep]:
    """Return parameter id -> its step."""
    return {p.id: step for step in steps_of(schema) for p in step.parameters}


def find_step(schema: Schema, text: str) -> SetupStep:
    """Return the step of a number (``3``) or an id (``home``); raises ValueError."""
    steps = steps_of(schema)
    for step in steps:
        if text in (str(step.number), step.id):
            return step
    nearest = unknown_name("step", text, [step.id for step in steps])
    raise ValueError(f"{nearest}. The steps have the numbers 1 to {len(steps)}")
