"""Verbs that send and receive plain files, whatever they contain."""

from __future__ import annotations

import argparse
from pathlib import Path

from amp_studio.files import is_there
from amp_studio.files.atomic import write_atomic
from amp_studio.report.wording import counted
from amp_studio.schema.regular_file import read_file
from amp_studio.transfer.plain.files import protocol_of, receive_files, send_files
from amp_studio.transfer.plain.line import Patience
from amp_studio.transfer.plain.raw import Tape
from amp_studio.transfer.plain.receiver import LARGEST
from amp_studio.transfer.plain.ymodem import PlainFile, file_name
from amp_studio.transfer.progress import Progress

from .console import note, progress
from .errors import UsageError
from .options.exchanges import RECEIVING, SENDING
from .output import check_new
from .screen import print_over
from .stopping import asked_politely

BLANKS = {"nul": b"\0", "space": b" "}


def send_verb(options: argparse.Namespace) -> int:
    """Send files; 2 if nothing has arrived, 4 if it is not known how much."""
    endpoint, protocol = protocol_of(options.to, options.protocol, SENDING)
    if len(options.files) > 1 and protocol != "ymodem":
        raise UsageError(f"{protocol} sends one file at a time; ymodem sends several")
    files = [_read(path) for path in options.files]
    with asked_politely() as stop:
        send_files(
            endpoint,
            protocol,
            files,
            tape=_tape(options),
            patience=Patience(start=options.wait),
            progress=progress(),
            cancel=stop,
        )
    sent = "sent; nobody confirms a raw text" if protocol == "raw" else "sent, and every block acknowledged"
    for file in files:
        print(f"{file.name}: {counted(len(file.content), 'byte')} {sent}")
    return 0


def receive_verb(options: argparse.Namespace) -> int:
    """Receive files and write them once all are there; 2 where that fails, with nothing written."""
    endpoint, protocol = protocol_of(options.source, options.protocol, RECEIVING)
    output = options.output
    is_folder = output.is_dir()
    if is_folder and protocol != "ymodem":
        raise UsageError(f"{output} is a folder, and {protocol} carries no name: write -o {output / 'NAME'}")
    if not is_folder:
        check_new(output, "what is received")
    with asked_politely() as stop:
        files = receive_files(
            endpoint,
            protocol,
            tape=_tape(options),
            idle=options.idle,
            patience=Patience(start=options.wait),
            progress=_counted_bytes(progress()),
            cancel=stop,
        )
    if not files:
        raise UsageError("the other end has sent no file")
    if len(files) > 1 and not is_folder:
        raise UsageError(
            f"the other end has sent {len(files)} files: give a folder (-o); nothing was written"
        )
    targets = _in_folder(output, files) if is_folder else [output]
    for file, path in zip(files, targets, strict=True):
        content = file.content + b"\x1a" * (file.padding if options.keep_padding else 0)
        write_atomic(path, content, expected=None, keep_backup=False)
        named = f" (sent as {file.name})" if file.name and file.name != path.name else ""
        print(f"{path}: {counted(len(content), 'byte')}{named}")
        if file.padding and not options.keep_padding:
            note(
                f"{counted(file.padding, 'byte')} 1Ah at its end were taken for padding (--keep-padding keeps them)"
            )
    return 0


def _counted_bytes(show: Progress) -> Progress:
    """Show bytes instead of per cent where the sender has given no size."""

    def show_bytes(stage: str, done: int, total: int) -> None:
        if stage == "receive" and not total:
            print_over(f"receive {done} bytes", last=False)
        else:
            show(stage, done, total)

    return show_bytes


def _read(path: Path) -> PlainFile:
    content = read_file(path, LARGEST)
    return PlainFile(path.name, content)


def _in_folder(folder: Path, files: list[PlainFile]) -> list[Path]:
    """Return where files go; refuses names that are there already or come twice."""
    targets = [folder / file_name(file.name) for file in files]
    taken = [path for path in targets if is_there(path) or targets.count(path) > 1]
    if taken:
        raise UsageError(f"{taken[0]} is there already or was sent twice: nothing was written")
    return targets


def _tape(options: argparse.Namespace) -> Tape:
    return Tape(options.leader, BLANKS[options.blank], options.percent)
