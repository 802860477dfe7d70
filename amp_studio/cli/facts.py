"""Verbs about the facts of the families."""

from __future__ import annotations

import argparse
from typing import Any

from amp_studio.report import cells_of, counted, definition, one_line, page_of, table_lines
from amp_studio.schema import family_ids
from amp_studio.schema.nearest import unknown_name
from amp_studio.validate import calculate, calculators, shown_result

from .console import assignments, family, print_json
from .errors import UsageError


def families_verb(options: argparse.Namespace) -> int:
    """List the control families."""
    rows: list[dict[str, Any]] = []
    for family_id in family_ids():
        schema = family(family_id)
        values = max(len(schema.on(m.key).addresses) for m in schema.family.machines)
        rows.append(
            {
                "id": family_id,
                "name": schema.family.name,
                "parameters": len(schema.parameters),
                "values": values,
            }
        )
    if options.json:
        print_json({"families": rows})
    else:
        for row in rows:
            print(
                f"{row['id']:10} {row['name']:40} {counted(row['parameters'], 'parameter')}, {counted(row['values'], 'value')}"
            )
    return 0


def schema_verb(options: argparse.Namespace) -> int:
    """Print every parameter definition of a family."""
    schema = family(options.family)
    wanted = options.group and options.group.casefold()
    groups = [
        g for g in schema.groups if not wanted or wanted in map(str.casefold, (g.key, g.name, g.section))
    ]
    if not groups:
        raise UsageError(unknown_name("group", options.group, [g.name for g in schema.groups]))
    parameters = [p for g in groups for p in g.parameters]
    if options.json:
        print_json({"family": options.family, "signature": schema.signature,
                     "parameters": [definition(schema, p) for p in parameters]})  # fmt: skip
    else:
        for parameter in parameters:
            print(one_line(schema, parameter))
    return 0


def show_verb(options: argparse.Namespace) -> int:
    """Print one parameter as a person reads it."""
    schema = family(options.family)
    print(page_of(schema, options.param, options.machine))
    return 0


def tables_verb(options: argparse.Namespace) -> int:
    """List the printed tables of a family, or print one."""
    known = family(options.family).tables
    if options.table is not None and options.table not in known:
        raise UsageError(f"{unknown_name('table', options.table, known)}; without a name all are listed")
    chosen = list(known.values()) if options.table is None else [known[options.table]]
    if options.json:
        print_json({"tables": [{"id": t.id, "title": t.title, "source": t.page, "params": t.params,
                                "cells": cells_of(t), "note": t.note} for t in chosen]})  # fmt: skip
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


def calculate_verb(options: argparse.Namespace) -> int:
    """List the formulas of a family, describe one, or calculate it."""
    known = calculators(family(options.family).family.family)
    if options.formula is None:
        for calculator in known.values():
            print(f"{calculator.name}: {calculator.description.splitlines()[0]}")
        return 0
    if options.formula not in known:
        raise UsageError(f"{unknown_name('formula', options.formula, known)}; without a name all are listed")
    calculator = known[options.formula]
    if not options.arguments:
        print(calculator.description)
        for argument in calculator.arguments:
            default = f" (else {argument.default})" if argument.default is not None else ""
            print(f"  {argument.name}=…{f' {argument.example}' if argument.example else ''}{default}")
        return 0
    texts = dict(assignments(options.arguments, "NAME=VALUE"))
    print(shown_result(calculate(options.family, options.formula, texts)))
    return 0
