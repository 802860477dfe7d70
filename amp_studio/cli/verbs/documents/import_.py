"""A new parameter file from a control's own text format."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, ON_FAULT, OUTPUT, count, path_of
from amp_studio.cli.console import print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_new, write_new
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    VerbArgument("text", type=path_of, metavar="FILE", help="a control's own text file"),
    OUTPUT,
    VerbArgument(
        "--family", help="control family, where the text does not show it", completes=candidates.families
    ),
    VerbArgument("--format", help="format of the text, where it does not show it"),
    VerbArgument(
        "--keep-unknown", action="store_true", help="keep what is not understood, to be written back"
    ),
    VerbArgument("--machine", help="machine type, where the text shall not decide"),
    VerbArgument(
        "--listing",
        type=count,
        default=0,
        metavar="N",
        help="which of several listings in one text, counted from 1; without it the last one",
    ),
    ON_FAULT,
    JSON,
    writes=("output",),
    sections=("families", "FORMAT"),
    examples=("amp-studio import values.csv -o imported.amp --family 9pc",),
)


def run(options: Options) -> int:
    """Make a parameter file of a text; nothing is written when a part of it cannot be read."""
    from amp_studio import import_text
    from amp_studio.cli.accounts import print_account
    from amp_studio.cli.out_of_range import settle_values
    from amp_studio.formats import FamilyNotGivenError, FormatError
    from amp_studio.report import counted

    check_new(options.output, "an import", options.text)
    notes: list[str] = []
    try:
        machine = import_text(
            options.text,
            options.family,
            format_key=options.format,
            keep_unknown=options.keep_unknown,
            machine=options.machine or "",
            listing=options.listing,
            notify=notes.append,
        )
    except FamilyNotGivenError as error:
        raise UsageError(f"{options.text}: {error} (name it with --family)") from None
    except FormatError as error:
        raise UsageError(f"{options.text}: {error}") from None
    for message in notes:
        print_remark(message)
    settle_values(machine.file, options.on_fault, "an import")
    # The machine of a report has its name with it; a control's text has none.
    write_new(machine, options.output, named=options.text.suffix.casefold() == ".pdf")
    account = machine.account
    assert account is not None  # of an imported text
    print_account(options, machine, account, counted(account.written, "value"), " ".join(notes))
    return 0
