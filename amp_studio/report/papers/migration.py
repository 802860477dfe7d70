"""The paper of a migration: first what is less safe, then the questions, then every parameter once."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from amp_studio.meaning import MigratedParameter, Migration, less_safe, to_measure, write_migration
from amp_studio.report.language import Language, language_of

from .migration_lines import OUTCOMES, lost, migration_lines
from .paper import Paper, PaperTable, write_paper

_HEADS = {
    "exact": (("Number", "Before", "Key", "Value", "Formula"), ("raw", "key", "value", "formula")),
    "approximate": (
        ("Number", "Before", "Key", "Value", "Then", "Now", "Safe"),
        ("raw", "key", "value", "old", "new", "safe_side"),
    ),
    "not_possible": (("Number", "Before", "What is lost", "What to do"), ("raw", "loses", "do")),
    "asked": (("Number", "Before", "Question", "Answer"), ("old", "id", "answer")),
    "old_hardware": (("Number", "Before"), ("raw",)),
}


def write_migration_folder(
    migration: Migration,
    folder: Path,
    notify: Callable[[str], None] = lambda _note: None,
    language: str = "en",
) -> list[str]:
    """Write the configuration, the report and its paper into a new folder; returns the names. Raises OSError,
    with nothing written. ``language`` is a code of ``language_codes``, of report and paper.

    A name with an ending is that of a file: the configuration alone.
    """
    written = write_migration(migration, folder, migration_lines(migration, language))
    if folder.is_dir():
        write_paper(migration_paper(migration, language=language), folder / "migration.pdf", notify=notify)
        written.append("migration.pdf")
    return written


def migration_paper(migration: Migration, language: str = "en") -> Paper:
    """Return the paper in a language; a HAL is a template on it, and nothing is claimed of the wiring."""
    written = migration.written
    words = language_of(language, migration.target, migration.machine.family)
    worded = words.sentence
    tables = [
        PaperTable(
            worded("Less safe than before"), ("",), tuple((worded(text),) for text in less_safe(migration))
        ),
        PaperTable(
            worded("Open questions: their keys are left out"),
            (worded("Question"), ""),
            tuple((q.id, worded(q.question)) for q in written.open),
            (1.0, 4.0),
        ),
        PaperTable(
            worded("To be measured at the machine"),
            ("",),
            tuple((worded(text),) for text in to_measure(migration)),
        ),
    ]
    for outcome, (heads, keys) in _HEADS.items():
        rows = tuple((e.param, *(_cell(e, key, words) for key in keys)) for e in migration.of(outcome))
        tables.append(PaperTable(worded(OUTCOMES[outcome]), tuple(map(worded, heads)), rows))
    facts = (
        (worded("From"), migration.machine.family),
        (worded("To"), migration.target),
        (worded("Active parameters"), str(len(migration.entries))),
        *(
            (worded(title), words.counted(len(migration.of(outcome)), "parameter"))
            for outcome, title in OUTCOMES.items()
        ),
    )
    if any(name.endswith(".hal") for name in migration.written.texts):
        template = worded("a template: it moves nothing, and nothing of the old wiring is in it")
        facts = (*facts, ("HAL", template))
    return Paper(
        worded("Migration"),
        migration.machine.name,
        facts,
        tuple(t for t in tables if t.rows),
        datetime.now().astimezone(),
        language=language,
    )


def _cell(entry: MigratedParameter, key: str, words: Language) -> str:
    """Return a cell: what is written at either control, and a formula, as it is, words in the language."""
    text = str(entry.facts.get(key) or "")
    if key in ("raw", "key", "id", "answer"):
        return text
    if key == "loses":
        return lost(entry, words)
    return words.title(text) if key in ("value", "formula") else words.sentence(text)
