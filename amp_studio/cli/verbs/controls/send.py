"""Send a plain file to any control that takes one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import TO, line_options, path_of
from amp_studio.cli.console import progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.transfer.plain import PlainFile

PROTOCOLS = ("xmodem", "xmodem-1k", "ymodem", "raw")
"""The usual one first; here, because help loads no room (a test compares them)."""

VERB = Verb(
    __doc__,
    VerbArgument("files", nargs="+", type=path_of, metavar="FILE", help="several with ymodem only"),
    TO,
    *line_options(PROTOCOLS),
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio send MILL_1394.amp --to tcp://127.0.0.1:8194 --protocol xmodem-1k",),
)


def run(options: Options) -> int:
    """Send files; 2 if nothing has arrived, 4 if it is not known how much."""
    from amp_studio.cli.controls.tape import tape
    from amp_studio.report import counted
    from amp_studio.transfer.plain import Patience, protocol_of, send_files

    endpoint, protocol = protocol_of(options.to, options.protocol, PROTOCOLS)
    if len(options.files) > 1 and protocol != "ymodem":
        raise UsageError(f"{protocol} sends one file at a time; ymodem sends several")
    files = [_read(path) for path in options.files]
    with stop_requested() as stop:
        send_files(
            endpoint,
            protocol,
            files,
            tape=tape(options),
            patience=Patience(start=options.wait),
            progress=progress(),
            cancel=stop,
        )
    sent = "sent; nobody confirms a raw text" if protocol == "raw" else "sent, and every block acknowledged"
    for file in files:
        print(f"{file.name}: {counted(len(file.content), 'byte')} {sent}")
    return 0


def _read(path: Path) -> PlainFile:
    from amp_studio.schema import read_file
    from amp_studio.transfer.plain import LARGEST, PlainFile

    content = read_file(path, LARGEST)
    return PlainFile(path.name, content)
