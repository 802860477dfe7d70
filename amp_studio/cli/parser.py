"""The verbs and their options: the contract that other programs call."""

from __future__ import annotations

import argparse
import os
import re
from pathlib import Path
from typing import Any, NoReturn

from amp_studio import __version__

from .errors import UsageError
from .manual import sections
from .misuse import in_plain_words, unexpected, unknown

_USUAL = {
    "path": "parameter file (.amp)",
    "family": "control family",
    "param": "number or id of a parameter",
    "params": "numbers or ids of parameters",
    "assignments": "parameter and its new value",
    "machine": "machine type: mill, lathe, …",
    "group": "only the parameters of this group",
    "table": "the table to print",
    "formula": "the formula to calculate",
    "arguments": "the values the formula needs",
    "text": "a control's own text file",
    "address": "where the control is reached",
    "a": "file, or address of a control",
    "b": "file, or address of a control",
    "base": "what both sides began with",
    "ours": "our side, which wins conflicts",
    "theirs": "the other side",
    "scenario": "what is simulated",
    "axis": "axis by its letter or number (default: the first)",
    "output": "file to write",
    "sort": "order of the values (default: group)",
    "changed-only": "only values that differ from the default",
    "listen": "where the control is reached",
    "to": "where the control is reached",
    "source": "where the control is reached",
    "control": "where the control is reached",
    "shell": "bash, zsh or fish",
}
"""Name of an argument -> its help where a verb has no other."""


SENDING = ("xmodem", "xmodem-1k", "ymodem", "raw")
RECEIVING = ("xmodem", "xmodem-1k", "xmodem-checksum", "ymodem", "raw")
"""Protocols of plain files, the usual one first; here, because help loads no room (a test compares them)."""


