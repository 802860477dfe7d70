"""The verb that makes suggested fixes."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import nullcontext
from difflib import get_close_matches
from typing import Any

from amp_studio.files import Document, ParameterFile, describe
from amp_studio.report import finding_text
from amp_studio.schema import (
    MASKED,
    Parameter,
    Value,
    addresses_meant,
    show_value,
    write_value,
)
from amp_studio.validate import SEVERITIES, Finding, Fixed, Validator, apply_fixes, rules_beside

from .console import note, print_json
from .errors import UsageError

GENERAL_RULES = ("schema.range", "schema.choice", "schema.unknown", "schema.unset")
"""What findings belong to that no rule of a family or of a builder says."""


def fix_verb(options: argparse.Namespace) -> int:
    """Make suggested fixes, all or none; 1 where errors are left."""
    dry = options.dry_run
    with nullcontext(Document.view(options.path)) if dry else Document.open(options.path) as document:
        file = document.file
        validator = Validator(file, rules_beside(options.path, file.schema))
        wanted = _wanted(validator, options)
        validator.run()
        done = apply_fixes(validator, wanted)
        if done and not dry:
            document.save("fix")
    findings = validator.findings()
    left = Counter(finding.severity for finding in findings)
    if options.json:
        print_json({
            "file": str(options.path),
            "changes": [_json(file, fixed) for fixed in done],
            "left": {"errors": left["error"], "warnings": left["warning"], "advice": left["advice"]},
            "dry_run": dry,
        })  # fmt: skip
    else:
        print("\n".join(_lines(options, file, done, findings)))
    if not done:
        note(_nothing(options, validator))
    return int(left["error"] > 0)


def _wanted(validator: Validator, options: argparse.Namespace) -> Callable[[Finding], bool]:
    """Return what tells whether the fix of a finding is asked for; raises UsageError for an unknown rule or parameter."""
    rules = {*GENERAL_RULES, *(rule.id for rule in (*validator.file.schema.rules, *validator.own.rules))}
    if options.rule is not None and options.rule not in rules:
        raise UsageError(f"Unknown rule '{options.rule}'.{_nearest(options.rule, rules)}")
    named = None if options.param is None else addresses_meant(validator.file.evaluation, options.param)

    def wanted(finding: Finding) -> bool:
        return (
            options.rule in (None, finding.rule)
            and (finding.safe or not options.safe)
            and (named is None or any(repair.address in named for repair in finding.repairs))
        )

    return wanted


def _nearest(text: str, names: Collection[str]) -> str:
    """Return a sentence that names what may be meant; nothing where no name is like it."""
    near = get_close_matches(text.strip().partition("@")[0], names, 3, 0.5)
    return f" Nearest: {', '.join(near)}." if near else ""


def _nothing(options: argparse.Namespace, validator: Validator) -> str:
    """Say that there was nothing to fix, and what could be fixed otherwise."""
    others = sorted({finding.rule for finding in validator.findings() if finding.repairs})
    said = f"{options.path}: nothing to fix"
    return said + (f" with these options; there are fixes of {', '.join(others)}" if others else "")


def _lines(
    options: argparse.Namespace, file: ParameterFile, done: Sequence[Fixed], findings: Sequence[Finding]
) -> Iterator[str]:
    """Yield what was changed, the errors that are left, and how many findings."""
    for fixed in done:
        parameter, change = file.schema.parameters[fixed.change.address[0]], fixed.change
        yield (f"{describe(file, change.address)}: {show_value(parameter, change.old)} -> "
               f"{show_value(parameter, change.new)} ({fixed.rule})")  # fmt: skip
    yield from (finding_text(file, finding) for finding in findings if finding.severity == "error")
    names = {"error": "error", "warning": "warning", "advice": "recommendation"}
    counts = [(sum(f.severity == severity for f in findings), names[severity]) for severity in SEVERITIES]
    left = ", ".join(_counted(count, name) for count, name in counts)
    changed = _counted(len({fixed.change.address for fixed in done}), "value")
    yield f"{options.path}: {changed} {'would be ' if options.dry_run else ''}changed; left: {left}"


def _counted(count: int, name: str) -> str:
    return f"{count} {name}{'' if count == 1 else 's'}"


def _json(file: ParameterFile, fixed: Fixed) -> dict[str, Any]:
    address, old, new = fixed.change.address, fixed.change.old, fixed.change.new
    parameter = file.schema.parameters[address[0]]
    return {
        "param": file.machine_schema.short(address), "id": address[0], "instance": address[1],
        "old": _text(parameter, old), "new": _text(parameter, new), "rule": fixed.rule,
    }  # fmt: skip


def _text(parameter: Parameter, value: Value | None) -> str | None:
    return None if value is None else MASKED if parameter.secret else write_value(parameter, value)
