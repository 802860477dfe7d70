"""The numbers of a parameter in words: ``1300, 2300, … 8300 (axes 1 to 8)``."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby, pairwise

from amp_studio.schema import MachineSchema, Parameter, Schema


def number_lines(schema: Schema, parameter: Parameter, machine: str | None) -> Iterator[str]:
    """Yield the numbers, once if they are the same on all machine types."""
    machines = [m for m in schema.family.machines if machine in (None, m.key)]
    texts = {m.name: _spans(schema, parameter, m.key) for m in machines}
    if len(set(texts.values())) == 1:
        yield next(iter(texts.values()))
    else:
        yield from (f"{text} on a {name.lower()}" for name, text in texts.items() if text)


def instances_without_number(schema: Schema, parameter: Parameter, machine: str | None) -> Iterator[str]:
    """Yield ``fov.position@1 to fov.position@16 (Pos 1 to Pos 16)`` for instances that no number
    addresses.
    """
    keys = [machine] if machine else [m.key for m in schema.family.machines]
    yield from dict.fromkeys(filter(None, (_without_number(schema.on(key), parameter) for key in keys)))


def _without_number(here: MachineSchema, parameter: Parameter) -> str:
    numbers = {} if here.is_disputed(parameter.id) else here.numbers(parameter)
    bare = [i for i in here.instances(parameter) if i and i not in numbers]
    ends = list(dict.fromkeys((*bare[:1], *bare[-1:])))
    named = " to ".join(here.instance_label((parameter.id, i)) for i in ends)
    return " to ".join(f"{parameter.id}@{i}" for i in ends) + f" ({named})" if ends else ""


def sharing_numbers(schema: Schema, parameter: Parameter) -> list[str]:
    """Return the other parameters for which the manual prints numbers of this one."""
    machines = [schema.on(m.key) for m in schema.family.machines]
    claims = (a for m in machines for n in m.numbers(parameter).values() for a in m.claims(n))
    return [i for i in dict.fromkeys(a[0] for a in claims) if i != parameter.id]


def _spans(schema: Schema, parameter: Parameter, machine: str) -> str:
    """Return ``1300, 2300 … 8300 (Axis 1 to Axis 8)``."""
    here = schema.on(machine)
    numbers = here.numbers(parameter)
    if not numbers:
        return "none" if here.layout(parameter) else ""
    runs = []
    # Points of a table count up within their axis: a run across axes would hide the step between them.
    for _, group in groupby(numbers.items(), key=lambda item: item[0].rpartition(".")[0]):
        members = list(group)
        runs += [members] if _has_constant_step(members) else [[member] for member in members]
    text = "; ".join(_run(schema, parameter, machine, run) for run in runs)
    others = sharing_numbers(schema, parameter)
    if not others:
        return text
    named = ", ".join(f"{schema.parameters[i].name} ({i})" for i in others)
    # The manual prints the numbers for two parameters, and at the control they are those of the others.
    if here.is_disputed(parameter.id):
        return f"{text}; printed, but they address {named}"
    return f"{text}; also printed for {named}"


def _has_constant_step(members: list[tuple[str, str]]) -> bool:
    """Return whether the numbers have a constant step, so that first, second and last are enough."""
    split = [split_count(number) for _, number in members]
    steps = {b[1] - a[1] for a, b in pairwise(split)}
    # Two numbers always have one step: only from three on does a step show a rule.
    return len(split) > 2 and len({head for head, _ in split}) == len(steps) == 1 and steps != {0}


def split_count(text: str) -> tuple[str, int]:
    """Return a text without the digits at its end, and these digits as a number (0 without digits)."""
    head = text.rstrip("0123456789")
    return head, int(text[len(head) :] or 0)


def _run(schema: Schema, parameter: Parameter, machine: str, run: list[tuple[str, str]]) -> str:
    written = [number for _, number in run]
    if len(written) > 3:
        written = [written[0], f"{written[1]} … {written[-1]}"]
    ends = (schema.on(machine).instance_label((parameter.id, run[end][0])) for end in (0, -1))
    named = " to ".join(label for label in dict.fromkeys(ends) if label)
    return ", ".join(written) + (f" ({named})" if named else "")


def short_span(schema: Schema, parameter: Parameter, machine: str) -> str:
    """Return ``1300…8300`` or, where there are no numbers, the instances: ``@1…@16``."""
    own = {} if schema.on(machine).is_disputed(parameter.id) else schema.on(machine).numbers(parameter)
    every = list(own.values()) or [f"@{i}" for i in schema.on(machine).instances(parameter) if i]
    return "" if not every else every[0] if every[0] == every[-1] else f"{every[0]}…{every[-1]}"
