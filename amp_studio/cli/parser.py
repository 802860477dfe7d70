"""The verbs and their options: the contract that other programs call."""

from __future__ import annotations

import argparse

from amp_studio import __version__

from .arguments import (
    VerbParser,
    Verbs,
    count,
    file_or_address,
    folder,
    json_option,
    on_fault_option,
    path_of,
    seconds,
    secrets_option,
)
from .calibration_options import calibrate_options

SENDING = ("xmodem", "xmodem-1k", "ymodem", "raw")
RECEIVING = ("xmodem", "xmodem-1k", "xmodem-checksum", "ymodem", "raw")
"""Protocols of plain files, the usual one first; here, because help loads no room (a test compares them)."""
AXIS_OPERATIONS = ("list", "compare", "copy", "swap", "name", "type", "add", "remove")
"""What the verb about axes does; here for the same reason."""


def parser(asked: str = "") -> argparse.ArgumentParser:
    """Return the parser of every verb; ``module`` and ``verb`` name the function that runs.

    Where there is a verb ``asked``, it is of that one alone.
    """
    top = VerbParser(
        prog="amp-studio",
        description="Edit, check, print and exchange the parameters of a machine control. Without a verb: the desktop program, on the files that are named.",
    )
    top.add_argument("--version", action="version", version=f"amp-studio {__version__}")
    verbs = Verbs(top, asked)
    for some in (
        _facts,
        _files,
        _guide,
        _axes,
        _checks,
        _comparing,
        _documents,
        _controls,
        _exchanges,
        _plain_files,
        _motion,
        calibrate_options,
        _of_the_shell,
    ):
        some(verbs)
    return parser() if asked and not verbs.is_known else top