class _Parser(argparse.ArgumentParser):
    """An argument parser that reports what is wrong in one line, and whose help ends with examples."""

    def __init__(self, *, verb: str = "", **how: Any) -> None:
        self.verb = verb
        super().__init__(**how)

    def add_argument(self, *names: Any, **how: Any) -> argparse.Action:
        """Add an argument, with the usual help where none is given."""
        usual = _USUAL.get(how.get("dest") or names[-1].lstrip("-"))
        return super().add_argument(*names, **({"help": usual} if usual else {}) | how)

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{in_plain_words(message)} (see '{self.prog} --help')")

    def format_help(self) -> str:
        """Return the help of argparse with what comes below it."""
        below = (
            f"{title}:\n" + "\n".join(f"  {line}" for line in lines) for title, lines in sections(self.verb)
        )
        return "\n\n".join([super().format_help().rstrip(), *below]) + "\n"

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; an unknown option is reported before what is missing because of it."""
        for text in () if args is None else args:
            if text == "--" or not (self.verb or text.startswith("-")):
                break  # what follows are no options, or those of the verb
            name = text.partition("=")[0]
            known = list(self._option_string_actions)
            if name.startswith("--") and not any(option.startswith(name) for option in known):
                self.error(unknown("option", name, known))
        found, unknown_texts = super().parse_known_args(args, namespace)
        if self.verb and unknown_texts:
            self.error(unexpected(unknown_texts, self._option_string_actions))
        return found, unknown_texts

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            self.error(unknown(_named(action), str(value), action.choices))


def _named(action: argparse.Action) -> str:
    """Return what a person calls an argument."""
    return (action.option_strings or [str(action.metavar or action.dest).lower()])[-1].lstrip("-")


class _NotAsked(argparse.ArgumentParser):
    """In the place of the parser of a verb that is not on the command line; it takes arguments and keeps none."""

    def __init__(self) -> None:
        pass

    def add_argument(self, *_names: Any, **_how: Any) -> Any:
        """Add nothing."""


def parser(asked: str = "") -> argparse.ArgumentParser:
    """Return the parser of every verb; ``module`` and ``verb`` name the function that runs.

    Where there is a verb ``asked``, it is of that one alone: to make all of them takes a third of a start.
    """
    top = _Parser(
        prog="amp-studio",
        description="Edit, check, print and exchange the parameters of a machine control. Without a verb: the desktop program, on the files that are named.",
    )
    top.add_argument("--version", action="version", version=f"amp-studio {__version__}")
    verbs = top.add_subparsers(metavar="VERB", required=True, parser_class=_Parser)

    def verb(name: str, module: str, summary: str, writes: str = "") -> argparse.ArgumentParser:
        """Add a verb; ``writes`` names the option whose file it may replace."""
        if asked and name != asked:
            return _NotAsked()
        text = f"{summary[0].upper()}{summary[1:]}."
        sub: argparse.ArgumentParser = verbs.add_parser(name, help=summary, description=text, verb=name)
        sub.set_defaults(verb=f"{name}_verb", module=module, writes=writes.split())
        return sub

    def json_option(sub: argparse.ArgumentParser) -> None:
        sub.add_argument("--json", action="store_true", help="print one JSON document")

    def secrets_option(sub: argparse.ArgumentParser) -> None:
        sub.add_argument(
            "--secrets", action="store_true", help="passwords in clear; they are masked otherwise"
        )

    def on_fault(sub: argparse.ArgumentParser) -> None:
        sub.add_argument("--on-fault", choices=("ask", "keep", "quit"), default="ask",
                         help="what to do with out-of-range values (default: ask at a terminal, else quit)")  # fmt: skip

    def to_control(sub: argparse.ArgumentParser, kept: str) -> None:
        sub.add_argument("--to", required=True, metavar="ADDRESS")
        sub.add_argument("--expect", metavar="SHA256",
                         help="only where the control contains the image with this digest, as verify and upload print it")  # fmt: skip
        sub.add_argument(
            "--keep", type=_folder, metavar="DIR", help=f"where to keep what the control contained ({kept})"
        )

    def plain(sub: argparse.ArgumentParser, protocols: tuple[str, ...]) -> None:
        sub.add_argument(
            "--protocol", choices=protocols, help=f"how the file is carried (default: {protocols[0]})"
        )
        sub.add_argument("--wait", type=_seconds, default=60.0, metavar="SECONDS",
                         help="how long the other end may take to begin (default: 60)")  # fmt: skip
        sub.add_argument("--percent", action="store_true", help="raw: %% before and after the text")
        sub.add_argument(
            "--leader", type=_count, default=0, metavar="N", help="raw: blank signs before and after"
        )
        sub.add_argument(
            "--blank", choices=("nul", "space"), default="nul", help="raw: the blank sign (default: nul)"
        )

    sub = verb("families", "facts", "list the control families")
    json_option(sub)
    sub = verb("schema", "facts", "every parameter definition of a family")
    sub.add_argument("family")
    sub.add_argument("--group")
    json_option(sub)
    sub = verb("show", "facts", "one parameter as a person reads it")
    sub.add_argument("family")
    sub.add_argument("param")
    sub.add_argument(
        "--machine", help="machine type, where a number means another parameter on another machine"
    )
    sub = verb("tables", "facts", "the manual's tables: alarms, motors, codes; without one, list them")
    sub.add_argument("family")
    sub.add_argument("table", nargs="?")
    json_option(sub)
    sub = verb("calculate", "facts", "calculate a published formula of a family; without one, list them")
    sub.add_argument("family")
    sub.add_argument("formula", nargs="?")
    sub.add_argument("arguments", nargs="*", metavar="NAME=VALUE")
    sub = verb("new", "files", "a new parameter file with the family's defaults", writes="path")
    sub.add_argument("family")
    sub.add_argument("path", type=_path)
    sub.add_argument("--machine")
    sub.add_argument("--axes", help="axis names in order, with commas")
    sub = verb(
        "set", "files", "change values, all or none; the previous file becomes the backup", writes="path"
    )
    sub.add_argument("path", type=_path)
    sub.add_argument("assignments", nargs="+", metavar="PARAM=VALUE")
    sub.add_argument("--force", action="store_true", help="take values out of range, and mark them")
    sub = verb("get", "files", "values with unit, default, and whether changed")
    sub.add_argument("path", type=_path)
    sub.add_argument("params", nargs="*", metavar="PARAM")
    sub.add_argument("--all", action="store_true", help="also what is hidden or not set")
    json_option(sub)
    secrets_option(sub)
    sub = verb("validate", "checks", "range, choice, state and cross-parameter findings")
    sub.add_argument("paths", nargs="+", type=_path, metavar="PATH", help="files, or folders of files")
    sub.add_argument(
        "--jobs", type=_count, metavar="N", help="processes that share many files (one for each processor)"
    )
    sub.add_argument(
        "--rules", type=_path, help="a builder's own rules instead of the rules.yaml beside the file"
    )
    sub.add_argument(
        "--why", action="store_true", help="explain each finding: its rule, the values, the page"
    )
    json_option(sub)
    sub = verb(
        "fix",
        "fix",
        "make suggested fixes, all or none, and show what changed and what is left",
        writes="path",
    )
    sub.add_argument("path", type=_path)
    sub.add_argument("--rule", metavar="ID", help="only fixes of this rule")
    sub.add_argument("--param", help="only fixes that set this parameter")
    sub.add_argument("--safe", action="store_true", help="only fixes that cannot change motion")
    sub.add_argument("--dry-run", action="store_true", help="change nothing, show what would change")
    json_option(sub)
    sub = verb("diff", "files", "differences by parameter; A or B may be a control's address")
    sub.add_argument("a", type=_file_or_address)
    sub.add_argument("b", type=_file_or_address)
    json_option(sub)
    secrets_option(sub)
    sub = verb("merge", "files", "three-way merge by parameter", writes="output")
    for name in ("base", "ours", "theirs"):
        sub.add_argument(name, type=_path)
    sub.add_argument("-o", "--output", type=_path, required=True)
    secrets_option(sub)
    sub = verb("report", "documentation", "documentation as .pdf, .html, .csv or .txt", writes="output")
    sub.add_argument("path", type=_path)
    sub.add_argument("-o", "--output", type=_path, required=True)
    sub.add_argument("--sort", choices=("axis", "number", "group"), default="group")
    sub.add_argument("--changed-only", action="store_true")
    secrets_option(sub)
    sub = verb(
        "sheet",
        "sheet",
        "the values to key in at a control by hand: in its own numbers, in a safe order, to tick and to read back",
        writes="output",
    )
    sub.add_argument("path", type=_path)
    sub.add_argument("--against", required=True, type=_file_or_address, metavar="OTHER",
                     help="what the control contains: a file, a kept copy, or the control's address")  # fmt: skip
    sub.add_argument(
        "-o", "--output", type=_path, help="the sheet as .pdf, .html, .csv or .txt (default: as text here)"
    )
    sub.add_argument(
        "--tick",
        action="append",
        metavar="PARAM",
        help="remember that this value is keyed in; beside the file",
    )
    sub.add_argument("--untick", action="append", metavar="PARAM", help="forget that again")
    sub.add_argument("--check", type=_path, metavar="LIST",
                     help="lines of number and what the screen shows, or the sheet's .csv filled in: compare exactly")  # fmt: skip
    json_option(sub)
    secrets_option(sub)
    sub = verb("import", "formats", "a new parameter file from a control's own text format", writes="output")
    sub.add_argument("text", type=_path, metavar="FILE")
    sub.add_argument("-o", "--output", type=_path, required=True)
    sub.add_argument("--family", help="where the text does not show it")
    sub.add_argument("--format", help="where the text does not show it")
    sub.add_argument(
        "--keep-unknown", action="store_true", help="keep what is not understood, to be written back"
    )
    on_fault(sub)
    sub = verb(
        "export", "formats", "a parameter file in a text format; the ending shows which", writes="output"
    )
    sub.add_argument("path", type=_path)
    sub.add_argument("-o", "--output", type=_path, required=True)
    sub.add_argument("--format", help="where the ending does not show it")
    secrets_option(sub)
    sub = verb("emulate", "control", "an emulated control that takes downloads and gives uploads")
    sub.add_argument("family")
    sub.add_argument("--listen", required=True, metavar="ADDRESS")
    sub.add_argument("--state", type=_folder, metavar="DIR", help="where the control keeps its memory")
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
        help="what was ordered with the control, where its family has options: axes=3 for a 9/PC",
    )
    sub = verb("ports", "identify", "the serial ports of this computer")
    json_option(sub)
    sub = verb("identify", "identify", "what answers at an address, and what it contains")
    sub.add_argument("address", metavar="ADDRESS")
    sub.add_argument("--family", help="the family it must be of")
    json_option(sub)
    sub = verb("download", "control", "send a file to a control, read it back and compare")
    sub.add_argument("path", type=_path)
    to_control(sub, "beside the file")
    sub.add_argument(
        "--accept-errors",
        action="store_true",
        help="send a file that has errors; they are listed anyway",
    )
    sub = verb(
        "restore",
        "control",
        "put back what a control contained before a download or a restore, byte for byte",
    )
    sub.add_argument(
        "copy",
        type=_path,
        metavar="COPY",
        help="NAME.before-STAMP.img, which is compared with the digest beside it, or the .amp of that name",
    )
    to_control(sub, "beside the copy")
    sub = verb(
        "upload",
        "control",
        "fetch under a new name what a control contains, and print its digest",
        writes="output",
    )
    sub.add_argument("--from", dest="source", required=True, metavar="ADDRESS")
    sub.add_argument("-o", "--output", type=_path, required=True,
                     help="a parameter file; or NAME.img for the image byte for byte, whatever it is")  # fmt: skip
    on_fault(sub)
    sub = verb(
        "verify", "control", "compare values and every byte with what a control contains; print its digest"
    )
    sub.add_argument("path", type=_path)
    sub.add_argument("--with", dest="control", required=True, metavar="ADDRESS")
    json_option(sub)
    secrets_option(sub)
    sub = verb("send", "plain_files", "send a plain file to any control that takes one")
    sub.add_argument("files", nargs="+", type=_path, metavar="FILE", help="several with ymodem only")
    sub.add_argument("--to", required=True, metavar="ADDRESS")
    plain(sub, SENDING)
    sub = verb(
        "receive", "plain_files", "receive a plain file from any control that sends one", writes="output"
    )
    sub.add_argument("--from", dest="source", required=True, metavar="ADDRESS")
    sub.add_argument(
        "-o",
        "--output",
        type=_path,
        required=True,
        help="new file; with ymodem also a folder, which gets every file",
    )
    plain(sub, RECEIVING)
    sub.add_argument("--keep-padding", action="store_true", help="leave the 1Ah that fill the last block up")
    sub.add_argument(
        "--idle",
        type=_seconds,
        default=5.0,
        metavar="SECONDS",
        help="silence that ends a raw text (default: 5)",
    )
    sub = verb("simulate", "motion", "check settings in motion", writes="output")
    sub.add_argument("path", type=_path)
    sub.add_argument("scenario", nargs="?")
    sub.add_argument("--list", action="store_true",
                     help="list the scenarios of this family, its axes, and what can be set")  # fmt: skip
    sub.add_argument("--axis")
    sub.add_argument("--set", action="append", default=[], metavar="PARAM=VALUE", dest="assignments")
    sub.add_argument(
        "--units", metavar="SYSTEM", help="unit system of settings and result; default: that of the file"
    )
    sub.add_argument("-o", "--output", type=_path)
    json_option(sub)
    sub = verb(
        "demo",
        "motion",
        "the whole job on the example machine: in the desktop program, or here without a display",
    )
    sub.add_argument(
        "--terminal", action="store_true", help="stay in the terminal even where there is a display"
    )
    sub = verb("completion", "completion", "print the completion script of a shell")
    sub.add_argument("shell", choices=("bash", "zsh", "fish"))
    verb("man", "man_page", "print the man page")
    return parser() if asked and not verbs.choices else top


def _path(text: str) -> Path:
    """Return a path; an empty text, as of a variable that is not set, is not the current folder."""
    if not text:
        raise argparse.ArgumentTypeError("the path is empty")
    path = Path(text)
    if text.endswith((os.sep, "/", "/.")) and not _is_folder(path):  # Path forgets what it ended with
        raise argparse.ArgumentTypeError(f"{text} ends like a folder, and there is no such folder")
    return path


def _file_or_address(text: str) -> str:
    """Return the path of a file, or the address of a control."""
    if "://" not in text:
        _path(text)
    return text


def _folder(text: str) -> Path:
    """Return the path of a folder, which need not be there."""
    path = Path(text)
    return path if text and not path.exists() else _path(text)


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:
        return False


def verbs_of(top: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each verb."""
    (verbs,) = (action.choices for action in top._actions if isinstance(action.choices, dict))
    return dict(verbs)


def _count(text: str) -> int:
    if not (text.isdecimal() and 0 < int(text) <= 100_000):
        raise argparse.ArgumentTypeError(f"{text} is no number from 1 to 100000")
    return int(text)


def _seconds(text: str) -> float:
    if not re.fullmatch(r"\d{1,5}(\.\d{1,3})?", text, re.ASCII) or float(text) <= 0:
        raise argparse.ArgumentTypeError(f"{text} is no number of seconds")
    return float(text)
