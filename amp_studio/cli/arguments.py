"""Arguments that several verbs have, and the kinds of their values."""

from __future__ import annotations

import os
import re
from pathlib import Path

from . import candidates
from .verb import VerbArgument

# -- kinds of values: a function that raises ValueError with what is wrong


def path_of(text: str) -> Path:
    """Return a path; an empty text, as of a variable that is not set, is not the current folder."""
    if not text:
        raise ValueError("the path is empty")
    path = Path(text)
    if text.endswith((os.sep, "/", "/.")) and not is_folder(path):  # Path forgets what it ended with
        raise ValueError(f"{text} ends like a folder, and there is no such folder")
    return path


def axes_of(text: str) -> str:
    """Return the axes that are asked for; an empty text, as of a variable that is not set, is not the first
    one.
    """
    if not text.strip():
        raise ValueError("the axis is empty")
    return text


def file_or_address(text: str) -> str:
    """Return the path of a file, or the address of a control."""
    if "://" not in text:
        path_of(text)
    return text


def folder(text: str) -> Path:
    """Return the path of a folder, which need not be there."""
    path = Path(text)
    return path if text and not path.exists() else path_of(text)


def is_folder(path: Path) -> bool:
    """Return whether a path is a folder; what cannot be read is reported like an unreadable file."""
    try:
        return path.is_dir()
    except OSError:
        return False


def count(text: str) -> int:
    """Return a number from 1 to 100000."""
    if not (text.isdecimal() and 0 < int(text) <= 100_000):
        raise ValueError(f"{text} is no number from 1 to 100000")
    return int(text)


def seconds(text: str) -> float:
    """Return a number of seconds above 0."""
    # ASCII: otherwise \d takes the digits of every script, and float() some of them.
    if not re.fullmatch(r"\d{1,5}(\.\d{1,3})?", text, re.ASCII) or float(text) <= 0:
        raise ValueError(f"{text} is no number of seconds")
    return float(text)


# -- what is named

PATH = VerbArgument("path", type=path_of, help="parameter file (.amp)")
PATHS = VerbArgument(
    "paths", type=path_of, nargs="+", metavar="PATH", help="parameter files (.amp) of one family"
)
OUTPUT = VerbArgument("-o", "--output", type=path_of, required=True, help="file to write")
FAMILY = VerbArgument("family", help="control family", completes=candidates.families)
MACHINE = VerbArgument("--machine", help="machine type: mill, lathe, …", completes=candidates.machines)
AXIS = VerbArgument(
    "--axis",
    type=axes_of,
    help="axis by its letter or number (default: the first)",
    completes=candidates.axes,
)

# -- how results are printed

JSON = VerbArgument("--json", action="store_true", help="print one JSON document")
SECRETS = VerbArgument("--secrets", action="store_true", help="passwords in clear; they are masked otherwise")
LANGUAGE = VerbArgument(
    "--language", choices=("en", "de"), default="en", help="language of the report's own words (default: en)"
)
DRY_RUN = VerbArgument("--dry-run", action="store_true", help="change nothing, show what would change")
BY_LETTER = VerbArgument(
    "--by-letter", action="store_true", help="match axes by their letters instead of their numbers"
)

# -- what is read

TEXT = (
    VerbArgument(
        "--family",
        help="of a control's own text: its family, where the text does not show it",
        completes=candidates.families,
    ),
    VerbArgument(
        "--machine",
        metavar="TYPE",
        help="of a control's own text: its machine type, where the text shall not decide",
        completes=candidates.machines,
    ),
)
"""What is known of a control's own text that is named in place of a parameter file."""
ON_FAULT = VerbArgument(
    "--on-fault",
    choices=("ask", "keep", "quit"),
    default="ask",
    help="what to do with out-of-range values (default: ask at a terminal, else quit)",
)

# -- controls


def several_controls(*names: str, dest: str, required: bool = True) -> tuple[VerbArgument, ...]:
    """Return the addresses of one control or several, and what is for several only."""
    return (
        VerbArgument(
            *names,
            dest=dest,
            required=required,
            action="append",
            metavar="ADDRESS",
            help="address of a control; named again for several, side by side",
        ),
        VerbArgument(
            "--stop-on-failure",
            action="store_true",
            help="several controls one after the other; none is begun after the first failure",
        ),
        VerbArgument(
            "--report", type=path_of, metavar="FILE", help="write the table of results, as .csv or .html"
        ),
    )


EXPECT = VerbArgument(
    "--expect",
    metavar="SHA256",
    help="only where the control contains the image with this digest, as verify and upload print it",
)
TO = VerbArgument("--to", required=True, metavar="ADDRESS", help="where the control is reached")


def kept_in(where: str) -> VerbArgument:
    """Return where a copy is kept of what a control contained before."""
    return VerbArgument(
        "--keep", type=folder, metavar="DIR", help=f"where to keep what the control contained ({where})"
    )


def line_options(protocols: tuple[str, ...]) -> tuple[VerbArgument, ...]:
    """Return how a plain file is carried."""
    return (
        VerbArgument(
            "--protocol", choices=protocols, help=f"how the file is carried (default: {protocols[0]})"
        ),
        VerbArgument(
            "--wait",
            type=seconds,
            default=60.0,
            metavar="SECONDS",
            help="how long the other end may take to begin (default: 60)",
        ),
        VerbArgument("--percent", action="store_true", help="raw: % before and after the text"),
        VerbArgument(
            "--leader", type=count, default=0, metavar="N", help="raw: blank characters before and after"
        ),
        VerbArgument(
            "--blank", choices=("nul", "space"), default="nul", help="raw: the blank character (default: nul)"
        ),
    )
