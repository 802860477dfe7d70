"""A machine description of a parameter file, by the facts of its family. Only values that are active
count.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile, axis_letters, axis_turns, fitted_axes
from amp_studio.schema import (
    EVALUATION_ERRORS,
    WORD_FUNCTIONS,
    Address,
    Circumstances,
    UnknownParameterError,
    context_of,
    program,
    read_address,
    show_value,
)
from amp_studio.validate import rule_functions

from .description import (
    CHOICES,
    AxisMeaning,
    ConceptFigure,
    ConceptValue,
    MachineMeaning,
    MigrationQuestion,
    ParameterSource,
)
from .facts import ConceptFact, Derived, Meanings, Named, meanings_of
from .writing import NUMBER


class MeaningError(AmpStudioError, ValueError):
    """A file whose family has no machine description; one clear sentence."""


def read_meaning(file: ParameterFile, answers: Mapping[str, str] = MappingProxyType({})) -> MachineMeaning:
    """Return what the active parameters of a file mean; ``answers`` has the numbers that its family asks for.
    Raises MeaningError.
    """
    facts = meanings_of(file.schema.family.family)
    if facts is None:
        raise MeaningError(f"{file.schema.family.name} has no facts for a machine description")
    reader = _Reader(file, facts, answers)
    letters = axis_letters(file)
    axes = []
    for instance in fitted_axes(file):
        if (
            facts.is_axis is None
            or reader.value(facts.is_axis.reads, facts.is_axis.value, instance, {}) is True
        ):
            figures = {f.concept: f for f in reader.figures(facts.axis, instance)}
            turns, shares = axis_turns(file, instance), _shares_letter(letters, instance)
            axes.append(AxisMeaning(letters[instance].upper(), instance, turns, figures, shares))
    figures = {f.concept: f for f in reader.figures(facts.machine, "")}
    questions = tuple(reader.questions(axes))
    return MachineMeaning(file.schema.family.family, file.header.name, tuple(axes), figures, questions)


def _shares_letter(letters: Mapping[str, str], instance: str) -> bool:
    return sum(each.upper() == letters[instance].upper() for each in letters.values()) > 1


@dataclass
class _Reader:
    file: ParameterFile
    facts: Meanings
    answers: Mapping[str, str]

    def answered(self, instance: str) -> dict[str, float | None]:
        """Return the numbers that a person gave for an axis, None for one that is open or none."""
        letters = axis_letters(self.file)
        name = letters[instance].upper() + (instance if _shares_letter(letters, instance) else "")
        found = {q.gives: self.answers.get(f"{q.id}.{name}", "") for q in self.facts.questions if q.gives}
        return {
            name: float(text) if re.fullmatch(NUMBER, text.strip()) else None for name, text in found.items()
        }

    def figures(self, concepts: tuple[ConceptFact, ...], instance: str) -> Iterator[ConceptFigure]:
        derived = (
            {
                name: self.value(fact.reads, fact.value, instance, {})
                for name, fact in self.facts.derived.items()
            }
            | self.answered(instance)
            if instance
            else {}
        )
        for fact in concepts:
            sources = tuple(self.sources(fact.reads, instance))
            # A concept none of whose parameters is active is not known; an expression might still give a
            # constant.
            if fact.reads and not sources:
                continue
            value = self.value(fact.reads, fact.value, instance, derived)
            # Outside of a closed choice a reader is wrong: no figure is better than one that no writer
            # knows.
            if value is _NOTHING or (fact.concept in CHOICES and value not in CHOICES[fact.concept]):
                continue
            yield ConceptFigure(fact.concept, value, sources, fact.value, fact.page)

    def sources(self, reads: Named, instance: str) -> Iterator[ParameterSource]:
        """Yield the active values of these parameters."""
        here = self.file.machine_schema
        for text in reads.values():
            for address in self._addresses(text, instance):
                value = self.file.get(address)
                if value is not None and self.file.evaluation.state(address).is_active:
                    parameter = self.file.schema.parameters[address[0]]
                    yield ParameterSource(
                        address, here.short(address), show_value(parameter, value), parameter.page
                    )

    def value(self, reads: Named, expression: str, instance: str, derived: Mapping[str, Any]) -> Any:
        """Return what an expression is for the active values; ``_NOTHING`` where it makes no sense of
        them.
        """
        names = {name: self._canonical(text, instance) for name, text in reads.items()} | dict(derived)
        functions = {**WORD_FUNCTIONS, **rule_functions(self.file.schema.family.family)}
        compiled = program(expression)
        circumstances = Circumstances(self.file.machine, self.file.header.application, instance)
        always = [
            n for n in ("machine", "application", "instance") if n in compiled.references()["variables"]
        ]
        context = context_of(functions, always, names, names.values(), circumstances)
        try:
            found: ConceptValue = compiled.execute(context)
        except EVALUATION_ERRORS:
            return _NOTHING
        # CEL keeps whole numbers apart; concepts are compared as floats.
        return float(found) if isinstance(found, int) and not isinstance(found, bool) else found

    def questions(self, axes: list[AxisMeaning]) -> Iterator[MigrationQuestion]:
        """Yield the questions of the family about each axis."""
        for fact in self.facts.questions:
            for axis in axes:
                if not fact.when or fact.when in axis.figures:
                    sources = tuple(self.sources({p: p for p in fact.params}, axis.instance))
                    yield MigrationQuestion(
                        f"{fact.id}.{axis.name}",
                        fact.ask.format(axis=axis.name),
                        sources,
                        is_number=bool(fact.gives),
                    )

    def _addresses(self, text: str, instance: str) -> tuple[Address, ...]:
        """Return the addresses that a fact names for an instance; none where this machine does not have
        them.
        """
        # With the scope, axis 1 is not taken for process 1.
        scope = "axis" if instance else None
        try:
            return self.file.evaluation.reference(text, instance, scope).addresses
        except UnknownParameterError:
            # Raises for a name that the family does not have: then the facts are wrong, not the file.
            self.file.schema.parameter(read_address(text)[0])
            return ()

    def _canonical(self, text: str, instance: str) -> Any:
        addresses = self._addresses(text, instance)
        # To an expression a value without effect is not set, as in rules.
        values = [
            self.file.evaluation.canonical(a) if self.file.evaluation.state(a).is_active else None
            for a in addresses
        ]
        return values if read_address(text)[1] in ("*", ".", "<", ">") else (values[0] if values else None)


_NOTHING: Any = object()
__all__ = ["Derived", "MeaningError", "read_meaning"]
