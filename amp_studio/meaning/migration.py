"""The way out of an old control: its parameters, each exactly once, with what becomes of it at the new
one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Value,
    load_part,
    registered_families,
    registration_of,
    show_value,
    unknown_name,
)

from .description import ConceptFigure, MachineMeaning, MigrationQuestion
from .facts import RestFact, meanings_of
from .reading import read_meaning
from .writing import Graded, TargetError, WrittenMachine

_NO_FACT = RestFact.model_construct(
    params=(),
    outcome="not_possible",
    loses="{name}",
    do="look whether the machine needs it, and do it there by hand",
    less_safe=False,
)


@dataclass(frozen=True)
class MigratedParameter:
    """What became of one parameter of the old file."""

    address: Address
    param: str
    outcome: str
    facts: Mapping[str, Any]
    meanings: tuple[tuple[str, str], ...] = ()
    """Letter of the axis ("" for the machine) and concept of each figure that comes from it."""


@dataclass(frozen=True)
class Migration:
    """A machine on its way: its description, what was written, and what became of each active parameter."""

    machine: MachineMeaning
    target: str
    written: WrittenMachine
    entries: tuple[MigratedParameter, ...]

    def of(self, outcome: str) -> list[MigratedParameter]:
        """Return the parameters with an outcome."""
        return [entry for entry in self.entries if entry.outcome == outcome]


def targets() -> tuple[str, ...]:
    """Return the families that a machine can be migrated to."""
    return tuple(family for family in registered_families() if registration_of(family).migrate)


def migrate(file: ParameterFile, target: str, answers: Mapping[str, str] | None = None) -> Migration:
    """Return a file as a machine of another family; nothing is written. Raises TargetError, MeaningError."""
    known = targets()
    if target not in known:
        raise TargetError(unknown_name("target", target, known))
    if file.schema.family.family == target:
        raise TargetError(f"the file is one of {file.schema.family.name} already")
    machine = read_meaning(file, answers or {})
    if not machine.axes:
        raise TargetError("no axis of the file is fitted: there is nothing to migrate")
    # Before anything is written: limits that are crossed in the old file would be taken for a choice.
    _refuse_crossed(machine)
    _refuse_turning(machine)
    written: WrittenMachine = load_part(registration_of(target).migrate)(machine, answers or {})
    # Only now is it known which questions this machine raises: a misspelt answer must not be passed
    # over.
    strange = sorted(set(answers or {}) - {q.id for q in written.asked})
    if strange:
        raise TargetError(unknown_name("answer", strange[0], (q.id for q in written.asked)))
    return Migration(machine, target, written, tuple(_entries(file, machine, written)))


def _refuse_crossed(machine: MachineMeaning) -> None:
    """Raise TargetError for an axis with its lower limit above the upper one: nothing could move it."""
    for axis in machine.axes:
        low, high = axis.number("travel.low"), axis.number("travel.high")
        if low is not None and high is not None and low > high:
            named = [axis.figures[concept].sources for concept in ("travel.low", "travel.high")]
            params = ", ".join(f"{each.param} {each.raw}" for sources in named for each in sources[:1])
            raise TargetError(
                f"The limits of {axis.letter} are crossed, {low:g} above {high:g} ({params}):"
                " mend the file first"
            )


def _refuse_turning(machine: MachineMeaning) -> None:
    """Raise TargetError for an axis that turns by its name where no page has the unit of its figures."""
    for axis in machine.axes:
        if axis.choice("kind") == "rotary" and not axis.turns:
            raise TargetError(
                f"Axis {axis.letter} turns by its name, and no page prints in which unit this control has its"
                " figures: take the axis out of the file, and set it up at the new control"
            )


def _active_values(file: ParameterFile) -> Iterator[tuple[Address, Value]]:
    """Yield each value that has an effect, in the manual's order."""
    for address in file.machine_schema.addresses:
        value = file.get(address)
        if value is not None and file.evaluation.state(address).is_active:
            yield address, value


def _entries(
    file: ParameterFile, machine: MachineMeaning, written: WrittenMachine
) -> Iterator[MigratedParameter]:
    """Yield each active parameter with a value exactly once."""
    here = file.machine_schema
    used = _used(machine)
    grades = {(g.axis, g.concept): g for g in written.graded}
    asked = {source.address: q for q in written.asked for source in q.sources}
    for address, value in _active_values(file):
        param, raw = here.short(address), show_value(file.schema.parameters[address[0]], value)
        # A parameter that a question is about waits for its answer, whatever else it would become: each
        # is listed once.
        if address in asked:
            question = asked[address]
            answer = written.answered.get(question.id)
            yield MigratedParameter(
                address, param, "asked", {"id": question.id, "answer": answer, "old": raw}
            )
        elif found := [(u, g) for u in used.get(address, ()) if (g := grades.get((u[0], u[1].concept)))]:
            yield _graded(address, param, raw, found)
        else:
            yield _other(file, address, param, raw)


def _used(machine: MachineMeaning) -> dict[Address, list[tuple[str, ConceptFigure]]]:
    """Return parameter -> the figures that come from it, with the letter of their axis."""
    found: dict[Address, list[tuple[str, ConceptFigure]]] = {}
    places = [(axis.letter, figure) for axis in machine.axes for figure in axis.figures.values()]
    for letter, figure in (*places, *(("", figure) for figure in machine.figures.values())):
        for source in figure.sources:
            found.setdefault(source.address, []).append((letter, figure))
    return found


