"""Verbs that read and write the text formats of controls and their tools."""

from __future__ import annotations

import argparse

from amp_studio.files import secret_values
from amp_studio.formats import FamilyNotGivenError, export_file, import_file
from amp_studio.report.wording import counted
from amp_studio.schema import UnknownFamilyError, written

from .console import note
from .errors import UsageError
from .opened import opened
from .out_of_range import settle_values
from .output import check_new, check_replaced, write_new


def import_verb(options: argparse.Namespace) -> int:
    """Make a parameter file of a text; nothing is written when a part of it cannot be meant."""
    check_new(options.output, "an import", options.text)
    try:
        file = import_file(
            options.text,
            options.family,
            format_key=options.format,
            keep_unknown=options.keep_unknown,
            machine=options.machine or "",
            listing=options.listing,
            notify=note,
        )
    except FamilyNotGivenError as error:
        raise UsageError(f"{options.text}: {error} (name it with --family)") from None
    except UnknownFamilyError as error:
        raise UsageError(str(error)) from None
    except ValueError as error:
        raise UsageError(f"{options.text}: {error}") from None
    settle_values(file, options.on_fault, "an import")
    if file.unknown:
        note(f"kept without knowing it: {', '.join(file.unknown)}")
    write_new(file, options.output)
    print(f"{options.output}: {counted(len(file.values), 'value')}")
    return 0


def export_verb(options: argparse.Namespace) -> int:
    """Write a parameter file in a text format."""
    check_replaced(options.output, options.path)
    file = opened(options.path)
    for key in file.unknown:
        note(f"{key} is not known to this schema")
    hidden = [a for a in file.values if file.evaluation.state(a).state == "hidden"]
    if hidden:
        which = f"{written(hidden[0])} among them" if len(hidden) > 1 else written(hidden[0])
        verb = "do" if len(hidden) > 1 else "does"
        note(f"{counted(len(hidden), 'value')} {verb} not exist for this configuration, {which}")
    chosen = export_file(file, options.output, options.format, note, secrets=options.secrets)
    left_out = [] if options.secrets else secret_values(file)
    if left_out:
        which = f"{written(left_out[0])} among them" if len(left_out) > 1 else written(left_out[0])
        verb = "are" if len(left_out) > 1 else "is"
        note(f"{counted(len(left_out), 'secret value')} {verb} left out, {which} (--secrets writes all)")
    print(f"{options.output}: {chosen.title}, {counted(len(file.values) - len(left_out), 'value')}")
    return 0
