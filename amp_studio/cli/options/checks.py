"""The verbs about findings and fixes, and those that compare files."""

from __future__ import annotations

from amp_studio.cli.arguments import (
    Verbs,
    count,
    file_or_address,
    json_option,
    language_option,
    path_of,
    secrets_option,
    text_options,
)

CHECK_FORMATS = ("text", "json", "sarif", "github", "junit")
"""What ``validate`` prints; here, because help loads no room (a test compares them)."""


def add(verbs: Verbs) -> None:
    """Add the verbs that check and compare."""
    _checks(verbs)
    _comparing(verbs)


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
    sub.add_argument(
        "--no-cache", action="store_true", help="check every file, also one whose result is kept"
    )
    sub.add_argument(
        "--format",
        choices=CHECK_FORMATS,
        default="text",
        help="text, JSON, SARIF 2.1.0, GitHub's workflow commands, or JUnit's XML (default: text)",
    )
    sub.add_argument(
        "--json", dest="format", action="store_const", const="json", help="the same as --format json"
    )
    text_options(sub)
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
    language_option(sub)
    json_option(sub)
    secrets_option(sub)
    text_options(sub)
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
    language_option(sub)
    json_option(sub)
    text_options(sub)
    sub = verbs.add("merge", "merging", "three-way merge by parameter", writes="output")
    for name in ("base", "ours", "theirs"):
        sub.add_argument(name, type=path_of)
    sub.add_argument("-o", "--output", type=path_of, help="file to write; not needed with --dry-run")
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
    text_options(sub)