_WORST = ("not_possible", "approximate", "exact")


def _graded(
    address: Address, param: str, raw: str, found: list[tuple[tuple[str, ConceptFigure], Graded]]
) -> MigratedParameter:
    """Return a parameter with the worst grade of what comes from it; all keys that it went to are named."""
    # A parameter that went to several keys is as good as the worst of them.
    (_, figure), worst = min(found, key=lambda pair: _WORST.index(pair[1].outcome))
    keys = list(dict.fromkeys(g.key for _, g in found if g.key))
    facts: dict[str, Any] = {
        "key": ", ".join(keys),
        "value": worst.value,
        "formula": figure.formula,
        "page": figure.page,
        "raw": raw,
    }
    if worst.outcome == "approximate":
        facts |= {"old": worst.old, "new": worst.new, "safe_side": worst.safe_side}
    if worst.outcome == "not_possible":
        facts = {"loses": worst.loses, "do": worst.do, "page": figure.page, "raw": raw}
    meanings = tuple((letter, figure.concept) for (letter, figure), _ in found)
    return MigratedParameter(address, param, worst.outcome, facts, meanings)


def _other(file: ParameterFile, address: Address, param: str, raw: str) -> MigratedParameter:
    """Return what becomes of a parameter that no concept was read from."""
    parameter = file.schema.parameters[address[0]]
    facts = meanings_of(file.schema.family.family)
    rest = facts.rest if facts else ()
    # The first that fits: a fact about one parameter is written above that of its group.
    fact = next((r for r in rest if any(fnmatchcase(address[0], p) for p in r.params)), _NO_FACT)
    if fact.outcome == "old_hardware":
        return MigratedParameter(address, param, "old_hardware", {"raw": raw})
    loses, do = fact.loses.format(name=parameter.name), fact.do or str(_NO_FACT.do)
    without = {"loses": loses, "name": parameter.name, "do": do, "raw": raw, "less_safe": fact.less_safe}
    return MigratedParameter(address, param, "not_possible", without)


def less_safe(migration: Migration) -> list[str]:
    """Return what is less safe than before, a sentence each; what several axes or parameters lose is one."""
    lost = [str(e.facts["loses"]) for e in migration.of("not_possible") if e.facts.get("less_safe")]
    return _of_axes(migration.written.less_safe) + _of_subjects(dict.fromkeys(lost))


def to_measure(migration: Migration) -> list[str]:
    """Return what has to be measured at the machine, a sentence each; what is so of several axes is one."""
    return _of_axes(migration.written.measure)


def _of_axes(sentences: Iterable[str]) -> list[str]:
    """Join what is so of several axes: ``X, Y: no ceiling``."""
    heads: dict[str, list[str]] = {}
    for sentence in sentences:
        head, colon, end = sentence.partition(": ")
        # By what is behind the axis: ``X: no ceiling`` and ``Y: no ceiling`` are one sentence.
        heads.setdefault(end if colon else sentence, []).append(head if colon else "")
    return [f"{', '.join(dict.fromkeys(own))}: {end}".removeprefix(": ") for end, own in heads.items()]


def _of_subjects(sentences: Iterable[str]) -> list[str]:
    """Join what is lost of one thing: ``the zones: low limit, high limit``."""
    ends: dict[str, list[str]] = {}
    for sentence in sentences:
        head, _, end = sentence.partition(": ")
        ends.setdefault(head, []).append(end)
    return [": ".join(filter(None, (head, ", ".join(filter(None, own))))) for head, own in ends.items()]


def migration_json(migration: Migration) -> dict[str, Any]:
    """Return a migration in the form of ``migrate --json``;
    every active parameter is once in the first five lists.
    """

    def rows(outcome: str, *keys: str) -> list[dict[str, Any]]:
        return [
            {"param": e.param, **{k: e.facts[k] for k in keys if k in e.facts}} for e in migration.of(outcome)
        ]

    by_question: dict[str, list[str]] = {}
    for entry in migration.of("asked"):
        by_question.setdefault(str(entry.facts["id"]), []).append(entry.param)
    return {
        "from": migration.machine.family,
        "to": migration.target,
        "exact": rows("exact", "key", "value", "formula", "page", "raw"),
        "approximate": rows(
            "approximate", "key", "value", "formula", "old", "new", "safe_side", "page", "raw"
        ),
        "not_possible": rows("not_possible", "loses", "do", "page", "raw"),
        "asked": [_question_json(q, by_question, migration.written) for q in migration.written.asked],
        "old_hardware": rows("old_hardware", "raw"),
        "less_safe": less_safe(migration),
        "measure": migration.written.measure,
        "open": [q.id for q in migration.written.open],
        "files": list(migration.written.texts),
    }


def _question_json(
    question: MigrationQuestion, params: Mapping[str, list[str]], written: WrittenMachine
) -> dict[str, Any]:
    """Return one question as ``--json`` lists it, with its answer where there is one."""
    return {
        "id": question.id,
        "question": question.question,
        "params": params.get(question.id, []),
        "answer": written.answered.get(question.id),
    }
