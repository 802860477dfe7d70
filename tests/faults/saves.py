"""The power that goes off after a verb has written: what it has written is on the disk,
and so is the backup of what was there.
"""

import contextlib
import io
import re
import shutil
from pathlib import Path

from amp_studio import cli

from .disk import Disk
from .verbs import VERBS, contents, lay_out, target_of


def power_off_after_saves(seed: int, runs: int, folder: Path) -> list[str]:
    """Run so many verbs, beginning with that of the seed; returns what a power loss then would have lost."""
    found = []
    for number in range(runs):
        verb = VERBS[(seed + number) % len(VERBS)]
        work = folder / f"save-{number}"
        found += [f"{' '.join(verb)}: {what}" for what in _lost(verb, work)]
        shutil.rmtree(work)
    return found


def _lost(verb: tuple[str, ...], work: Path) -> list[str]:
    lay_out(work)
    before, disk = contents(work), Disk()
    words = [str(work / word) if re.fullmatch(r"[a-z]+\.[a-z]+", word) else word for word in verb]
    with (
        disk.watched(),
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.redirect_stderr(io.StringIO()) as text,
    ):
        code = cli.run(words)
    after = contents(work)
    target = target_of(before, after)
    if code not in (0, 1) or target is None:
        return [f"exit {code}, and {target or 'nothing'} has changed: {text.getvalue()}"]
    found = [*disk.faults, *disk.unsafe(work, work / target)]
    if target in before:
        backup = work / f"{target}.bak"
        found += disk.unsafe(backup) if backup.exists() else ["there is no backup"]
        if backup.exists() and backup.read_bytes() != before[target]:
            found.append("the backup is not the previous file")
    return found
