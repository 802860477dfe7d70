"""Change values, all or none; the previous file becomes the backup."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import PATH
from amp_studio.cli.console import assignments, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import print_remarks
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "assignments",
        nargs="+",
        metavar="PARAM=VALUE",
        help="parameter and its new value",
        completes=candidates.assignments,
    ),
    VerbArgument("--force", action="store_true", help="take values out of range, and mark them"),
    writes=("path",),
    sections=("PARAM", "VALUE"),
    examples=(
        "amp-studio set MILL_1394.amp 1300=1.5",
        'amp-studio set MILL_1394.amp home.calibration@X="0.05 in" 1350=300',
        "amp-studio set MILL_1394.amp 1300=not-set",
        "amp-studio set MILL_1394.amp 1340==25.4/5000 1750='=Y*1.1'",
    ),
)


def run(options: Options) -> int:
    """Change values, all or none."""
    from amp_studio import RangeError, edit
    from amp_studio.files import now
    from amp_studio.report import state_name
    from amp_studio.schema import show_value

    with edit(options.path) as machine:
        file = machine.file
        notes: list[str] = []
        marks = dict(file.forced)
        by = f"on {now()} by 'set --force'" if options.force else ""
        try:
            changes = machine.set(assignments(options.assignments), force=by, notify=notes.append)
        except RangeError as error:
            raise UsageError(f"{error}; nothing was changed (--force takes it and marks it)") from None
        if changes or file.forced != marks:
            machine.save(verb="set --force" if options.force else "set")
        for message in notes:
            print_remark(message)
        print_remarks(machine.notes)
        if not changes:
            print_remark("no change")
        for change in changes:
            parameter = file.schema.parameters[change.address[0]]
            name = file.machine_schema.named(change.address)
            print(f"{name}: {show_value(parameter, change.old)} -> {show_value(parameter, change.new)}")
            state = file.evaluation.state(change.address)
            if not state.is_active:
                print_remark(f"{name} is inactive ({state_name(state.state)}): {state.why}")
    return 0
