"""The columns of the table behind the values: a fact of each row, read only, where rows differ in it.

One more column is one more line of ``FACT_COLUMNS``: head, width, sight and German of it follow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from amp_studio.schema import Parameter, Schema
from amp_studio.ui.base.translated import tr


@dataclass(frozen=True)
class FactColumn:
    """One column: its head in the language of the window, and what it has of a parameter (or nothing)."""

    title: Callable[[], str]
    text: Callable[[Schema, Parameter], str]


def reading_command(schema: Schema, parameter: Parameter) -> str:
    """Return the command that makes the control read the values of a parameter."""
    effect = parameter.effect or schema.family.effect
    return effect.command or "" if effect.level == "command" else ""


FACT_COLUMNS = (FactColumn(lambda: tr("Read by"), reading_command),)
"""From left to right."""
