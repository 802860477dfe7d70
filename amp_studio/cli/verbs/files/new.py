"""A new parameter file with the family's defaults."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, MACHINE, PATH
from amp_studio.cli.console import family
from amp_studio.cli.output import check_new, write_new
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    FAMILY,
    PATH,
    MACHINE,
    VerbArgument(
        "--axes", help="axis names in order, with commas; where axes are in groups, X.2 is X of group 2"
    ),
    VerbArgument(
        "--like",
        metavar="FILE|EXAMPLE",
        help=(
            "with the values of this file or example, except what was measured on that machine, and passwords"
        ),
        completes=candidates.example_names,
    ),
    writes=("path",),
    sections=("families",),
    examples=(
        "amp-studio new 9pc lathe.amp --machine lathe --axes X,Z,S",
        "amp-studio new 9pc second.amp --like mill-1394 --axes X,Y,Z,S",
    ),
)


def run(options: Options) -> int:
    """Make a parameter file with the family's defaults."""
    from amp_studio import new
    from amp_studio.cli.files.like import file_like
    from amp_studio.report import counted

    schema = family(options.family)
    axes = [a.strip() for a in options.axes.split(",")] if options.axes else []
    check_new(options.path, "a new file")
    if options.like:
        machine = file_like(options, axes)
    else:
        machine = new(options.family, options.machine, axes, options.path.stem)
    write_new(machine, options.path)
    number = counted(len(machine.file.values), "value")
    print(f"{options.path}: {schema.family.name}, {machine.file.machine}, {number}")
    return 0
