"""Draw zones, ramps, jog speeds, gears and gains of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.arguments import JSON, OUTPUT, PATH, TEXT
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_picture
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.drawing import Scene
    from amp_studio.files import ParameterFile

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument("name", nargs="?", help="the picture; without one the pictures of the file are listed"),
    VerbArgument("--part", help="the axes (X,Y), the axis or the spindle; default: the first one"),
    VerbArgument(
        "--speed",
        metavar="PERCENT",
        help="of the signals of the loops, in % of the rapid feedrate; default: 100",
    ),
    OUTPUT.but(required=False, help="file to write (.svg)"),
    JSON,
    *TEXT,
    writes=("output",),
    examples=(
        "amp-studio picture MILL_1394.amp",
        "amp-studio picture MILL_1394.amp travel --part X,Y -o travel.svg",
        "amp-studio picture MILL_1394.amp loop --part X --speed 25",
    ),
)


def run(options: Options) -> int:
    """List the pictures of a file, or draw one."""
    from amp_studio.drawing import scene_json, scene_svg
    from amp_studio.files import write_atomic
    from amp_studio.pictures import draw

    if options.output:
        check_picture(options.output, options.path)
    file = opened(options.path, options).file
    if options.name is None:
        if options.output:
            raise UsageError("Name a picture; amp-studio picture PATH lists them")
        return _list(file, as_json=options.json)
    try:
        part = options.part or ""
        scene = draw(file, options.name, f"{part}@{options.speed}" if options.speed else part)
    except KeyError as error:
        raise UsageError(str(error.args[0])) from None
    if options.output:
        write_atomic(options.output, scene_svg(scene).encode(), keep_backup=False, notify=print_remark)
        print_remark(f"Written: {options.output}")
    if options.json:
        print_json(scene_json(scene))
    elif not options.output:
        print(_described(scene))
    return 0


def _list(file: ParameterFile, *, as_json: bool) -> int:
    """Print the pictures that the file has, each with its parts."""
    from amp_studio.pictures import pictures_of

    pictures = pictures_of(file)
    if as_json:
        entries = [
            {"picture": p.name, "title": p.title, "parts": [name for _, name in p.parts if name]}
            for p in pictures
        ]
        print_json({"pictures": entries})
        return 0
    for picture in pictures:
        parts = ", ".join(name for _, name in picture.parts if name)
        print(f"{picture.name:13}{picture.title}{f': {parts}' if parts else ''}")
    return 0


def _described(scene: Scene) -> str:
    """Return what a picture is drawn from, a line for each value, and what it does not draw."""
    lines = [f"{scene.title}: {scene.subtitle}"]
    lines += [f"  {handle.label:52}{handle.value}" for handle in scene.handles if len(handle.drags) == 1]
    lines += [f"{'wrong' if note.wrong else 'note'}: {note.text}" for note in scene.notes]
    return "\n".join(lines)
