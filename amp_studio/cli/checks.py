"""Verbs that check and print parameter files."""

from __future__ import annotations

import argparse
from typing import Any

from amp_studio.files import open_file
from amp_studio.report import finding_json, finding_text, suppressed_text, why_parts, why_text, write_report
from amp_studio.validate import Finding, Validator, explain, read_builder_rules, rules_beside

from .console import print_json


def validate_verb(options: argparse.Namespace) -> int:
    """Check files; 1 where there are errors."""
    if options.rules:
        options.rules.read_bytes()  # a file that is not there is a slip of the hand, one that is wrong a finding
    documents, errors = [], 0
    for path in options.paths:
        file = open_file(path).file
        own = (
            read_builder_rules(options.rules, file.schema)
            if options.rules
            else rules_beside(path, file.schema)
        )
        validator = Validator(file, own)
        findings = validator.run()
        counts = {s: sum(f.severity == s for f in findings) for s in ("error", "warning", "advice")}
        errors += counts["error"]
        documents.append({"file": str(path), "errors": counts["error"], "warnings": counts["warning"],
                          "advice": counts["advice"], "findings": [_json(validator, f, options.why) for f in findings],
                          "suppressed": [finding_json(file, s.finding) | {"by": s.suppression.by, "reason": s.suppression.reason}
                                         for s in validator.suppressed]})  # fmt: skip
        if not options.json:
            for finding in findings:
                print(finding_text(file, finding))
                if options.why:
                    print(why_text(file, finding, explain(validator, finding)))
            for left in validator.suppressed:
                print(suppressed_text(file, left))
            told = (
                f"{counts['error']} errors, {counts['warning']} warnings, {counts['advice']} pieces of advice"
            )
            print(f"{path}: {told}" + (f", {n} suppressed" if (n := len(validator.suppressed)) else ""))
    if options.json:
        print_json(documents[0] if len(documents) == 1 else {"files": documents})
    return 1 if errors else 0


def _json(validator: Validator, finding: Finding, with_why: bool) -> dict[str, Any]:
    found = finding_json(validator.file, finding)
    if with_why:
        parts = why_parts(validator.file, finding, explain(validator, finding))
        found["why"] = [{"title": title, "text": text} for title, text, _ in parts]
    return found


def report_verb(options: argparse.Namespace) -> int:
    """Write the documentation of a file."""
    file = open_file(options.path).file
    own = rules_beside(options.path, file.schema)
    write_report(
        file,
        options.output,
        sort=options.sort,
        changed_only=options.changed_only,
        source=options.path,
        own=own,
    )
    print(options.output)
    return 0
