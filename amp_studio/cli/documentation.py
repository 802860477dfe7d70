"""The verb that prints the documentation of a parameter file."""

from __future__ import annotations

import argparse

from amp_studio.dossier import write_dossier
from amp_studio.files import open_file, real_path
from amp_studio.report import Contents
from amp_studio.validate import RULES_FILE, rules_beside

from .console import note
from .output import check_replaced


def report_verb(options: argparse.Namespace) -> int:
    """Write the documentation of a file."""
    check_replaced(options.output, options.path, real_path(options.path).with_name(RULES_FILE))
    file = open_file(options.path).file
    own = rules_beside(options.path, file.schema)
    write_dossier(
        file,
        options.output,
        Contents(
            options.sort,
            options.changed_only,
            options.inactive,
            options.units,
            frozenset(options.without or ()),
        ),
        source=options.path,
        own=own,
        notify=note,
    )
    print(options.output)
    return 0
