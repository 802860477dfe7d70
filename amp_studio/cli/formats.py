"""Verbs that read and write the text formats of controls and their tools."""

from __future__ import annotations

import argparse

from amp_studio.files import ParameterFile
from amp_studio.formats import (
    Account,
    FamilyNotGivenError,
    account_json,
    account_lines,
    export_file,
    import_file,
)
from amp_studio.report.wording import counted
from amp_studio.schema import UnknownFamilyError

from .console import note, print_json
from .errors import UsageError
from .opened import opened
from .out_of_range import settle_values
from .output import check_new, check_replaced, write_new


def import_verb(options: argparse.Namespace) -> int:
    """Make a parameter file of a text; nothing is written when a part of it cannot be meant."""
    check_new(options.output, "an import", options.text)
    accounts: list[Account] = []
    notes: list[str] = []
    try:
        file = import_file(
            options.text,
            options.family,
            format_key=options.format,
            keep_unknown=options.keep_unknown,
            machine=options.machine or "",
            listing=options.listing,
            notify=notes.append,
            take_account=accounts.append,
        )
    except FamilyNotGivenError as error:
        raise UsageError(f"{options.text}: {error} (name it with --family)") from None
    except UnknownFamilyError as error:
        raise UsageError(str(error)) from None
    except ValueError as error:
        raise UsageError(f"{options.text}: {error}") from None
    for message in notes:
        note(message)
    settle_values(file, options.on_fault, "an import")
    write_new(file, options.output)
    (account,) = accounts
    _print_account(options, file, account, counted(account.written, "value"), " ".join(notes))
    return 0


def export_verb(options: argparse.Namespace) -> int:
    """Write a parameter file in a text format."""
    check_replaced(options.output, options.path)
    file = opened(options.path, options)
    export = export_file(file, options.output, options.format, note, secrets=options.secrets)
    number = counted(len(file.values), "value")
    _print_account(
        options, file, export.account, f"{export.format.title}, {export.account.written} of {number}"
    )
    return 0


def _print_account(
    options: argparse.Namespace, file: ParameterFile, account: Account, written: str, named: str = ""
) -> None:
    """Print what went across, and name what did not."""
    if options.json:
        print_json(account_json(file, account))
        return
    for line in account_lines(file, account, named):
        note(line)
    print(f"{options.output}: {written}")