def verbs_of(top: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each verb."""
    (verbs,) = (action.choices for action in top._actions if isinstance(action.choices, dict))
    return dict(verbs)


def _facts(verbs: Verbs) -> None:
    """Add the verbs about the facts of a family."""
    sub = verbs.add("families", "facts", "list the control families")
    json_option(sub)
    sub = verbs.add("schema", "facts", "every parameter definition of a family")
    sub.add_argument("family")
    sub.add_argument("--group")
    json_option(sub)
    sub = verbs.add("show", "facts", "one parameter as a person reads it")
    sub.add_argument("family")
    sub.add_argument("param")
    sub.add_argument(
        "--machine", help="machine type, where a number means another parameter on another machine"
    )
    sub = verbs.add("tables", "facts", "the manual's tables: alarms, motors, codes; without one, list them")
    sub.add_argument("family")
    sub.add_argument("table", nargs="?")
    json_option(sub)
    sub = verbs.add(
        "find",
        "find",
        "find parameters, values, choices and messages of the control by what one remembers of them; typing errors are forgiven",
    )
    sub.add_argument(
        "words", nargs="+", metavar="FAMILY|FILE WORDS", help="where to look (every family), and what for"
    )
    sub.add_argument("--family", help="look in this family")
    sub.add_argument("--limit", type=count, metavar="N", default=20, help="most hits (default: 20)")
    json_option(sub)
    sub = verbs.add("calculate", "facts", "calculate a published formula of a family; without one, list them")
    sub.add_argument("family")
    sub.add_argument("formula", nargs="?")
    sub.add_argument("arguments", nargs="*", metavar="NAME=VALUE")


def _files(verbs: Verbs) -> None:
    """Add the verbs about the values of a file."""
    sub = verbs.add("new", "files", "a new parameter file with the family's defaults", writes="path")
    sub.add_argument("family")
    sub.add_argument("path", type=path_of)
    sub.add_argument("--machine")
    sub.add_argument(
        "--axes", help="axis names in order, with commas; where axes are in groups, X.2 is X of group 2"
    )
    sub.add_argument("--like", metavar="FILE|EXAMPLE",
                     help="with the values of this file or example, except what was measured on that machine, and passwords")  # fmt: skip
    sub = verbs.add(
        "set", "files", "change values, all or none; the previous file becomes the backup", writes="path"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("assignments", nargs="+", metavar="PARAM=VALUE")
    sub.add_argument("--force", action="store_true", help="take values out of range, and mark them")
    sub = verbs.add("get", "files", "values with unit, default, and whether changed")
    sub.add_argument("path", type=path_of)
    sub.add_argument("params", nargs="*", metavar="PARAM")
    sub.add_argument("--all", action="store_true", help="also what is hidden or not set")
    for name, meaning in (
        ("changed", "only values that are not the printed default"),
        ("axes-differ", "only parameters whose axes have different values"),
        ("with-findings", "only values that cause a finding"),
        ("since-download", "only what is not as in the last recorded download"),
        ("restart", "only values that take effect after a restart"),
        ("with-notes", "only values with a note"),
    ):
        sub.add_argument(f"--{name}", action="store_true", help=meaning)
    sub.add_argument(
        "--not-set",
        action="store_true",
        help="only active values that are not set, step by step of the guide",
    )
    json_option(sub)
    secrets_option(sub)
    sub = verbs.add(
        "note", "notes", "read and write notes about values, groups and the machine", writes="path"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument(
        "about",
        nargs="?",
        metavar="PARAM|group:KEY|machine",
        help="what it is about; without it all notes are listed",
    )
    sub.add_argument("text", nargs="?", help="the note; without it the present one is printed")
    sub.add_argument("--remove", action="store_true", help="remove the note")
    json_option(sub)


def _guide(verbs: Verbs) -> None:
    """Add the verb that leads through commissioning."""
    sub = verbs.add("guide", "guide", "the steps of commissioning in the manual's order: what is set, what is not, what is next",
                    writes="path output")  # fmt: skip
    sub.add_argument(
        "path", type=path_of, metavar="FILE", help="parameter file (.amp), or a family for its steps alone"
    )
    sub.add_argument(
        "step", nargs="?", metavar="STEP", help="only this step, by number or id, with its values"
    )
    sub.add_argument("--step", dest="at", metavar="STEP", help="the same")
    sub.add_argument("--next", action="store_true", help="the next value that is not set, with its help")
    sub.add_argument("--after", metavar="PARAM", help="with --next: the one that comes after this parameter")
    sub.add_argument(
        "--done", action="append", metavar="STEP", help="tick a step as done; it is kept in the file"
    )
    sub.add_argument("--not-done", action="append", metavar="STEP", help="take that tick away")
    sub.add_argument(
        "--keep-defaults", metavar="STEP", help="set what is not set in a step to the printed defaults"
    )
    sub.add_argument("-o", "--output", type=path_of, help="write the check list as .pdf, .html or .txt")
    json_option(sub)


def _axes(verbs: Verbs) -> None:
    """Add the verb about the axes of a file."""
    sub = verbs.add("axis", "axes", "list, compare, name, copy, swap, add and remove axes", writes="path")
    sub.add_argument("path", type=path_of)
    sub.add_argument(
        "operation",
        nargs="?",
        choices=AXIS_OPERATIONS,
        default="list",
        help="compare A B, copy FROM TO, swap A B, name A LETTER, type A TYPE, add LETTER [PLACE], remove A",
    )
    sub.add_argument(
        "arguments",
        nargs="*",
        metavar="ARGUMENT",
        help="an axis by itself or by its letter, a letter, a type",
    )
    json_option(sub)
    secrets_option(sub)


def _checks(verbs: Verbs) -> None:
    """Add the verbs about findings and fixes."""
    sub = verbs.add("validate", "checks", "range, choice, state and cross-parameter findings")
    sub.add_argument("paths", nargs="+", type=path_of, metavar="PATH", help="files, or folders of files")
    sub.add_argument(
        "--jobs", type=count, metavar="N", help="processes that share many files (one for each processor)"
    )
    sub.add_argument(
        "--rules", type=path_of, help="a builder's own rules instead of the rules.yaml beside the file"
    )
    sub.add_argument(
        "--why", action="store_true", help="explain each finding: its rule, the values, the page"
    )
    json_option(sub)
    sub = verbs.add(
        "fix",
        "fix",
        "make suggested fixes, all or none, and show what changed and what is left",
        writes="path",
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("--rule", metavar="ID", help="only fixes of this rule")
    sub.add_argument("--param", help="only fixes that set this parameter")
    sub.add_argument("--safe", action="store_true", help="only fixes that cannot change motion")
    sub.add_argument("--dry-run", action="store_true", help="change nothing, show what would change")
    json_option(sub)


def _comparing(verbs: Verbs) -> None:
    """Add the verbs that compare files."""
    sub = verbs.add(
        "diff", "comparing", "differences by parameter; A or B may be a control's address", writes="output"
    )
    sub.add_argument("a", type=file_or_address)
    sub.add_argument("b", type=file_or_address, nargs="?")
    for option, what in (
        ("--defaults", "compare with the printed defaults"),
        ("--backup", "compare with the backup beside the file"),
        ("--last-download", "compare with what the last recorded download put into a control"),
    ):
        sub.add_argument(option, action="store_true", help=what)
    sub.add_argument(
        "--axes", nargs=2, metavar=("AXIS", "OTHER"), help="compare one axis of A with another one of it"
    )
    sub.add_argument(
        "--base", type=file_or_address, help="what both come from: shows which side changed a value"
    )
    sub.add_argument(
        "--by-letter", action="store_true", help="match axes by their letters instead of their numbers"
    )
    sub.add_argument("-o", "--output", type=path_of, help="the report of them, as .pdf, .html, .xlsx or .csv")
    json_option(sub)
    secrets_option(sub)
    sub = verbs.add(
        "compare",
        "machines",
        "several machines side by side: a row for each value that differs",
        writes="output",
    )
    sub.add_argument(
        "paths", type=path_of, nargs="+", metavar="PATH", help="parameter files (.amp) of one family"
    )
    sub.add_argument("--everything", action="store_true", help="also what is the same on all of them")
    sub.add_argument(
        "--by-letter", action="store_true", help="match axes by their letters instead of their numbers"
    )
    sub.add_argument("-o", "--output", type=path_of, help="the table, as .pdf, .html, .xlsx or .csv")
    json_option(sub)
    sub = verbs.add("merge", "merging", "three-way merge by parameter", writes="output")
    for name in ("base", "ours", "theirs"):
        sub.add_argument(name, type=path_of)
    sub.add_argument("-o", "--output", type=path_of)
    sub.add_argument(
        "--take",
        metavar="[PARAM=]SIDE",
        action="append",
        default=[],
        help="settle conflicts: ours, theirs or base, for all or for one parameter",
    )
    sub.add_argument("--dry-run", action="store_true", help="write nothing, list the conflicts")
    sub.add_argument("--git", action="store_true", help="be git's merge driver: OUTPUT may be OURS")
    sub.add_argument("--window", action="store_true", help="merge in a window of the desktop program")
    json_option(sub)
    secrets_option(sub)


def _documents(verbs: Verbs) -> None:
    """Add the verbs about documentation and text formats."""
    sub = verbs.add(
        "report", "documentation", "documentation as .pdf, .html, .xlsx, .csv, .json or .txt", writes="output"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("-o", "--output", type=path_of, required=True)
    sub.add_argument("--sort", choices=("axis", "number", "group", "steps"), default="group")
    sub.add_argument("--changed-only", action="store_true")
    sub.add_argument(
        "--without",
        action="append",
        choices=("pictures", "motion", "exchanges", "signatures"),
        help="leave out a chapter; again for more",
    )
    sub.add_argument(
        "--language",
        choices=("en", "de"),
        default="en",
        help="language of the report's own words (default: en)",
    )
    sub.add_argument("--inactive", action="store_true", help="also what the control ignores on this machine")
    sub.add_argument(
        "--units",
        choices=("file", "metric", "inch", "both"),
        default="file",
        help="units of the figures; both: those of the file, with the other system's beside them (default: file)",
    )
    sub = verbs.add(
        "form", "documentation", "tables to fill in by hand, as .pdf, .html, .xlsx or .csv", writes="output"
    )
    sub.add_argument(
        "what", metavar="FAMILY|PATH", help="a control family, or a parameter file for what its machine has"
    )
    sub.add_argument("--machine", metavar="TYPE", help="machine type of the family")
    sub.add_argument("-o", "--output", type=path_of, required=True)
    sub = verbs.add(
        "sheet",
        "sheet",
        "the values to key in at a control by hand: in its own numbers, in a safe order, to tick and to read back",
        writes="output",
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("--against", required=True, type=file_or_address, metavar="OTHER",
                     help="what the control contains: a file, a kept copy, or the control's address")  # fmt: skip
    sub.add_argument(
        "-o", "--output", type=path_of, help="the sheet as .pdf, .html, .csv or .txt (default: as text here)"
    )
    sub.add_argument(
        "--tick",
        action="append",
        metavar="PARAM",
        help="remember that this value is keyed in; beside the file",
    )
    sub.add_argument("--untick", action="append", metavar="PARAM", help="forget that again")
    sub.add_argument("--check", type=path_of, metavar="LIST",
                     help="lines of number and what the screen shows, or the sheet's .csv filled in: compare exactly")  # fmt: skip
    json_option(sub)
    secrets_option(sub)
    sub = verbs.add(
        "import", "formats", "a new parameter file from a control's own text format", writes="output"
    )
    sub.add_argument("text", type=path_of, metavar="FILE")
    sub.add_argument("-o", "--output", type=path_of, required=True)
    sub.add_argument("--family", help="where the text does not show it")
    sub.add_argument("--format", help="where the text does not show it")
    sub.add_argument(
        "--keep-unknown", action="store_true", help="keep what is not understood, to be written back"
    )
    on_fault_option(sub)
    sub = verbs.add(
        "export", "formats", "a parameter file in a text format; the ending shows which", writes="output"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("-o", "--output", type=path_of, required=True)
    sub.add_argument("--format", help="where the ending does not show it")
    secrets_option(sub)


def _controls(verbs: Verbs) -> None:
    """Add the verbs about emulated controls, and what answers at an address."""
    sub = verbs.add("emulate", "control", "an emulated control that takes downloads and gives uploads")
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
        help="what was ordered with the control, where its family has options: axes=3 for a 9/PC",
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


def _several(sub: argparse.ArgumentParser, name: str, dest: str) -> None:
    """Add the addresses of one control or several, and what is for several only."""
    sub.add_argument(name, dest=dest, required=True, action="append", metavar="ADDRESS",
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
    sub.add_argument("path", type=path_of)
    _several(sub, "--with", "control")
    json_option(sub)
    secrets_option(sub)
    sub = verbs.add(
        "history", "record", "every recorded exchange with controls: who, when, which, digests, changes"
    )
    sub.add_argument(
        "path", type=path_of, metavar="PATH", help="a parameter file, or the folder of a project"
    )
    sub.add_argument("--show", type=count, metavar="N", help="exchange N of the list with what it changed")
    json_option(sub)


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


def _motion(verbs: Verbs) -> None:
    """Add the simulator and the demonstration."""
    sub = verbs.add("simulate", "motion", "check settings in motion", writes="output")
    sub.add_argument("path", type=path_of)
    sub.add_argument("scenario", nargs="?")
    sub.add_argument("--list", action="store_true",
                     help="list the scenarios of this family, its axes, and what can be set")  # fmt: skip
    sub.add_argument("--axis")
    sub.add_argument("--set", action="append", default=[], metavar="PARAM=VALUE", dest="assignments")
    sub.add_argument(
        "--units", metavar="SYSTEM", help="unit system of settings and result; default: that of the file"
    )
    sub.add_argument("-o", "--output", type=path_of)
    json_option(sub)
    sub = verbs.add(
        "picture", "picture", "draw zones, ramps, jog speeds, gears and gains of a file", writes="output"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("name", nargs="?", help="the picture; without one the pictures of the file are listed")
    sub.add_argument("--part", help="the axes (X,Y), the axis or the spindle; default: the first one")
    sub.add_argument("-o", "--output", type=path_of)
    json_option(sub)
    sub = verbs.add(
        "demo",
        "motion",
        "the whole job on the example machine: in the desktop program, or here without a display",
    )
    sub.add_argument(
        "--terminal", action="store_true", help="stay in the terminal even where there is a display"
    )


def _of_the_shell(verbs: Verbs) -> None:
    """Add the completion and the man page."""
    sub = verbs.add("completion", "completion", "print the completion script of a shell")
    sub.add_argument("shell", choices=("bash", "zsh", "fish"))
    verbs.add("man", "man_page", "print the man page")
