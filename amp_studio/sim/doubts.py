"""What is wrong or doubtful about the values that a simulated axis was made of: shown with the result,
not refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from amp_studio.files import ParameterFile
from amp_studio.guide import present
from amp_studio.schema import Address
from amp_studio.validate import Finding, Validator

_MAX_LISTED = 8
"""Findings that are listed one by one."""


def doubts(file: ParameterFile, read: Iterable[Address], overridden: Iterable[str] = ()) -> tuple[str, ...]:
    """Return a sentence for each value that is outside its range, inactive or not set,
    and for a file with errors.

    ``read`` are the addresses that the axis was made of; those in ``overridden`` came from elsewhere.
    """
    replaced = frozenset(overridden)
    # An overridden value is not the file's: what is wrong with the file's does not matter to the result.
    own_ids = file.schema.parameters.keys() - replaced
    addresses = dict.fromkeys(address for address in read if address[0] in own_ids)
    validator = Validator(file)
    own = [f for f in _errors(validator.run()) if not addresses.keys().isdisjoint(f.addresses)]
    doubts_of_findings = [finding.message for finding in own[:_MAX_LISTED]]
    left = _errors(present(validator, validator.findings()).findings)
    # Those that are shown, as `validate` counts them: most that follow from an earlier error are not.
    others = len(own[_MAX_LISTED:]) + sum(finding not in own for finding in left)
    if others:
        doubts_of_findings.append(
            f"The file has {others} other error{'s' if others > 1 else ''}: validate it before this result is"
            " trusted"
        )
    return (*doubts_of_findings, *_states(file, addresses))


def _errors(findings: Iterable[Finding]) -> list[Finding]:
    return [finding for finding in findings if finding.severity == "error"]


def _states(file: ParameterFile, addresses: Iterable[Address]) -> Iterator[str]:
    """Yield what was read and is inactive, then what is not set."""
    not_set = []
    for address in addresses:
        name = file.machine_schema.named(address)
        state = file.evaluation.state(address)
        if address not in file.values:
            # An optional one that is not set is a choice: the control has a meaning for it.
            if state.is_active and not file.schema.parameters[address[0]].optional:
                not_set.append(name)
        elif not state.is_active:
            why = f": {state.why}" if state.why else ""
            yield f"{name} is inactive, and the simulation used it{why}"
    if not_set:
        yield f"Not set, and simulated as if there were none: {', '.join(not_set)}"
