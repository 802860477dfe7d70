"""A new parameter file with the family's defaults."""

from __future__ import annotations

from pathlib import Path

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, MACHINE, PATH
from amp_studio.cli.console import family, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_new, write_new
from amp_studio.cli.verb import Options, Verb, VerbArgument

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Iterator

    from amp_studio import MachineParameters
    from amp_studio.files import MadeLike

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
    from amp_studio.report import counted

    schema = family(options.family)
    axes = [a.strip() for a in options.axes.split(",")] if options.axes else []
    # First: what is printed about a file made like another one would mislead if none were written.
    check_new(options.path, "a new file")
    if options.like:
        machine = _file_like(options, axes)
    else:
        machine = new(options.family, options.machine, axes, options.path.stem)
    write_new(machine, options.path)
    number = counted(len(machine.file.values), "value")
    print(f"{options.path}: {schema.family.name}, {machine.file.machine}, {number}")
    return 0


def _file_like(options: Options, axes: list[str]) -> MachineParameters:
    """Return the machine, and print what it does not have of the other;
    raises UsageError where they cannot be alike.
    """
    from amp_studio import MachineParameters

    made = _made_like(options, axes)
    for text in _not_taken(made):
        print_remark(text)
    return MachineParameters(made.file)


def _made_like(options: Options, axes: list[str]) -> MadeLike:
    """Return a file like another file or an example; raises UsageError where they cannot be alike."""
    from amp_studio.cli.opened import opened
    from amp_studio.files import made_like, record_origin

    path = Path(options.like)
    # A file comes before an example of the same name: the user sees the file, and not the examples.
    source = opened(path if path.exists() else _example(options.like)).file
    if source.schema.family.family != options.family:
        raise UsageError(
            f"{options.like} is a file for {source.schema.family.name}, not for {options.family}"
        )
    if options.machine not in (None, source.machine):
        raise UsageError(f"{options.like} is a {source.machine}: a {options.machine} cannot be made like it")
    try:
        made = made_like(source, options.path.stem, axes)
    except ValueError as error:
        raise UsageError(str(error)) from None
    # An example is no earlier state of this machine: only a user's own file is named as its origin.
    if path.exists():
        record_origin(made.file, options.path, path)
    return made


def _example(name: str) -> Path:
    """Return the file of an example, named by its folder or file; raises UsageError."""
    from amp_studio.files import examples
    from amp_studio.schema import unknown_name

    paths = [example.path for example in examples()]
    known = {path.parent.name: path for path in paths} | {path.stem: path for path in paths}
    if name not in known:
        raise UsageError(unknown_name("file or example", name, [path.parent.name for path in paths]))
    return known[name]


def _not_taken(made: MadeLike) -> Iterator[str]:
    """Yield what a file that is made like another one does not have of it."""
    if made.left:
        names = ", ".join(p.name for p in made.left)
        yield f"Not taken over, because true of that machine alone: {names}"
    if made.new_axes:
        yield f"At the printed defaults, because the other file has no such axis: {', '.join(made.new_axes)}"
    if made.missing_axes:
        yield f"Axes of the other file that the new one does not have: {', '.join(made.missing_axes)}"
