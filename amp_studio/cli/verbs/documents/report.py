"""Documentation as .pdf, .html, .xlsx, .csv, .json or .txt."""

from __future__ import annotations

from amp_studio.cli.arguments import LANGUAGE, OUTPUT, PATH, TEXT, path_of
from amp_studio.cli.console import print_remark
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    PATH,
    OUTPUT,
    VerbArgument(
        "--sort",
        choices=("axis", "number", "group", "steps"),
        default="group",
        help="order of the values (default: group)",
    ),
    VerbArgument(
        "--changed-only",
        action="store_true",
        help="only values that differ from the printed default, or have none",
    ),
    VerbArgument(
        "--without",
        action="append",
        choices=("pictures", "motion", "power-up", "tuning", "exchanges", "signatures"),
        help="leave out a chapter; again for more",
    ),
    VerbArgument(
        "--check",
        action="store_true",
        help="with a chapter of what check finds in motion (every scenario is run)",
    ),
    VerbArgument(
        "--program",
        action="append",
        type=path_of,
        default=[],
        metavar="FILE.nc",
        help="with a chapter of a part program under the file; again for more",
    ),
    LANGUAGE,
    VerbArgument("--inactive", action="store_true", help="also what the control ignores on this machine"),
    VerbArgument(
        "--units",
        choices=("file", "metric", "inch", "both"),
        default="file",
        help=(
            "units of the figures; both: those of the file, with the other system's beside them (default:"
            " file)"
        ),
    ),
    VerbArgument("--paper", choices=("a4", "letter"), default="a4", help="paper of a PDF (default: a4)"),
    *TEXT,
    writes=("output",),
    examples=(
        "amp-studio report MILL_1394.amp -o mill.pdf",
        "amp-studio report MILL_1394.amp -o changed.csv --changed-only --sort axis",
    ),
)


def run(options: Options) -> int:
    """Write the documentation of a file; 1 where the project's template failed
    and the standard report was written.
    """
    from amp_studio.files import real_path
    from amp_studio.validate import RULES_FILE

    # The builder's rules are read for the report, though no argument names them.
    check_replaced(options.output, options.path, real_path(options.path).with_name(RULES_FILE))
    as_wanted = opened(options.path, options).report(
        options.output,
        sort=options.sort,
        changed_only=options.changed_only,
        inactive=options.inactive,
        units=options.units,
        language=options.language,
        without=frozenset(options.without or ()),
        paper=options.paper,
        check=options.check,
        programs=tuple(options.program),
        notify=print_remark,
    )
    print(options.output)
    return 0 if as_wanted else 1
