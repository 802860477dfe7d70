"""Make suggested fixes, all or none, and show what changed and what is left."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import DRY_RUN, JSON, PATH
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Parameter, Value
    from amp_studio.validate import Finding, Fixed, Validator

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument("--rule", metavar="ID", help="only fixes of this rule", completes=candidates.rules),
    VerbArgument("--param", help="only fixes that set this parameter", completes=candidates.parameters),
    VerbArgument("--safe", action="store_true", help="only fixes that cannot change motion"),
    DRY_RUN,
    JSON,
    writes=("path",),
    sections=("PARAM",),
    examples=("amp-studio fix MILL_1394.amp --dry-run", "amp-studio fix MILL_1394.amp --safe"),
)


def run(options: Options) -> int:
    """Make suggested fixes, all or none; 1 where errors are left."""
    from amp_studio import edit

    dry = options.dry_run
    # A dry run takes no lock: the file may be open in the window.
    with edit(options.path, only_view=dry) as machine:
        file, validator = machine.file, machine.validator()
        done = machine.fix(options.rule, param=options.param, safe=options.safe, validator=validator)
        if done and not dry:
            machine.save(verb="fix")
            # The saved file became the backup, which the findings are compared with.
            validator = machine.validator()
            validator.run()
    findings = validator.findings()
    left = Counter(finding.severity for finding in findings)
    if options.json:
        print_json(
            {
                "file": str(options.path),
                "changes": [_json(file, fixed) for fixed in done],
                "left": {"errors": left["error"], "warnings": left["warning"], "advice": left["advice"]},
                "dry_run": dry,
            }
        )
    else:
        print("\n".join(_lines(options, file, done, findings)))
    if not done:
        print_remark(_nothing_to_fix(options, validator))
    return int(left["error"] > 0)


def _nothing_to_fix(options: Options, validator: Validator) -> str:
    """Return that there was nothing to fix, and the rules that have fixes without these options."""
    others = _fixable(validator.findings())
    message = f"{options.path}: nothing to fix"
    return message + (f" with these options; there are fixes of {others}" if others else "")


def _fixable(findings: Sequence[Finding]) -> str:
    """Return the rules whose findings have a fix."""
    return ", ".join(sorted({finding.rule for finding in findings if finding.fix}))


def _doubtful(options: Options, findings: Sequence[Finding]) -> str:
    """Return the rules with doubtful fixes: without an option that chooses, all others were made."""
    # With an option that chooses, the others were not asked for.
    return "" if options.rule or options.param or options.safe else _fixable(findings)


def _change_line(file: ParameterFile, fixed: Fixed) -> str:
    """Return the line of one value that was changed, and by which rule."""
    from amp_studio.files import describe
    from amp_studio.schema import show_value

    change = fixed.change
    old, new = (
        show_value(file.schema.parameters[change.address[0]], value) for value in (change.old, change.new)
    )
    return f"{describe(file, change.address)}: {old} -> {new} ({fixed.rule})"


def _lines(
    options: Options, file: ParameterFile, done: Sequence[Fixed], findings: Sequence[Finding]
) -> Iterator[str]:
    """Yield what was changed, the errors that are left, and how many findings."""
    from amp_studio.report import alike, counted, same_finding_text
    from amp_studio.validate import SEVERITIES

    yield from map(partial(_change_line, file), done)
    for same in alike([finding for finding in findings if finding.severity == "error"]):
        yield same_finding_text(file, same)
    if doubtful := _doubtful(options, findings):
        yield (
            f"Not made, because another value is likely the cause: fixes of {doubtful}."
            " Check that value, or name the rule with --rule."
        )
    severities = Counter(finding.severity for finding in findings)
    left = ", ".join(counted(severities[severity], severity) for severity in SEVERITIES)
    changed = counted(len({fixed.change.address for fixed in done}), "value")
    yield f"{options.path}: {changed} {'would be ' if options.dry_run else ''}changed; left: {left}"


def _json(file: ParameterFile, fixed: Fixed) -> dict[str, Any]:
    """Return one value that was changed as ``--json`` lists it."""
    address, old, new = fixed.change.address, fixed.change.old, fixed.change.new
    parameter = file.schema.parameters[address[0]]
    return {
        "param": file.machine_schema.short(address),
        "id": address[0],
        "instance": address[1],
        "old": _text(parameter, old),
        "new": _text(parameter, new),
        "rule": fixed.rule,
    }


def _text(parameter: Parameter, value: Value | None) -> str | None:
    from amp_studio.schema import MASKED, write_value

    return None if value is None else MASKED if parameter.secret else write_value(parameter, value)
