"""A machine taken to another control: what goes over exactly, what does not, and what has to be asked."""

from __future__ import annotations

import json
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, LANGUAGE, PATH, TEXT
from amp_studio.cli.console import print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_new
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from collections.abc import Sequence

    from amp_studio.meaning import Migration, MigrationQuestion

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument("--to", required=True, help="family of the new control", completes=candidates.targets),
    VerbArgument(
        "-o",
        "--output",
        type=Path,
        help="new folder for the configuration and the report, or a new file for the configuration alone:"
        " the parameter file of the new control (.amp), or its own text",
    ),
    VerbArgument("--answers", type=Path, help="file of answers to the questions: one line each, id: answer"),
    VerbArgument(
        "--draft", action="store_true", help="write although questions are open: their keys are left out"
    ),
    LANGUAGE,
    JSON,
    *TEXT,
    writes=("output",),
    examples=("amp-studio migrate MILL_1394.amp --to linuxcnc -o retrofit --draft",),
)


def run(options: Options) -> int:
    """Migrate a file; open questions write nothing and end with 2, unless a draft is wanted."""
    from amp_studio.meaning import MeaningError, TargetError, migrate, migration_json
    from amp_studio.report import migration_lines, write_migration_folder

    if options.output:
        check_new(options.output, "a migration", options.path)
    file = opened(options.path, options).file
    answers = _answers(options.answers) if options.answers else {}
    try:
        migration = migrate(file, options.to, answers)
    except (TargetError, MeaningError) as error:
        raise UsageError(str(error)) from None
    if options.json:
        print(json.dumps(migration_json(migration), indent=2, ensure_ascii=False))
    else:
        print("\n".join(migration_lines(migration)))
    # After the answer is printed: the open questions are in it, and they are what the user needs to go on.
    if not options.draft:
        _check_answered(migration.written.open)
    if options.output is None:
        return 0
    if options.output.suffix.lower() == ".amp":
        _write_parameter_file(options, migration)
        return 0
    try:
        written = write_migration_folder(
            migration, options.output, notify=print_remark, language=options.language
        )
    except OSError as error:
        raise UsageError(f"{options.output}: {error.strerror or error}; nothing was written") from None
    print_remark(f"{options.output}: {', '.join(written)}")
    return 0


def _write_parameter_file(options: Options, migration: Migration) -> None:
    """Write the new machine as a parameter file, as an import of its configuration does."""
    from amp_studio import import_text
    from amp_studio.cli.output import write_new

    name, text = next(iter(migration.written.texts.items()))
    # By its name an import knows the format.
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_text(text, encoding="utf-8")
        machine = import_text(path, options.to)
    write_new(machine, options.output)
    print_remark(f"{options.output}: a parameter file of {options.to}")


def _check_answered(questions: Sequence[MigrationQuestion]) -> None:
    """Raise UsageError for questions that are open."""
    if questions:
        names = ", ".join(question.id for question in questions)
        raise UsageError(
            f"{len(questions)} questions are open, nothing was written: {names}. Answer them in"
            " a file for --answers, or write a draft without their keys with --draft"
        )


def _answers(path: Path) -> dict[str, str]:
    """Return the answers of a file: flat YAML, a text each."""
    from amp_studio.meaning import read_answers

    try:
        return read_answers(path)
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: {error}") from None
