"""What the manual calls dangerous about values that are printed or about to change, each statement once."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from amp_studio.schema import Schema

from .axes import place_of
from .chapters import Danger
from .language import ENGLISH, Language
from .model import ReportRow
from .wording import joined_places

if TYPE_CHECKING:
    from amp_studio.files import Difference, ParameterFile


def dangers_of(schema: Schema, rows: Iterable[ReportRow], language: Language = ENGLISH) -> tuple[Danger, ...]:
    """Return the dangers of values that are active and were chosen: not the printed default."""
    # A default was not chosen, and the dangers of all defaults would fill pages.
    chosen = (row for row in rows if row.state == "in-force" and (row.is_changed or row.no_default))
    return _grouped(schema, ((row.id, row.anchor, row.name, row.place) for row in chosen), language)


def dangers_of_change(
    file: ParameterFile, differences: Iterable[Difference], language: Language = ENGLISH
) -> tuple[Danger, ...]:
    """Return the dangers of values that differ; ``file`` is one of the two sides."""
    parameters = file.schema.parameters
    addresses = (difference.address for difference in differences)
    return _grouped(
        file.schema,
        (
            (i, f"{i}@{instance}", parameters[i].name, place_of(file, (i, instance)))
            for i, instance in addresses
            if parameters[i].help.danger
        ),
        language,
    )


def _grouped(
    schema: Schema, values: Iterable[tuple[str, str, str, str]], language: Language
) -> tuple[Danger, ...]:
    """Return each statement with the values that it is about: (id, anchor, name, place) of each."""
    found: dict[tuple[str, str, str], dict[str, tuple[str, str, list[str]]]] = {}
    for parameter, anchor, name, place in values:
        for danger in schema.parameters[parameter].help.danger:
            about = found.setdefault((language.sentence(danger.says), danger.page, danger.brief), {})
            # One statement with all its axes: printed for each of them, it would not be read.
            about.setdefault(parameter, (anchor, name, []))[2].append(language.text(place))
    return tuple(
        Danger(
            statement,
            page,
            tuple((anchor, _label(name, places)) for anchor, name, places in about.values()),
            language.sentence(brief),
        )
        for (statement, page, brief), about in found.items()
    )


def _label(name: str, places: Iterable[str]) -> str:
    named = [place for place in places if place]
    return f"{name} ({joined_places(named)})" if named else name
