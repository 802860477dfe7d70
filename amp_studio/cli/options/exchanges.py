"""The verbs about controls: emulated ones, exchanges, and plain files over a line."""

from __future__ import annotations

import argparse

from amp_studio.cli.arguments import (
    Verbs,
    count,
    folder,
    json_option,
    on_fault_option,
    path_of,
    seconds,
    secrets_option,
    text_options,
)

SENDING = ("xmodem", "xmodem-1k", "ymodem", "raw")
RECEIVING = ("xmodem", "xmodem-1k", "xmodem-checksum", "ymodem", "raw")
"""Protocols of plain files, the usual one first; here, because help loads no room (a test compares them)."""


def add(verbs: Verbs) -> None:
    """Add the verbs about controls."""
    _controls(verbs)
    _exchanges(verbs)
    _plain_files(verbs)


def _controls(verbs: Verbs) -> None:
    """Add the verbs about emulated controls, and what answers at an address."""
    sub = verbs.add(
        "emulate",
        "control",
        "an emulated control that takes downloads and gives uploads, until quit or Ctrl-C",
    )
    sub.add_argument("family")
    sub.add_argument("--listen", required=True, metavar="ADDRESS")
    sub.add_argument("--state", type=folder, metavar="DIR", help="where the control keeps its memory")
    sub.add_argument("--machine", help="machine type of the parameters it starts with")
    sub.add_argument("--no-estop", action="store_true", help="start out of E-stop")
    sub.add_argument(
        "--manual-restart", action="store_true", help="do not restart by itself after a download"
    )
    sub.add_argument(
        "--faults",
        default="{}",
        metavar="JSON",
        help='what goes wrong, to practise with: {"drop_after_bytes": 9000}',
    )
    sub.add_argument(
        "--option",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="what was ordered with the control, where its family has options: axes=3",
    )
    sub.add_argument(
        "--password-file", type=path_of, metavar="FILE", help="ask clients for the password in its first line"
    )
    sub.add_argument(
        "--certificate",
        type=path_of,
        metavar="FILE",
        help="speak TLS with this certificate (PEM); listen on tls://",
    )
    sub.add_argument(
        "--key", type=path_of, metavar="FILE", help="key of the certificate, where it is in another file"
    )
    sub = verbs.add("ports", "identify", "the serial ports of this computer")
    json_option(sub)
    sub = verbs.add("identify", "identify", "what answers at an address, and what it contains")
    sub.add_argument("address", metavar="ADDRESS")
    sub.add_argument("--family", help="the family it must be of")
    json_option(sub)


def _exchanges(verbs: Verbs) -> None:
    """Add the verbs that exchange parameters with a control."""
    sub = verbs.add("download", "control", "send a file to a control, read it back and compare")
    sub.add_argument("path", type=path_of)
    _several(sub, "--to", "to")
    _to_control(sub, "beside the file")
    json_option(sub)
    sub.add_argument(
        "--accept-errors",
        action="store_true",
        help="send a file that has errors; they are listed anyway",
    )
    text_options(sub)
    sub = verbs.add(
        "restore",
        "control",
        "put back what a control contained before a download or a restore, byte for byte",
    )
    sub.add_argument(
        "copy",
        type=path_of,
        metavar="COPY",
        help="NAME.before-STAMP.img, which is compared with the digest beside it, or the .amp of that name",
    )
    sub.add_argument("--to", required=True, metavar="ADDRESS")
    _to_control(sub, "beside the copy")
    sub = verbs.add(
        "upload",
        "control",
        "fetch under a new name what a control contains, and print its digest",
        writes="output",
    )
    _several(sub, "--from", "source")
    sub.add_argument("-o", "--output", type=path_of, required=True,
                     help="a parameter file; or NAME.img for the image byte for byte, whatever it is; of several controls a folder")  # fmt: skip
    on_fault_option(sub)
    json_option(sub)
    sub = verbs.add(
        "verify", "control", "compare values and every byte with what a control contains; print its digest"
    )
    sub.add_argument(
        "path", type=path_of, nargs="?", help="parameter file (.amp); with --all a folder (default: this one)"
    )
    _several(sub, "--with", "control", required=False)
    sub.add_argument(
        "--all",
        action="store_true",
        help="every control that the folder knows, from its exchanges and projects, against its file",
    )
    json_option(sub)
    secrets_option(sub)
    text_options(sub)
    sub = verbs.add(
        "history", "record", "every recorded exchange with controls: who, when, which, digests, changes"
    )
    sub.add_argument(
        "path", type=path_of, metavar="PATH", help="a parameter file, or the folder of a project"
    )
    sub.add_argument("--show", type=count, metavar="N", help="exchange N of the list with what it changed")
    json_option(sub)


def _several(sub: argparse.ArgumentParser, name: str, dest: str, *, required: bool = True) -> None:
    """Add the addresses of one control or several, and what is for several only."""
    sub.add_argument(name, dest=dest, required=required, action="append", metavar="ADDRESS",
                     help="address of a control; named again for several, side by side")  # fmt: skip
    sub.add_argument("--stop-on-failure", action="store_true",
                     help="several controls one after the other; none is begun after the first failure")  # fmt: skip
    sub.add_argument(
        "--report", type=path_of, metavar="FILE", help="write the table of results, as .csv or .html"
    )


def _to_control(sub: argparse.ArgumentParser, kept: str) -> None:
    """Add what a download may replace, and the folder of the copy."""
    sub.add_argument("--expect", metavar="SHA256",
                     help="only where the control contains the image with this digest, as verify and upload print it")  # fmt: skip
    sub.add_argument(
        "--keep", type=folder, metavar="DIR", help=f"where to keep what the control contained ({kept})"
    )


def _plain_files(verbs: Verbs) -> None:
    """Add the verbs that carry plain files over a line."""
    sub = verbs.add("send", "plain_files", "send a plain file to any control that takes one")
    sub.add_argument("files", nargs="+", type=path_of, metavar="FILE", help="several with ymodem only")
    sub.add_argument("--to", required=True, metavar="ADDRESS")
    _plain(sub, SENDING)
    sub = verbs.add(
        "receive", "plain_files", "receive a plain file from any control that sends one", writes="output"
    )
    sub.add_argument("--from", dest="source", required=True, metavar="ADDRESS")
    sub.add_argument(
        "-o",
        "--output",
        type=path_of,
        required=True,
        help="new file; with ymodem also a folder, which gets every file",
    )
    _plain(sub, RECEIVING)
    sub.add_argument("--keep-padding", action="store_true", help="leave the 1Ah that fill the last block up")
    sub.add_argument(
        "--idle",
        type=seconds,
        default=5.0,
        metavar="SECONDS",
        help="silence that ends a raw text (default: 5)",
    )


def _plain(sub: argparse.ArgumentParser, protocols: tuple[str, ...]) -> None:
    """Add how a plain file is carried."""
    sub.add_argument(
        "--protocol", choices=protocols, help=f"how the file is carried (default: {protocols[0]})"
    )
    sub.add_argument("--wait", type=seconds, default=60.0, metavar="SECONDS",
                     help="how long the other end may take to begin (default: 60)")  # fmt: skip
    sub.add_argument("--percent", action="store_true", help="raw: %% before and after the text")
    sub.add_argument("--leader", type=count, default=0, metavar="N", help="raw: blank signs before and after")
    sub.add_argument(
        "--blank", choices=("nul", "space"), default="nul", help="raw: the blank sign (default: nul)"
    )
