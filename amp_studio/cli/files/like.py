"""A new file like another file, or like one of the examples."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from amp_studio import MachineParameters
from amp_studio.cli.console import print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options
from amp_studio.files import MadeLike, examples, made_like, record_origin
from amp_studio.schema import unknown_name


def file_like(options: Options, axes: list[str]) -> MachineParameters:
    """Return the machine, and print what it does not have of the other;
    raises UsageError where they cannot be alike.
    """
    made = _made_like(options, axes)
    for text in _not_taken(made):
        print_remark(text)
    return MachineParameters(made.file)


def _made_like(options: Options, axes: list[str]) -> MadeLike:
    """Return a file like another file or an example; raises UsageError where they cannot be alike."""
    path = Path(options.like)
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
    if path.exists():
        record_origin(made.file, options.path, path)
    return made


def _example(name: str) -> Path:
    """Return the file of an example, named by its folder or file; raises UsageError."""
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
