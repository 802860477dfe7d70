"""Send a file to a control, read it back and compare."""

from __future__ import annotations

from amp_studio.cli.arguments import EXPECT, JSON, PATH, TEXT, kept_in, several_controls
from amp_studio.cli.console import print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    PATH,
    *several_controls("--to", dest="to"),
    EXPECT,
    kept_in("beside the file"),
    JSON,
    VerbArgument(
        "--accept-errors", action="store_true", help="send a file that has errors; they are listed anyway"
    ),
    *TEXT,
    sections=("ADDRESS",),
    at_control=True,
    examples=(
        "amp-studio download MILL_1394.amp --to tcp://127.0.0.1:8193",
        (
            "amp-studio download MILL_1394.amp --to tcp://127.0.0.1:8193 --to tcp://localhost:8193"
            " --stop-on-failure"
        ),
    ),
)


def run(options: Options) -> int:
    """Send a file to a control; 3 if that is not proved afterwards, 4 where it is not known what it
    contains.
    """
    from amp_studio import connect
    from amp_studio.cli.controls.by_hand import print_by_hand, ways_offered
    from amp_studio.cli.controls.endings import exchange_of, print_errors, print_outcome
    from amp_studio.cli.controls.fleet import check_fleet, download_to_several, is_fleet

    machine, path = opened(options.path, options), options.path
    errors = print_errors(machine)
    if errors and not options.accept_errors:
        raise UsageError(f"{path} has {errors}: nothing was sent (--accept-errors sends it anyway)")
    name = machine.schema.family.family
    check_fleet(options, options.to)
    with stop_requested() as stop, ways_offered(name, options.to[0]):
        if is_fleet(options, options.to):
            return download_to_several(options, machine.file, exchange_of(options, path, stop))
        control = connect(options.to[0], progress=progress(), cancel=stop, notify=print_remark)
        # Accepted, or refused, above, where they were listed.
        outcome = control.download(machine, expect=options.expect, accept_errors=True, keep=options.keep)
        print_by_hand(name)
        return print_outcome(outcome)
