"""A migration on disk: a new folder, whole or not at all, and the answers that a person wrote."""

from __future__ import annotations

import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from amp_studio.schema import read_file

from .migration import Migration, migration_json

_MAX_BYTES = 200_000
"""Bytes of a file of answers."""
_LINE = re.compile(r"\s*([A-Za-z][A-Za-z0-9_.]*)\s*:\s*(.*?)\s*")


def write_migration(migration: Migration, folder: Path, lines: Iterable[str]) -> list[str]:
    """Write the configuration and its report, in words in these lines, into a new folder; returns the
    names. Raises OSError, with nothing written.

    A name with an ending is that of one file, the configuration alone. What is there already stays as it is:
    it is not known what in it is of another machine.
    """
    if folder.suffix:
        # "x" fails where the file exists: a check before it could be overtaken.
        with folder.open("x", encoding="utf-8", newline="\n") as file:
            file.write(next(iter(migration.written.texts.values())))
        return [next(iter(migration.written.texts))]
    texts = {
        **migration.written.texts,
        "migration.txt": "\n".join((*lines, "")),
        "migration.json": json.dumps(migration_json(migration), indent=2, ensure_ascii=False) + "\n",
    }
    if folder.exists():
        raise FileExistsError(17, "it is there already; name a new folder", str(folder))
    parent = folder.resolve().parent
    # Beside the goal: a rename is whole or not at all only within one file system.
    made = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=parent))
    try:
        for name, text in texts.items():
            with (made / name).open("w", encoding="utf-8", newline="\n") as file:
                file.write(text)
                file.flush()
                # Before the rename: a power cut must not leave the folder with empty files in it.
                os.fsync(file.fileno())
        # mkdtemp makes it for its owner alone.
        made.chmod(0o755)
        made.rename(folder)
    except BaseException:
        shutil.rmtree(made, ignore_errors=True)
        raise
    return list(texts)


def read_answers(path: Path) -> dict[str, str]:
    """Return the answers of a file, ``id: answer`` in each line; raises OSError, ValueError with the line."""
    answers: dict[str, str] = {}
    for number, line in enumerate(read_file(path, _MAX_BYTES).decode("utf-8", "replace").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith(("#", "---", "...")):
            continue
        found = _LINE.fullmatch(line)
        if found is None:
            raise ValueError(f"line {number} is no answer: write id: answer")
        if found[1] in answers:
            raise ValueError(f"line {number}: {found[1]} is answered already")
        answers[found[1]] = found[2].strip("'\"")
    return answers
