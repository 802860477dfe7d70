"""Verbs that check and print parameter files."""

from __future__ import annotations

import argparse

from amp_studio.files import open_file
from amp_studio.report import finding_json, finding_text, write_report
from amp_studio.schema import read_rules
from amp_studio.validate import Validator

from .console import print_json


def validate_verb(options: argparse.Namespace) -> int:
    """Check files; 1 where there are errors."""
    extra = read_rules(options.rules) if options.rules else ()
    documents, errors = [], 0
    for path in options.paths:
        file = open_file(path).file
        findings = Validator(file, extra).run()
        counts = {s: sum(f.severity == s for f in findings) for s in ("error", "warning", "advice")}
        errors += counts["error"]
        documents.append({"file": str(path), "errors": counts["error"], "warnings": counts["warning"],
                          "advice": counts["advice"], "findings": [finding_json(file, f) for f in findings]})  # fmt: skip
        if not options.json:
            for finding in findings:
                print(finding_text(file, finding))
            print(
                f"{path}: {counts['error']} errors, {counts['warning']} warnings, {counts['advice']} pieces of advice"
            )
    if options.json:
        print_json(documents[0] if len(documents) == 1 else {"files": documents})
    return 1 if errors else 0


def report_verb(options: argparse.Namespace) -> int:
    """Write the documentation of a file."""
    file = open_file(options.path).file
    write_report(
        file, options.output, sort=options.sort, changed_only=options.changed_only, source=options.path
    )
    print(options.output)
    return 0
