"""Tables to fill in by hand, as .pdf, .html, .xlsx or .csv."""

from __future__ import annotations

from pathlib import Path

from amp_studio.cli import candidates
from amp_studio.cli.arguments import LANGUAGE, OUTPUT
from amp_studio.cli.console import is_family, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    VerbArgument(
        "what",
        metavar="FAMILY|PATH",
        help="a control family, or a parameter file for what its machine has",
        completes=candidates.family_first,
    ),
    VerbArgument(
        "--machine", metavar="TYPE", help="machine type of the family", completes=candidates.machines
    ),
    OUTPUT,
    LANGUAGE,
    writes=("output",),
    sections=("families",),
    examples=("amp-studio form num -o tables.pdf", "amp-studio form MILL_1394.amp -o form.html"),
)


def run(options: Options) -> int:
    """Write tables to fill in by hand."""
    from amp_studio import new
    from amp_studio.report import form_paper, write_paper

    if is_family(options.what):
        file, everything = new(options.what, options.machine).file, True
    else:
        if options.machine is not None:
            raise UsageError("--machine belongs to a family; a file has its own machine type")
        path = Path(options.what)
        check_replaced(options.output, path)
        file, everything = opened(path).file, False
    write_paper(
        form_paper(file, everything=everything, language=options.language), options.output, print_remark
    )
    print(options.output)
    return 0
