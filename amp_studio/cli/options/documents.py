"""The verbs about documentation and text formats."""

from __future__ import annotations

from amp_studio.cli.arguments import (
    Verbs,
    count,
    file_or_address,
    json_option,
    language_option,
    on_fault_option,
    path_of,
    secrets_option,
    text_options,
)


def add(verbs: Verbs) -> None:
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
    language_option(sub)
    sub.add_argument("--inactive", action="store_true", help="also what the control ignores on this machine")
    sub.add_argument(
        "--units",
        choices=("file", "metric", "inch", "both"),
        default="file",
        help="units of the figures; both: those of the file, with the other system's beside them (default: file)",
    )
    sub.add_argument("--paper", choices=("a4", "letter"), default="a4", help="paper of a PDF (default: a4)")
    text_options(sub)
    sub = verbs.add(
        "form", "documentation", "tables to fill in by hand, as .pdf, .html, .xlsx or .csv", writes="output"
    )
    sub.add_argument(
        "what", metavar="FAMILY|PATH", help="a control family, or a parameter file for what its machine has"
    )
    sub.add_argument("--machine", metavar="TYPE", help="machine type of the family")
    sub.add_argument("-o", "--output", type=path_of, required=True)
    language_option(sub)
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
    language_option(sub)
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
    sub.add_argument("--family", help="control family, where the text does not show it")
    sub.add_argument("--format", help="format of the text, where it does not show it")
    sub.add_argument(
        "--keep-unknown", action="store_true", help="keep what is not understood, to be written back"
    )
    sub.add_argument("--machine", help="machine type, where the text shall not decide")
    sub.add_argument("--listing", type=count, default=0, metavar="N",
                     help="which of several listings in one text, counted from 1; without it the last one")  # fmt: skip
    on_fault_option(sub)
    json_option(sub)
    sub = verbs.add(
        "export", "formats", "a parameter file in a text format; the ending shows which", writes="output"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("-o", "--output", type=path_of, required=True)
    sub.add_argument("--format", help="format of the text, where the ending of OUTPUT does not show it")
    json_option(sub)
    secrets_option(sub)
    text_options(sub)
