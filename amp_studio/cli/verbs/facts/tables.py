"""The manual's tables: alarms, motors, codes; without one, list them."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, JSON
from amp_studio.cli.console import family, print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    FAMILY,
    VerbArgument("table", nargs="?", help="the table to print", completes=candidates.tables),
    JSON,
    sections=("families",),
    examples=("amp-studio tables 9pc", "amp-studio tables 9pc accdec-codes"),
)


def run(options: Options) -> int:
    """List the printed tables of a family, or print one."""
    from amp_studio.report import cells_of, table_lines
    from amp_studio.schema import unknown_name

    known = family(options.family).tables
    if options.table is not None and options.table not in known:
        raise UsageError(f"{unknown_name('table', options.table, known)}; without a name all are listed")
    chosen = list(known.values()) if options.table is None else [known[options.table]]
    if options.json:
        print_json(
            {
                "tables": [
                    {
                        "id": t.id,
                        "title": t.title,
                        "source": t.page,
                        "params": t.params,
                        "cells": cells_of(t),
                        "note": t.note,
                    }
                    for t in chosen
                ]
            }
        )
    elif options.table is None:
        width = max(map(len, known), default=0)
        for table in chosen:
            print(f"{table.id:{width}}  {table.title} (page {table.page})")
    else:
        (table,) = chosen
        print(f"{table.title} (page {table.page})", *table_lines(table), sep="\n")
        if table.params:
            print(f"Parameters: {', '.join(table.params)}")
    return 0
