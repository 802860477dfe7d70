"""Every recorded exchange with controls: who, when, which, digests, changes."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import JSON, PATH, count
from amp_studio.cli.console import print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.transfer.client import RecordedExchange

VERB = Verb(
    __doc__,
    PATH.but(metavar="PATH", help="a parameter file, or the folder of a project"),
    VerbArgument("--show", type=count, metavar="N", help="exchange N of the list with what it changed"),
    JSON,
    examples=("amp-studio history MILL_1394.amp",),
)


def run(options: Options) -> int:
    """List the exchanges of a file, or of all files of a folder; oldest first."""
    from amp_studio.files import RECORD, real_path, text_of_name
    from amp_studio.transfer.client import read_exchanges

    path: Path = options.path
    if path.is_dir():
        found = read_exchanges(path)
    else:
        opened(path, notify=lambda _note: None)  # what cannot be read has no history to be shown
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
    """Print one exchange: the digests before and after, how to put back, and every value that changed."""
    from amp_studio.files import local_time

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
