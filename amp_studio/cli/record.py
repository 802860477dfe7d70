"""The record of exchanges, shown."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from pathlib import Path

from amp_studio.files import open_file, real_path, text_of_name
from amp_studio.files.local_time import local_time
from amp_studio.transfer.client.record import RECORD, RecordedExchange, read_exchanges

from .console import print_json
from .errors import UsageError


def history_verb(options: argparse.Namespace) -> int:
    """List the exchanges of a file, or of all files of a folder; oldest first."""
    path: Path = options.path
    if path.is_dir():
        found = read_exchanges(path)
    else:
        open_file(path)  # what cannot be read has no history to be shown
        real = real_path(path)
        found = read_exchanges(real.parent, text_of_name(real.name))
    numbered = list(enumerate(found, 1))
    if options.show is not None:
        if not 1 <= options.show <= len(found):
            raise UsageError(f"there is no exchange {options.show}: {len(found)} are recorded")
        numbered = [numbered[options.show - 1]]
    if options.json:
        print_json({"exchanges": [{"number": n, **asdict(each)} for n, each in numbered]})
        return 0
    if not found:
        print(f"No exchange is recorded ({RECORD} beside the file).")
    for n, each in numbered:
        print(f"{n:4}  {each.line()}")
        if options.show is not None:
            _show(each)
    return 0


def _show(each: RecordedExchange) -> None:
    print(f"      {each.text}")
    print(f"      at {local_time(each.when)} ({each.when}), family {each.family}")
    print(f"      before {each.before or 'not known'}")
    print(f"      after  {each.after or 'not known'}")
    if each.kept:
        print(
            f"      amp-studio restore '{each.kept}' --to '{each.control}' puts back what it contained before"
        )
    for param, old, new in each.changes:
        print(f"      {param:40} {old or 'not set'}  →  {new or 'not set'}")
