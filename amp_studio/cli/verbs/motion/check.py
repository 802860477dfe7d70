"""Every scenario that a file allows: what of the machine in motion is good, and what is not."""

from __future__ import annotations

from amp_studio.cli.arguments import AXIS, JSON, LANGUAGE, OUTPUT, PATH, TEXT
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.motion.text import as_json, text
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb

VERB = Verb(
    __doc__,
    PATH,
    AXIS,
    OUTPUT.but(required=False, help="file to write: .pdf, .html"),
    LANGUAGE,
    JSON,
    *TEXT,
    writes=("output",),
    sections=("scenarios",),
    examples=("amp-studio check MILL_1394.amp", "amp-studio check MILL_1394.amp --axis X -o motion.html"),
)


def run(options: Options) -> int:
    """Check a file in motion: 1 where something is bad."""
    from amp_studio.motion_paper import PAPERS, write_check_paper

    if options.output:
        check_replaced(options.output, options.path)
        if options.output.suffix.lower() not in PAPERS:
            raise UsageError(f"{options.output}: a check is written as {' or '.join(PAPERS)}")
    machine = opened(options.path, options)
    file = machine.file
    checks = machine.check_motion(options.axis)
    if options.output:
        write_check_paper(
            file, options.path.name, checks, options.output, print_remark, language=options.language
        )
    if options.json:
        print_json(as_json(file, checks))
    else:
        print(text(file, checks))
    return int(any(check.verdict == "bad" for check in checks))
