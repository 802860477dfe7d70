"""``meaning.yaml`` of a family: how its parameters become a machine description, in CEL,
and what becomes of all others.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Literal

from amp_studio.schema import FileError, Model, database_folder, read_yaml_file, registration_of

Named = dict[str, str]
"""Name in the expression -> parameter, as in the ``reads`` of a rule."""


class Derived(Model):
    """A value that several concepts use (the size of the internal unit)."""

    reads: Named = {}  # noqa: RUF012  # a record is frozen
    value: str


class ConceptFact(Model):
    """One concept. An expression that makes no sense of its values, as of one that is not set,
    gives no figure.
    """

    concept: str
    reads: Named
    value: str
    page: str


class QuestionFact(Model):
    """A question about each axis that has one of these parameters, which no figure can answer."""

    id: str
    ask: str
    params: tuple[str, ...] = ()
    when: str = ""
    """A concept of the axis that has to be there."""
    gives: str = ""
    """Name in expressions of the number above 0 that the answer is; "" for a sign, which a writer needs."""


class RestFact(Model):
    """What becomes of parameters that no concept uses: ids, or ``zone.*``."""

    params: tuple[str, ...]
    outcome: Literal["not_possible", "old_hardware"]
    loses: str = ""
    do: str = ""
    less_safe: bool = False
    """Whether the machine is less safe without it."""


class Meanings(Model):
    """The facts of a family."""

    is_axis: Derived | None = None
    """Which of its axes are axes of the machine; all where it is left out."""
    derived: dict[str, Derived] = {}  # noqa: RUF012  # a record is frozen
    axis: tuple[ConceptFact, ...] = ()
    machine: tuple[ConceptFact, ...] = ()
    questions: tuple[QuestionFact, ...] = ()
    rest: tuple[RestFact, ...] = ()


@cache
def meanings_of(family: str) -> Meanings | None:
    """Return the facts of a family, None for one without; raises ValueError for facts that are wrong."""
    path = _folder(family) / "meaning.yaml"
    if not path.is_file():
        return None
    return Meanings.model_validate(read_yaml_file(path, FileError).data)


def _folder(family: str) -> Path:
    return registration_of(family).facts or database_folder() / family
