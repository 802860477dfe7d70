"""The paper of a migration: first what is less safe, then the questions, then every parameter once."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from amp_studio.meaning import Migration, less_safe, write_migration
from amp_studio.report.wording import counted

from .paper import Paper, PaperTable, write_paper

_HEADS = {
    "exact": (
        "Taken over exactly",
        ("Number", "Before", "Key", "Value", "Formula"),
        ("raw", "key", "value", "formula"),
    ),
    "approximate": (
        "Approximated",
        ("Number", "Before", "Key", "Value", "Then", "Now", "Safe"),
        ("raw", "key", "value", "old", "new", "safe_side"),
    ),
    "not_possible": (
        "Not possible",
        ("Number", "Before", "What is lost", "What to do"),
        ("raw", "loses", "do"),
    ),
    "asked": ("Asked", ("Number", "Before", "Question", "Answer"), ("old", "id", "answer")),
    "old_hardware": ("Of the old hardware", ("Number", "Before"), ("raw",)),
}


def write_migration_folder(
    migration: Migration, folder: Path, notify: Callable[[str], None] = lambda _note: None
) -> list[str]:
    """Write the configuration, the report and its paper into a new folder; returns the names. Raises OSError,
    with nothing written.

    A name with an ending is that of a file: the configuration alone.
    """
    written = write_migration(migration, folder)
    if folder.is_dir():
        write_paper(migration_paper(migration), folder / "migration.pdf", notify=notify)
        written.append("migration.pdf")
    return written


def migration_paper(migration: Migration) -> Paper:
    """Return the paper; HAL is a template on it, and nothing is claimed of the wiring."""
    written = migration.written
    tables = [
        PaperTable("Less safe than before", ("",), tuple(zip(less_safe(migration)))),
        PaperTable(
            "Open questions: their keys are left out",
            ("Question", ""),
            tuple((q.id, q.question) for q in written.open),
            (1.0, 4.0),
        ),
        PaperTable("To be measured at the machine", ("",), tuple(zip(written.measure))),
    ]
    for outcome, (title, heads, keys) in _HEADS.items():
        rows = tuple((e.param, *(str(e.facts.get(key) or "") for key in keys)) for e in migration.of(outcome))
        tables.append(PaperTable(title, heads, rows))
    counts = [
        (heads[0], counted(len(migration.of(outcome)), "parameter")) for outcome, heads in _HEADS.items()
    ]
    facts = (
        ("From", migration.machine.family),
        ("To", migration.target),
        ("Active parameters", str(len(migration.entries))),
        *counts,
        ("HAL", "a template: it moves nothing, and nothing of the old wiring is in it"),
    )
    return Paper(
        "Migration",
        migration.machine.name,
        facts,
        tuple(t for t in tables if t.rows),
        datetime.now().astimezone(),
    )
