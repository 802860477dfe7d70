"""The cam profile of an axis: position, speed and acceleration, and a new one from points over time or over a
master.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.arguments import AXIS, DRY_RUN, JSON, OUTPUT, PATH, path_of
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_picture
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.sim import CamProfile

VERB = Verb(
    __doc__,
    PATH,
    AXIS.but(required=True, help="axis by its letter or number"),
    VerbArgument(
        "--points",
        type=path_of,
        metavar="FILE",
        help="points as CSV: time (s) or master (counts), and position (counts)",
    ),
    VerbArgument(
        "--scans", type=int, default=0, metavar="N", help="scans between two points; default: as few as fit"
    ),
    OUTPUT.but(required=False, help="the profile as a picture (.svg)"),
    DRY_RUN,
    JSON,
    writes=("path", "output"),
    examples=(
        "amp-studio cam LABEL_PRESS.amp --axis Y",
        "amp-studio cam LABEL_PRESS.amp --axis Y -o cam.svg",
    ),
)


def run(options: Options) -> int:
    """Show the cam of one axis, or make one of points; all or nothing."""
    from amp_studio import RangeError, edit
    from amp_studio.schema import InvalidValueError
    from amp_studio.sim import SimulationError, law_of, read_cam_points

    if options.scans < 0:
        raise UsageError("--scans is 1 or more")
    if options.output:
        check_picture(options.output, options.path, *filter(None, [options.points]))
    writes = bool(options.points) and not options.dry_run
    with edit(options.path, only_view=not writes) as machine:
        file = machine.file
        form = law_of(file.schema.family.family).cam
        if form is None:
            raise UsageError(f"{file.schema.family.name} has no cams that are printed")
        axis = machine.axis(options.axis)
        try:
            cam = (
                form.make(file, axis, read_cam_points(options.points), options.scans)
                if options.points
                else form.present(file, axis)
            )
            changes = file.set_checked(cam.settings)
        except (SimulationError, RangeError, InvalidValueError) as error:
            raise UsageError(f"{error}; nothing was changed" if writes else str(error)) from None
        if writes and changes:
            machine.save(verb="cam")
    if options.output:
        _draw(options, cam)
    _show(options, cam, len(changes))
    return 0


def _draw(options: Options, cam: CamProfile) -> None:
    """Write the picture of the cam."""
    from amp_studio.drawing import picture_svg
    from amp_studio.files import write_atomic
    from amp_studio.sim import cam_picture

    write_atomic(
        options.output, picture_svg(cam_picture(cam)).encode(), keep_backup=False, notify=print_remark
    )
    print_remark(f"Written: {options.output}")


def _show(options: Options, cam: CamProfile, changed: int) -> None:
    """Print the figures of the cam and what is doubtful about it."""
    from amp_studio.sim import cam_figures, value_text

    figures = cam_figures(cam)
    if options.json:
        print_json(
            {
                "axis": options.axis,
                "over": cam.over,
                "result": {name: {"value": v, "unit": u} for name, (v, u) in figures.items()},
                "doubts": list(cam.doubts),
                "changed": changed,
            }
        )
        return
    for name, (value, unit) in figures.items():
        assert value is not None  # a cam has all of its figures
        print(f"{name.replace('_', ' ')}: {value_text(value, unit)}")
    for doubt in cam.doubts:
        print(f"doubtful: {doubt}")
    if options.points:
        print(f"{options.path}: {changed} values {'would be ' if options.dry_run else ''}changed")
