"""The verbs that print the documentation of a parameter file."""

from __future__ import annotations

import argparse
from pathlib import Path

from amp_studio.dossier import write_report
from amp_studio.files import new_file, real_path
from amp_studio.report import Contents
from amp_studio.validate import RULES_FILE, rules_beside

from .console import is_family, note
from .errors import UsageError
from .opened import opened
from .output import check_replaced


def report_verb(options: argparse.Namespace) -> int:
    """Write the documentation of a file; 1 where the project's template failed and the standard report was written."""
    check_replaced(options.output, options.path, real_path(options.path).with_name(RULES_FILE))
    file = opened(options.path, options)
    own = rules_beside(options.path, file.schema)
    as_wanted = write_report(
        file,
        options.output,
        Contents(
            options.sort,
            options.changed_only,
            options.inactive,
            options.units,
            options.language,
            frozenset(options.without or ()),
            options.paper,
        ),
        source=options.path,
        own=own,
        notify=note,
    )
    print(options.output)
    return 0 if as_wanted else 1


def form_verb(options: argparse.Namespace) -> int:
    """Write tables to fill in by hand."""
    from amp_studio.report.form import form_paper
    from amp_studio.report.paper import write_paper

    if is_family(options.what):
        file, everything = new_file(options.what, options.machine), True
    else:
        if options.machine is not None:
            raise UsageError("--machine belongs to a family; a file has its own machine type")
        path = Path(options.what)
        check_replaced(options.output, path)
        file, everything = opened(path), False
    write_paper(form_paper(file, everything=everything, language=options.language), options.output, note)
    print(options.output)
    return 0
