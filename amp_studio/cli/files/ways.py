"""The ways of tuning and fitting that a manual prints, for ``guide``: each step and what shows it."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from amp_studio.cli.errors import UsageError
from amp_studio.schema import Guide, GuideStep, Schema, show_value, unknown_name

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile


def ways_json(schema: Schema) -> list[dict[str, Any]]:
    """Return the printed ways of a family, as ``--json`` lists them."""
    return [
        {
            "id": way.id,
            "title": way.title,
            "page": way.page,
            "steps": [_step_json(each) for each in way.steps],
        }
        for way in schema.guides
    ]


def _step_json(step: GuideStep) -> dict[str, Any]:
    shows = step.shows
    return {
        "title": step.title,
        "what": step.what,
        "look": step.look,
        "page": step.page,
        "parameters": list(step.params),
        "shows": None
        if shows is None
        else {"scenario": shows.scenario, "figures": list(shows.figures), "settings": dict(shows.settings)},
    }


def way_names(schema: Schema) -> Iterator[str]:
    """Yield a line for each printed way of a family."""
    for way in schema.guides:
        yield f"--way {way.id}: {way.title} (page {way.page})"


def way_lines(schema: Schema, name: str, path: str, file: ParameterFile | None) -> Iterator[str]:
    """Yield a printed way step by step, with the values of a file and the commands that show what it does.

    Raises UsageError for a way that the family does not have.
    """
    way = _way(schema.guides, name)
    yield f"{way.title} (page {way.page})"
    for number, step in enumerate(way.steps, 1):
        yield f"{number:>3}  {step.title} (page {step.page})"
        if step.what:
            yield f"     {step.what}"
        if step.look:
            yield f"     Look for: {step.look}"
        yield from _values(schema, step) if file is None else _values_of(file, step)
        if step.shows is not None and file is not None:
            # With the path quoted: the line is copied into a shell, and a file may have blanks in its name.
            settings = _options(step.shows.settings)
            yield f"     Shown by: amp-studio simulate {shlex.quote(path)} {step.shows.scenario}{settings}"
            yield f"               {', '.join(step.shows.figures)}"


def _way(ways: Sequence[Guide], name: str) -> Guide:
    found = next((each for each in ways if each.id == name), None)
    if found is None:
        raise UsageError(unknown_name("way", name, [each.id for each in ways]))
    return found


def _options(settings: Mapping[str, float | str]) -> str:
    return "".join(f" --set {name}={value}" for name, value in settings.items())


def _values(schema: Schema, step: GuideStep) -> Iterator[str]:
    here = schema.on(schema.family.default_machine)
    for parameter in (schema.parameters[each] for each in step.params):
        if instances := here.instances(parameter):
            yield f"     {here.label((parameter.id, instances[0]))}"


def _values_of(file: ParameterFile, step: GuideStep) -> Iterator[str]:
    """Yield every active value of a step, as ``guide`` lists those of a step of commissioning."""
    here = file.machine_schema
    for parameter in (file.schema.parameters[each] for each in step.params):
        for instance in here.instances(parameter):
            address = (parameter.id, instance)
            if file.evaluation.state(address).is_active:
                value = file.get(address)
                text = "not set" if value is None else show_value(parameter, value)
                yield f"     {here.named(address):52} {text}"
