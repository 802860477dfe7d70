"""A parameter file in a text format; the ending shows which."""

from __future__ import annotations

from amp_studio.cli.arguments import JSON, OUTPUT, PATH, SECRETS, TEXT
from amp_studio.cli.console import print_remark
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    PATH,
    OUTPUT,
    VerbArgument("--format", help="format of the text, where the ending of OUTPUT does not show it"),
    JSON,
    SECRETS,
    *TEXT,
    writes=("output",),
    sections=("FORMAT",),
    examples=("amp-studio export MILL_1394.amp -o mill.csv",),
)


def run(options: Options) -> int:
    """Write a parameter file in a text format."""
    from amp_studio.cli.accounts import print_account
    from amp_studio.report import counted

    check_replaced(options.output, options.path)
    machine = opened(options.path, options)
    account = machine.export(options.output, options.format, secrets=options.secrets, notify=print_remark)
    number = counted(len(machine.file.values), "value")
    print_account(options, machine, account, f"{account.format}, {account.written} of {number}")
    return 0
