"""Put back what a control contained before a download or a restore, byte for byte."""

from __future__ import annotations

from amp_studio.cli.arguments import EXPECT, TO, kept_in, path_of
from amp_studio.cli.console import print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    VerbArgument(
        "copy",
        type=path_of,
        metavar="COPY",
        help="NAME.before-STAMP.img, which is compared with the digest beside it, or the .amp of that name",
    ),
    TO,
    EXPECT,
    kept_in("beside the copy"),
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio restore uploaded.img --to tcp://127.0.0.1:8193",),
)


def run(options: Options) -> int:
    """Put back what a control has contained; codes as of a download."""
    from amp_studio import MachineParameters, connect
    from amp_studio.cli.controls.endings import print_errors, print_outcome
    from amp_studio.transfer.client import digest_path, open_copy

    path = options.copy
    copy = open_copy(path)
    if not copy.is_checked:
        print_remark(f"{digest_path(path)} is not there: {path.name} goes back unchecked")
    if copy.file is None:
        print_remark(f"{path} goes back byte for byte, but this program cannot read it: {copy.fault}")
    elif errors := print_errors(MachineParameters(copy.file, path)):
        if not copy.is_kept:
            raise UsageError(
                f"{path} has {errors}, and no image beside it proves that a control contained it: nothing was"
                " sent (download --accept-errors sends it anyway)"
            )
        print_remark(f"{path} goes back with {errors}, as the control contained it")
    with stop_requested() as stop:
        control = connect(options.to, progress=progress(), cancel=stop, notify=print_remark)
        outcome = control.restore(copy, expect=options.expect, keep=options.keep)
        return print_outcome(outcome)
