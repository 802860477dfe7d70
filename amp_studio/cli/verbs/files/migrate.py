"""A machine taken to another control: what goes over exactly, what does not, and what has to be asked."""

from __future__ import annotations

import json
from pathlib import Path

from amp_studio.cli.arguments import JSON, LANGUAGE, PATH, TEXT
from amp_studio.cli.console import print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument("--to", required=True, help="family of the new control"),
    VerbArgument(
        "-o",
        "--output",
        type=Path,
        help="new folder for the configuration and the report, or a new file for the configuration alone",
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
    from amp_studio.meaning import MeaningError, TargetError, migrate, migration_json, migration_lines
    from amp_studio.report import write_migration_folder

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
    if migration.written.open and not options.draft:
        names = ", ".join(question.id for question in migration.written.open)
        raise UsageError(
            f"{len(migration.written.open)} questions are open, nothing was written: {names}. Answer them in"
            " a file for --answers, or write a draft without their keys with --draft"
        )
    if options.output is None:
        return 0
    try:
        written = write_migration_folder(
            migration, options.output, notify=print_remark, language=options.language
        )
    except OSError as error:
        raise UsageError(f"{options.output}: {error.strerror or error}; nothing was written") from None
    print_remark(f"{options.output}: {', '.join(written)}")
    return 0


def _answers(path: Path) -> dict[str, str]:
    """Return the answers of a file: flat YAML, a text each."""
    from amp_studio.meaning import read_answers

    try:
        return read_answers(path)
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: {error}") from None
