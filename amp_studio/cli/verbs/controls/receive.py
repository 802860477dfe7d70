"""Receive a plain file from any control that sends one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import OUTPUT, line_options, seconds
from amp_studio.cli.console import print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_new
from amp_studio.cli.screen import print_over
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.transfer import Progress
    from amp_studio.transfer.plain import PlainFile

PROTOCOLS = ("xmodem", "xmodem-1k", "xmodem-checksum", "ymodem", "raw")
"""The usual one first; here, because help loads no room (a test compares them)."""

VERB = Verb(
    __doc__,
    VerbArgument(
        "--from", dest="source", required=True, metavar="ADDRESS", help="where the control is reached"
    ),
    OUTPUT.but(help="new file; with ymodem also a folder, which gets every file"),
    *line_options(PROTOCOLS),
    VerbArgument("--keep-padding", action="store_true", help="leave the 1Ah that fill the last block up"),
    VerbArgument(
        "--idle",
        type=seconds,
        default=5.0,
        metavar="SECONDS",
        help="silence that ends a raw text (default: 5)",
    ),
    writes=("output",),
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio receive --from tcp://127.0.0.1:8195 -o received.txt --protocol ymodem",),
)


def run(options: Options) -> int:
    """Receive files and write them once all are there; 2 where that fails, with nothing written."""
    from amp_studio.cli.controls.tape import tape
    from amp_studio.transfer.plain import Patience, protocol_of, receive_files

    endpoint, protocol = protocol_of(options.source, options.protocol, PROTOCOLS)
    output = options.output
    is_folder = output.is_dir()
    if is_folder and protocol != "ymodem":
        raise UsageError(f"{output} is a folder, and {protocol} carries no name: write -o {output / 'NAME'}")
    if not is_folder:
        check_new(output, "what is received")
    with stop_requested() as stop:
        files = receive_files(
            endpoint,
            protocol,
            tape=tape(options),
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
        _write(file, path, keep_padding=options.keep_padding)
    return 0


def _write(file: PlainFile, path: Path, *, keep_padding: bool) -> None:
    """Write one file, and report the padding that was taken off it."""
    from amp_studio.files import write_atomic
    from amp_studio.report import counted

    # XMODEM knows no length: the last block is filled up with 1Ah, and a text may end with one itself.
    content = file.content + b"\x1a" * (file.padding if keep_padding else 0)
    write_atomic(path, content, expected=None, keep_backup=False)
    named = f" (sent as {file.name})" if file.name not in ("", path.name) else ""
    print(f"{path}: {counted(len(content), 'byte')}{named}")
    if file.padding and not keep_padding:
        print_remark(
            f"{counted(file.padding, 'byte')} 1Ah at its end were taken for padding (--keep-padding keeps"
            " them)"
        )


def _counted_bytes(show: Progress) -> Progress:
    """Show bytes instead of per cent where the sender has given no size."""

    def show_bytes(stage: str, done: int, total: int) -> None:
        if stage == "receive" and not total:
            print_over(f"receive {done} bytes", last=False)
        else:
            show(stage, done, total)

    return show_bytes


def _in_folder(folder: Path, files: list[PlainFile]) -> list[Path]:
    """Return where files go; refuses names that are there already or come twice."""
    from amp_studio.files import is_there
    from amp_studio.transfer.plain import file_name

    targets = [folder / file_name(file.name) for file in files]
    taken = [path for path in targets if is_there(path) or targets.count(path) > 1]
    if taken:
        raise UsageError(f"{taken[0]} is there already or was sent twice: nothing was written")
    return targets
