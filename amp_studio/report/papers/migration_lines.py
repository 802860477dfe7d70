"""The report of a migration in lines: what is less safe, then the questions, then each parameter once."""

from __future__ import annotations

from collections.abc import Iterator

from amp_studio.meaning import MigratedParameter, Migration, less_safe, to_measure
from amp_studio.report.language import Language, language_of

OUTCOMES = {
    "exact": "Taken over exactly",
    "approximate": "Approximated",
    "not_possible": "Not possible",
    "asked": "Asked",
    "old_hardware": "Of the old hardware",
}


def migration_lines(migration: Migration, language: str = "en") -> Iterator[str]:
    """Yield a migration in words; ``language`` is a code of ``language_codes``."""
    words = language_of(language, migration.target, migration.machine.family)
    worded, name = words.sentence, migration.machine.name
    families = f"{migration.machine.family} -> {migration.target}"
    yield f"{worded('Migration')}: {f'{name} ({families})' if name else families}"
    counts = ", ".join(f"{worded(title)}: {len(migration.of(o))}" for o, title in OUTCOMES.items())
    yield f"{worded('Active parameters')}: {len(migration.entries)}. {counts}"
    yield from _section(worded("Less safe than before"), [worded(text) for text in less_safe(migration)])
    yield from _section(
        worded("Open questions: their keys are left out"),
        [f"{q.id}: {worded(q.question)}" for q in migration.written.open],
    )
    yield from _section(
        worded("To be measured at the machine"), [worded(text) for text in to_measure(migration)]
    )
    if any(file.endswith(".hal") for file in migration.written.texts):
        template = worded("a template: it moves nothing, and nothing of the old wiring is in it")
        yield from _section(f"HAL: {template}", [])
    for outcome, title in OUTCOMES.items():
        yield from _section(worded(title), list(_lines(migration.of(outcome), words)))


def _section(title: str, lines: list[str]) -> Iterator[str]:
    yield from ("", title, *(f"  {line}" for line in lines))


def _lines(entries: list[MigratedParameter], words: Language) -> Iterator[str]:
    """Yield the line of each entry; those that ask for the same are below it."""
    by_task: dict[str, list[MigratedParameter]] = {}
    for entry in entries:
        by_task.setdefault(words.sentence(str(entry.facts.get("do", ""))), []).append(entry)
    for task, own in by_task.items():
        if task:
            yield f"{task[0].upper()}{task[1:]} ({len(own)}):"
        yield from (f"  {_line(entry, words)}" if task else _line(entry, words) for entry in own)


def _line(entry: MigratedParameter, words: Language) -> str:
    """Return one parameter by its outcome: what is written at either control as it is, words in the
    language.
    """
    facts, worded = entry.facts, words.sentence
    match entry.outcome:
        case "exact":
            formula, page = words.title(facts["formula"]), words.title(f"page {facts['page']}")
            return f"{_written(entry, words)} ({formula}, {page})"
        case "approximate":
            compared = (("Then", "old"), ("Now", "new"), ("Safe", "safe_side"))
            return "; ".join(
                (_written(entry, words), *(f"{worded(head)}: {worded(facts[key])}" for head, key in compared))
            )
        case "not_possible":
            return f"{entry.param} {facts['raw']}: {lost(entry, words)}"
        case "asked":
            return f"{entry.param} {facts['old']}: {facts['id']}" + f" = {facts['answer'] or ''}".rstrip(" =")
        case _:
            return f"{entry.param} {facts['raw']}"


def lost(entry: MigratedParameter, words: Language) -> str:
    """Return what is lost in a language; the bare name of the parameter stays."""
    loses = str(entry.facts["loses"])
    return loses if loses == entry.facts.get("name") else words.sentence(loses)


def _written(entry: MigratedParameter, words: Language) -> str:
    facts = entry.facts
    return f"{entry.param} {facts['raw']} -> {facts['key']} = {words.title(facts['value'])}"
